//! What a raw cloud lacks before it has a winding field: areas, normals, and which way the normals point.
mod areas;
mod curved;
mod neighbours;
mod normals;
mod orientation;
mod roughness;
mod sites;
mod spacing;
mod voronoi;

pub use areas::{AreaMethod, areas, complete_with};
pub use roughness::{Roughness, deviations, roughness};
pub use spacing::{Spacings, spacings};

use crate::data::{Cancelled, CloudError, Monitor, OrientedCloud, Parts, PointCloud, Warning, WarningKind};
use crate::math::{Vec3, fit_plane};
use neighbours::Neighbourhoods;
use sites::Sites;
use voronoi::voronoi_areas;

/// A cloud is flat if its thickness is below this share of its length: coordinates of 32 bits leave about 1e-7 of a plane.
const FLAT: f64 = 1e-6;

/// How quantities are estimated from neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EstimateConfig {
    /// Nearest neighbours looked at for each point; the paper uses 20 and finds results insensitive to it.
    pub neighbours: usize,
}

impl Default for EstimateConfig {
    fn default() -> Self {
        EstimateConfig { neighbours: 20 }
    }
}

/// Why a cloud could not be completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EstimateError {
    #[error("the cloud has no points")]
    Empty,
    #[error("the {points} points have no normals: give them, or have them estimated")]
    MissingNormals { points: usize },
    #[error("the {points} points are all in one place: no area can be estimated, so give them")]
    OnePlace { points: usize },
    #[error(transparent)]
    Invalid(#[from] CloudError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The cloud with an area for each point: those it came with, or the area of the point's Voronoi cell among its
/// neighbours (Barill et al. 2018, section 3.1).
///
/// # Errors
/// If and only if the cloud is empty or without normals, all its points are in one place and it has no areas, or `monitor`
/// cancels.
// Not part of its caller, which the package for JavaScript loads sooner.
#[inline(never)]
pub fn complete(
    cloud: &PointCloud,
    config: &EstimateConfig,
    monitor: &dyn Monitor,
) -> Result<OrientedCloud, EstimateError> {
    let normals = areas::normals_of(cloud)?;
    let areas = match cloud.areas() {
        Some(areas) => areas.to_vec(),
        None => areas::areas_by(voronoi_areas, cloud, &normals, config, monitor)?,
    };
    Ok(OrientedCloud::new(cloud.points().to_vec(), normals, areas)?)
}

/// The cloud with normals and areas. Normals it does not have are fitted to the neighbours and oriented by propagation
/// along a minimum spanning tree (Hoppe et al. 1992); a warning then says so, since thin or sparse parts may come out
/// inverted. Another warning tells of points without extent in space, such as three, or any number in a plane.
///
/// # Errors
/// If and only if the cloud is empty, `monitor` cancels, or the cloud has normals, but no areas, and all its points are in
/// one place.
pub fn orient(
    cloud: &PointCloud,
    config: &EstimateConfig,
    monitor: &dyn Monitor,
) -> Result<(OrientedCloud, Vec<Warning>), EstimateError> {
    if cloud.normals().is_some() || cloud.is_empty() {
        return Ok((complete(cloud, config, monitor)?, vec![]));
    }
    let points = cloud.points();
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.3);
    let sites = Sites::find(points, &[]);
    let neighbourhoods = Neighbourhoods::find(&sites.points, &[], config.neighbours, monitor)?;
    monitor.begin(0.3, 0.5);
    let mut normals = normals::plane_normals(&sites.points, &neighbourhoods, monitor)?;
    orientation::propagate(&sites.points, &mut normals, &neighbourhoods, monitor)?;
    monitor.begin(0.5, 1.0);
    let areas = match cloud.areas() {
        Some(areas) => areas.to_vec(),
        None => sites.share(voronoi_areas(&sites, &normals, &neighbourhoods, monitor)?),
    };
    let oriented = OrientedCloud::new(points.to_vec(), sites.spread(normals), areas)?;
    let mut warnings = vec![Warning::new(WarningKind::EstimatedNormals, points.len())];
    if is_flat(points) {
        warnings.push(Warning::new(WarningKind::FlatCloud, points.len()));
    }
    Ok((oriented, warnings))
}

/// Whether the points lie in a plane, on a line or in one place.
pub fn is_flat(points: &[Vec3]) -> bool {
    let [least, _, most] = fit_plane(points).variances;
    least <= FLAT * FLAT * most
}
