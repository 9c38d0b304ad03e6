//! Layers of a solid: where planes cross from w < 1/2 to w ≥ 1/2.
mod contour;
mod heat_map;
mod plan;

pub use heat_map::heat_map;
pub use plan::{LayerPlan, PlanError, SampleAt, Span};

use crate::data::{Cancelled, LatticeError, Layer, Monitor, map_tasks, threads};
use crate::winding::WindingField;

/// How contours are traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceConfig {
    /// Cells along the longest side of the bounds; used when `spacing` is not given.
    pub resolution: usize,
    /// Edge of a cell in millimetres. Contours are exact where they cross the cells' edges; a corner inside a cell is cut
    /// by at most 0.7 of this.
    pub spacing: Option<f64>,
}

impl Default for SliceConfig {
    fn default() -> Self {
        SliceConfig { resolution: 256, spacing: None }
    }
}

/// Why a shape could not be sliced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SliceError {
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Lattice(#[from] LatticeError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Slices a shape into layers, bottom to top; layers without anything inside are kept, empty.
///
/// # Errors
/// If and only if the shape is empty, the plan or the cells are out of range, or the monitor cancels.
pub fn slice(
    field: &WindingField,
    plan: &LayerPlan,
    config: &SliceConfig,
    monitor: &dyn Monitor,
) -> Result<Vec<Layer>, SliceError> {
    let slicer = contour::Slicer::new(field, config)?;
    let spans = plan.spans(field.bounds().min.z, field.bounds().max.z)?;
    field.prepare_single_points();
    let mut layers = Vec::with_capacity(spans.len());
    // Two layers for each thread between reports: enough to keep all busy, soon enough to cancel.
    for block in spans.chunks(2 * threads()) {
        monitor.report(layers.len() as f64 / spans.len() as f64, "layers")?;
        layers.extend(map_tasks(block.len(), |k| slicer.layer(&block[k])));
    }
    monitor.report(1.0, "layers")?;
    Ok(layers)
}
