//! Which pieces bound the result: it is inside on one side of them only.
use super::closing::Closing;
use super::operands::{Operand, Pieces, largest_coordinate};
use super::regions::{Regions, across_edges};
use super::{BooleanError, BooleanOp};
use crate::data::{Monitor, edges, sorted};
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

impl Fate {
    /// How often a piece is part of the result, with its sign.
    pub fn turn(self) -> i32 {
        match self {
            Fate::Kept => 1,
            Fate::Turned => -1,
            Fate::Dropped => 0,
        }
    }
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
    let mut fates = fates(pieces, operands, op, &regions, &all, monitor)?;
    let mut first: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let is_first: Vec<bool> = (0..pieces.corners.len())
        .map(|piece| *first.entry(sorted(pieces.corners[piece])).or_insert(piece) == piece)
        .collect();
    let size = largest_coordinate(operands);
    let most = OF_COORDINATE * size;
    let is_thin =
        |region: &usize| Aside::of(pieces.places(regions.largest[*region] as usize), most).is_thin();
    let thin: Vec<usize> = all.into_iter().filter(is_thin).collect();
    Closing { pieces, regions: &regions, is_first: &is_first, size }.close(&thin, &mut fates);
    let fate = |piece: usize| if is_first[piece] { fates[regions.of[piece] as usize] } else { Fate::Dropped };
    Ok((0..pieces.corners.len()).map(fate).collect())
}

/// The edges of a piece, lower vertex first, and whether it leads up along each: 1, or down: −1.
pub fn directed(corners: [u32; 3]) -> [([u32; 2], i32); 3] {
    let [a, b, c] = corners;
    let [x, y, z] = edges(corners);
    [(x, a < b), (y, b < c), (z, c < a)].map(|(ends, is_upward)| (ends, if is_upward { 1 } else { -1 }))
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
    let aside = |region: &usize| Aside::of(pieces.places(regions.largest[*region] as usize), most).places();
    let points: Vec<Vec3> = asked.iter().flat_map(aside).collect();
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

/// How the sides of a piece are looked at.
struct Aside {
    center: Vec3,
    normal: Vec3,
    /// Of a circle in it, about.
    radius: f64,
    off: f64,
}

impl Aside {
    /// At most about `most` from it.
    fn of(corners: [Vec3; 3], most: f64) -> Aside {
        let [a, b, c] = corners;
        let (center, vector) = (barycentre(corners), area_vector(corners));
        let around = a.distance(b) + b.distance(c) + c.distance(a);
        let radius = if around > 0.0 { 2.0 * vector.length() / around } else { 0.0 };
        let least = OF_COORDINATE * center.abs().max_element();
        Aside { center, normal: vector.normalize_or_zero(), radius, off: (OFF * radius).min(most).max(least) }
    }

    /// Whether other pieces begin before its sides: rounding has made its normal, too.
    fn is_thin(&self) -> bool {
        self.radius < self.off
    }

    /// Places next to it, on the side of its normal first.
    fn places(&self) -> [Vec3; 2] {
        [self.center + self.off * self.normal, self.center - self.off * self.normal]
    }
}
