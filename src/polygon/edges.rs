use crate::data::{Polygon, sides};
use crate::math::Vec2;

/// Pieces shorter than this part of a cell are rounding, not geometry.
const SHORTEST: f64 = 1e-9;
/// How far beyond its cells an edge is entered, in cells: crossings on a border of cells are found from both of them.
const MARGIN: f64 = 1e-6;

/// The edges of polygons in the cells of a grid: answers in the time that what lies nearby takes.
pub struct EdgeGrid {
    edges: Vec<Edge>,
    low: Vec2,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's edges start in `members`, and the end.
    starts: Vec<u32>,
    members: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Edge {
    from: Vec2,
    to: Vec2,
    polygon: u32,
}

/// A stretch of a line that lies all inside polygons, or all outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    pub points: Vec<Vec2>,
    pub is_inside: bool,
}

impl EdgeGrid {
    pub fn new(polygons: &[Polygon]) -> EdgeGrid {
        let mut edges = Vec::new();
        for (polygon, shape) in polygons.iter().enumerate() {
            let all = shape.rings().flat_map(|ring| sides(ring));
            edges.extend(all.map(|(from, to)| Edge { from, to, polygon: polygon as u32 }));
        }
        let (low, high) = edges.iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), edge| {
            (low.min(edge.from), high.max(edge.from))
        });
        let size = if edges.is_empty() { Vec2::ONE } else { (high - low).max(Vec2::splat(1e-6)) };
        // About as many cells as edges; none so thin that a flat shape would get a million of them in a row.
        let cell = (size.x * size.y / edges.len().max(1) as f64).sqrt().max(size.max_element() / 4096.0);
        let count = |extent: f64| ((extent / cell) as usize + 1).min(4097);
        let mut grid = EdgeGrid {
            low: if edges.is_empty() { Vec2::ZERO } else { low },
            cell,
            columns: count(size.x),
            rows: count(size.y),
            edges,
            starts: Vec::new(),
            members: Vec::new(),
        };
        grid.enter_edges();
        grid
    }

    /// Counts, then places: two passes over the same cells in place of a list for each cell.
    fn enter_edges(&mut self) {
        let mut starts = vec![0_u32; self.columns * self.rows + 1];
        for edge in &self.edges {
            self.for_cells(edge.from, edge.to, |cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut next = starts.clone();
        let mut members = vec![0; starts[starts.len() - 1] as usize];
        for (number, edge) in self.edges.iter().enumerate() {
            self.for_cells(edge.from, edge.to, |cell| {
                members[next[cell] as usize] = number as u32;
                next[cell] += 1;
            });
        }
        (self.starts, self.members) = (starts, members);
    }

    /// Every cell that a segment touches, row by row.
    fn for_cells(&self, from: Vec2, to: Vec2, mut visit: impl FnMut(usize)) {
        let (a, b) = ((from - self.low) / self.cell, (to - self.low) / self.cell);
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        let slope = (b.x - a.x) / (b.y - a.y);
        let (first, last) = (self.row(a.y - MARGIN), self.row(b.y + MARGIN));
        let (least, most) = (a.x.min(b.x), a.x.max(b.x));
        for row in first..=last {
            let (mut left, mut right) = (least, most);
            if first < last && slope.is_finite() {
                // Only where the segment crosses this row; the outermost rows take in all that lies beyond the grid.
                let at = |y: f64| a.x + (y.clamp(a.y, b.y) - a.y) * slope;
                let below = if row == first { a.y } else { row as f64 - MARGIN };
                let above = if row == last { b.y } else { row as f64 + 1.0 + MARGIN };
                let (one, other) = (at(below), at(above));
                (left, right) = (one.min(other).max(least), one.max(other).min(most));
            }
            for column in self.column(left - MARGIN)..=self.column(right + MARGIN) {
                visit(row * self.columns + column);
            }
        }
    }

    fn row(&self, y: f64) -> usize {
        (y.max(0.0) as usize).min(self.rows - 1)
    }

    fn column(&self, x: f64) -> usize {
        (x.max(0.0) as usize).min(self.columns - 1)
    }

    fn members(&self, cell: usize) -> &[u32] {
        &self.members[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// The polygon that a point lies in: the parity of crossings with the ray towards +x.
    pub fn polygon_around(&self, p: Vec2) -> Option<usize> {
        let place = (p - self.low) / self.cell;
        let row = self.row(place.y);
        let mut odd: Vec<u32> = Vec::new();
        for column in self.column(place.x)..self.columns {
            for &member in self.members(row * self.columns + column) {
                let Edge { from: a, to: b, polygon } = self.edges[member as usize];
                if (a.y <= p.y) == (b.y <= p.y) {
                    continue;
                }
                let x = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
                // An edge is in several cells of the row: it counts in that of its crossing.
                let is_here = self.column(((x - self.low.x) / self.cell).max(place.x)) == column;
                if x > p.x && is_here {
                    match odd.iter().position(|o| *o == polygon) {
                        Some(place) => drop(odd.swap_remove(place)),
                        None => odd.push(polygon),
                    }
                }
            }
        }
        odd.into_iter().min().map(|polygon| polygon as usize)
    }

    pub fn contains(&self, p: Vec2) -> bool {
        self.polygon_around(p).is_some()
    }

    /// The point on an edge nearest to `p`, if one is nearer than `reach`.
    pub fn nearest_on_edges(&self, p: Vec2, reach: f64) -> Option<Vec2> {
        let (low, high) = ((p - self.low - reach) / self.cell, (p - self.low + reach) / self.cell);
        let mut best = (reach * reach, None);
        for row in self.row(low.y)..=self.row(high.y) {
            for column in self.column(low.x)..=self.column(high.x) {
                for &member in self.members(row * self.columns + column) {
                    let edge = &self.edges[member as usize];
                    let q = nearest_on_segment(p, edge.from, edge.to);
                    let squared = q.distance_squared(p);
                    if squared < best.0 {
                        best = (squared, Some(q));
                    }
                }
            }
        }
        best.1
    }

    /// Cuts a line, or a ring if it is `closed`, where it enters or leaves the polygons. The stretches follow one another, each
    /// begins where the one before ends, and neighbours differ. A ring that is cut gets as its first a stretch that begins at a
    /// cut; one that is not cut comes back whole, without its first point repeated.
    pub fn cut(&self, line: &[Vec2], closed: bool) -> Vec<Stretch> {
        let mut stretches: Vec<Stretch> = Vec::new();
        let mut state: Option<bool> = None;
        let ends = line.iter().skip(1).chain(line.first().filter(|_| closed));
        for (&a, &b) in line.iter().zip(ends) {
            let cuts = self.crossings(a, b);
            let mut from = 0.0;
            for &to in cuts.iter().chain(&[1.0]) {
                if (to - from) * a.distance(b) <= SHORTEST * self.cell {
                    // The cut counts, though the piece is too short to be asked about: the next one is asked.
                    state = state.filter(|_| cuts.is_empty());
                    continue;
                }
                // Told anew wherever something is crossed: a crossing that rounding hides or doubles goes no further.
                if !cuts.is_empty() || state.is_none() {
                    state = Some(self.contains(a.lerp(b, 0.5 * (from + to))));
                }
                append(&mut stretches, a.lerp(b, from), a.lerp(b, to), state == Some(true));
                from = to;
            }
        }
        if closed { joined_at_start(stretches) } else { stretches }
    }

    /// Where on the way from `a` to `b` edges are crossed, ascending, in [0, 1].
    fn crossings(&self, a: Vec2, b: Vec2) -> Vec<f64> {
        let mut found = Vec::new();
        self.for_cells(a, b, |cell| {
            for &member in self.members(cell) {
                let edge = &self.edges[member as usize];
                let (p, q) = (edge.from, edge.to);
                let side = |x: Vec2| (q - p).perp_dot(x - p);
                let across = |x: Vec2| (b - a).perp_dot(x - a) >= 0.0;
                let (before, after) = (side(a), side(b));
                if (before >= 0.0) != (after >= 0.0) && across(p) != across(q) {
                    found.push((before / (before - after)).clamp(0.0, 1.0));
                }
            }
        });
        found.sort_unstable_by(f64::total_cmp);
        found.dedup();
        found
    }
}

/// The point of a segment that is nearest to `p`.
pub fn nearest_on_segment(p: Vec2, a: Vec2, b: Vec2) -> Vec2 {
    let along = b - a;
    let square = along.length_squared();
    let share = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    a + share * along
}

fn append(stretches: &mut Vec<Stretch>, from: Vec2, to: Vec2, is_inside: bool) {
    match stretches.last_mut() {
        Some(last) if last.is_inside == is_inside => last.points.push(to),
        _ => stretches.push(Stretch { points: vec![from, to], is_inside }),
    }
}

/// A ring's last stretch goes on as its first where both are of one kind.
fn joined_at_start(mut stretches: Vec<Stretch>) -> Vec<Stretch> {
    if let [only] = stretches.as_mut_slice() {
        only.points.pop();
    } else if stretches.len() > 1 && stretches[0].is_inside == stretches[stretches.len() - 1].is_inside {
        let first = stretches.remove(0);
        if let Some(last) = stretches.last_mut() {
            last.points.extend(&first.points[1..]);
        }
        stretches.rotate_right(1);
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Ring;
    use crate::polygon::tests::square;

    /// A square of 10 with a hole of 2 in the middle, and an island in it.
    fn frame() -> Vec<Polygon> {
        let mut hole = square(4.0, 4.0, 2.0);
        hole.reverse();
        vec![
            Polygon { outer: square(0.0, 0.0, 10.0), holes: vec![hole] },
            Polygon { outer: square(4.5, 4.5, 1.0), holes: vec![] },
        ]
    }

    #[test]
    fn points_are_found_in_their_polygons() {
        let grid = EdgeGrid::new(&frame());
        let at = |x: f64, y: f64| grid.polygon_around(Vec2::new(x, y));
        assert_eq!(
            (at(1.0, 5.0), at(4.2, 5.0), at(5.0, 5.0), at(7.0, 5.0)),
            (Some(0), None, Some(1), Some(0))
        );
        assert_eq!((at(-1.0, 5.0), at(11.0, 5.0), at(5.0, -1.0), at(5.0, 11.0)), (None, None, None, None));
        assert!(EdgeGrid::new(&[]).polygon_around(Vec2::ZERO).is_none());
    }

    #[test]
    fn lines_are_cut_in_order() {
        let grid = EdgeGrid::new(&frame());
        let line = [Vec2::new(-1.0, 5.0), Vec2::new(2.0, 5.0), Vec2::new(11.0, 5.0)];
        let cut = grid.cut(&line, false);
        let rounded = |x: f64| (1e12 * x).round() / 1e12 + 0.0;
        let ends: Vec<(f64, bool)> = cut.iter().map(|s| (rounded(s.points[0].x), s.is_inside)).collect();
        let expected =
            [(-1.0, false), (0.0, true), (4.0, false), (4.5, true), (5.5, false), (6.0, true), (10.0, false)];
        assert_eq!(ends, expected);
        assert_eq!(cut[1].points.len(), 3, "the vertex between is kept");
        assert!(cut.windows(2).all(|w| w[0].points.last() == w[1].points.first()));
    }

    #[test]
    fn rings_start_at_a_cut_or_stay_whole() {
        let grid = EdgeGrid::new(&frame());
        let ring = square(8.0, 8.0, 4.0);
        let cut = grid.cut(&ring, true);
        assert_eq!(cut.iter().map(|s| s.is_inside).collect::<Vec<_>>(), [true, false]);
        assert_eq!((cut[0].points[0], cut[0].points.len()), (Vec2::new(8.0, 10.0), 3));
        let whole = grid.cut(&square(1.0, 1.0, 1.0), true);
        assert_eq!((whole.len(), whole[0].points.len(), whole[0].is_inside), (1, 4, true));
    }

    #[test]
    fn lines_through_vertices_are_cut_once() {
        let diamond: Ring = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)].map(Vec2::from).to_vec();
        let grid = EdgeGrid::new(&[Polygon { outer: diamond, holes: vec![] }]);
        let cut = grid.cut(&[Vec2::new(-2.0, 0.0), Vec2::new(2.0, 0.0)], false);
        assert_eq!(cut.iter().map(|s| s.is_inside).collect::<Vec<_>>(), [false, true, false]);
        let touching = grid.cut(&[Vec2::new(-2.0, 1.0), Vec2::new(2.0, 1.0)], false);
        assert!(touching.iter().all(|s| !s.is_inside));
    }

    #[test]
    fn level_edges_on_a_border_of_cells_are_in_all_their_cells() {
        let grid = EdgeGrid::new(&[Polygon { outer: square(0.0, 0.0, 20.0), holes: vec![] }]);
        let cut = grid.cut(&[Vec2::new(8.05, 19.9), Vec2::new(8.1, 20.1)], false);
        assert_eq!(cut.iter().map(|s| s.is_inside).collect::<Vec<_>>(), [true, false]);
    }

    #[test]
    fn the_nearest_edge_is_found_within_reach() {
        let grid = EdgeGrid::new(&frame());
        assert_eq!(grid.nearest_on_edges(Vec2::new(1.0, 3.0), 2.0), Some(Vec2::new(0.0, 3.0)));
        assert_eq!(grid.nearest_on_edges(Vec2::new(2.0, 7.5), 1.0), None);
    }
}
