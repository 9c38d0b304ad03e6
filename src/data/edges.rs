//! Triangles by their corners, and their sides by the edges that they run along: side 3t + k leads from corner k of triangle t to
//! the next, and has the number of the corner that it starts at.
use super::sort_keyed;

/// The edge between two vertices, the lower one first.
pub fn edge_between(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// An edge as one number that sorts as its ends do: the lower vertex in the upper half, the higher in the lower.
pub fn edge_key(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

/// The edge of a key.
pub fn edge_of_key(key: u64) -> [u32; 2] {
    [(key >> 32) as u32, key as u32]
}

/// The side, or the corner, after one of a triangle.
#[inline]
pub fn next_side(side: u32) -> u32 {
    if side % 3 == 2 { side - 2 } else { side + 1 }
}

/// The vertices that a side leads from and to.
#[inline]
pub fn ends(triangles: &[[u32; 3]], side: u32) -> [u32; 2] {
    let corners = &triangles[side as usize / 3];
    let k = side as usize % 3;
    [corners[k], corners[(k + 1) % 3]]
}

/// The vertex of a side's triangle that the side does not touch.
#[inline]
pub fn opposite(triangles: &[[u32; 3]], side: u32) -> u32 {
    triangles[side as usize / 3][(side as usize + 2) % 3]
}

/// Those sides that count, by which they are and their ends, with the keys of their edges; sorted by these, then ascending.
pub fn sides_by_edge(
    triangles: &[[u32; 3]],
    mut counts: impl FnMut(u32, [u32; 2]) -> bool,
) -> Vec<(u64, u32)> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (first, [a, b, c]) in (0..).step_by(3).zip(triangles) {
        for (side, [from, to]) in (first..).zip([[*a, *b], [*b, *c], [*c, *a]]) {
            if counts(side, [from, to]) {
                sides.push((edge_key(from, to), side));
            }
        }
    }
    sort_keyed(&mut sides);
    sides
}

/// The groups of [`sides_by_edge`]: the sides along one edge each.
pub fn by_edge(sides: &[(u64, u32)]) -> impl Iterator<Item = &[(u64, u32)]> {
    sides.chunk_by(|one, other| one.0 == other.0)
}

/// The edges of a triangle; edge k leads from corner k to the next, or back.
pub fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [edge_between(a, b), edge_between(b, c), edge_between(c, a)]
}

/// Corners in rising order: equal for triangles in the same place.
pub fn sorted(mut corners: [u32; 3]) -> [u32; 3] {
    corners.sort_unstable();
    corners
}

/// Whether two triangles with the same corners turn the same way.
pub fn turn_alike([a, b, c]: [u32; 3], other: [u32; 3]) -> bool {
    [[a, b, c], [b, c, a], [c, a, b]].contains(&other)
}
