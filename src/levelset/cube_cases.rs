//! How a level set passes through a cube, for each of the 256 ways its corners can be inside or outside.
//!
//! ```text
//!      6─────7      corner = x + 2 y + 4 z
//!     /│    /│      edge = 4 axis + the two other coordinates of its lower end as bits,
//!    4─────5 │             in the order x y z without the axis
//!    │ 2───│─3
//!    │/    │/       z y
//!    0─────1        │/_ x
//! ```
//!
//! The cases are derived, not listed. On each face, seen from outside the cube, a segment runs from every edge where a
//! counter-clockwise walk around the face enters the inside to the next edge where it leaves. That rule depends on the
//! face's corners alone, so neighbouring cubes agree: the surface is closed. The segments join into loops. Loops are
//! cut into triangles without diagonals in a face of the cube, where the neighbour might draw the same one: so each edge
//! of the mesh has two triangles.
use std::sync::LazyLock;

/// The lower corner and the axis of each of the 12 edges.
pub(super) const EDGES: [(usize, usize); 12] = [
    (0b000, 0),
    (0b010, 0),
    (0b100, 0),
    (0b110, 0),
    (0b000, 1),
    (0b001, 1),
    (0b100, 1),
    (0b101, 1),
    (0b000, 2),
    (0b001, 2),
    (0b010, 2),
    (0b011, 2),
];

/// Corners of each face, counter-clockwise seen from outside the cube; face = 2 axis + side.
const FACES: [[usize; 4]; 6] = [
    [0b000, 0b100, 0b110, 0b010],
    [0b001, 0b011, 0b111, 0b101],
    [0b000, 0b001, 0b101, 0b100],
    [0b010, 0b110, 0b111, 0b011],
    [0b000, 0b010, 0b011, 0b001],
    [0b100, 0b101, 0b111, 0b110],
];

/// Triangles of each case, as edges of the cube, counter-clockwise seen from outside the level set. Bit c of the case
/// says that corner c is inside.
pub(super) static TRIANGLES: LazyLock<Vec<Vec<[u8; 3]>>> =
    LazyLock::new(|| (0..256).map(triangles).collect());

fn triangles(case: usize) -> Vec<[u8; 3]> {
    loops(case).iter().flat_map(|l| triangulate(l).expect("each loop has such a triangulation")).collect()
}

fn edge_between(a: usize, b: usize) -> usize {
    let (lower, axis) = (a & b, (a ^ b).trailing_zeros() as usize);
    EDGES.iter().position(|e| *e == (lower, axis)).expect("a and b are neighbours")
}

/// The closed loops of crossed edges.
fn loops(case: usize) -> Vec<Vec<usize>> {
    let inside = |corner: usize| case >> corner & 1 == 1;
    let mut next = [None; 12];
    for face in FACES {
        for k in 0..4 {
            if !inside(face[k]) && inside(face[(k + 1) % 4]) {
                let leave = (1..4).map(|s| (face[(k + s) % 4], face[(k + s + 1) % 4])).find(|e| !inside(e.1));
                let (last, first_outside) = leave.expect("the walk comes back to an outside corner");
                next[edge_between(face[k], face[(k + 1) % 4])] = Some(edge_between(last, first_outside));
            }
        }
    }
    let mut found = Vec::new();
    for start in 0..12 {
        let mut loop_ = Vec::new();
        let mut edge = start;
        while let Some(to) = next[edge].take() {
            loop_.push(edge);
            edge = to;
        }
        if !loop_.is_empty() {
            found.push(loop_);
        }
    }
    found
}

/// Whether two edges of the cube lie in one of its faces.
fn share_face(a: usize, b: usize) -> bool {
    let on_face =
        |edge: usize, axis: usize, side: usize| EDGES[edge].1 != axis && EDGES[edge].0 >> axis & 1 == side;
    (0..3).any(|axis| (0..2).any(|side| on_face(a, axis, side) && on_face(b, axis, side)))
}

/// Cuts a loop into triangles whose inner sides lie in no face of the cube, if there is a way.
fn triangulate(loop_: &[usize]) -> Option<Vec<[u8; 3]>> {
    let n = loop_.len();
    let triangle = |i: usize, j: usize, k: usize| [loop_[i], loop_[j], loop_[k]].map(|e| e as u8);
    if n == 3 {
        return Some(vec![triangle(0, 1, 2)]);
    }
    // The side from the last to the first vertex gets each other vertex in turn as its apex.
    (1..n - 1).find_map(|apex| {
        let (left, right) = (&loop_[..=apex], &loop_[apex..]);
        let allowed = |part: &[usize]| part.len() == 2 || !share_face(part[0], part[part.len() - 1]);
        if !allowed(left) || !allowed(right) {
            return None;
        }
        let mut all = vec![triangle(0, apex, n - 1)];
        for part in [left, right].into_iter().filter(|part| part.len() > 2) {
            all.extend(triangulate(part)?);
        }
        Some(all)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_use_each_crossed_edge_once() {
        for case in 0..256 {
            let mut used: Vec<usize> = loops(case).concat();
            used.sort();
            let crossed = |e: &usize| {
                let (lower, axis) = EDGES[*e];
                (case >> lower & 1) != (case >> (lower | 1 << axis) & 1)
            };
            assert_eq!(used, (0..12).filter(crossed).collect::<Vec<_>>(), "case {case}");
        }
    }

    #[test]
    fn every_case_is_triangulated_without_diagonals_in_faces() {
        for case in 0..256 {
            let expected: usize = loops(case).iter().map(|l| l.len() - 2).sum();
            assert_eq!(TRIANGLES[case].len(), expected, "case {case}");
        }
    }

    #[test]
    fn a_single_inside_corner_is_cut_off_facing_away() {
        let edges = [0, 4, 8]; // the x, y and z edges at corner 0: counter-clockwise seen from (1, 1, 1)
        let t = TRIANGLES[1][0].map(usize::from);
        let turns = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].map(|p| p.map(|i| edges[i]));
        assert!(turns.contains(&t), "{t:?}");
    }
}
