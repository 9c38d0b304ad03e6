//! Layers of a solid: where planes cross from w < 1/2 to w ≥ 1/2.
//!
//! Of a closed soup the section of its triangles is the contour, once what overlaps is united (`section`, `chains`, `disjoint`). Of an
//! open one those parts of the section are that 1/2 lies between the two sides of (`arrangement`, `kept`); where the surface is missing
//! the level curve is followed from end to end (`arcs`, `open`). Clouds have no section: their contours are traced on a `grid`,
//! with more vertices where they turn (`refine`).
mod arcs;
mod arrangement;
mod chains;
mod disjoint;
mod grid;
mod heat_map;
mod kept;
mod open;
mod plan;
mod plane;
mod refine;
mod section;
mod slicer;
mod slopes;

pub use heat_map::heat_map;
pub use plan::{AdaptiveHeights, LayerPlan, PlanError, SampleAt, Span};

use crate::data::{Cancelled, LatticeError, Layer, Monitor, map_tasks, threads};
use crate::winding::WindingField;
use slicer::Slicer;

/// How contours are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceConfig {
    /// Of clouds, and of soups of loose triangles: cells along the longest side of the bounds; used when `spacing` is not given.
    pub resolution: usize,
    /// Of these: edge of a cell in millimetres. Contours are exact where they cross the cells' edges; a corner inside a cell is cut
    /// by at most 0.7 of this.
    pub spacing: Option<f64>,
    pub mode: SliceMode,
    /// Vertices are left out as long as contours stay this near, in millimetres, and hang together as they do; 0 keeps all.
    pub simplify: f64,
}

impl Default for SliceConfig {
    fn default() -> Self {
        SliceConfig { resolution: 256, spacing: None, mode: SliceMode::Winding, simplify: 0.0 }
    }
}

/// What is inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SliceMode {
    /// w ≥ 1/2.
    #[default]
    Winding,
    /// Where w, rounded to the nearest integer, is odd: what overlaps is left out.
    EvenOdd,
    /// The largest outline where w ≥ 1/2, without holes: for a vase.
    Largest,
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
    #[error("contours cannot be simplified by {0} mm: a finite number, 0 or more, is needed")]
    BadSimplification(f64),
}

/// Slices a shape into layers, in the order of the plan; layers without anything inside are kept, empty.
///
/// Of soups, contours are sections of the triangles, their vertices exact to rounding, and where the surface is missing level
/// curves of the field to 5e-5 of the size. Planes are half open: a vertex on one counts as below it.
///
/// # Errors
/// If and only if the shape is empty, the plan, the cells or the simplification are out of range, or the monitor cancels.
pub fn slice(
    field: &WindingField,
    plan: &LayerPlan,
    config: &SliceConfig,
    monitor: &dyn Monitor,
) -> Result<Vec<Layer>, SliceError> {
    let mut layers = Vec::new();
    let report = slice_each(field, plan, config, monitor, &mut |place, layer| layers.push((place, layer)))?;
    layers.sort_unstable_by_key(|(place, _)| *place);
    debug_assert_eq!(report.layers, layers.len());
    Ok(layers.into_iter().map(|(_, layer)| layer).collect())
}

/// What [`slice_each`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SliceReport {
    pub layers: usize,
    /// Layers of soups whose contours were traced on a grid: of loose triangles, or as arcs in openings did not come to an end.
    pub approximated: usize,
}

/// As [`slice()`], one layer after the other from the lowest sample up, each with its place in the plan: only some are in memory.
///
/// # Errors
/// As [`slice()`].
pub fn slice_each(
    field: &WindingField,
    plan: &LayerPlan,
    config: &SliceConfig,
    monitor: &dyn Monitor,
    take: &mut dyn FnMut(usize, Layer),
) -> Result<SliceReport, SliceError> {
    let spans = plan.spans_of(field.shape())?;
    slice_spans(field, &spans, config, monitor, take)
}

/// [`slice_each`] of spans that are given: part of a plan's, so that its layers may be made as they are wanted.
///
/// # Errors
/// As [`slice()`].
#[inline(never)]
pub fn slice_spans(
    field: &WindingField,
    spans: &[Span],
    config: &SliceConfig,
    monitor: &dyn Monitor,
    take: &mut dyn FnMut(usize, Layer),
) -> Result<SliceReport, SliceError> {
    if !(config.simplify.is_finite() && config.simplify >= 0.0) {
        return Err(SliceError::BadSimplification(config.simplify));
    }
    let slicer = Slicer::new(field, spans, config)?;
    // Two blocks for each thread between reports: enough to keep all busy, soon enough to cancel.
    let (blocks, at_once) = (slicer.blocks(), 2 * threads());
    for first in (0..blocks).step_by(at_once) {
        monitor.report(first as f64 / blocks as f64, "layers")?;
        let count = at_once.min(blocks - first);
        let made = map_tasks(count, |k| slicer.block(first + k));
        made.into_iter().flatten().for_each(|(place, layer)| take(place, layer));
    }
    monitor.report(1.0, "layers")?;
    Ok(SliceReport { layers: spans.len(), approximated: slicer.approximated() })
}
