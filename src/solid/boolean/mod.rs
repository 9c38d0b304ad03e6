//! Union, intersection and difference: each operand trimmed against the other's field (Barill et al. 2018, section 4).
//!
//! The triangles of both are cut along each other exactly (`operands`, [`crate::arrangement`]); where a field changes sides beside
//! its triangles, at openings, the other operand is cut along its level set (`level`). What hangs together without crossing a cut
//! lies on one side (`regions`) and is kept or dropped as a whole (`keep`, `sides`), or where sides do not tell becomes what closes
//! the result (`closing`). A cloud stands in by the surface of its level set (`cloud`).
mod closing;
mod cloud;
mod keep;
mod level;
mod operands;
mod regions;
mod result;
mod sides;

pub use result::BooleanMesh;

use crate::data::{
    Cancelled, LatticeError, Monitor, OutOfMemory, Parts, SoupError, Warning, WarningKind, edges,
};
use crate::levelset::TraceError;
use crate::winding::{FieldError, WindingField};
use operands::{Operand, Pieces};
use sides::Fate;

/// How two operands are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BooleanOp {
    Union,
    Intersection,
    /// The first without the second.
    Difference,
}

impl BooleanOp {
    /// Whether the result is inside where the operands are or are not.
    fn combines(self, [a, b]: [bool; 2]) -> bool {
        match self {
            BooleanOp::Union => a || b,
            BooleanOp::Intersection => a && b,
            BooleanOp::Difference => a && !b,
        }
    }
}

/// How fine a boolean is where it is not exact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BooleanConfig {
    /// Longest edge, in millimetres, that may cross the level set of an open operand where its triangles are missing: the cut there
    /// is a chain of such steps. A 256th of the smaller diagonal where it is not given.
    pub tolerance: Option<f64>,
    /// Cells along the longest side of a cloud, whose level set is traced. Where it is not given, cells are 0.7 of the median distance
    /// between its points.
    pub resolution: Option<usize>,
}

