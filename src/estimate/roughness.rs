//! How densely and how noisily a surface was sampled.
use super::EstimateError;
use super::curved::fit_height;
use super::sites::Sites;
use crate::bvh::{Nearest, PointTree};
use crate::data::{Monitor, fill_in_blocks};
use crate::math::{Vec3, fit_plane};
use std::f64::consts::PI;

/// Points that a surface is fitted to. On a bunny of 3,000 points without noise, 40 leave a fifth of the spacing, as curvature
/// changes; 16 leave a fifteenth.
const NEIGHBOURS: usize = 16;
/// Points that are looked at, spread over the cloud.
const LOOKED_AT: usize = 2000;
/// Numbers that a fitted quadratic surface takes from the deviations.
const TERMS: f64 = 6.0;

/// Medians over a cloud, in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// The edge of the square that a point has to itself.
    pub spacing: f64,
    /// Root mean square of the distances from a smooth surface, along its normal.
    pub noise: f64,
}

/// Spacing and noise of a cloud, from up to 2,000 of its points and the 15 nearest neighbours of each: a quadratic surface
/// takes their curvature out (Cazals & Pouget 2005), what it leaves is noise. Noise much wider than the spacing is
/// underestimated; points in one place count as one.
///
/// # Errors
/// If and only if the cloud is empty or `monitor` cancels.
pub fn roughness(points: &[Vec3], monitor: &dyn Monitor) -> Result<Roughness, EstimateError> {
    if points.is_empty() {
        return Err(EstimateError::Empty);
    }
    let found = Patches::new(&Sites::find(points, &[]).points).look_at(LOOKED_AT, monitor)?;
    let median = |mut values: Vec<f64>| {
        values.sort_unstable_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let (spacings, deviations) = found.into_iter().unzip();
    Ok(Roughness { spacing: median(spacings), noise: median(deviations) })
}

/// Noise around each point of a cloud, in its unit and order: the root mean square of the distances of it and its 15 nearest
/// neighbours from the quadratic surface that fits them best. Points in one place count as one.
///
/// # Errors
/// If and only if `monitor` cancels.
pub fn deviations(points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f64>, EstimateError> {
    let sites = Sites::find(points, &[]);
    let patches = Patches::new(&sites.points);
    let found = patches.look_at(sites.points.len(), monitor)?;
    let mut of_sites = vec![0.0; found.len()];
    patches.tree.items().iter().zip(found).for_each(|(site, (_, noise))| of_sites[*site as usize] = noise);
    Ok(sites.spread(of_sites))
}

/// Points and their neighbours.
struct Patches<'a> {
    points: &'a [Vec3],
    tree: PointTree,
}

impl Patches<'_> {
    fn new(points: &[Vec3]) -> Patches<'_> {
        Patches { points, tree: PointTree::new(points) }
    }

    /// Spacing and deviation at up to `most` points, evenly chosen, in the order of the tree.
    fn look_at(&self, most: usize, monitor: &dyn Monitor) -> Result<Vec<(f64, f64)>, EstimateError> {
        let count = self.points.len().min(most);
        let mut found = vec![(0.0, 0.0); count];
        let of_point = |k: usize, nearest: &mut Nearest| {
            let place = k * self.points.len() / count;
            let near = nearest.find(&self.tree, place, NEIGHBOURS);
            let reach = near.last().map_or(0.0, |n| n.0.sqrt());
            let patch: Vec<Vec3> = near.iter().map(|n| self.points[n.1 as usize]).collect();
            ((PI * reach * reach / patch.len() as f64).sqrt(), deviation(&patch, reach))
        };
        fill_in_blocks(&mut found, of_point, "neighbours", monitor)?;
        Ok(found)
    }
}

