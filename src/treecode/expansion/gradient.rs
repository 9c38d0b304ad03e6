//! Gradients of the far fields: ∇(Hₙ(R) / |R|^(2n+1)) = (∇Hₙ(u) − (2n+1) Hₙ(u) u) / |R|^(n+2), u = R/|R|.
use super::{Expansion, Order, Positions, Series, squared_length};
use wide::f32x4;

impl Expansion {
    /// Which clusters are farther from the query than β radii, as bits; and the gradients of their winding numbers in the
    /// unit frame, 0 in the other lanes.
    #[inline(always)]
    pub fn far_gradient(&self, query: &Positions, order: Order, beta_squared: f32x4) -> ([f32x4; 3], u32) {
        let offset = query.minus(&self.centers);
        let square = squared_length(&offset);
        let is_far = square.simd_gt(beta_squared * self.radius_squared);
        let far = is_far.to_bitmask();
        if far == 0 {
            return ([f32x4::ZERO; 3], 0);
        }
        (self.series.gradient(offset, square, order).map(|g| is_far & g), far)
    }
}

type Gradient = [f32x4; 3];

impl Series {
    /// The gradient of [`Series::at`] with respect to R.
    #[inline(always)]
    fn gradient(&self, offset: [f32x4; 3], square: f32x4, order: Order) -> Gradient {
        let inverse_square = f32x4::splat(1.0) / square;
        let inverse = square.sqrt() * inverse_square;
        let u = offset.map(|c| c * inverse);
        let mut sum = tangential(1.0, self.dipole, u);
        if order >= Order::One {
            let mut higher = tangential(2.0, self.quadrupole_slope(u), u);
            if order >= Order::Two {
                let octupole = tangential(3.0, self.octupole_slope(u), u);
                higher = [0, 1, 2].map(|i| higher[i] + octupole[i] * inverse);
            }
            sum = [0, 1, 2].map(|i| sum[i] + higher[i] * inverse);
        }
        sum.map(|g| g * inverse_square * inverse)
    }

    /// ∇H₂ at u.
    #[inline(always)]
    fn quadrupole_slope(&self, [x, y, z]: Gradient) -> Gradient {
        let [a, b, c, d, e] = self.quadrupole;
        [(a + a) * x + c * y + d * z, c * x + (b + b) * y + e * z, d * x + e * y - (a + a + b + b) * z]
    }

    /// ∇H₃ at u.
    #[inline(always)]
    fn octupole_slope(&self, [x, y, z]: Gradient) -> Gradient {
        let [o0, o1, o2, o3, o4, o5, o6] = self.octupole;
        let [two, three, four] = [2.0, 3.0, 4.0].map(f32x4::splat);
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let (xy, xz, yz) = (two * x * y, two * x * z, two * y * z);
        let half = f32x4::splat(0.5);
        let saddle = xx - yy;
        let along_x = half * o0 * yz + (o1 - three * o4) * xz + three * (o2 * saddle + o3 * xy) - o6 * xy
            + o5 * (four * zz - three * xx - yy);
        let along_y = half * o0 * xz - (o1 + three * o4) * yz + three * (o3 * saddle - o2 * xy) - o5 * xy
            + o6 * (four * zz - xx - three * yy);
        let along_z =
            half * o0 * xy + o1 * saddle + three * o4 * (two * zz - xx - yy) + four * (o5 * xz + o6 * yz);
        [along_x, along_y, along_z]
    }
}

/// ∇Hₙ − (2n+1) Hₙ u, given ∇Hₙ; Hₙ is homogeneous, so n Hₙ = u · ∇Hₙ.
#[inline(always)]
fn tangential(degree: f32, slope: Gradient, [x, y, z]: Gradient) -> Gradient {
    let radial = f32x4::splat((2.0 * degree + 1.0) / degree) * (slope[0] * x + slope[1] * y + slope[2] * z);
    [slope[0] - radial * x, slope[1] - radial * y, slope[2] - radial * z]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradient_is_the_slope_of_every_term() {
        const STEP: f32 = 0.02;
        // One coefficient at a time, so that a wrong one cannot hide behind the others.
        for term in 0..15 {
            let only = |first: usize, k: usize| f32x4::splat(if term == first + k { 1.0 } else { 0.0 });
            let series = Series {
                dipole: [0, 1, 2].map(|k| only(0, k)),
                quadrupole: [0, 1, 2, 3, 4].map(|k| only(3, k)),
                octupole: [0, 1, 2, 3, 4, 5, 6].map(|k| only(8, k)),
            };
            let place =
                [[1.1f32, -0.4, 0.7, 1.3], [0.6, 1.2, -0.9, -0.2], [-0.5, 0.8, 1.0, 0.4]].map(f32x4::from);
            let value = |p: [f32x4; 3]| series.at(p, squared_length(&p), Order::Two);
            let gradient = series.gradient(place, squared_length(&place), Order::Two);
            for axis in 0..3 {
                let moved = |by: f32| {
                    let mut p = place;
                    p[axis] += f32x4::splat(by);
                    value(p)
                };
                let slope = (moved(STEP) - moved(-STEP)) * f32x4::splat(0.5 / STEP);
                // Truncation: about (STEP / 1.3)² of a term and its powers; rounding: 1e-7 / STEP.
                let difference = (slope - gradient[axis]).abs().to_array();
                assert!(difference.iter().all(|d| *d < 1e-2), "term {term}, axis {axis}: {difference:?}");
            }
        }
    }
}
