//! Comparisons of two surfaces by points spread over them (see [`sample_surface`](super::sample_surface)). Each looks for
//! the nearest point of the other surface, in both directions.
use super::{MetricError, NearestPoints, SurfaceSamples, mean};
use crate::math::Vec3;

/// Half the sum of the two mean distances to the nearest point of the other, not squared, in the points' unit (*Leaps and
/// Bounds*, section on the GCNO data): ½ (mean of min |a − b| over A + that over B).
///
/// Two samplings of one surface are apart too: for n points each drawn at random over an area S, by ½ √(S/n).
///
/// # Errors
/// If and only if one of them is empty.
pub fn chamfer_distance(a: &[Vec3], b: &[Vec3]) -> Result<f64, MetricError> {
    let [there, back] = both_ways(a, b)?;
    let mean_distance = |near: &[(usize, f64)]| mean(near.iter().map(|near| near.1));
    Ok(0.5 * (mean_distance(&there) + mean_distance(&back)))
}

/// The harmonic mean of precision (the share of found points within `threshold` of a true one) and recall (that of true
/// points near a found one), from 0 to 1 (Knapitsch et al. 2017, *Tanks and Temples*, eq. 5). The threshold is a distance
/// in the points' unit; equal to it counts as within.
///
/// # Errors
/// If and only if one of them is empty.
pub fn f_score(found: &[Vec3], truth: &[Vec3], threshold: f64) -> Result<f64, MetricError> {
    let share =
        |near: Vec<(usize, f64)>| mean(near.iter().map(|near| f64::from(u8::from(near.1 <= threshold))));
    let [precision, recall] = both_ways(found, truth)?.map(share);
    let sum = precision + recall;
    Ok(if sum > 0.0 { 2.0 * precision * recall / sum } else { 0.0 })
}

/// The mean of |n · n′|, of the normal of each sample and that of the nearest one of the other surface, over both
/// directions in equal parts, from 0 to 1 (Mescheder et al. 2019, *Occupancy Networks*). The sign is left out as it is
/// there: [`good_points`](super::good_points) tells of normals that point the wrong way.
///
/// # Errors
/// If and only if one of them is empty, or has not as many normals as points.
pub fn normal_consistency(a: &SurfaceSamples, b: &SurfaceSamples) -> Result<f64, MetricError> {
    for samples in [a, b] {
        super::check_lengths(samples.normals.len(), samples.points.len())?;
    }
    let [there, back] = both_ways(&a.points, &b.points)?;
    let agreement = |near: &[(usize, f64)], own: &[Vec3], other: &[Vec3]| {
        mean(near.iter().zip(own).map(|(near, n)| n.dot(other[near.0]).abs()))
    };
    Ok(0.5 * (agreement(&there, &a.normals, &b.normals) + agreement(&back, &b.normals, &a.normals)))
}

/// What is nearest in `b` to each of `a`, and in `a` to each of `b`.
fn both_ways(a: &[Vec3], b: &[Vec3]) -> Result<[Vec<(usize, f64)>; 2], MetricError> {
    if a.is_empty() || b.is_empty() {
        return Err(MetricError::Empty);
    }
    Ok([NearestPoints::new(b).of(a), NearestPoints::new(a).of(b)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(z: f64) -> Vec<Vec3> {
        (0..100).map(|i| Vec3::new((i % 10) as f64, (i / 10) as f64, z)).collect()
    }

    #[test]
    fn distances_of_parallel_grids_are_theirs() {
        let (a, b) = (grid(0.0), grid(0.25));
        assert_eq!(chamfer_distance(&a, &b), Ok(0.25));
        assert_eq!((f_score(&a, &b, 0.25), f_score(&a, &b, 0.2)), (Ok(1.0), Ok(0.0)));
        // Half of one of them: the other's points in the rows 5 to 9 have 1 to 5 to go.
        assert_eq!(chamfer_distance(&a, &a[..50]), Ok(0.5 * 1.5));
        // All of the half is near, and six tenths of the whole.
        assert!((f_score(&a[..50], &a, 1.0).unwrap() - 2.0 * 0.6 / 1.6).abs() < 1e-15);
        assert_eq!(chamfer_distance(&a, &[]), Err(MetricError::Empty));
    }

    #[test]
    fn consistency_is_the_cosine_whatever_the_sign() {
        let with = |normal: Vec3| SurfaceSamples { points: grid(0.0), normals: vec![normal; 100] };
        let (z, tilted) = (with(Vec3::Z), with(Vec3::new(0.6, 0.0, -0.8)));
        assert!((normal_consistency(&z, &tilted).unwrap() - 0.8).abs() < 1e-12);
        assert_eq!(normal_consistency(&z, &z), Ok(1.0));
        let bare = SurfaceSamples { points: grid(0.0), normals: vec![] };
        assert!(normal_consistency(&z, &bare).is_err());
    }
}
