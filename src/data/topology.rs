//! How the triangles of a soup hang together: edges, fans around vertices, shells.
use super::{
    Sets, TwoKinds, by_edge, edge_key, edge_of_key, ends, map_items, next_side, sides_by_edge, sort_keyed,
    sorted, turn_alike,
};

/// An edge and the sides of triangles that run along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The lower vertex first.
    pub ends: [u32; 2],
    first: u32,
    pub count: u32,
}

/// Which triangles with the corners of an earlier one are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeftOut {
    /// Those that turn the same way.
    Repeated,
    /// Those that turn either way.
    AllCopies,
}

/// The triangles of a soup as a complex over welded vertices. Those with two corners in one place take no part, nor do copies.
///
/// Side 3t + k of triangle t runs from its corner k to the next. Two triangles belong to one *shell* if a chain of edges with
/// two triangles each leads from one to the other.
pub struct Topology {
    /// Welded corners.
    pub corners: Vec<[u32; 3]>,
    /// Of each triangle the first with the same corners, itself in general; [`Topology::COLLAPSED`] where two corners are one.
    pub first_copies: Vec<u32>,
    /// Sorted by their ends.
    pub edges: Vec<Edge>,
    sides: Vec<u32>,
    /// Of each triangle that takes part; [`Topology::NONE`] of the others.
    pub shells: Vec<u32>,
    /// Whether it runs against the first triangle of its shell.
    pub is_turned: Vec<bool>,
    /// Of each shell, whether its triangles can all run with the first.
    pub is_orientable: Vec<bool>,
    /// Of each side, the one that it is joined to; [`Topology::NONE`] of those that are not: along a boundary, or where more
    /// than two meet, unless two of them are the only ones of their shell.
    pub joined: Vec<u32>,
}

impl Topology {
    pub const COLLAPSED: u32 = u32::MAX;
    pub const NONE: u32 = u32::MAX;

    /// `welded` gives the vertex in the same place that stands for each.
    pub fn new(triangles: &[[u32; 3]], welded: &[u32], left_out: LeftOut) -> Topology {
        let corners = map_items(triangles.len(), |t| triangles[t].map(|v| welded[v as usize]));
        let first_copies = first_copies(&corners, left_out);
        let mut topology = Topology {
            edges: Vec::new(),
            sides: Vec::new(),
            shells: vec![Topology::NONE; corners.len()],
            is_turned: vec![false; corners.len()],
            is_orientable: Vec::new(),
            joined: vec![Topology::NONE; 3 * corners.len()],
            corners,
            first_copies,
        };
        topology.find_edges();
        topology.find_shells();
        topology
    }

    /// Whether a triangle takes part.
    pub fn is_kept(&self, triangle: usize) -> bool {
        self.first_copies[triangle] == triangle as u32
    }

    /// From where to where a side runs.
    pub fn ends(&self, side: u32) -> [u32; 2] {
        ends(&self.corners, side)
    }

    /// The sides along an edge, ascending.
    pub fn sides(&self, edge: &Edge) -> &[u32] {
        &self.sides[edge.first as usize..(edge.first + edge.count) as usize]
    }

    fn is_upward(&self, side: u32) -> bool {
        let [from, to] = self.ends(side);
        from < to
    }

    fn find_edges(&mut self) {
        let keyed = sides_by_edge(&self.corners, |side, _| self.is_kept(side as usize / 3));
        for same in by_edge(&keyed) {
            let (ends, first) = (edge_of_key(same[0].0), self.sides.len() as u32);
            self.edges.push(Edge { ends, first, count: same.len() as u32 });
            self.sides.extend(same.iter().map(|(_, side)| *side));
        }
    }

    fn find_shells(&mut self) {
        let mut sets = TwoKinds::new(self.corners.len());
        let mut contradictions = Vec::new();
        for edge in self.edges.iter().filter(|edge| edge.count == 2) {
            let sides = self.sides(edge);
            let (one, other) = (sides[0], sides[1]);
            if !sets.join(one / 3, other / 3, self.is_upward(one) == self.is_upward(other)) {
                contradictions.push(one / 3);
            }
            (self.joined[one as usize], self.joined[other as usize]) = (other, one);
        }
        let mut shells = 0;
        for t in 0..self.corners.len() {
            if !self.is_kept(t) {
                continue;
            }
            let (first, is_turned) = sets.find(t as u32);
            self.is_turned[t] = is_turned;
            // The first triangle stands for its shell, and comes first.
            self.shells[t] = if first == t as u32 { shells } else { self.shells[first as usize] };
            shells += u32::from(first == t as u32);
        }
        self.is_orientable = vec![true; shells as usize];
        self.join_rest();
        contradictions.iter().for_each(|t| self.is_orientable[self.shells[*t as usize] as usize] = false);
    }

