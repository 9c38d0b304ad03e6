//! How large the cells are.
use super::{SurfaceConfig, SurfaceError};
use crate::data::{Lattice, LatticeError, Monitor, OrientedCloud, Shape};
use crate::estimate::{EstimateError, roughness};
use crate::levelset::{Blur, SurfaceGrid, places_of_shape};
use crate::math::area_vector;
use crate::winding::WindingField;

/// Edge of a cell of a cloud, in distances between its points. On 35,000 and 100,000 points of four models, 1 leaves the surface up to
/// a quarter farther from the truth than Poisson's of depth 8, 0.85 as far, 0.7 nearer on all of them, and 0.5 not much nearer still for
/// twice the triangles.
const CELL_OF_CLOUD: f64 = 0.7;

/// Cells over the bounds, centred on them, and how values at their corners are smoothed.
pub fn grid(
    field: &WindingField,
    config: &SurfaceConfig,
    monitor: &dyn Monitor,
) -> Result<(SurfaceGrid, Option<Blur>), SurfaceError> {
    let (shape, bounds) = (field.shape(), field.bounds());
    if bounds.is_empty() {
        return Err(LatticeError::EmptyBounds.into());
    }
    let longest = bounds.size().max_element();
    let distance = match shape {
        Shape::Cloud(cloud) if config.smoothing.is_some() || is_automatic(config) => {
            distance_of_points(cloud, monitor)?
        }
        _ => 0.0,
    };
    let deviation = config.smoothing.map_or(0.0, |smoothing| smoothing * distance);
    let spacing = match (config.spacing, config.resolution, shape) {
        (Some(spacing), ..) => spacing,
        (_, Some(0), _) => return Err(LatticeError::BadResolution(0.0).into()),
        (_, Some(resolution), _) => longest / resolution as f64,
        (_, None, Shape::Soup(_)) => longest / SurfaceConfig::SOUP_RESOLUTION as f64,
        (_, None, Shape::Cloud(_)) => (CELL_OF_CLOUD * distance).max(deviation / Blur::WIDEST),
    };
    // What lies in one place has no size: any spacing serves.
    let spacing = if spacing == 0.0 && config.spacing.is_none() { 1.0 } else { spacing };
    if !(spacing.is_finite() && spacing > 0.0) {
        return Err(LatticeError::BadSpacing(spacing).into());
    }
    Lattice::check_area(area(shape), spacing)?;
    let places = places_of_shape(shape, spacing);
    if places > Lattice::MAX_SAMPLES as f64 {
        return Err(LatticeError::TooMany(places).into());
    }
    // The slack is for rounding.
    if deviation > (1.0 + 1e-9) * Blur::WIDEST * spacing {
        return Err(SurfaceError::SmallCells { spacing, deviation });
    }
    let blur = (deviation > 0.0).then(|| Blur::new(deviation / spacing));
    Ok((SurfaceGrid::over(bounds, spacing), blur))
}

/// Whether the size of cells is left to the shape.
fn is_automatic(config: &SurfaceConfig) -> bool {
    config.spacing.is_none() && config.resolution.is_none()
}

/// The median distance between points of a cloud.
fn distance_of_points(cloud: &OrientedCloud, monitor: &dyn Monitor) -> Result<f64, SurfaceError> {
    match roughness(cloud.points(), monitor) {
        Ok(found) => Ok(found.spacing),
        Err(EstimateError::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(_) => Err(LatticeError::EmptyBounds.into()),
    }
}

pub fn area(shape: &Shape) -> f64 {
    match shape {
        Shape::Soup(soup) => (0..soup.len()).map(|t| area_vector(soup.corners(t)).length()).sum(),
        Shape::Cloud(cloud) => cloud.areas().iter().sum(),
    }
}
