//! Which pieces bound the result: it is inside on one side of them only.
use super::operands::{Operand, Pieces, largest_coordinate};
use super::regions::{Regions, across_edges};
use super::{BooleanError, BooleanOp};
use crate::data::{Monitor, sorted};
use crate::math::{Vec3, area_vector, barycentre};
use rustc_hash::FxHashMap;

/// What becomes of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    Kept,
    /// Kept with its other side out.
    Turned,
    Dropped,
}

/// How far from a piece its sides are looked at, at most, in the radius of a circle in it.
const OFF: f64 = 1e-6;
/// And in the largest coordinate: at most in that of the operands, at least in the piece's own. Far above rounding, and far below a step of
/// the grid that vertices are moved to: what comes as near as that lies beyond.
const OF_COORDINATE: f64 = 1e-13;

/// What becomes of each piece of operands that are cut along themselves too: of those in one place one stays.
pub fn keep(
    pieces: &Pieces,
    operands: &[Operand; 2],
    op: BooleanOp,
    monitor: &dyn Monitor,
) -> Result<Vec<Fate>, BooleanError> {
    let regions = across_edges(pieces);
    let all: Vec<usize> = (0..regions.largest.len()).collect();
    let fates = fates(pieces, operands, op, &regions, &all, monitor)?;
    let mut first: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let fate = |piece: usize| {
        let is_first = *first.entry(sorted(pieces.corners[piece])).or_insert(piece) == piece;
        if is_first { fates[regions.of[piece] as usize] } else { Fate::Dropped }
    };
    Ok((0..pieces.corners.len()).map(fate).collect())
}

/// What becomes of some regions, by both sides of their largest pieces.
pub fn fates(
    pieces: &Pieces,
    operands: &[Operand; 2],
    op: BooleanOp,
    regions: &Regions,
    asked: &[usize],
    monitor: &dyn Monitor,
) -> Result<Vec<Fate>, BooleanError> {
    let most = OF_COORDINATE * largest_coordinate(operands);
    let points: Vec<Vec3> =
        asked.iter().flat_map(|r| both_sides(pieces.places(regions.largest[*r] as usize), most)).collect();
    let a = operands[0].field().contains(&points, monitor)?;
    let b = operands[1].field().contains(&points, monitor)?;
    let fate = |k: usize| {
        let [out, inner] = [2 * k, 2 * k + 1].map(|i| op.combines([a[i], b[i]]));
        match (out, inner) {
            (false, true) => Fate::Kept,
            (true, false) => Fate::Turned,
            _ => Fate::Dropped,
        }
    };
    Ok((0..asked.len()).map(fate).collect())
}

/// Places next to a piece, on the side of its normal first, at most about `most` from it.
fn both_sides(corners: [Vec3; 3], most: f64) -> [Vec3; 2] {
    let [a, b, c] = corners;
    let (center, vector) = (barycentre(corners), area_vector(corners));
    let around = a.distance(b) + b.distance(c) + c.distance(a);
    let radius = if around > 0.0 { 2.0 * vector.length() / around } else { 0.0 };
    let least = OF_COORDINATE * center.abs().max_element();
    let off = (OFF * radius).min(most).max(least) * vector.normalize_or_zero();
    [center + off, center - off]
}
