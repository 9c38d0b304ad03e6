//! Marching squares by continuation: closed contours of an inside test in a plane.
use super::{At, crossing};
use crate::data::Ring;
use crate::math::Vec2;
use rustc_hash::{FxHashMap, FxHashSet};

/// Square cells in a plane: node (i, j) lies at `origin + spacing * (i, j)`, cell (i, j) is up and right of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneGrid {
    pub origin: Vec2,
    pub spacing: f64,
}

type Square = [i32; 2];

/// The edge from a node to the next along x (axis 0) or y (axis 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Edge {
    node: Square,
    axis: u8,
}

impl PlaneGrid {
    pub fn node(&self, [i, j]: [i32; 2]) -> Vec2 {
        self.origin + self.spacing * Vec2::new(f64::from(i), f64::from(j))
    }

    /// The cell that holds `p`.
    pub fn cell(&self, p: Vec2) -> [i32; 2] {
        ((p - self.origin) / self.spacing).floor().to_array().map(|c| c as i32)
    }
}

/// Traces every contour that passes through a seed cell, as closed rings with the inside on their left: outer rings
/// run counter-clockwise, holes clockwise. Rings do not cross themselves or each other.
///
/// ```text
/// 3──2──2    corners and edges of a cell, both counted counter-clockwise;
/// 3     1    edge k goes from corner k to corner k + 1
/// 0──0──1
/// ```
pub fn trace_contours(
    grid: &PlaneGrid,
    seeds: impl IntoIterator<Item = [i32; 2]>,
    inside: impl FnMut(Vec2, At) -> bool,
) -> Vec<Ring> {
    let mut tracer = Tracer { grid, inside, nodes: FxHashMap::default() };
    let mut next_edge: FxHashMap<Edge, Edge> = FxHashMap::default();
    let mut starts = Vec::new();
    let mut visited: FxHashSet<u64> = FxHashSet::default();
    let mut pending: Vec<Square> = seeds.into_iter().collect();
    while let Some(cell) = pending.pop() {
        if !visited.insert(key(cell)) {
            continue;
        }
        for (from, to) in tracer.segments(cell) {
            starts.push(edge_of(cell, from));
            next_edge.insert(edge_of(cell, from), edge_of(cell, to));
            pending.extend([across(cell, from), across(cell, to)]);
        }
    }
    tracer.rings(starts, next_edge)
}

fn key([i, j]: Square) -> u64 {
    u64::from(i as u32) | u64::from(j as u32) << 32
}

const CORNERS: [Square; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

fn edge_of([i, j]: Square, side: usize) -> Edge {
    match side {
        0 => Edge { node: [i, j], axis: 0 },
        1 => Edge { node: [i + 1, j], axis: 1 },
        2 => Edge { node: [i, j + 1], axis: 0 },
        _ => Edge { node: [i, j], axis: 1 },
    }
}

fn across([i, j]: Square, side: usize) -> Square {
    match side {
        0 => [i, j - 1],
        1 => [i + 1, j],
        2 => [i, j + 1],
        _ => [i - 1, j],
    }
}

struct Tracer<'a, F> {
    grid: &'a PlaneGrid,
    inside: F,
    /// By their keys: those of surfaces are numbers too, and share the map's code.
    nodes: FxHashMap<u64, bool>,
}

