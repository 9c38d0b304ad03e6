//! Potential and field of a triangle with an even charge, in closed form: Wilton et al. 1984, *Potential integrals for uniform
//! and linear source distributions on polygonal and polyhedral domains*.
//!
//! With the unit normal n, the height h of x above the plane, the outward normals m of the edges in the plane, their distances
//! p from x along m and f = ∫ 1/r along each edge: ∫ 1/r = Σ p f − |h| |Ω|, Ω the solid angle; ∫ (x − y)/r³ = Σ m f + sign(h) |Ω| n.
use crate::math::{Vec3, area_vector, solid_angle};

/// An edge counts as no nearer than this, in its lengths: the field has no value on it.
const LEAST_DISTANCE: f64 = 1e-12;

/// ∫ 1/|x − y| over the triangle, and ∫ (x − y)/|x − y|³, which points away from it: potential and field at `x` of a charge of 1
/// per area. On the triangle the field is the mean of both sides; on its edges, where it has no value, it is large.
///
/// The error is some roundings of the result times (1 + distance/size)²: far away a quadrature is better.
pub fn potential_and_field(x: Vec3, corners: [Vec3; 3]) -> (f64, Vec3) {
    let normal = area_vector(corners).normalize_or_zero();
    let height = (x - corners[0]).dot(normal);
    let angle = solid_angle(x, corners);
    // The angle is positive below the triangle.
    let mut potential = -(height * angle).abs();
    let mut field = -angle * normal;
    for k in 0..3 {
        let (start, end) = (corners[k], corners[(k + 1) % 3]);
        let length = start.distance(end);
        if length == 0.0 {
            continue;
        }
        let outward = ((end - start) / length).cross(normal);
        let integral = along_edge(start - x, end - x, length);
        potential += (start - x).dot(outward) * integral;
        field += integral * outward;
    }
    (potential.max(0.0), field)
}

/// ∫ 1/r along an edge, its ends given relative to where r is measured from: ln((r₁ + r₂ + l) / (r₁ + r₂ − l)).
fn along_edge(start: Vec3, end: Vec3, length: f64) -> f64 {
    let (to_start, to_end) = (start.length(), end.length());
    let (product, cosine) = (to_start * to_end, start.dot(end));
    // (r₁ + r₂)² − l² = 2 (r₁r₂ + r₁·r₂), which cancels next to the edge.
    let gap = if cosine > 0.0 {
        product + cosine
    } else {
        start.cross(end).length_squared() / (product - cosine).max(f64::MIN_POSITIVE)
    };
    let sum = to_start + to_end + length;
    libm::log(0.5 * sum * sum / gap.max((LEAST_DISTANCE * length) * (LEAST_DISTANCE * length)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::charge::Rule;

    /// The mean of 1/r and of its field over a triangle, by a rule on 4ᵈ equal parts.
    fn by_parts(x: Vec3, [a, b, c]: [Vec3; 3], depth: usize) -> (f64, Vec3) {
        if depth == 0 {
            let sums = Rule::Six.points([a, b, c]).map(|(w, p)| {
                let r = x - p;
                (w / r.length(), w * r / r.length().powi(3))
            });
            return sums.fold((0.0, Vec3::ZERO), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        }
        let [ab, bc, ca] = [a.midpoint(b), b.midpoint(c), c.midpoint(a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].into_iter().fold(
            (0.0, Vec3::ZERO),
            |sum, part| {
                let part = by_parts(x, part, depth - 1);
                (sum.0 + part.0 / 4.0, sum.1 + part.1 / 4.0)
            },
        )
    }

    #[test]
    fn the_closed_form_is_the_limit_of_quadratures() {
        let corners = [Vec3::new(0.1, -0.2, 0.3), Vec3::new(1.3, 0.1, 0.2), Vec3::new(0.4, 0.9, -0.3)];
        let area = area_vector(corners).length();
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        for k in 0..200 {
            let t = f64::from(k);
            let x = middle + 1.5 * Vec3::new((1.1 * t).sin(), (2.3 * t).cos(), (0.7 * t + 0.4).sin());
            if crate::math::distance_to_triangle(x, corners) < 0.25 {
                continue;
            }
            let ((potential, field), expected) = (potential_and_field(x, corners), by_parts(x, corners, 4));
            assert!((potential - area * expected.0).abs() < 1e-12, "{x}: {potential}, {}", area * expected.0);
            assert!(field.distance(area * expected.1) < 1e-11, "{x}: {field}, {}", area * expected.1);
        }
    }

    /// An equilateral triangle of inradius ρ about the origin: its potential there is 6 ρ arsinh √3.
    #[test]
    fn the_potential_at_the_barycentre_is_that_of_its_closed_form() {
        let corner = |k: f64| {
            Vec3::new((k * std::f64::consts::TAU / 3.0).cos(), (k * std::f64::consts::TAU / 3.0).sin(), 0.0)
        };
        let (potential, field) = potential_and_field(Vec3::ZERO, [0.0, 1.0, 2.0].map(corner));
        assert!((potential - 6.0 * 0.5 * 3f64.sqrt().asinh()).abs() < 1e-14, "{potential}");
        assert!(field.length() < 1e-15);
    }

    #[test]
    fn the_field_jumps_by_4_pi_and_is_the_slope_of_the_potential() {
        let corners = [Vec3::ZERO, Vec3::new(2.0, 0.1, 0.0), Vec3::new(0.3, 1.5, 0.0)];
        let on = Vec3::new(0.7, 0.5, 0.0);
        let [above, below] = [1e-9, -1e-9].map(|z| potential_and_field(on + z * Vec3::Z, corners).1);
        assert!(((above - below).z - 4.0 * std::f64::consts::PI).abs() < 1e-7);
        for x in [Vec3::new(0.7, 0.5, 0.01), Vec3::new(1.0, 0.06, -0.02), Vec3::new(-0.1, 0.0, 1e-3)] {
            let step = 1e-6;
            let slope = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| {
                let at = |s: f64| potential_and_field(x + s * axis, corners).0;
                (at(step) - at(-step)) / (2.0 * step)
            });
            let field = potential_and_field(x, corners).1;
            assert!(
                (field + Vec3::from_array(slope)).length() < 1e-6 * field.length(),
                "{x}: {field}, {slope:?}"
            );
        }
    }

    #[test]
    fn edges_and_corners_have_finite_values() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        for x in [Vec3::ZERO, 0.5 * Vec3::X, Vec3::Y, Vec3::new(0.5, 0.5, 0.0), 2.0 * Vec3::X] {
            let (potential, field) = potential_and_field(x, corners);
            assert!(
                potential.is_finite() && potential > 0.0 && field.is_finite(),
                "{x}: {potential} {field}"
            );
        }
    }
}
