//! What a raw cloud lacks before it has a winding field: areas, normals, and which way the normals point.
mod areas;
mod neighbours;
mod normals;
mod orientation;

use crate::data::{Cancelled, CloudError, Monitor, OrientedCloud, PointCloud, Warning, WarningKind};
use neighbours::Neighbourhoods;

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
    #[error(transparent)]
    Invalid(#[from] CloudError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The cloud with an area for each point: those it came with, or the area of the point's Voronoi cell among its
/// neighbours (Barill et al. 2018, section 3.1).
///
/// # Errors
/// If and only if the cloud is empty or without normals, or `monitor` cancels.
pub fn complete(
    cloud: &PointCloud,
    config: &EstimateConfig,
    monitor: &dyn Monitor,
) -> Result<OrientedCloud, EstimateError> {
    if cloud.is_empty() {
        return Err(EstimateError::Empty);
    }
    let normals = cloud.normals().ok_or(EstimateError::MissingNormals { points: cloud.len() })?.to_vec();
    let areas = match cloud.areas() {
        Some(areas) => areas.to_vec(),
        None => {
            let neighbourhoods = Neighbourhoods::find(cloud.points(), config.neighbours, monitor)?;
            areas::voronoi_areas(cloud.points(), &normals, &neighbourhoods, monitor)?
        }
    };
    Ok(OrientedCloud::new(cloud.points().to_vec(), normals, areas)?)
}

/// The cloud with normals and areas. Normals it does not have are fitted to the neighbours and oriented by propagation
/// along a minimum spanning tree (Hoppe et al. 1992); a warning then says so, since thin or sparse parts may come out
/// inverted.
///
/// # Errors
/// If and only if the cloud is empty, or `monitor` cancels.
pub fn orient(
    cloud: &PointCloud,
    config: &EstimateConfig,
    monitor: &dyn Monitor,
) -> Result<(OrientedCloud, Vec<Warning>), EstimateError> {
    if cloud.normals().is_some() || cloud.is_empty() {
        return Ok((complete(cloud, config, monitor)?, vec![]));
    }
    let points = cloud.points();
    let neighbourhoods = Neighbourhoods::find(points, config.neighbours, monitor)?;
    let mut normals = normals::plane_normals(points, &neighbourhoods, monitor)?;
    orientation::propagate(points, &mut normals, &neighbourhoods, monitor)?;
    let areas = match cloud.areas() {
        Some(areas) => areas.to_vec(),
        None => areas::voronoi_areas(points, &normals, &neighbourhoods, monitor)?,
    };
    let oriented = OrientedCloud::new(points.to_vec(), normals, areas)?;
    Ok((oriented, vec![Warning::new(WarningKind::EstimatedNormals, points.len())]))
}
