//! Parallel lines in polygons: infill, skins and bridges.
use crate::data::{Polygon, Ring, ascending, sides, sorted_pairs};
use crate::math::Vec2;

/// Lines go on along the border for at most so many spacings: rows that meet it at 10° are that far apart.
const LONGEST_LINK: f64 = 6.0;

/// How an area is hatched. Lines lie at the same places whatever the area, so that layers stack.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hatch {
    /// Radians from +x towards +y.
    pub angle: f64,
    pub spacing: f64,
    /// Whether lines go on into their neighbours along the border, to and fro.
    pub linked: bool,
}

/// Where a line meets a border.
#[derive(Clone, Copy)]
struct End {
    x: f64,
    row: i64,
    ring: u32,
    /// How far along the ring.
    along: f64,
}

/// Lines over polygons, from border to border.
pub(super) fn hatch(area: &[Polygon], hatch: Hatch) -> Vec<Vec<Vec2>> {
    let turn = turn(hatch.angle);
    let rings: Vec<Ring> = area
        .iter()
        .flat_map(Polygon::rings)
        .map(|ring| ring.iter().map(|p| back(turn).rotate(*p)).collect())
        .collect();
    let ends = ends(&rings, hatch.spacing);
    let lines = if hatch.linked {
        linked(&rings, &ends, hatch.spacing)
    } else {
        // Every other row backwards: the nozzle goes to and fro.
        ends.chunks_exact(2)
            .map(|pair| {
                let line = vec![pair[0].point(hatch.spacing), pair[1].point(hatch.spacing)];
                if pair[0].row % 2 == 0 { line } else { line.into_iter().rev().collect() }
            })
            .collect()
    };
    lines.into_iter().map(|line| line.into_iter().map(|p| turn.rotate(p)).collect()).collect()
}

/// The direction of an angle, the same on all platforms.
pub(super) fn turn(angle: f64) -> Vec2 {
    let (sin, cos) = libm::sincos(angle);
    Vec2::new(cos, sin)
}

/// The opposite turn.
pub(super) fn back(turn: Vec2) -> Vec2 {
    Vec2::new(turn.x, -turn.y)
}

impl End {
    fn point(&self, spacing: f64) -> Vec2 {
        Vec2::new(self.x, height(self.row, spacing))
    }
}

fn height(row: i64, spacing: f64) -> f64 {
    (row as f64 + 0.5) * spacing
}

/// Where rows cross rings, row by row, from left to right: each even one enters, each odd one leaves.
fn ends(rings: &[Ring], spacing: f64) -> Vec<End> {
    let mut ends = Vec::new();
    for (number, ring) in rings.iter().enumerate() {
        let mut along = 0.0;
        for (a, b) in sides(ring) {
            let (low, high) = (a.y.min(b.y), a.y.max(b.y));
            let row = |y: f64| (y / spacing - 0.5).floor() as i64;
            for row in row(low)..=row(high) + 1 {
                let y = height(row, spacing);
                // Half-open: a row through a vertex meets one of its two edges.
                if (a.y <= y) != (b.y <= y) {
                    let share = (y - a.y) / (b.y - a.y);
                    let (x, along) = (a.x + share * (b.x - a.x), along + share * a.distance(b));
                    ends.push(End { x, row, ring: number as u32, along });
                }
            }
            along += a.distance(b);
        }
    }
    ends.sort_unstable_by(|a, b| {
        let places = a.row.cmp(&b.row).then(a.x.total_cmp(&b.x));
        places.then(a.ring.cmp(&b.ring)).then(a.along.total_cmp(&b.along))
    });
    ends
}

/// Lines that go on along the border to the next free one, as long as it is near.
fn linked(rings: &[Ring], ends: &[End], spacing: f64) -> Vec<Vec<Vec2>> {
    let around = Around::new(rings, ends);
    let mut is_free = vec![true; ends.len() / 2];
    let mut lines = Vec::new();
    for first in 0..is_free.len() {
        if !is_free[first] {
            continue;
        }
        let mut points: Vec<Vec2> = Vec::new();
        let mut from = 2 * first;
        loop {
            let to = from ^ 1;
            is_free[from / 2] = false;
            points.extend([ends[from].point(spacing), ends[to].point(spacing)]);
            let near = around.neighbours(ends, to).into_iter().filter(|(next, distance, _)| {
                is_free[next / 2]
                    && *distance <= LONGEST_LINK * spacing
                    && ends[*next].row.abs_diff(ends[to].row) == 1
            });
            let Some((next, distance, forward)) = near.min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
            around.walk(ends[to], distance, forward, &mut points);
            from = next;
        }
        lines.push(points);
    }
    lines
}

/// The ends in their order along the rings.
struct Around<'a> {
    rings: &'a [Ring],
    /// How far along its ring each vertex is, and the whole length.
    vertices: Vec<Vec<f64>>,
    /// Ends, ring by ring.
    order: Vec<u32>,
    /// Where each end is in `order`.
    place: Vec<u32>,
    /// Where each ring starts in `order`, and the end.
    starts: Vec<usize>,
}

