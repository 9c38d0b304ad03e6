//! Multipole fields at queries (M2P), four at once.
//!
//! Modulo ξξ̄ + z² = 0, ξ = x + iy, the polynomials of degree n are spanned by Re ξ^m z^(n−m) and Im ξ^m z^(n−m), and
//! (∂x + i∂y)^m ∂z^(n−m) (1/r) = (−1)ⁿ (2n−1)!! (u_x + i u_y)^m q_nm(u_z) / r^(n+1), q_nm the m-th derivative of the Legendre
//! polynomial Pₙ, scaled to leading coefficient 1.
use super::QueryLanes;
use super::clusters::Series;
use super::harmonic::place;
use super::moments::COEFFICIENTS;
use wide::f32x4;

/// Coefficients of one cluster's field for queries near a point.
pub struct Multipole {
    /// The centre, relative to that point.
    center: QueryLanes,
    radius: f32x4,
    area: f32x4,
    /// Factors of q_nm cos mφ and q_nm sin mφ in the order of [`factor`].
    factors: [f32x4; COEFFICIENTS],
}

/// Place of the factor for n and m: of the cosine, m = 0 … n, or, `sine` places later, of the sine.
const fn factor(n: usize, m: usize, sine: bool) -> usize {
    n * n - 1 + m + if sine { n } else { 0 }
}

impl Multipole {
    #[inline]
    pub fn new(series: &Series, center: [f32; 3], radius: f32, order: usize) -> Multipole {
        let mut factors = [0.0f32; COEFFICIENTS];
        let c = &series.coefficients;
        factors[0..3].copy_from_slice(&[-c[2], -c[1], -c[0]]);
        if order >= 1 {
            let [c0, c2, s2] = quadratic([c[3], c[4], c[5]]);
            set(&mut factors[3..8], 3.0, [c0, c[7], c2, c[6], s2]);
        }
        if order >= 2 {
            let [c1, c3, s1, s3] = cubic([c[8], c[9], c[10], c[11]]);
            let [c0, c2, s2] = quadratic([c[12], c[13], c[14]]);
            set(&mut factors[8..15], -15.0, [c0, c1, c2, c3, s1, s2, s3]);
        }
        if order >= 3 {
            let [c0, c2, c4, s2, s4] = quartic([c[15], c[16], c[17], c[18], c[19]]);
            let [c1, c3, s1, s3] = cubic([c[20], c[21], c[22], c[23]]);
            set(&mut factors[15..24], 105.0, [c0, c1, c2, c3, c4, s1, s2, s3, s4]);
        }
        let [x, y, z] = center;
        let mut multipole = Multipole {
            center: [f32x4::splat(x), f32x4::splat(y), f32x4::splat(z)],
            radius: f32x4::splat(radius),
            area: f32x4::splat(series.area),
            factors: [f32x4::ZERO; COEFFICIENTS],
        };
        let used = place(order + 2, 0, 0) - 1;
        multipole.factors.iter_mut().zip(&factors[..used]).for_each(|(lanes, f)| *lanes = f32x4::splat(*f));
        multipole
    }

    /// The field at four queries, relative to the same point, of order `ORDER`.
    #[inline(always)]
    pub fn at<const ORDER: usize>(&self, queries: &QueryLanes) -> f32x4 {
        let splat = f32x4::splat;
        let offset = [0, 1, 2].map(|i| queries[i] - self.center[i]);
        let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
        let inverse_square = splat(1.0) / square;
        let inverse = square.sqrt() * inverse_square;
        let [x, y, z] = offset.map(|c| c * inverse);
        let t = self.radius * inverse;
        let c = |m: usize, n: usize| self.factors[factor(n, m, false)];
        let s = |m: usize, n: usize| self.factors[factor(n, m, true)];
        // For each m the sum over n of t^(n−1) q_nm(z) times the coefficients, by Horner's scheme in t.
        let mut zero = c(0, 1) * z;
        let (mut cosine_1, mut sine_1) = (c(1, 1), s(1, 1));
        let mut sum = f32x4::ZERO;
        if ORDER >= 1 {
            let tt = t * t;
            let (tz, zz) = (t * z, z * z);
            let q20 = (zz - splat(1.0 / 3.0)) * t;
            zero += c(0, 2) * q20;
            cosine_1 += c(1, 2) * tz;
            sine_1 += s(1, 2) * tz;
            let (xx_yy, xy) = (x * x - y * y, (x + x) * y);
            let (mut cosine_2, mut sine_2) = (c(2, 2) * t, s(2, 2) * t);
            if ORDER >= 2 {
                let (q30, q31) = ((zz - splat(0.6)) * (tt * z), (zz - splat(0.2)) * tt);
                let ttz = t * tz;
                zero += c(0, 3) * q30;
                cosine_1 += c(1, 3) * q31;
                sine_1 += s(1, 3) * q31;
                cosine_2 += c(2, 3) * ttz;
                sine_2 += s(2, 3) * ttz;
                let (re_3, im_3) = (xx_yy * x - xy * y, xx_yy * y + xy * x);
                let (mut cosine_3, mut sine_3) = (c(3, 3) * tt, s(3, 3) * tt);
                if ORDER >= 3 {
                    let ttt = tt * t;
                    let tttz = ttt * z;
                    let q40 = (zz * (zz - splat(6.0 / 7.0)) + splat(3.0 / 35.0)) * ttt;
                    let q41 = (zz - splat(3.0 / 7.0)) * tttz;
                    let q42 = (zz - splat(1.0 / 7.0)) * ttt;
                    zero += c(0, 4) * q40;
                    cosine_1 += c(1, 4) * q41;
                    sine_1 += s(1, 4) * q41;
                    cosine_2 += c(2, 4) * q42;
                    sine_2 += s(2, 4) * q42;
                    cosine_3 += c(3, 4) * tttz;
                    sine_3 += s(3, 4) * tttz;
                    let (re_4, im_4) = (xx_yy * xx_yy - xy * xy, (xx_yy + xx_yy) * xy);
                    sum += (c(4, 4) * re_4 + s(4, 4) * im_4) * ttt;
                }
                sum += cosine_3 * re_3 + sine_3 * im_3;
            }
            sum += cosine_2 * xx_yy + sine_2 * xy;
        }
        sum += zero + (cosine_1 * x + sine_1 * y);
        sum * (self.area * inverse_square)
    }

