//! The gradient of the winding number, summed directly in f64: the oracle of the fast one.
//!
//! The solid angle of a surface is the potential of a current along its rim, so its gradient is the Biot–Savart integral
//! ∇w(q) = (1/4π) ∮ r × dr / |r|³, r = x − q, over the boundary chain alone. On the straight edge from a to b, relative to
//! q, the integral is (a × b) (|a| + |b|) / (|a||b| (|a||b| + a·b)).
use crate::data::{OrientedCloud, Shape, TriangleSoup};
use crate::math::Vec3;
use std::f64::consts::PI;

/// What the directed edge from `a` to `b` adds to the gradient of the winding number at `q`: along edges whose surface
/// lies to the left, seen from its outer side.
///
/// 0 where `q` lies on the edge, which is singular there, or on its line. The error is a few roundings of
/// |q − edge| for the direction, and of the value itself: nothing cancels far away, next to the edge or next to its line.
pub fn edge_gradient(q: Vec3, a: Vec3, b: Vec3) -> Vec3 {
    // Along the edge from the corners as given, and from the nearer one to the query: exact where it matters.
    let along = b - a;
    let (a, b) = (a - q, b - q);
    let (length_a, length_b) = (a.length(), b.length());
    if length_a == 0.0 || length_b == 0.0 {
        return Vec3::ZERO;
    }
    let (near, shorter, longer) =
        if length_a <= length_b { (a, length_a, length_b) } else { (b, length_b, length_a) };
    let sine = (near / shorter).cross(along / longer);
    let sine_squared = sine.length_squared();
    if sine_squared == 0.0 {
        return Vec3::ZERO;
    }
    let cosine = (a / length_a).dot(b / length_b);
    // 1 / (1 + cos), without the cancellation between the two ends.
    let weight = if cosine >= 0.0 { 1.0 / (1.0 + cosine) } else { (1.0 - cosine) / sine_squared };
    (1.0 / length_a + 1.0 / length_b) * weight / (4.0 * PI) * sine
}

/// The gradient of [`super::winding_of_soup`] at `q`, per millimetre: it points to where w grows, inward.
///
/// It depends on the boundary only. On the surface, where w jumps, it is that of the continuous part, the same on both
/// sides; edges that hold `q` contribute 0. In the sum over all triangles the edges of a closed mesh cancel to
/// rounding: what is left is some 10⁻¹⁶ of the largest single term. NaN where `q` is not finite.
pub fn winding_gradient_of_soup(soup: &TriangleSoup, q: Vec3) -> Vec3 {
    if !q.is_finite() {
        return Vec3::NAN;
    }
    (0..soup.len()).map(|t| rim_gradient(q, soup.corners(t))).sum()
}

/// The sum over the edges of a triangle.
pub fn rim_gradient(q: Vec3, [a, b, c]: [Vec3; 3]) -> Vec3 {
    edge_gradient(q, a, b) + edge_gradient(q, b, c) + edge_gradient(q, c, a)
}

/// The gradient of [`super::winding_of_cloud`] at `q`: Σ a (3 (n·u) u − n) / (4π |r|³), r = p − q, u = r/|r|.
///
/// A point at `q` itself contributes 0. NaN where `q` is not finite.
pub fn winding_gradient_of_cloud(cloud: &OrientedCloud, q: Vec3) -> Vec3 {
    if !q.is_finite() {
        return Vec3::NAN;
    }
    let dipole = |((p, n), a): ((&Vec3, &Vec3), &f64)| {
        let r = *p - q;
        let square = r.length_squared();
        if square == 0.0 {
            return Vec3::ZERO;
        }
        let direction = r / square.sqrt();
        *a * (3.0 * n.dot(direction) * direction - *n) / (square * square.sqrt())
    };
    cloud.points().iter().zip(cloud.normals()).zip(cloud.areas()).map(dipole).sum::<Vec3>() / (4.0 * PI)
}

/// The gradient of the winding number of a shape at `q`, summed directly.
pub fn winding_gradient(shape: &Shape, q: Vec3) -> Vec3 {
    match shape {
        Shape::Soup(soup) => winding_gradient_of_soup(soup, q),
        Shape::Cloud(cloud) => winding_gradient_of_cloud(cloud, q),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Midpoint rule of ∮ r × dr / |r|³ over the edge.
    fn by_quadrature(q: Vec3, a: Vec3, b: Vec3) -> Vec3 {
        const STEPS: usize = 40_000;
        let at = |i: usize| a + (b - a) * ((i as f64 + 0.5) / STEPS as f64) - q;
        let sum: Vec3 = (0..STEPS).map(|i| at(i).cross(b - a) / at(i).length().powi(3)).sum();
        sum / (4.0 * PI * STEPS as f64)
    }

    #[test]
    fn closed_form_equals_the_integral_beside_between_and_beyond_the_ends() {
        let (a, b) = (Vec3::new(0.2, -0.1, 0.3), Vec3::new(1.4, 0.9, -0.5));
        for (along, aside) in [(0.5, 0.05), (0.9, 0.2), (-0.4, 0.01), (2.0, 0.3), (0.0, 0.4), (30.0, 7.0)] {
            let q = a + along * (b - a) + aside * (b - a).any_orthonormal_vector();
            let (value, expected) = (edge_gradient(q, a, b), by_quadrature(q, a, b));
            assert!((value - expected).length() < 1e-6 * expected.length(), "{value} {expected}");
            assert!((value + edge_gradient(q, b, a)).length() < 1e-15 * value.length());
        }
    }

    #[test]
    fn next_to_a_long_edge_it_is_that_of_a_straight_wire() {
        let (a, b) = (Vec3::new(-1e3, 0.0, 0.0), Vec3::new(1e3, 0.0, 0.0));
        for distance in [1e-3, 1e-7, 1e-12, 1e-100] {
            let value = edge_gradient(Vec3::new(0.25, distance, 0.0), a, b);
            // The ends are 10³ away: they take (distance / 10³)² / 2.
            assert!((value.z * (2.0 * PI * distance) - 1.0).abs() < 1e-11, "{value} at {distance}");
            assert!(value.truncate().length() == 0.0);
        }
    }

    #[test]
    fn on_the_edge_and_on_its_line_it_is_zero() {
        let (a, b) = (Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0));
        for x in [-1.0, 0.0, 0.5, 2.0, 5.0] {
            assert_eq!(edge_gradient(Vec3::new(x, 0.0, 0.0), a, b), Vec3::ZERO);
        }
        assert_eq!(edge_gradient(Vec3::ONE, b, b), Vec3::ZERO);
    }
}
