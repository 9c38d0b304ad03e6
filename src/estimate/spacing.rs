use super::EstimateError;
use super::neighbours::Neighbourhoods;
use super::sites::Sites;
use crate::data::Monitor;
use crate::math::Vec3;
use std::f64::consts::PI;

/// How far the nearest neighbours of each point are, in the points' unit; 0 if all points are in one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Spacings {
    /// Their mean distances.
    pub means: Vec<f64>,
    /// Areas without regard to normals: π r² / k, r the distance of the k-th neighbour. They add up to that of the surface for
    /// points drawn at random; with four neighbours to 0.79 times that for a square grid and to 0.91 times for a hexagonal one.
    /// Points in one place share one.
    pub areas: Vec<f64>,
}

/// Spacings by the `count` other places nearest to each point, or as many as there are.
///
/// # Errors
/// If and only if there are no points or `monitor` cancels.
pub fn spacings(points: &[Vec3], count: usize, monitor: &dyn Monitor) -> Result<Spacings, EstimateError> {
    if points.is_empty() {
        return Err(EstimateError::Empty);
    }
    let sites = Sites::find(points, &[]);
    let neighbourhoods = Neighbourhoods::find(&sites.points, &[], count, monitor)?;
    let of_site = |i: usize| {
        let near = neighbourhoods.of(i);
        let distance = |j: &u32| sites.points[i].distance(sites.points[*j as usize]);
        let (count, reach) = (near.len().max(1) as f64, near.last().map_or(0.0, distance));
        (near.iter().map(distance).sum::<f64>() / count, PI * reach * reach / count)
    };
    let (means, areas) = (0..sites.points.len()).map(of_site).unzip();
    Ok(Spacings { means: sites.spread(means), areas: sites.share(areas) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    #[test]
    fn copies_are_no_neighbours() {
        let line: Vec<Vec3> = (0..10).flat_map(|i| [f64::from(i) * Vec3::X; 3]).collect();
        let found = spacings(&line, 2, &Silent).unwrap();
        assert_eq!((found.means[0], found.means[1], found.means[15]), (1.5, 1.5, 1.0));
        assert_eq!((found.areas[0], found.areas[15]), (2.0 * PI / 3.0, PI / 6.0));
        let one_place = Spacings { means: vec![0.0; 5], areas: vec![0.0; 5] };
        assert_eq!(spacings(&[Vec3::ONE; 5], 2, &Silent), Ok(one_place));
        assert_eq!(spacings(&[], 2, &Silent), Err(EstimateError::Empty));
    }

    #[test]
    fn areas_do_not_depend_on_how_regular_points_are() {
        let grid = |place: &dyn Fn(f64, f64) -> Vec3| -> Vec<Vec3> {
            (0..10_000).map(|i| place(f64::from(i % 100), f64::from(i / 100))).collect()
        };
        let square = grid(&|x, y| Vec3::new(x, y, 0.0));
        let hexagonal = grid(&|x, y| Vec3::new(x + 0.5 * (y % 2.0), 0.75f64.sqrt() * y, 0.0));
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            100.0 * (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let scattered: Vec<Vec3> = (0..10_000).map(|_| Vec3::new(random(), random(), 0.0)).collect();
        let cases = [(square, 1.0, PI / 4.0), (hexagonal, 0.75f64.sqrt(), 0.907), (scattered, 1.0, 1.0)];
        for (points, cell, expected) in cases {
            let sum: f64 = spacings(&points, 4, &Silent).unwrap().areas.iter().sum();
            // The border has neighbours on one side only.
            let ratio = sum / (10_000.0 * cell * expected);
            assert!(ratio > 0.99 && ratio < 1.05, "{ratio} for {expected}");
        }
    }
}
