//! Which pieces stay, when each operand is looked at from the other.
use super::operands::{Operand, Pieces};
use super::regions::{Regions, across_vertices};
use super::sides::{self, Fate, directed};
use super::{BooleanError, BooleanOp};
use crate::data::{Monitor, sorted};
use crate::math::{Vec3, barycentre};
use rustc_hash::FxHashMap;

/// What becomes of each piece: a region is inside or outside the other operand; what both have in one place stays once. A cut
/// along a level set need not separate regions to the last: beside an open operand each piece is asked for.
pub fn by_regions(
    pieces: &Pieces,
    operands: &[Operand; 2],
    op: BooleanOp,
    monitor: &dyn Monitor,
) -> Result<Vec<Fate>, BooleanError> {
    let regions = across_vertices(pieces, [1, 0].map(|other| !operands[other].field().is_closed()));
    let mut fates = vec![Fate::Dropped; regions.largest.len()];
    for of in [0, 1] {
        let is_asked = |region: &usize| {
            !regions.is_double[*region] && pieces.operand(regions.largest[*region] as usize) == of
        };
        let asked: Vec<usize> = (0..fates.len()).filter(is_asked).collect();
        let points: Vec<Vec3> =
            asked.iter().map(|r| barycentre(pieces.places(regions.largest[*r] as usize))).collect();
        let inside = operands[1 - of].field().contains(&points, monitor)?;
        for (region, inside) in asked.into_iter().zip(inside) {
            fates[region] = fate(op, of, inside);
        }
    }
    let doubles: Vec<usize> = (0..fates.len()).filter(|region| regions.is_double[*region]).collect();
    let of_doubles = sides::fates(pieces, operands, op, &regions, &doubles, monitor)?;
    doubles.iter().zip(of_doubles).for_each(|(region, fate)| fates[*region] = fate);
    let mut kept: Vec<Fate> = regions.of.iter().map(|region| fates[*region as usize]).collect();
    drop_copies(pieces, &regions, &mut kept);
    Ok(kept)
}

fn fate(op: BooleanOp, of: usize, inside: bool) -> Fate {
    match (op, of, inside) {
        (BooleanOp::Union, _, false)
        | (BooleanOp::Intersection, _, true)
        | (BooleanOp::Difference, 0, false) => Fate::Kept,
        (BooleanOp::Difference, 1, true) => Fate::Turned,
        _ => Fate::Dropped,
    }
}

/// Of pieces in one place only one stays, as it is if one of them lies that way.
fn drop_copies(pieces: &Pieces, regions: &Regions, kept: &mut [Fate]) {
    let mut first: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    for piece in 0..kept.len() {
        if !regions.is_double[regions.of[piece] as usize] || kept[piece] == Fate::Dropped {
            continue;
        }
        let before = *first.entry(sorted(pieces.corners[piece])).or_insert(piece);
        if before == piece {
            continue;
        }
        if kept[before] == Fate::Turned && kept[piece] == Fate::Kept {
            kept[before] = Fate::Dropped;
            first.insert(sorted(pieces.corners[piece]), piece);
        } else {
            kept[piece] = Fate::Dropped;
        }
    }
}

/// Whether what is kept has a boundary along the seams.
pub fn is_torn(pieces: &Pieces, kept: &[Fate]) -> bool {
    let mut net: FxHashMap<[u32; 2], i32> = FxHashMap::default();
    for (corners, fate) in pieces.corners.iter().zip(kept).filter(|(_, fate)| **fate != Fate::Dropped) {
        for (ends, turn) in directed(*corners) {
            if pieces.seams.contains(&ends) {
                *net.entry(ends).or_default() += turn * fate.turn();
            }
        }
    }
    net.values().any(|n| *n != 0)
}
