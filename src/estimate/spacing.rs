use super::EstimateError;
use super::neighbours::Neighbourhoods;
use super::sites::Sites;
use crate::data::Monitor;
use crate::math::Vec3;

/// The mean distance of each point from the `count` other places with points that are nearest to it, in the points' unit;
/// from as many as there are, and 0 if all points are in one place.
///
/// # Errors
/// If and only if there are no points or `monitor` cancels.
pub fn spacings(points: &[Vec3], count: usize, monitor: &dyn Monitor) -> Result<Vec<f64>, EstimateError> {
    if points.is_empty() {
        return Err(EstimateError::Empty);
    }
    let sites = Sites::find(points, &[]);
    let neighbourhoods = Neighbourhoods::find(&sites.points, &[], count, monitor)?;
    let mean = |i: usize| {
        let near = neighbourhoods.of(i);
        let sum: f64 = near.iter().map(|&j| sites.points[i].distance(sites.points[j as usize])).sum();
        sum / near.len().max(1) as f64
    };
    Ok(sites.spread((0..sites.points.len()).map(mean).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    #[test]
    fn copies_are_no_neighbours() {
        let line: Vec<Vec3> = (0..10).flat_map(|i| [f64::from(i) * Vec3::X; 3]).collect();
        let found = spacings(&line, 2, &Silent).unwrap();
        assert_eq!((found[0], found[1], found[15]), (1.5, 1.5, 1.0));
        assert_eq!(spacings(&[Vec3::ONE; 5], 2, &Silent), Ok(vec![0.0; 5]));
        assert_eq!(spacings(&[], 2, &Silent), Err(EstimateError::Empty));
    }
}