/// Root mean square of the distances of a point and those nearest to it, which follow, from the quadratic surface, or else the
/// plane, that fits them best.
fn deviation(patch: &[Vec3], reach: f64) -> f64 {
    let plane = fit_plane(patch);
    let across = plane.normal.cross(plane.tangent);
    let local: Vec<Vec3> = patch
        .iter()
        .map(|p| *p - patch[0])
        .map(|d| Vec3::new(d.dot(plane.tangent), d.dot(across), d.dot(plane.normal)))
        .collect();
    match fit_height(&local[1..], reach) {
        Some(height) if local.len() as f64 > TERMS => {
            let squares: f64 = local.iter().map(|p| (p.z - height.at(p.truncate())).powi(2)).sum();
            (squares / (local.len() as f64 - TERMS)).sqrt()
        }
        _ => plane.variances[0].max(0.0).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    /// Points on a sphere of radius 10, moved along their normals by up to `noise` either way.
    fn sphere(count: usize, noise: f64) -> Vec<Vec3> {
        let point = |i: usize| {
            let z = 1.0 - 2.0 * (i as f64 + 0.5) / count as f64;
            let (r, a) = ((1.0 - z * z).sqrt(), 2.399_963 * i as f64);
            let out = 2.0 * ((i as f64 * 12.9898).sin() * 43_758.545_3).rem_euclid(1.0) - 1.0;
            (10.0 + noise * out) * Vec3::new(r * a.cos(), r * a.sin(), z)
        };
        (0..count).map(point).collect()
    }

    #[test]
    fn spacing_and_noise_of_a_sphere_are_found() {
        for (count, noise) in [(2000, 0.0), (2000, 0.3), (20_000, 0.1), (20_000, 0.02)] {
            let found = roughness(&sphere(count, noise), &Silent).unwrap();
            let spacing = (400.0 * PI / count as f64).sqrt();
            assert!((found.spacing / spacing - 1.0).abs() < 0.15, "{count}: {} for {spacing}", found.spacing);
            // Uniformly distributed: a standard deviation of 1/√3.
            let expected = noise / 3f64.sqrt();
            let error = (found.noise - expected).abs();
            assert!(error < 0.1 * expected + 2e-3 * spacing, "{count}: {} for {expected}", found.noise);
        }
    }

    #[test]
    fn noise_is_found_where_it_is() {
        let mut points = sphere(4000, 0.0);
        let rough = sphere(4000, 0.2);
        points.iter_mut().zip(rough).filter(|(p, _)| p.z > 0.0).for_each(|(p, q)| *p = q);
        points.extend_from_within(..100);
        let found = deviations(&points, &Silent).unwrap();
        let mean = |wanted: &dyn Fn(f64) -> bool| {
            let chosen: Vec<f64> =
                points.iter().zip(&found).filter(|(p, _)| wanted(p.z)).map(|(_, noise)| *noise).collect();
            chosen.iter().sum::<f64>() / chosen.len() as f64
        };
        let (upper, lower) = (mean(&|z| z > 2.0), mean(&|z| z < -2.0));
        assert!((upper / (0.2 / 3f64.sqrt()) - 1.0).abs() < 0.1 && lower < 2e-3, "{upper} and {lower}");
        assert_eq!(found[..100], found[4000..]);
        assert!(deviations(&[], &Silent).unwrap().is_empty());
    }

    #[test]
    fn copies_do_not_count() {
        let once = sphere(1500, 0.1);
        let often: Vec<Vec3> = (0..20).flat_map(|_| once.clone()).collect();
        assert_eq!(roughness(&often, &Silent), roughness(&once, &Silent));
    }

    #[test]
    fn any_points_have_a_roughness() {
        assert_eq!(roughness(&[], &Silent), Err(EstimateError::Empty));
        for points in
            [vec![Vec3::ONE], vec![Vec3::ONE; 100], (0..50).map(|i| f64::from(i) * Vec3::X).collect()]
        {
            let found = roughness(&points, &Silent).unwrap();
            assert!(found.noise < 1e-9 && found.spacing.is_finite(), "{found:?}");
        }
    }
}
