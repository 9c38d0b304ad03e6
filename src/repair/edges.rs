//! Sides of triangles, grouped by the edge that they run along.
use crate::data::sort_keyed;

/// The sides of triangles, side 3 t + k from corner k of triangle t to the next, sorted by the edge that they run along; an edge's
/// key holds its lower vertex in its upper half, its higher vertex in its lower. Sides without length are left out.
pub fn sides_by_edge(triangles: &[[u32; 3]]) -> Vec<(u64, u32)> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for side in 0..3 * triangles.len() as u32 {
        let [from, to] = ends(triangles, side);
        if from != to {
            sides.push((key(from, to), side));
        }
    }
    sort_keyed(&mut sides);
    sides
}

/// The groups of [`sides_by_edge`].
pub fn edges(sides: &[(u64, u32)]) -> impl Iterator<Item = &[(u64, u32)]> {
    sides.chunk_by(|one, other| one.0 == other.0)
}

pub fn key(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

/// The vertices that a side runs between.
pub fn ends(triangles: &[[u32; 3]], side: u32) -> [u32; 2] {
    let corners = &triangles[side as usize / 3];
    let k = side as usize % 3;
    [corners[k], corners[(k + 1) % 3]]
}

/// The corner opposite to a side.
pub fn opposite(triangles: &[[u32; 3]], side: u32) -> u32 {
    triangles[side as usize / 3][(side as usize + 2) % 3]
}

/// The edges that are run through more often in one direction than in the other, in that direction and as often.
pub fn net_edges(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let sides = sides_by_edge(triangles);
    let mut net = Vec::new();
    for same in edges(&sides) {
        let (lower, higher) = ((same[0].0 >> 32) as u32, same[0].0 as u32);
        let upward = same.iter().filter(|(_, side)| ends(triangles, *side)[0] == lower).count();
        let downward = same.len() - upward;
        let edge = if upward > downward { [lower, higher] } else { [higher, lower] };
        net.extend(std::iter::repeat_n(edge, upward.abs_diff(downward)));
    }
    net
}
