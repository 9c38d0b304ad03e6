//! The surface that stands for a cloud: its level set, closed.
use super::{BooleanConfig, BooleanError};
use crate::data::{Lattice, LatticeError, Monitor, OrientedCloud, TriangleSoup};
use crate::estimate::{EstimateError, roughness};
use crate::levelset::{Edge, LevelSet, SurfaceGrid, TraceError, cells_of_points, find_roots, trace_surface};
use crate::math::Vec3;
use crate::winding::{Accuracy, THRESHOLD, WindingField};

/// Largest error of w.
const TOLERANCE: f64 = 1e-2;
/// Edge of a cell, in distances between points.
const CELL: f64 = 0.7;

struct Level<'a>(&'a WindingField);

impl Level<'_> {
    fn at(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        let values = self.0.evaluate(points, Accuracy::Tolerance(TOLERANCE), monitor)?;
        Ok(values.into_iter().map(|w| w - THRESHOLD).collect())
    }
}

impl LevelSet for Level<'_> {
    fn takes_bricks(&self) -> bool {
        true
    }

    fn values(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f32>, TraceError> {
        Ok(self.at(points, monitor)?.into_iter().map(|w| w as f32).collect())
    }

    fn crossings(&self, edges: &[Edge], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        find_roots(edges, &|points, part: &dyn Monitor| self.at(points, part), monitor)
    }
}

pub fn traced(
    field: &WindingField,
    cloud: &OrientedCloud,
    config: &BooleanConfig,
    monitor: &dyn Monitor,
) -> Result<TriangleSoup, BooleanError> {
    let bounds = field.bounds();
    if bounds.is_empty() {
        return Ok(TriangleSoup::default());
    }
    let spacing = match config.resolution {
        Some(0) => return Err(LatticeError::BadResolution(0.0).into()),
        Some(resolution) => bounds.size().max_element() / resolution as f64,
        None => match roughness(cloud.points(), monitor) {
            Ok(found) => CELL * found.spacing,
            Err(EstimateError::Cancelled(cancelled)) => return Err(cancelled.into()),
            Err(_) => 0.0,
        },
    };
    // What lies in one place has no size: any spacing serves.
    let spacing = if spacing > 0.0 { spacing } else { 1.0 };
    if !spacing.is_finite() {
        return Err(LatticeError::BadSpacing(spacing).into());
    }
    Lattice::check_area(cloud.areas().iter().sum(), spacing)?;
    let grid = SurfaceGrid { origin: bounds.min - Vec3::splat(0.5 * spacing), spacing };
    let seeds = cells_of_points(cloud.points(), grid.origin, Vec3::splat(spacing));
    Ok(trace_surface(&grid, &seeds, &Level(field), monitor)?.into())
}