    /// Whether all four queries are farther from the centre than `distance`.
    #[inline(always)]
    pub fn is_farther(center: &QueryLanes, queries: &QueryLanes, distance_squared: f32x4) -> bool {
        let offset = [0, 1, 2].map(|i| queries[i] - center[i]);
        let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
        square.simd_gt(distance_squared).all()
    }
}

fn set<const N: usize>(factors: &mut [f32], scale: f32, values: [f32; N]) {
    factors.iter_mut().zip(values).for_each(|(factor, value)| *factor = scale * value);
}

// Homogeneous polynomials in x and y as factors of Re ξ^m z^(n−m), then of Im ξ^m z^(n−m), m of the parity of n.

fn quadratic([yy, xy, xx]: [f32; 3]) -> [f32; 3] {
    [-0.5 * (xx + yy), 0.5 * (xx - yy), 0.5 * xy]
}

fn cubic([yyy, xyy, xxy, xxx]: [f32; 4]) -> [f32; 4] {
    [-0.75 * xxx - 0.25 * xyy, 0.25 * (xxx - xyy), -0.25 * xxy - 0.75 * yyy, 0.25 * (xxy - yyy)]
}

fn quartic([y4, xy3, x2y2, x3y, x4]: [f32; 5]) -> [f32; 5] {
    [
        0.375 * (x4 + y4) + 0.125 * x2y2,
        0.5 * (y4 - x4),
        0.125 * (x4 + y4 - x2y2),
        -0.25 * (x3y + xy3),
        0.125 * (x3y - xy3),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::treecode::dual::bounds::{
        ROUNDING_OF_MULTIPOLE, largest_field, multipole_tail, spread_of_order,
    };
    use crate::treecode::dual::clusters::Clusters;
    use crate::treecode::dual::sources::tests::{Dipoles, random};
    use std::f64::consts::PI;

    fn value(multipole: &Multipole, q: Vec3, order: usize) -> f64 {
        let query = q.to_array().map(|x| f32x4::splat(x as f32));
        let lanes = match order {
            0 => multipole.at::<0>(&query),
            1 => multipole.at::<1>(&query),
            2 => multipole.at::<2>(&query),
            _ => multipole.at::<3>(&query),
        };
        f64::from(lanes.to_array()[1])
    }

    #[test]
    fn error_stays_below_the_bound_and_rounding_below_its_part() {
        let mut largest_rounding: f64 = 0.0;
        for seed in 0..8000 {
            let order = (seed % 4) as usize;
            let mut next = random(seed);
            let mut vector = || Vec3::new(next(), next(), next());
            let dipoles: Vec<(Vec3, Vec3)> = (0..6).map(|_| (vector(), vector())).collect();
            let far = if seed % 2 == 0 { 1e4 } else { 2.5 + (seed % 11) as f64 / 5.0 };
            let q = far * vector().normalize();
            let sum: f64 =
                dipoles.iter().map(|(p, v)| (*p - q).dot(*v) / ((*p - q).length().powi(3) * 4.0 * PI)).sum();
            let clusters = Clusters::build(&Dipoles(dipoles), 8);
            let ball = clusters.balls[0];
            let center = Vec3::new(f64::from(ball[0]), f64::from(ball[1]), f64::from(ball[2]));
            let local = clusters.frame.local(q);
            let offset = (center - local).to_array().map(|x| x as f32);
            let multipole = Multipole::new(&clusters.series[0], offset, ball[3], order);
            let error = (value(&multipole, Vec3::ZERO, order) - sum).abs();
            let [area, radius, distance, spread] = [
                clusters.series[0].area,
                ball[3],
                (center - local).length() as f32,
                spread_of_order(clusters.series[0].spread, order),
            ]
            .map(f32x4::splat);
            if (distance - radius).to_array()[0] <= 0.1 * radius.to_array()[0] {
                continue;
            }
            let one = |lanes: f32x4| f64::from(lanes.to_array()[0]);
            let left_out = one(multipole_tail(area, spread, radius, distance, order));
            let scale = one(largest_field(area, distance - radius));
            let bound = left_out + ROUNDING_OF_MULTIPOLE * scale;
            assert!(error <= bound, "seed {seed}: {error} above {bound}");
            if order == 3 && far > 1e3 {
                largest_rounding = largest_rounding.max(error / scale);
            }
        }
        assert!(largest_rounding < 0.05 * ROUNDING_OF_MULTIPOLE, "{largest_rounding}");
    }
}