    /// Where more than two sides meet, those that are the only two of a shell are joined.
    fn join_rest(&mut self) {
        for edge in self.edges.iter().filter(|edge| edge.count > 2) {
            let mut sides: Vec<(u32, u32)> =
                self.sides(edge).iter().map(|side| (self.shells[*side as usize / 3], *side)).collect();
            sides.sort_unstable();
            for pair in sides.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 2) {
                let [(shell, one), (_, other)] = [pair[0], pair[1]];
                let turned = [one, other].map(|s| self.is_turned[s as usize / 3] ^ self.is_upward(s));
                if turned[0] == turned[1] {
                    self.is_orientable[shell as usize] = false;
                }
                (self.joined[one as usize], self.joined[other as usize]) = (other, one);
            }
        }
    }

    /// The corners 3t + k in sets: those of one vertex that edges lead around; across all edges, or only across sides that are
    /// joined.
    pub fn fans(&self, across_all: bool) -> Sets {
        let mut sets = Sets::new(3 * self.corners.len());
        let mut join = |one: u32, other: u32| {
            if self.is_upward(one) == self.is_upward(other) {
                sets.join(one, other);
                sets.join(next_side(one), next_side(other));
            } else {
                sets.join(one, next_side(other));
                sets.join(next_side(one), other);
            }
        };
        for edge in &self.edges {
            let sides = self.sides(edge);
            if across_all {
                sides[1..].iter().for_each(|side| join(sides[0], *side));
            } else {
                sides.iter().for_each(|side| {
                    let other = self.joined[*side as usize];
                    if other != Topology::NONE && *side < other {
                        join(*side, other);
                    }
                });
            }
        }
        sets
    }
}

fn first_copies(corners: &[[u32; 3]], left_out: LeftOut) -> Vec<u32> {
    let mut first: Vec<u32> = (0..corners.len() as u32).collect();
    let mut keyed = Vec::with_capacity(corners.len());
    let sorted = |t: u32| sorted(corners[t as usize]);
    for t in 0..corners.len() as u32 {
        let [a, b, c] = sorted(t);
        if a == b || b == c {
            first[t as usize] = Topology::COLLAPSED;
        } else {
            keyed.push((edge_key(a, b), t));
        }
    }
    sort_keyed(&mut keyed);
    for same_edge in by_edge(&keyed).filter(|same| same.len() > 1) {
        for (place, (_, t)) in same_edge.iter().enumerate() {
            let is_copy = |other: &&(u64, u32)| {
                let alike = || turn_alike(corners[*t as usize], corners[other.1 as usize]);
                sorted(*t) == sorted(other.1) && (left_out == LeftOut::AllCopies || alike())
            };
            if let Some((_, other)) = same_edge[..place].iter().find(is_copy) {
                first[*t as usize] = *other;
            }
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    fn topology(triangles: &[[u32; 3]], left_out: LeftOut) -> Topology {
        Topology::new(triangles, &(0..20).collect::<Vec<_>>(), left_out)
    }

    /// Without its last face.
    const BOWL: [[u32; 3]; 3] = [[0, 2, 1], [0, 1, 3], [0, 3, 2]];

    #[test]
    fn a_turned_triangle_is_told_apart() {
        let found = topology(&[BOWL[0], [1, 0, 3], BOWL[2], [1, 2, 3]], LeftOut::Repeated);
        assert_eq!((found.edges.len(), &found.is_orientable[..]), (6, &[true][..]));
        assert_eq!(found.is_turned, [false, true, false, false]);
        assert!(found.edges.iter().all(|edge| edge.count == 2));
        assert!(found.joined.iter().zip(0..).all(|(j, side)| found.joined[*j as usize] == side));
        // One fan for each vertex.
        let mut fans = found.fans(false);
        let roots: std::collections::HashSet<u32> = (0..12).map(|corner| fans.find(corner)).collect();
        assert_eq!(roots.len(), 4);
    }

    #[test]
    fn copies_and_collapsed_triangles_take_no_part() {
        let triangles = [&BOWL[..], &[[2, 1, 0], [0, 1, 2], [5, 5, 6]]].concat();
        let found = topology(&triangles, LeftOut::Repeated);
        assert_eq!(found.first_copies, [0, 1, 2, 0, 4, Topology::COLLAPSED]);
        let found = topology(&triangles, LeftOut::AllCopies);
        assert_eq!(found.first_copies, [0, 1, 2, 0, 0, Topology::COLLAPSED]);
        assert_eq!(found.edges.iter().map(|edge| edge.count).filter(|count| *count == 1).count(), 3);
    }

    #[test]
    fn a_strip_with_a_half_turn_has_no_sides() {
        let strip = [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 0], [4, 0, 1], [1, 2, 4]];
        assert_eq!(topology(&strip[..5], LeftOut::Repeated).is_orientable, [false]);
    }

    #[test]
    fn two_tetrahedra_along_an_edge_are_two_closed_shells() {
        let one = [BOWL[0], BOWL[1], BOWL[2], [1, 2, 3]];
        let other = one.map(|t| t.map(|v| if v < 2 { v } else { v + 2 }));
        let found = topology(&[one, other].concat(), LeftOut::Repeated);
        assert_eq!(found.shells, [0, 0, 0, 0, 1, 1, 1, 1]);
        assert!(found.joined.iter().all(|other| *other != Topology::NONE));
        let edge = found.edges.iter().find(|edge| edge.count > 2).unwrap();
        assert_eq!((edge.ends, edge.count), ([0, 1], 4));
        let count =
            |mut sets: Sets| (0..24).map(|c| sets.find(c)).collect::<std::collections::HashSet<u32>>().len();
        assert_eq!((count(found.fans(false)), count(found.fans(true))), (8, 6));
    }
}
