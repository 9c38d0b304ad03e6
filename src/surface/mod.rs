//! Surfaces from a field: its level set as a mesh.
mod samples;

use crate::data::{Lattice, LatticeError, Monitor, Shape, SurfaceMesh};
use crate::levelset::{At, Edge, InsideTest, LevelSet, SurfaceGrid, TraceError, cells_of_shape, find_roots, trace_surface};
use crate::math::Vec3;
use crate::winding::{Scratch, WindingField};

/// How a surface is traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceConfig {
    /// Cells along the longest side of the bounds; used when `spacing` is not given.
    pub resolution: usize,
    /// Edge of a cell in millimetres.
    pub spacing: Option<f64>,
    /// The winding number on the surface.
    pub level: f64,
}

impl Default for SurfaceConfig {
    fn default() -> Self {
        SurfaceConfig { resolution: 64, spacing: None, level: 0.5 }
    }
}

/// Why a surface could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    #[error(transparent)]
    Lattice(#[from] LatticeError),
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error("a level of {0} has no closed surface: it must be finite and not 0, the winding number far away")]
    BadLevel(f64),
}

/// The surface {w = level}, traced from the cells that hold geometry (Barill et al. 2018, Fig. 9): closed, manifold,
/// oriented outward, its vertices found by bisection. It may reach beyond the bounds, as the field does.
///
/// # Errors
/// If and only if the shape is empty, an option is out of range, or the monitor cancels.
pub fn extract(
    field: &WindingField,
    config: &SurfaceConfig,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, SurfaceError> {
    if !config.level.is_finite() || config.level == 0.0 {
        return Err(SurfaceError::BadLevel(config.level));
    }
    let lattice = match config.spacing {
        Some(spacing) => Lattice::with_spacing(field.bounds(), spacing)?,
        None => Lattice::with_resolution(field.bounds(), config.resolution)?,
    };
    let grid = SurfaceGrid { origin: lattice.origin, spacing: lattice.spacing.x };
    let seeds = cells_of_shape(field.shape(), grid.origin, Vec3::splat(grid.spacing));
    if let Shape::Cloud(_) = field.shape() {
        let level_set = samples::Samples { field, level: config.level };
        return Ok(trace_surface(&grid, &seeds, &level_set, monitor)?);
    }
    field.prepare_single_points();
    let inside = |p: Vec3, at: At, scratch: &mut Scratch| match at {
        At::Node => field.is_above(p, config.level, scratch),
        At::Edge => field.is_nearly_above(p, config.level, scratch),
    };
    Ok(trace_surface(&grid, &seeds, &InsideTest::new(inside), monitor)?)
}
