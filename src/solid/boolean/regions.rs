//! What hangs together without crossing a cut.
use super::operands::{Pieces, edges, key};
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

fn root(parents: &mut [u32], mut i: u32) -> u32 {
    while parents[i as usize] != i {
        parents[i as usize] = parents[parents[i as usize] as usize];
        i = parents[i as usize];
    }
    i
}

fn join(parents: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(parents, a), root(parents, b));
    parents[a.max(b) as usize] = a.min(b);
}

/// Regions of one operand each: pieces share a vertex away from all cuts, or an edge that is no seam. Those of an operand that is
/// `scattered` each are their own.
pub fn across_vertices(pieces: &Pieces, scattered: [bool; 2]) -> Regions {
    let is_cut = pieces.is_cut();
    let vertices = pieces.positions.len() as u32;
    let mut parents: Vec<u32> = (0..vertices + pieces.corners.len() as u32).collect();
    let doubles = doubles(pieces, &is_cut);
    let mut between: FxHashMap<([u32; 2], usize, bool), u32> = FxHashMap::default();
    for (piece, corners) in pieces.corners.iter().enumerate() {
        let node = vertices + piece as u32;
        if scattered[pieces.operand(piece)] && !doubles.contains(&key(*corners)) {
            continue;
        }
        let free = corners.iter().filter(|v| !is_cut[**v as usize]);
        free.for_each(|v| join(&mut parents, *v, node));
        let is_double = doubles.contains(&key(*corners));
        for ends in edges(*corners) {
            if ends.iter().all(|v| is_cut[*v as usize]) && !pieces.seams.contains(&ends) {
                let place = (ends, pieces.operand(piece), is_double);
                let other = *between.entry(place).or_insert(node);
                join(&mut parents, other, node);
            }
        }
    }
    let is_double = |piece: usize| doubles.contains(&key(pieces.corners[piece]));
    numbered(pieces, &mut parents, vertices, is_double)
}

/// Sorted corners of pieces that both operands have.
fn doubles(pieces: &Pieces, is_cut: &[bool]) -> FxHashSet<[u32; 3]> {
    let mut users: FxHashMap<[u32; 3], u8> = FxHashMap::default();
    for (piece, corners) in pieces.corners.iter().enumerate() {
        if corners.iter().all(|v| is_cut[*v as usize]) {
            *users.entry(key(*corners)).or_default() |= 1 << pieces.operand(piece);
        }
    }
    users.into_iter().filter(|(_, of)| *of == 3).map(|(corners, _)| corners).collect()
}

/// Regions of pieces that share edges which no others have, in opposite directions; only the first of those in one place counts,
/// the others belong to its region.
pub fn across_edges(pieces: &Pieces) -> Regions {
    let mut first: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    let mut around: FxHashMap<[u32; 2], Vec<(u32, bool)>> = FxHashMap::default();
    let mut parents: Vec<u32> = (0..pieces.corners.len() as u32).collect();
    for (piece, corners) in pieces.corners.iter().enumerate() {
        let of = *first.entry(key(*corners)).or_insert(piece as u32);
        if of != piece as u32 {
            join(&mut parents, of, piece as u32);
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
            join(&mut parents, a, b);
        }
    }
    numbered(pieces, &mut parents, 0, |_| false)
}

fn numbered(pieces: &Pieces, parents: &mut [u32], shift: u32, is_double: impl Fn(usize) -> bool) -> Regions {
    let mut numbers: FxHashMap<u32, u32> = FxHashMap::default();
    let mut regions = Regions { of: Vec::new(), largest: Vec::new(), is_double: Vec::new() };
    let mut areas = Vec::new();
    for piece in 0..pieces.corners.len() {
        let root = root(parents, shift + piece as u32);
        let region = *numbers.entry(root).or_insert_with(|| {
            regions.largest.push(piece as u32);
            regions.is_double.push(is_double(piece));
            areas.push(-1.0);
            areas.len() as u32 - 1
        });
        regions.of.push(region);
        let area = area_vector(pieces.places(piece)).length();
        if area > areas[region as usize] {
            areas[region as usize] = area;
            regions.largest[region as usize] = piece as u32;
        }
    }
    regions
}
