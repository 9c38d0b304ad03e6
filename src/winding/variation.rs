//! How fast the winding number changes, from the boundary edges alone.
//!
//! The gradient of w is that of the boundary chain, by the law of Biot & Savart 1/4π ∮ dl × r / r³: an edge of length l at
//! distance d contributes no more than min(l / d², 2 / d) / 4π. Along a path of length R from where the distance is d > R
//! that adds up to no more than R min(l / d, 2) / (d − R) / 4π. Caps do not matter for it: across them w is smooth.
use crate::math::{Aabb, Vec3};
use std::f64::consts::PI;

/// Edges of a group: consecutive ones of a cycle lie close together.
const GROUP: usize = 6;
/// Groups farther away than this many of their radii, and of the ball's, are bounded as a whole.
const FAR: f64 = 3.0;

/// Boundary edges, for bounds of how much w varies.
#[derive(Clone, Debug, Default)]
pub struct BoundaryEdges {
    groups: Vec<Group>,
}

#[derive(Clone, Debug)]
struct Group {
    center: Vec3,
    radius: f64,
    /// Of all its edges.
    length: f64,
    edges: Vec<Edge>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    from: Vec3,
    along: Vec3,
    length: f64,
    /// Of the squared length; 0 for an edge too short to have one.
    inverse: f64,
}

impl Edge {
    fn new([from, to]: [Vec3; 2]) -> Edge {
        let along = to - from;
        let squared = along.length_squared();
        let inverse = if squared > f64::MIN_POSITIVE { 1.0 / squared } else { 0.0 };
        Edge { from, along, length: along.length(), inverse }
    }

    /// A lower bound of the distance to a point.
    fn distance(&self, q: Vec3) -> f64 {
        let to_point = q - self.from;
        let place = (to_point.dot(self.along) * self.inverse).clamp(0.0, 1.0);
        let distance = (to_point - place * self.along).length() * (1.0 - 1e-9);
        // Without an inverse it is the distance to one end.
        if self.inverse > 0.0 { distance } else { distance - 1e-150 }
    }
}

impl Group {
    fn new(edges: &[[Vec3; 2]]) -> Group {
        let center = Aabb::around(edges.iter().flatten().copied()).center();
        let radius = edges.iter().flatten().map(|p| p.distance(center)).fold(0.0, f64::max);
        let edges: Vec<Edge> = edges.iter().map(|e| Edge::new(*e)).collect();
        Group { center, radius: radius * (1.0 + 1e-9), length: edges.iter().map(|e| e.length).sum(), edges }
    }

    /// 4π times the variation for each length of the path; infinite if an edge may be within `radius` of `center`.
    fn variation(&self, center: Vec3, radius: f64) -> f64 {
        let distance = center.distance(self.center) * (1.0 - 1e-9) - self.radius;
        if !distance.is_finite() {
            return f64::INFINITY; // its square is out of range
        }
        if distance > FAR * self.radius.max(radius) {
            return self.length / (distance * (distance - radius));
        }
        let mut sum = 0.0;
        for edge in &self.edges {
            let distance = edge.distance(center);
            if distance <= radius * (1.0 + 1e-9) || !distance.is_finite() {
                return f64::INFINITY;
            }
            sum += (edge.length / distance).min(2.0) / (distance - radius);
        }
        sum
    }
}

impl BoundaryEdges {
    pub fn new(edges: impl Iterator<Item = [Vec3; 2]>) -> BoundaryEdges {
        let edges: Vec<[Vec3; 2]> = edges.collect();
        BoundaryEdges { groups: edges.chunks(GROUP).map(Group::new).collect() }
    }

    /// How much w, continued smoothly through the openings, differs at most between `center` and a point within `radius`
    /// of it, if that is not more than `limit`; infinite otherwise, or if an edge may reach that far.
    pub fn variation(&self, center: Vec3, radius: f64, limit: f64) -> f64 {
        let mut sum = 0.0;
        for group in &self.groups {
            sum += group.variation(center, radius) * radius / (4.0 * PI);
            if sum > limit {
                return f64::INFINITY;
            }
        }
        sum * (1.0 + 1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::winding::curtain::Curtain;

    #[test]
    fn the_bound_holds_around_rims_of_short_and_long_edges() {
        let rim = |n: usize| -> Vec<Vec3> {
            let turn = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
            (0..n).map(|k| Vec3::new(0.1 * turn(3 * k).sin(), turn(k).cos(), turn(k).sin())).collect()
        };
        for n in [3, 4, 50] {
            let curtain = Curtain::new(vec![rim(n)]);
            let boundary = BoundaryEdges::new(curtain.each_edge());
            let mut bounded = 0;
            for k in 0..3000 {
                let t = f64::from(k);
                let center = 2.0 * Vec3::new((1.3 * t).sin(), (2.1 * t).cos(), (0.7 * t).sin());
                let radius = 0.4 * (1.1 * t).sin().abs();
                let bound = boundary.variation(center, radius, 0.5);
                let nearest = boundary
                    .groups
                    .iter()
                    .flat_map(|g| &g.edges)
                    .map(|e| e.distance(center))
                    .fold(9.0, f64::min);
                assert!(bound.is_infinite() || nearest > radius);
                bounded += usize::from(bound < 0.5);
                for step in 0..4 {
                    let s = t + f64::from(step);
                    let offset =
                        Vec3::new((3.0 * s).sin(), (5.0 * s).cos(), (4.0 * s).sin()).normalize() * radius;
                    // Continued through curtains the sum jumps by whole turns.
                    let change = curtain.fraction(center + offset) - curtain.fraction(center);
                    assert!((change - change.round()).abs() <= bound + 1e-14, "{center} {radius}: {change}");
                }
            }
            assert!(bounded > 500, "{bounded}");
        }
    }
}