/// Why two shapes could not be combined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BooleanError {
    #[error("a tolerance of {0} is not possible: it must be finite and above 0")]
    BadTolerance(f64),
    #[error("the surface of a cloud: {0}")]
    Lattice(#[from] LatticeError),
    #[error("the surface of a cloud: {0}")]
    TooFine(TraceError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    #[error(transparent)]
    Soup(#[from] SoupError),
}

impl From<FieldError> for BooleanError {
    fn from(error: FieldError) -> BooleanError {
        match error {
            FieldError::Lattice(error) => error.into(),
            FieldError::Cancelled(error) => error.into(),
            FieldError::OutOfMemory(error) => error.into(),
        }
    }
}

impl From<TraceError> for BooleanError {
    fn from(error: TraceError) -> BooleanError {
        match error {
            TraceError::Cancelled(error) => error.into(),
            TraceError::OutOfMemory(error) => error.into(),
            error => BooleanError::TooFine(error),
        }
    }
}

/// One diagonal is as many times as long as the other from where units are doubtful.
const SCALES: f64 = 200.0;
/// Steps of a cut along a level set, in the smaller diagonal.
const STEPS: f64 = 256.0;

/// Combines the solids of two fields, w ≥ 1/2 each.
///
/// Of closed soups the result is closed, and its volume that of the solids, to rounding. Triangles that nothing cuts are those of the
/// operands, bit for bit, and share their vertices as before; pieces of others know their triangle. Where both surfaces coincide, one
/// copy stays, turned the right way, if the result is inside on one side of it only: what merely touches is joined by a union, and
/// left as it is by a difference. Open soups are trimmed as they are, so that the result is open where they were. Closed soups that cross
/// themselves where they are cut are cut along themselves too, and only what bounds the result stays. Equal soups are their union and their
/// intersection. An empty result is a mesh without triangles and a warning. Where closed surfaces come so near to each other that
/// rounding would tear the result, they are cut as if their vertices lay on a grid of 2⁻³⁶ of their size, with a warning.
///
/// # Errors
/// If and only if an option is out of range, the surface of a cloud would be too fine, memory does not suffice or the monitor cancels.
// Not part of its caller, which the package for JavaScript loads sooner.
#[inline(never)]
pub fn boolean(
    a: &WindingField,
    b: &WindingField,
    op: BooleanOp,
    config: &BooleanConfig,
    monitor: &dyn Monitor,
) -> Result<BooleanMesh, BooleanError> {
    if let Some(tolerance) = config.tolerance.filter(|t| !(t.is_finite() && *t > 0.0)) {
        return Err(BooleanError::BadTolerance(tolerance));
    }
    let monitor = &Parts::new(monitor);
    monitor.report(0.0, "operands")?;
    monitor.begin(0.0, 0.1);
    let operands = [Operand::new(a, config, monitor)?, Operand::new(b, config, monitor)?];
    let mut warnings = warnings(&operands);
    // Cutting and keeping is done once as a rule.
    monitor.begin_attempt(0.9);
    let mut mesh = combine(&operands, op, config, &mut warnings, monitor)?;
    if mesh.triangles.is_empty() {
        warnings.push(Warning::new(WarningKind::EmptyResult, 1));
    }
    mesh.warnings = warnings;
    monitor.begin(0.0, 1.0);
    monitor.report(1.0, "operands")?;
    Ok(mesh)
}

fn combine(
    operands: &[Operand; 2],
    op: BooleanOp,
    config: &BooleanConfig,
    warnings: &mut Vec<Warning>,
    monitor: &Parts,
) -> Result<BooleanMesh, BooleanError> {
    if operands[0].soup() == operands[1].soup() {
        return Ok(match op {
            BooleanOp::Difference => BooleanMesh::default(),
            _ => BooleanMesh::of(operands[0].soup()),
        });
    }
    let mut tried = trimmed(operands, op, config, monitor)?;
    if operands.iter().all(|o| o.field().is_closed()) && tried.is_torn() {
        monitor.begin_attempt(0.5);
        let resolved = resolved(operands, op, monitor)?;
        if !resolved.is_torn() {
            warnings.push(Warning::new(WarningKind::SelfCrossing, 1));
            tried = resolved;
        } else {
            // Surfaces that nearly coincide: on a grid they do so, or are clearly apart.
            let snapped = operands::snapped(operands)?;
            monitor.begin_attempt(0.5);
            let mut again = trimmed(&snapped, op, config, monitor)?;
            if again.is_torn() {
                monitor.begin_attempt(0.9);
                again = self::resolved(&snapped, op, monitor)?;
            }
            warnings.push(Warning::new(WarningKind::SnappedOperands, 1));
            again.pieces.restore(operands);
            tried = again;
        }
    }
    if tried.pieces.unresolved > 0 {
        warnings.push(Warning::new(WarningKind::CrossingFaces, tried.pieces.unresolved));
    }
    Ok(BooleanMesh::assembled(&tried.pieces, operands, &tried.fates))
}

/// Pieces, and what becomes of each.
struct Trimmed {
    pieces: Pieces,
    fates: Vec<Fate>,
}

impl Trimmed {
    /// Whether what stays has a boundary along the seams.
    fn is_torn(&self) -> bool {
        keep::is_torn(&self.pieces, &self.fates)
    }
}

/// Each operand cut along the other, and what lies on the right side of that kept.
fn trimmed(
    operands: &[Operand; 2],
    op: BooleanOp,
    config: &BooleanConfig,
    monitor: &dyn Monitor,
) -> Result<Trimmed, BooleanError> {
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.4);
    let mut pieces = Pieces::cut(operands, false, monitor)?;
    for of in [0, 1] {
        let field = operands[1 - of].field();
        monitor.begin(0.4 + 0.25 * of as f64, 0.65 + 0.25 * of as f64);
        if !field.is_closed() {
            let diagonals = operands.each_ref().map(|o| o.field().bounds().diagonal());
            let step = config.tolerance.unwrap_or(diagonals[0].min(diagonals[1]) / STEPS);
            level::cut(&mut pieces, of, field, step, monitor)?;
        }
    }
    monitor.begin(0.9, 1.0);
    let fates = keep::by_regions(&pieces, operands, op, monitor)?;
    Ok(Trimmed { pieces, fates })
}

/// All triangles cut along each other, and what bounds the result kept.
fn resolved(operands: &[Operand; 2], op: BooleanOp, monitor: &dyn Monitor) -> Result<Trimmed, BooleanError> {
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.6);
    let mut pieces = Pieces::cut(operands, true, monitor)?;
    // Regions end at every edge that more than two pieces have, whether anything is cut there or not.
    pieces.seams.extend(pieces.corners.iter().flat_map(|corners| edges(*corners)));
    monitor.begin(0.6, 1.0);
    let fates = sides::keep(&pieces, operands, op, monitor)?;
    Ok(Trimmed { pieces, fates })
}

fn warnings(operands: &[Operand; 2]) -> Vec<Warning> {
    let diagonals = operands.each_ref().map(|o| o.field().bounds().diagonal());
    let [small, large] = [diagonals[0].min(diagonals[1]), diagonals[0].max(diagonals[1])];
    let mut warnings = Vec::new();
    if small > 0.0 && large / small > SCALES {
        warnings.push(Warning::new(WarningKind::DifferentScales, (large / small).min(1e9) as usize));
    }
    let open: usize = operands.iter().map(|o| o.field().report().boundary_edges).sum();
    if open > 0 {
        warnings.push(Warning::new(WarningKind::OpenOperands, open));
    }
    warnings
}