impl<'a> Around<'a> {
    fn new(rings: &'a [Ring], ends: &[End]) -> Around<'a> {
        let lengths = |ring: &Ring| {
            let mut along = vec![0.0];
            for (a, b) in sides(ring) {
                along.push(along[along.len() - 1] + a.distance(b));
            }
            along
        };
        // First all in order along their rings, then ring by ring.
        let along = ascending(ends.iter().map(|end| end.along));
        let by_ring = sorted_pairs(along.iter().zip(0..).map(|(end, rank)| [ends[*end as usize].ring, rank]));
        let order: Vec<u32> = by_ring.into_iter().map(|[_, rank]| along[rank as usize]).collect();
        let mut place = vec![0; ends.len()];
        (0..).zip(&order).for_each(|(k, end)| place[*end as usize] = k);
        let of_ring = |ring: usize| order.partition_point(|end| (ends[*end as usize].ring as usize) < ring);
        let starts = (0..=rings.len()).map(of_ring).collect();
        Around { rings, vertices: rings.iter().map(lengths).collect(), order, place, starts }
    }

    /// The ends before and after one on its ring, how far they are, and whether forwards.
    fn neighbours(&self, ends: &[End], end: usize) -> [(usize, f64, bool); 2] {
        let ring = ends[end].ring as usize;
        let (start, stop) = (self.starts[ring], self.starts[ring + 1]);
        let place = self.place[end] as usize;
        let length = self.vertices[ring][self.vertices[ring].len() - 1];
        let before = self.order[if place == start { stop - 1 } else { place - 1 }] as usize;
        let after = self.order[if place + 1 == stop { start } else { place + 1 }] as usize;
        let forward = (ends[after].along - ends[end].along).rem_euclid(length);
        let backward = (ends[end].along - ends[before].along).rem_euclid(length);
        [(after, forward, true), (before, backward, false)]
    }

    /// Adds the vertices on the way from an end along its ring.
    fn walk(&self, from: End, distance: f64, forward: bool, points: &mut Vec<Vec2>) {
        let (ring, along) = (&self.rings[from.ring as usize], &self.vertices[from.ring as usize]);
        let (count, length) = (ring.len(), along[along.len() - 1]);
        let after = along[..count].partition_point(|a| *a <= from.along);
        for k in 0..count {
            let vertex = if forward { (after + k) % count } else { (after + 2 * count - 1 - k) % count };
            let way = if forward { along[vertex] - from.along } else { from.along - along[vertex] };
            let way = way.rem_euclid(length);
            if way >= distance {
                return;
            }
            points.push(ring[vertex]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print::path::length_of;

    fn square(side: f64) -> Polygon {
        let outer = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        Polygon { outer: outer.map(Vec2::from).to_vec(), holes: Vec::new() }
    }

    fn frame() -> Polygon {
        let hole = square(4.0).outer.iter().rev().map(|p| *p + Vec2::splat(3.0)).collect();
        Polygon { holes: vec![hole], ..square(10.0) }
    }

    #[test]
    fn lines_cover_the_area_at_any_angle() {
        for degrees in [0.0_f64, 30.0, 45.0, 90.0, 120.0] {
            let how = Hatch { angle: degrees.to_radians(), spacing: 0.5, linked: false };
            let lines = hatch(&[frame()], how);
            let covered = 0.5 * lines.iter().map(|l| length_of(l, false)).sum::<f64>();
            assert!((covered / 84.0 - 1.0).abs() < 0.01, "{degrees}: {covered}");
            let along = turn(how.angle);
            assert!(lines.iter().all(|l| (l[1] - l[0]).normalize().perp_dot(along).abs() < 1e-9));
        }
    }

    #[test]
    fn linked_lines_are_few_and_stay_inside() {
        let how = Hatch { angle: 0.3, spacing: 0.4, linked: true };
        let lines = hatch(&[frame()], how);
        assert!(lines.len() <= 4, "{}", lines.len());
        let inside = |p: Vec2| {
            p.min_element() > -1e-9
                && p.max_element() < 10.0 + 1e-9
                && !(p.min_element() > 3.0 + 1e-9 && p.max_element() < 7.0 - 1e-9)
        };
        for line in &lines {
            for w in line.windows(2) {
                assert!((0..=10).all(|k| inside(w[0].lerp(w[1], f64::from(k) / 10.0))));
            }
        }
        // Half of the border is walked in addition.
        let covered = 0.4 * lines.iter().map(|l| length_of(l, false)).sum::<f64>();
        let expected = 84.0 + 0.4 * 0.5 * (40.0 + 16.0);
        assert!((covered / expected - 1.0).abs() < 0.03, "{covered} {expected}");
    }

    #[test]
    fn nothing_is_hatched_where_nothing_is() {
        assert!(hatch(&[], Hatch { angle: 0.0, spacing: 1.0, linked: true }).is_empty());
        assert!(hatch(&[square(0.1)], Hatch { angle: 0.0, spacing: 1.0, linked: true }).is_empty());
    }
}
