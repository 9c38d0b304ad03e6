//! What hangs together without crossing a cut.
use super::operands::Pieces;
use crate::data::{Sets, edges, sorted};
use crate::math::area_vector;
use rustc_hash::{FxHashMap, FxHashSet};

/// Pieces in numbered regions.
pub struct Regions {
    /// The region of each piece.
    pub of: Vec<u32>,
    /// The largest piece of each region.
    pub largest: Vec<u32>,
    /// Whether the pieces of each are in the same place as pieces of the other operand.
    pub is_double: Vec<bool>,
}

/// Regions of one operand each: pieces share a vertex away from all cuts, or an edge that is no seam. Those of an operand that is
/// `scattered` each are their own.
pub fn across_vertices(pieces: &Pieces, scattered: [bool; 2]) -> Regions {
    let is_cut = pieces.is_cut();
    let vertices = pieces.positions.len() as u32;
    let mut sets = Sets::new(pieces.positions.len() + pieces.corners.len());
    let doubles = doubles(pieces, &is_cut);
    let mut between: FxHashMap<([u32; 2], usize, bool), u32> = FxHashMap::default();
    for (piece, corners) in pieces.corners.iter().enumerate() {
        let node = vertices + piece as u32;
        if scattered[pieces.operand(piece)] && !doubles.contains(&sorted(*corners)) {
            continue;
        }
        let free = corners.iter().filter(|v| !is_cut[**v as usize]);
        free.for_each(|v| sets.join(*v, node));
        let is_double = doubles.contains(&sorted(*corners));
        for ends in edges(*corners) {
            if ends.iter().all(|v| is_cut[*v as usize]) && !pieces.seams.contains(&ends) {
                let place = (ends, pieces.operand(piece), is_double);
                let other = *between.entry(place).or_insert(node);
                sets.join(other, node);
            }
        }
    }
    let is_double = |piece: usize| doubles.contains(&sorted(pieces.corners[piece]));
    numbered(pieces, &mut sets, vertices, is_double, |_| true)
}

/// Sorted corners of pieces that both operands have.
fn doubles(pieces: &Pieces, is_cut: &[bool]) -> FxHashSet<[u32; 3]> {
    let mut users: FxHashMap<[u32; 3], u8> = FxHashMap::default();
    for (piece, corners) in pieces.corners.iter().enumerate() {
        if corners.iter().all(|v| is_cut[*v as usize]) {
            *users.entry(sorted(*corners)).or_default() |= 1 << pieces.operand(piece);
        }
    }
    users.into_iter().filter(|(_, of)| *of == 3).map(|(corners, _)| corners).collect()
}

/// Regions of pieces that share edges which no others have, in opposite directions; only the first of those in one place counts,
/// the others belong to its region, whichever way they are turned.
pub fn across_edges(pieces: &Pieces) -> Regions {
    let mut first: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    let mut around: FxHashMap<[u32; 2], Vec<(u32, bool)>> = FxHashMap::default();
    let mut sets = Sets::new(pieces.corners.len());
    for (piece, corners) in pieces.corners.iter().enumerate() {
        let of = *first.entry(sorted(*corners)).or_insert(piece as u32);
        if of != piece as u32 {
            sets.join(of, piece as u32);
            continue;
        }
        let [a, b, c] = *corners;
        for (ends, is_upward) in edges(*corners).into_iter().zip([a < b, b < c, c < a]) {
            around.entry(ends).or_default().push((of, is_upward));
        }
    }
    for faces in around.values() {
        if let [(a, up), (b, other)] = faces[..]
            && up != other
        {
            sets.join(a, b);
        }
    }
    let is_first = |piece: usize| first[&sorted(pieces.corners[piece])] == piece as u32;
    numbered(pieces, &mut sets, 0, |_| false, is_first)
}

/// Sets as regions; pieces that do not count are never the largest of one.
fn numbered(
    pieces: &Pieces,
    sets: &mut Sets,
    shift: u32,
    is_double: impl Fn(usize) -> bool,
    counts: impl Fn(usize) -> bool,
) -> Regions {
    let mut numbers: FxHashMap<u32, u32> = FxHashMap::default();
    let mut regions = Regions { of: Vec::new(), largest: Vec::new(), is_double: Vec::new() };
    let mut areas = Vec::new();
    for piece in 0..pieces.corners.len() {
        let region = *numbers.entry(sets.find(shift + piece as u32)).or_insert_with(|| {
            regions.largest.push(piece as u32);
            regions.is_double.push(is_double(piece));
            areas.push(-1.0);
            areas.len() as u32 - 1
        });
        regions.of.push(region);
        let area = area_vector(pieces.places(piece)).length();
        if area > areas[region as usize] && counts(piece) {
            areas[region as usize] = area;
            regions.largest[region as usize] = piece as u32;
        }
    }
    regions
}
