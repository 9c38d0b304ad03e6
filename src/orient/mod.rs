//! Normals of clouds that have none: those that make the winding number consistent with itself. Faces of soups that run
//! either way: turned outward.
mod consistency;
mod schedule;
mod soup;
mod stochastic;

pub use consistency::{Bounded, ConsistencyConfig, consistent_area_vectors};
pub use schedule::Widths;
pub use soup::{FaceConfig, FaceMethod, OrientReport, orient_soup};
pub use stochastic::{LossWeights, StochasticConfig, stochastic_area_vectors};

use crate::data::{Monitor, OrientedCloud, Parts, PointCloud, Warning, WarningKind};
use crate::estimate::{self, EstimateConfig, EstimateError};
use crate::math::Vec3;
use consistency::watched_area_vectors;

/// How normals are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OrientMethod {
    /// Winding number normal consistency (Lin et al. 2024): all points at once.
    Consistency(ConsistencyConfig),
    /// Stochastic globally consistent normal orientation (the sGCNO of *Leaps and Bounds*): winding numbers that are 0 or 1.
    /// Some twenty times slower.
    Stochastic(StochasticConfig),
    /// Planes fitted to neighbours, oriented along a minimum spanning tree (Hoppe et al. 1992): a few times faster, but one
    /// wrong edge inverts all that hangs on it.
    Propagation,
}

impl Default for OrientMethod {
    fn default() -> Self {
        OrientMethod::Consistency(ConsistencyConfig::default())
    }
}

/// The cloud with normals, outward, and areas: those it lacks are estimated. A warning says so; another tells of points without
/// extent in space, for which nothing is outward: they take the method of propagation.
///
/// # Errors
/// If and only if the cloud is empty, `monitor` cancels, or the cloud has normals, but no areas, and all its points are in one
/// place.
pub fn orient(
    cloud: &PointCloud,
    method: &OrientMethod,
    monitor: &dyn Monitor,
) -> Result<(OrientedCloud, Vec<Warning>), EstimateError> {
    orient_watched(cloud, method, monitor, &|_| ())
}

/// [`orient`], which shows vectors along the normals to `watch` while they settle, if the method has such.
///
/// # Errors
/// As [`orient`].
// Not part of its caller, which the package for JavaScript loads sooner.
#[inline(never)]
pub fn orient_watched(
    cloud: &PointCloud,
    method: &OrientMethod,
    monitor: &dyn Monitor,
    watch: &dyn Fn(&[Vec3]),
) -> Result<(OrientedCloud, Vec<Warning>), EstimateError> {
    let config = EstimateConfig::default();
    let points = cloud.points();
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.9);
    let area_vectors = match method {
        _ if cloud.normals().is_some() || estimate::is_flat(points) => None,
        OrientMethod::Consistency(consistency) => {
            Some(watched_area_vectors(points, consistency, monitor, watch)?)
        }
        OrientMethod::Stochastic(stochastic) => Some(stochastic_area_vectors(points, stochastic, monitor)?),
        OrientMethod::Propagation => None,
    };
    let Some(area_vectors) = area_vectors else {
        monitor.begin(0.0, 1.0);
        return estimate::orient(cloud, &config, monitor);
    };
    // Where the field has no slope at all, nothing is better than anything else.
    let normals: Vec<Vec3> = area_vectors.iter().map(|v| v.try_normalize().unwrap_or(Vec3::Z)).collect();
    monitor.begin(0.9, 1.0);
    let given = (points.to_vec(), Some(normals), cloud.areas().map(<[f64]>::to_vec));
    let (with_normals, _) = PointCloud::cleaned(given.0, given.1, given.2)?;
    let oriented = estimate::complete(&with_normals, &config, monitor)?;
    Ok((oriented, vec![Warning::new(WarningKind::EstimatedNormals, points.len())]))
}
