use crate::data::{Polygon, Ring, ascending};
use crate::math::{Vec2, orient};

/// The tolerance grows to the one asked for in this many steps of two, so that what matters least goes first.
const ROUNDS: i32 = 4;

/// A ring without the vertices that lie exactly on the line between their neighbours: it encloses the same.
pub fn straightened(ring: &[Vec2]) -> Ring {
    let count = ring.len();
    let is_between = |k: usize| {
        let (before, p, after) = (ring[(k + count - 1) % count], ring[k], ring[(k + 1) % count]);
        orient(before, p, after) == 0 && (p - before).dot(after - p) > 0.0
    };
    (0..count).filter(|k| !is_between(*k)).map(|k| ring[k]).collect()
}

/// Polygons with fewer vertices: those that went lie within `tolerance` (in the polygons' units) of what remains. Vertices only
/// leave, and one leaves only if no other vertex lies in the triangle it makes with its neighbours: rings stay simple, nested as
/// they were, and of three vertices at least.
pub fn simplify(polygons: &[Polygon], tolerance: f64) -> Vec<Polygon> {
    if tolerance <= 0.0 {
        return polygons.to_vec();
    }
    let rings: Vec<&Ring> = polygons.iter().flat_map(Polygon::rings).collect();
    let mut outline = Outline::new(&rings);
    for round in (0..ROUNDS).rev() {
        let allowed = tolerance / f64::from(1 << round);
        (0..rings.len()).for_each(|ring| outline.thin(ring, allowed));
    }
    let mut kept = (0..rings.len()).map(|ring| outline.ring(ring));
    polygons
        .iter()
        .map(|p| Polygon {
            outer: kept.next().unwrap_or_default(),
            holes: p.holes.iter().filter_map(|_| kept.next()).collect(),
        })
        .collect()
}

/// All vertices of all rings, one ring after the other.
struct Outline {
    points: Vec<Vec2>,
    alive: Vec<bool>,
    /// Where each ring starts, and the end.
    starts: Vec<usize>,
    /// Vertices in order of x, to look for those in a triangle.
    by_x: Vec<u32>,
}

impl Outline {
    fn new(rings: &[&Ring]) -> Outline {
        let mut starts = vec![0];
        starts.extend(rings.iter().scan(0, |end, ring| {
            *end += ring.len();
            Some(*end)
        }));
        let points: Vec<Vec2> = rings.iter().flat_map(|ring| ring.iter().copied()).collect();
        let by_x = ascending(points.iter().map(|p| p.x));
        Outline { alive: vec![true; points.len()], points, starts, by_x }
    }

    fn ring(&self, ring: usize) -> Ring {
        let range = self.starts[ring]..self.starts[ring + 1];
        range.filter(|&v| self.alive[v]).map(|v| self.points[v]).collect()
    }

    /// Takes vertices until none can go.
    fn thin(&mut self, ring: usize, tolerance: f64) {
        let range = self.starts[ring]..self.starts[ring + 1];
        let mut vertices: Vec<usize> = range.clone().filter(|&v| self.alive[v]).collect();
        loop {
            let count = vertices.len();
            // No two neighbours in one pass: else a whole arc could go, vertex by vertex, from one end.
            let mut k = 0;
            let mut left = count;
            while k < count && left > 3 {
                let before = vertices[(k + count - 1) % count];
                let (vertex, after) = (vertices[k], vertices[(k + 1) % count]);
                let ends_alive = self.alive[before] && self.alive[after];
                if ends_alive
                    && self.all_near(&range, before, after, tolerance)
                    && !self.holds_others([before, vertex, after])
                {
                    self.alive[vertex] = false;
                    left -= 1;
                    k += 1;
                }
                k += 1;
            }
            if left == count {
                return;
            }
            vertices.retain(|&v| self.alive[v]);
        }
    }

    /// Whether all vertices of a ring between two of them, gone or not, lie near the line from one to the other.
    fn all_near(&self, ring: &std::ops::Range<usize>, from: usize, to: usize, tolerance: f64) -> bool {
        let (a, b) = (self.points[from], self.points[to]);
        let along = b - a;
        let square = along.length_squared();
        let mut v = from;
        loop {
            v = if v + 1 == ring.end { ring.start } else { v + 1 };
            if v == to {
                return true;
            }
            let offset = self.points[v] - a;
            let share = if square > 0.0 { (offset.dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
            if (offset - share * along).length_squared() > tolerance * tolerance {
                return false;
            }
        }
    }

    /// Whether a vertex other than its corners lies in a triangle or on its border.
    fn holds_others(&self, triangle: [usize; 3]) -> bool {
        let [a, b, c] = triangle.map(|v| self.points[v]);
        let (low, high) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
        let from = self.by_x.partition_point(|&v| self.points[v as usize].x < low);
        let candidates = self.by_x[from..].iter().map(|&v| v as usize);
        let mut candidates = candidates.take_while(|&v| self.points[v].x <= high);
        let turn = (b - a).perp_dot(c - a).signum();
        candidates.any(|v| {
            let p = self.points[v];
            let on_side = |from: Vec2, to: Vec2| (to - from).perp_dot(p - from) * turn >= 0.0;
            self.alive[v] && !triangle.contains(&v) && on_side(a, b) && on_side(b, c) && on_side(c, a)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::sides;
    use std::f64::consts::TAU;

    fn circle(center: Vec2, radius: f64, count: usize) -> Ring {
        (0..count).map(|k| center + radius * Vec2::from_angle(TAU * k as f64 / count as f64)).collect()
    }

    #[test]
    fn a_circle_keeps_its_shape_and_loses_vertices() {
        let fine = Polygon { outer: circle(Vec2::ZERO, 10.0, 5000), holes: Vec::new() };
        let coarse = &simplify(std::slice::from_ref(&fine), 0.01)[0].outer;
        assert!((30..200).contains(&coarse.len()), "{}", coarse.len());
        // What lies between two that are left is at most the tolerance away.
        for (a, b) in sides(coarse) {
            assert!(10.0 - 0.5 * (a + b).length() < 0.011);
        }
    }

    #[test]
    fn a_hole_next_to_the_rim_stays_inside() {
        // A thin ring: the tolerance is ten times the width of its wall.
        let mut hole = circle(Vec2::ZERO, 9.99, 720);
        hole.reverse();
        let thin = Polygon { outer: circle(Vec2::ZERO, 10.0, 720), holes: vec![hole] };
        let simple = &simplify(&[thin], 0.1)[0];
        assert!(simple.outer.len() < 720 && simple.area() > 0.0);
        let rings = [simple.outer.clone(), simple.holes[0].clone()];
        let resolved = crate::polygon::enclosed(&rings, Default::default());
        assert_eq!((resolved.len(), resolved[0].holes.len()), (1, 1));
        assert!((resolved[0].area() - simple.area()).abs() < 1e-9, "rings do not cross");
    }

    #[test]
    fn only_what_lies_on_a_side_is_left_out() {
        let ring = [(0.0, 0.0), (1.0, 0.0), (3.0, 0.0), (3.0, 2.0), (3.0, 2.5), (1.5, 1.25)].map(Vec2::from);
        let corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.5)].map(Vec2::from);
        assert_eq!(straightened(&ring), corners);
        let spike = [(0.0, 0.0), (4.0, 0.0), (2.0, 0.0), (2.0, 2.0)].map(Vec2::from);
        assert_eq!(straightened(&spike), spike, "what folds back is a corner");
    }
}
