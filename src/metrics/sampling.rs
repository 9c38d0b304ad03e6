use super::MetricError;
use crate::data::{TriangleSoup, map_items};
use crate::math::{Vec3, area_vector, hashed};

/// Points spread evenly over a surface, with its unit normals there.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceSamples {
    pub points: Vec<Vec3>,
    pub normals: Vec<Vec3>,
}

/// `count` points of a soup's triangles, each part of the surface with as many as its share of the area, or one more or
/// less: laid end to end, the triangles are cut into `count` equal shares, each of which gives a point at random. The same
/// seed gives the same points. Triangles without area get none; overlapping ones get theirs each.
///
/// # Errors
/// If and only if the area of all triangles together is zero or not finite.
pub fn sample_surface(soup: &TriangleSoup, count: usize, seed: u64) -> Result<SurfaceSamples, MetricError> {
    let mut total = 0.0;
    let ends: Vec<f64> = (0..soup.len())
        .map(|t| {
            total += area_vector(soup.corners(t)).length();
            total
        })
        .collect();
    if !(total > 0.0 && total < f64::INFINITY) {
        return Err(MetricError::NoArea { triangles: soup.len() });
    }
    let random = |k: usize, dimension: u64| hashed([seed, k as u64, dimension]);
    let sample = |k: usize| {
        let at = total * ((k as f64 + random(k, 0)) / count as f64);
        // Rounding may lead past the last triangle that has an area.
        let t = ends.partition_point(|end| *end <= at).min(ends.partition_point(|end| *end < total));
        let [a, b, c] = soup.corners(t);
        // The square root spreads points evenly over a triangle.
        let (across, along) = (random(k, 1).sqrt(), random(k, 2));
        let point = a + across * ((b - a) + along * (c - b));
        (point, area_vector([a, b, c]).normalize_or_zero())
    };
    let (points, normals) = map_items(count, sample).into_iter().unzip();
    Ok(SurfaceSamples { points, normals })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle of area 3, one without area, and one of area 1 elsewhere.
    fn soup() -> TriangleSoup {
        let positions =
            vec![Vec3::ZERO, 3.0 * Vec3::X, 2.0 * Vec3::Y, 5.0 * Vec3::Z, Vec3::new(1.0, 0.0, 5.0)];
        let last = vec![Vec3::new(0.0, -2.0, 5.0)];
        TriangleSoup::new([positions, last].concat(), vec![[0, 1, 2], [0, 1, 1], [3, 4, 5]]).unwrap()
    }

    #[test]
    fn samples_are_shared_by_area_and_spread_evenly() {
        let samples = sample_surface(&soup(), 40_000, 7).unwrap();
        let (first, last): (Vec<Vec3>, Vec<Vec3>) = samples.points.iter().partition(|p| p.z < 1.0);
        assert_eq!((first.len(), last.len()), (30_000, 10_000));
        let mean = first.iter().sum::<Vec3>() / 30_000.0;
        // The standard deviation of the mean of x is √(1/2) / √30,000 = 0.004.
        assert!(mean.distance(Vec3::new(1.0, 2.0 / 3.0, 0.0)) < 0.016, "{mean}");
        assert!(first.iter().all(|p| p.x >= 0.0 && p.y >= 0.0 && p.x / 3.0 + p.y / 2.0 <= 1.0 + 1e-12));
        assert_eq!((samples.normals[0], samples.normals[39_999]), (Vec3::Z, -Vec3::Z));
    }

    #[test]
    fn the_seed_decides() {
        let sample = |seed| sample_surface(&soup(), 3000, seed).unwrap();
        assert_eq!(sample(1), sample(1));
        assert_ne!(sample(1), sample(2));
        assert_eq!(sample_surface(&soup(), 0, 1), Ok(SurfaceSamples::default()));
        let flat = TriangleSoup::new(vec![Vec3::X], vec![[0, 0, 0]]).unwrap();
        assert_eq!(sample_surface(&flat, 5, 1), Err(MetricError::NoArea { triangles: 1 }));
    }
}