impl<F: FnMut(Vec2, At) -> bool> Tracer<'_, F> {
    fn is_inside(&mut self, node: Square) -> bool {
        let (grid, inside) = (self.grid, &mut self.inside);
        *self.nodes.entry(key(node)).or_insert_with(|| inside(grid.node(node), At::Node))
    }

    /// The contour's segments in a cell, from side to side, the inside on their left.
    fn segments(&mut self, [i, j]: Square) -> Vec<(usize, usize)> {
        let corner = CORNERS.map(|[x, y]| self.is_inside([i + x, j + y]));
        // On a counter-clockwise walk around the cell, a segment with the inside on its left comes in through the side
        // where the inside ends and leaves through the one where it begins.
        let begins: Vec<usize> = (0..4).filter(|&k| !corner[k] && corner[(k + 1) % 4]).collect();
        let ends: Vec<usize> = (0..4).filter(|&k| corner[k] && !corner[(k + 1) % 4]).collect();
        if begins.len() < 2 {
            return ends.into_iter().zip(begins).collect();
        }
        // A saddle: the middle tells whether the inside corners are joined or cut off singly.
        let middle = self.grid.node([i, j]) + 0.5 * Vec2::splat(self.grid.spacing);
        let joined = (self.inside)(middle, At::Node);
        let turn = if joined { 1 } else { 3 };
        ends.iter().map(|&end| (end, (end + turn) % 4)).collect()
    }

    fn rings(mut self, starts: Vec<Edge>, mut next_edge: FxHashMap<Edge, Edge>) -> Vec<Ring> {
        let mut rings = Vec::new();
        for start in starts {
            let mut ring = Vec::new();
            let mut edge = start;
            while let Some(next) = next_edge.remove(&edge) {
                ring.push(self.vertex(edge));
                edge = next;
            }
            if ring.len() > 2 {
                rings.push(without_collinear(ring, self.grid.spacing));
            }
        }
        rings
    }

    fn vertex(&mut self, edge: Edge) -> Vec2 {
        let [i, j] = edge.node;
        let far = if edge.axis == 0 { [i + 1, j] } else { [i, j + 1] };
        let at_zero = self.is_inside(edge.node);
        let (a, b) = (self.grid.node(edge.node), self.grid.node(far));
        let inside = &mut self.inside;
        a.lerp(b, crossing(at_zero, |t| inside(a.lerp(b, t), At::Edge)))
    }
}

/// Share of a cell by which a vertex may lie off the line between its neighbours and still be left out: ten times the
/// error of bisection, far below what can be seen.
const COLLINEAR: f64 = 1e-5;

fn without_collinear(ring: Ring, spacing: f64) -> Ring {
    let mut kept: Ring = Vec::new();
    for (k, &p) in ring.iter().enumerate() {
        let previous = kept.last().copied().unwrap_or(ring[ring.len() - 1]);
        let along = ring[(k + 1) % ring.len()] - previous;
        let off_line = along.perp_dot(p - previous).abs();
        if off_line > COLLINEAR * spacing * along.length() || along.dot(p - previous) < 0.0 {
            kept.push(p);
        }
    }
    if kept.len() > 2 { kept } else { ring }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::signed_area;
    use std::f64::consts::PI;

    const GRID: PlaneGrid = PlaneGrid { origin: Vec2::new(-2.03, -2.01), spacing: 0.05 };

    #[test]
    fn ring_around_a_hole_gives_two_contours_of_opposite_turn() {
        let annulus = |p: Vec2| (0.5..=1.0).contains(&p.length());
        let seeds = [GRID.cell(Vec2::X), GRID.cell(0.5 * Vec2::Y)];
        let rings = trace_contours(&GRID, seeds, |p, _| annulus(p));
        let mut areas: Vec<f64> = rings.iter().map(|r| signed_area(r)).collect();
        areas.sort_by(f64::total_cmp);
        assert_eq!(areas.len(), 2);
        assert!((areas[0] + 0.25 * PI).abs() < 2e-3 && (areas[1] - PI).abs() < 4e-3, "{areas:?}");
        assert!(
            rings.iter().flatten().all(|p| (p.length() - 1.0).abs().min((p.length() - 0.5).abs()) < 1e-7)
        );
    }

    #[test]
    fn straight_sides_keep_only_their_ends() {
        let square = |p: Vec2| p.abs().max_element() <= 1.0;
        let rings = trace_contours(&GRID, [GRID.cell(Vec2::new(1.0, 0.3))], |p, _| square(p));
        assert_eq!(rings.len(), 1);
        assert_eq!(rings[0].len(), 8, "four sides, four cut corners");
        assert!((signed_area(&rings[0]) - 4.0).abs() < 4.0 * GRID.spacing * GRID.spacing);
    }

    #[test]
    fn every_saddle_closes() {
        let checkers = |p: Vec2| (p.x * 23.0).sin() * (p.y * 19.0).sin() > 0.1 && p.length() < 1.2;
        let seeds = (0..80).flat_map(|i| (0..80).map(move |j| [i, j]));
        let rings = trace_contours(&GRID, seeds, |p, _| checkers(p));
        assert!(rings.len() > 50);
        assert!(rings.iter().all(|r| signed_area(r) != 0.0));
    }

    #[test]
    fn nothing_inside_gives_no_ring() {
        assert!(trace_contours(&GRID, [[0, 0]], |_, _| false).is_empty());
    }
}
