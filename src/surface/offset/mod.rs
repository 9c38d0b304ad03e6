//! Surfaces at a distance from a shape, and hollow shapes: the level sets of signed distances (Barill et al. 2018, Fig. 17), traced
//! through the cells next to them alone.
mod cylinder;
mod hollow;
mod region;
mod seeds;
mod sharp;

pub use hollow::{Drain, HollowConfig, hollow};

use super::cells::area;
use super::sharp::{Limits, sharpen};
use super::{SurfaceConfig, SurfaceError, check_sharp};
use crate::data::{Cancelled, LARGEST_COORDINATE, Lattice, LatticeError, Monitor, Parts, Shape, SurfaceMesh};
use crate::distance::DistanceTree;
use crate::levelset::{SurfaceGrid, TraceError, trace_surface};
use crate::math::Aabb;
use crate::winding::WindingField;
use region::{Kept, Region};
use seeds::cells_near;

/// What surface is made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OffsetConfig {
    /// The signed distance of the surface from the shape, in millimetres: above 0 it lies outside, below 0 inside.
    pub distance: f64,
    /// Cells along the longest side of the bounds of shape and surface; used when `spacing` is not given. Where neither is,
    /// [`SurfaceConfig::SOUP_RESOLUTION`].
    pub resolution: Option<usize>,
    /// Edge of a cell in millimetres.
    pub spacing: Option<f64>,
    /// As [`SurfaceConfig::sharp`].
    pub sharp: Option<f64>,
}

/// Why there is no such surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OffsetError {
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    #[error("a distance of {0} is not possible: it must be a finite number, up to {LARGEST_COORDINATE:e}")]
    BadDistance(f64),
    #[error(
        "a distance of {0} has no two sides: a finite number above 0 is needed, up to {LARGEST_COORDINATE:e}"
    )]
    BadTwoSidedDistance(f64),
    #[error("nothing is left at a distance of {0}: no cell of the shape is that deep inside")]
    NothingLeft(f64),
    #[error("walls cannot be {0} thick: a finite number above 0 is needed, up to {LARGEST_COORDINATE:e}")]
    BadThickness(f64),
    #[error("walls of {thickness} are too thin for cells of {spacing}: they must be twice as thick")]
    ThinWall { thickness: f64, spacing: f64 },
    #[error("walls of {0} leave no cavity: no cell of the shape is that deep inside")]
    NoCavity(f64),
    #[error("drain {0} needs a finite place, a direction that is not zero and a finite radius above 0")]
    BadDrain(usize),
    #[error(
        "drain {drain} has a radius of {radius}, too small for cells of {spacing}: it must be as large as they are"
    )]
    SmallDrain { drain: usize, radius: f64, spacing: f64 },
    #[error(
        "drain {0} misses the cavity: its axis must lead from its place into the part that becomes hollow"
    )]
    DrainMisses(usize),
}

impl From<LatticeError> for OffsetError {
    fn from(error: LatticeError) -> OffsetError {
        SurfaceError::from(error).into()
    }
}

impl From<TraceError> for OffsetError {
    fn from(error: TraceError) -> OffsetError {
        SurfaceError::from(error).into()
    }
}

impl From<Cancelled> for OffsetError {
    fn from(cancelled: Cancelled) -> OffsetError {
        SurfaceError::from(cancelled).into()
    }
}

/// The surface {signed distance = d} of a soup or a cloud: closed, manifold, oriented outward. It bounds what is inside or no farther
/// than d away, for d below 0 what is inside and farther than −d from the triangles or points.
///
/// For d ≥ √3 cells it strictly contains all triangles and points: a cell that holds some of them has all corners within. Vertices lie
/// on edges of the cells, where the distance is d to a hundred-thousandth of a cell; in openings, where the sign of the distance changes
/// at w = 1/2 farther than |d| from any triangle, they lie there. What is thinner than a cell may be missed.
///
/// # Errors
/// If and only if the shape is empty, the distance is not finite, nothing is that deep inside, the cells have no size or are too many,
/// `sharp` is out of range, or the monitor cancels.
#[inline(never)]
pub fn offset(
    field: &WindingField,
    config: &OffsetConfig,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, OffsetError> {
    if !(0.0..=LARGEST_COORDINATE).contains(&config.distance.abs()) {
        return Err(OffsetError::BadDistance(config.distance));
    }
    at_distance(field, Kept::UpTo(config.distance), config, monitor)
}

/// The surface {distance = d}, d > 0, whatever is inside: around sheets and closed shapes alike it has two sides, of which the inner one
/// faces what is farther than d from all triangles or points and vanishes where nothing is. Otherwise as [`offset`].
///
/// # Errors
/// As [`offset`], and if and only if the distance is not above 0.
#[inline(never)]
pub fn two_sided_offset(
    field: &WindingField,
    config: &OffsetConfig,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, OffsetError> {
    if !(config.distance > 0.0 && config.distance <= LARGEST_COORDINATE) {
        return Err(OffsetError::BadTwoSidedDistance(config.distance));
    }
    at_distance(field, Kept::Near(config.distance), config, monitor)
}

fn at_distance(
    field: &WindingField,
    kept: Kept,
    config: &OffsetConfig,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, OffsetError> {
    let distance = config.distance;
    let bounds = bounds_of(field)?.padded(distance.max(0.0));
    let spacing = spacing(bounds, config.resolution, config.spacing)?;
    check_sharp(config.sharp)?;
    let monitor = &Parts::new(monitor);
    let tree = DistanceTree::new(field.shape());
    let region = Region { field, tree, kept, drains: Vec::new(), spacing };
    let mesh = surface_of(&region, bounds, config.sharp, monitor)?;
    if mesh.triangles.is_empty() { Err(OffsetError::NothingLeft(distance)) } else { Ok(mesh) }
}

fn bounds_of(field: &WindingField) -> Result<Aabb, LatticeError> {
    let bounds = field.bounds();
    if bounds.is_empty() { Err(LatticeError::EmptyBounds) } else { Ok(bounds) }
}

/// Edge of a cell.
fn spacing(bounds: Aabb, resolution: Option<usize>, spacing: Option<f64>) -> Result<f64, LatticeError> {
    let longest = bounds.size().max_element();
    let spacing = match (spacing, resolution.unwrap_or(SurfaceConfig::SOUP_RESOLUTION)) {
        (Some(spacing), _) => spacing,
        (None, 0) => return Err(LatticeError::BadResolution(0.0)),
        // What lies in one place has no size: any spacing serves.
        (None, _) if longest == 0.0 => 1.0,
        (None, resolution) => longest / resolution as f64,
    };
    if spacing.is_finite() && spacing > 0.0 { Ok(spacing) } else { Err(LatticeError::BadSpacing(spacing)) }
}

/// The surface of a region that lies in the bounds.
fn surface_of(
    region: &Region,
    bounds: Aabb,
    sharp: Option<f64>,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, OffsetError> {
    let (spacing, shape) = (region.spacing, region.field.shape());
    if matches!(shape, Shape::Cloud(_)) && region.kept.has_one_side() {
        // What is inside of a cloud may reach far beyond its bounds.
        Lattice::check_area(area(shape), spacing)?;
    }
    let grid = SurfaceGrid::over(bounds, spacing);
    region.field.prepare_single_points();
    let seeds = cells_near(region, &grid, bounds.padded(spacing), monitor)?;
    let mut mesh = trace_surface(&grid, &seeds, region, monitor)?;
    if let Some(limits) = sharp.map(Limits::new) {
        sharpen(&mut mesh, region, spacing, limits, monitor)?;
    }
    Ok(mesh)
}
