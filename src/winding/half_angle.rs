use crate::math::{Floats, Vec3};

/// Rounding error of (a − q)·n relative to the same sum of absolute values: (7 + 56ε) ε, ε = 2⁻⁵³ (Shewchuk 1997,
/// orient3d), with what the bound's own computation may lose.
const NUMERATOR_ERROR: f64 = 8.0 * (f64::EPSILON / 2.0);

/// Of the sums of absolute values that numerator and denominator are made of they must be this share for the solid angle of a cap to
/// be good to 1e-10 turns: else the query is close to its plane or an edge, and edges and crossings tell it exactly.
pub const LEAST_OF_CAP: f64 = 1e-5;

/// A triangle whose solid angle is asked for in 64-bit floats.
pub struct Triangle {
    corners: [[f64; 3]; 3],
    normal: [f64; 3],
    /// Bounds of the numerator's error for each unit of (a − q).
    errors: [f64; 3],
}

/// The tangent of half a solid angle as numerator and denominator.
pub struct HalfAngle<F> {
    /// (a − q)·n, n = (b − a) × (c − a).
    pub numerator: F,
    pub denominator: F,
    /// A bound of the numerator's error.
    pub error: F,
    /// |a − q||b − q||c − q|.
    pub lengths: F,
}

impl Triangle {
    #[inline(always)]
    pub fn new([a, b, c]: [Vec3; 3]) -> Triangle {
        // The normal from edges, not from corners relative to the query: that stays accurate far away.
        let (u, v) = (b - a, c - a);
        let (m, n) = (u.abs(), v.abs());
        let magnitude = Vec3::new(m.y * n.z + m.z * n.y, m.z * n.x + m.x * n.z, m.x * n.y + m.y * n.x);
        Triangle {
            corners: [a.to_array(), b.to_array(), c.to_array()],
            normal: u.cross(v).to_array(),
            errors: (NUMERATOR_ERROR * magnitude).to_array(),
        }
    }

    /// Seen from queries (van Oosterom & Strackee 1983).
    #[inline(always)]
    pub fn half_angle<F: Floats<Number = f64>>(&self, q: [F; 3]) -> HalfAngle<F> {
        let [a, b, c] =
            [difference(self.corners[0], q), difference(self.corners[1], q), difference(self.corners[2], q)];
        let numerator = dot(a, splat(self.normal));
        let error = dot([a[0].abs(), a[1].abs(), a[2].abs()], splat(self.errors));
        let (la, lb, lc) = (dot(a, a).sqrt(), dot(b, b).sqrt(), dot(c, c).sqrt());
        let ab = la * lb;
        let denominator = (ab + dot(a, b)) * lc + (dot(b, c) * la + dot(c, a) * lb);
        HalfAngle { numerator, denominator, error, lengths: ab * lc }
    }
}

impl<F: Floats<Number = f64>> HalfAngle<F> {
    /// The lanes in which the sign is certain, and numerator and denominator are not so small that rounding is more than some
    /// ε / `least` of the angle: that they are where the query is close to an edge.
    #[inline(always)]
    pub fn is_certain(&self, least: f64) -> u32 {
        let size = self.numerator.abs();
        let magnitudes = self.lengths + self.error * F::splat(1.0 / NUMERATOR_ERROR);
        let is_large = (size + self.denominator.abs()).greater(F::splat(least) * magnitudes);
        is_large & size.greater(self.error)
    }
}

#[inline(always)]
fn splat<F: Floats<Number = f64>>(v: [f64; 3]) -> [F; 3] {
    [F::splat(v[0]), F::splat(v[1]), F::splat(v[2])]
}

#[inline(always)]
fn difference<F: Floats<Number = f64>>(corner: [f64; 3], q: [F; 3]) -> [F; 3] {
    let corner = splat::<F>(corner);
    [corner[0] - q[0], corner[1] - q[1], corner[2] - q[2]]
}

#[inline(always)]
fn dot<F: Floats>(a: [F; 3], b: [F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
