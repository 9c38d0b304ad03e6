//! Shapes with a cavity.
use super::cylinder::Cylinder;
use super::region::{Kept, Region};
use super::{OffsetError, bounds_of, spacing, surface_of};
use crate::data::{LARGEST_COORDINATE, Monitor, Parts, SurfaceMesh, TriangleSoup, fill_in_blocks};
use crate::distance::{DistanceTree, Search};
use crate::math::Vec3;
use crate::surface::{SurfaceConfig, check_sharp, extract};
use crate::winding::{FieldConfig, WindingField};

/// Cells of a wall at least, so that its two sides do not meet.
const CELLS_OF_WALL: f64 = 2.0;
/// Steps along the axis of a drain, in cells.
const STEP: f64 = 0.5;

/// A hole through the wall, round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drain {
    /// A place on its axis, outside or in the wall.
    pub at: Vec3,
    /// From there into the cavity; of any length but 0.
    pub direction: Vec3,
    /// In millimetres.
    pub radius: f64,
}

/// How a shape is hollowed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HollowConfig {
    /// Of the walls, in millimetres.
    pub thickness: f64,
    /// Holes through which the cavity is emptied.
    pub drains: Vec<Drain>,
    /// As [`super::OffsetConfig::resolution`].
    pub resolution: Option<usize>,
    /// Edge of a cell in millimetres.
    pub spacing: Option<f64>,
    /// As [`SurfaceConfig::sharp`].
    pub sharp: Option<f64>,
}

/// The surface of walls along the inside of a shape: what is inside and no deeper than the thickness, less the drains. Closed, manifold,
/// oriented away from the walls: its outer part outward, that around the cavity inward. Parts that are thinner than two walls stay solid.
///
/// Openings of a soup, and clouds, are closed by the surface that [`extract`] makes with the same cells, and get a wall there.
///
/// # Errors
/// If and only if the shape is empty, the walls are not at least two cells thick or leave no cavity, a drain is out of range or misses
/// the cavity, the cells have no size or are too many, `sharp` is out of range, or the monitor cancels.
#[inline(never)]
pub fn hollow(
    field: &WindingField,
    config: &HollowConfig,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, OffsetError> {
    let thickness = config.thickness;
    if !(thickness > 0.0 && thickness <= LARGEST_COORDINATE) {
        return Err(OffsetError::BadThickness(thickness));
    }
    let spacing = spacing(bounds_of(field)?, config.resolution, config.spacing)?;
    check_sharp(config.sharp)?;
    if thickness < CELLS_OF_WALL * spacing {
        return Err(OffsetError::ThinWall { thickness, spacing });
    }
    for (number, drain) in config.drains.iter().enumerate() {
        check(number, drain, spacing)?;
    }
    let monitor = &Parts::new(monitor);
    let closed = match field.is_closed() {
        true => None,
        false => {
            monitor.begin(0.0, 0.3);
            let config =
                SurfaceConfig { spacing: Some(spacing), sharp: config.sharp, ..SurfaceConfig::default() };
            let mesh = TriangleSoup::from(extract(field, &config, monitor)?);
            Some(WindingField::new(mesh, FieldConfig::default()))
        }
    };
    let field = closed.as_ref().unwrap_or(field);
    let tree = DistanceTree::new(field.shape());
    let mut region = Region { field, tree, kept: Kept::Shell(thickness), drains: Vec::new(), spacing };
    for (number, drain) in config.drains.iter().enumerate() {
        let cylinder = cylinder_of(&region, drain, thickness).ok_or(OffsetError::DrainMisses(number))?;
        region.drains.push(cylinder);
    }
    monitor.begin(if closed.is_some() { 0.3 } else { 0.0 }, 0.95);
    let mesh = surface_of(&region, bounds_of(field)?, config.sharp, monitor)?;
    monitor.begin(0.95, 1.0);
    if region.drains.is_empty() && !has_cavity(&region, &mesh, thickness, monitor)? {
        return Err(OffsetError::NoCavity(thickness));
    }
    Ok(mesh)
}

fn check(number: usize, drain: &Drain, spacing: f64) -> Result<(), OffsetError> {
    let is_size = drain.radius.is_finite() && drain.radius > 0.0;
    let has_direction = drain.direction.try_normalize().is_some();
    if !(is_size && has_direction && drain.at.is_finite()) {
        return Err(OffsetError::BadDrain(number));
    }
    if drain.radius < spacing {
        return Err(OffsetError::SmallDrain { drain: number, radius: drain.radius, spacing });
    }
    Ok(())
}

/// From before the wall to where its axis is in the cavity; nothing if that is nowhere.
fn cylinder_of(region: &Region, drain: &Drain, thickness: f64) -> Option<Cylinder> {
    let direction = drain.direction.try_normalize()?;
    let bounds = region.field.bounds();
    let step = STEP * region.spacing;
    let reach = drain.at.distance(bounds.center()) + 0.5 * bounds.diagonal();
    // What is farther away than the shape is large leads nowhere that steps would find.
    let steps = ((2.0 * reach / step).ceil() as i64).min(1 << 24);
    let mut search = Search::default();
    let mut depth = |k: i64| {
        let place = drain.at + k as f64 * step * direction;
        if !bounds.contains(place) {
            return f64::NEG_INFINITY; // an axis may begin far away
        }
        let distance = region.tree.distance_within(place, f64::INFINITY, &mut search).unwrap_or(0.0);
        if region.field.contains_point(place) { distance } else { -distance }
    };
    let start = (-steps..=0).rev().find(|k| depth(*k) <= 0.0)?;
    // The last entry into the wall before the cavity.
    let mut entry = start;
    let cavity = (start..=steps).find(|&k| {
        let depth = depth(k);
        entry = if depth <= 0.0 { k } else { entry };
        depth >= thickness
    })?;
    let end = (cavity..=steps).find(|k| depth(*k) < thickness)?;
    // So far that walls askew are cut through, but not into the opposite one.
    let within = drain.radius.min(0.5 * (end - cavity) as f64 * step);
    let before = entry as f64 * step - drain.radius;
    Some(Cylinder {
        start: drain.at + before * direction,
        direction,
        length: cavity as f64 * step + within - before,
        radius: drain.radius,
    })
}

/// Whether some of the surface is far enough from the shape to be that of a cavity.
fn has_cavity(
    region: &Region,
    mesh: &SurfaceMesh,
    thickness: f64,
    monitor: &dyn Monitor,
) -> Result<bool, OffsetError> {
    let mut is_deep = vec![false; mesh.positions.len()];
    let deep = |v: usize, search: &mut Search| {
        region.tree.distance_within(mesh.positions[v], 0.5 * thickness, search).is_none()
    };
    fill_in_blocks(&mut is_deep, deep, "surface vertices", monitor)?;
    Ok(is_deep.contains(&true))
}
