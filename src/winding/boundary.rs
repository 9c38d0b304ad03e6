//! How fast the winding number changes, from the boundary edges alone.
//!
//! The gradient of w is that of the boundary chain, by the law of Biot & Savart 1/4π ∮ dl × r / r³: an edge of length l at
//! distance d contributes no more than min(l / d², 2 / d) / 4π. Along a path of length R from where the distance is d > R
//! that adds up to no more than R min(l / d, 2) / (d − R) / 4π. Caps do not matter for it: across them w is smooth.
use crate::math::Vec3;
use std::f64::consts::PI;

/// Boundary edges, for bounds of how much w varies.
#[derive(Clone, Debug, Default)]
pub struct BoundaryEdges {
    edges: Vec<Edge>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    from: Vec3,
    along: Vec3,
    length: f64,
    /// Of the squared length; 0 for an edge without length.
    inverse: f64,
}

impl BoundaryEdges {
    pub fn new(edges: impl Iterator<Item = [Vec3; 2]>) -> BoundaryEdges {
        let edge = |[from, to]: [Vec3; 2]| {
            let along = to - from;
            let squared = along.length_squared();
            let inverse = if squared > f64::MIN_POSITIVE { 1.0 / squared } else { 0.0 };
            Edge { from, along, length: along.length(), inverse }
        };
        BoundaryEdges { edges: edges.map(edge).collect() }
    }

    /// How much w, continued smoothly through the openings, differs at most between `center` and a point within `radius`
    /// of it, if that is not more than `limit`; infinite otherwise, or if an edge may reach that far.
    pub fn variation(&self, center: Vec3, radius: f64, limit: f64) -> f64 {
        let mut sum = 0.0;
        for edge in &self.edges {
            let to_center = center - edge.from;
            let place = (to_center.dot(edge.along) * edge.inverse).clamp(0.0, 1.0);
            let distance = (to_center - place * edge.along).length() * (1.0 - 1e-9);
            // An edge too short to have an inverse is nowhere longer than that.
            let distance = if edge.inverse > 0.0 { distance } else { distance - edge.length };
            let left = distance - radius;
            if !(left > 1e-9 * radius) {
                return f64::INFINITY;
            }
            sum += (edge.length / distance).min(2.0) / left;
            if sum * radius > 4.0 * PI * limit {
                return f64::INFINITY;
            }
        }
        sum * radius / (4.0 * PI) * (1.0 + 1e-9)
    }
}
