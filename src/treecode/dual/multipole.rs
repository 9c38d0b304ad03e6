//! Multipole fields at queries (M2P), four at once.
//!
//! Modulo ξξ̄ + z² = 0, ξ = x + iy, the polynomials of degree n are spanned by Re ξ^m z^(n−m) and Im ξ^m z^(n−m), and
//! (∂x + i∂y)^m ∂z^(n−m) (1/r) = (−1)ⁿ (2n−1)!! (u_x + i u_y)^m q_nm(u_z) / r^(n+1), q_nm the m-th derivative of the Legendre
//! polynomial Pₙ, scaled to leading coefficient 1.
use super::QueryLanes;
use super::clusters::Series;
use super::moments::MAX_ORDER;
use wide::f32x4;

/// Coefficients of one cluster's field for queries near a point.
pub struct Multipole {
    /// The centre, relative to that point.
    center: QueryLanes,
    radius: f32x4,
    area: f32x4,
    /// For each m: factors of cos mφ, then of sin mφ, of each degree n = max(m, 1), …; ordered by m, then n.
    cosines: [[f32x4; MAX_ORDER + 1]; MAX_ORDER + 2],
    sines: [[f32x4; MAX_ORDER + 1]; MAX_ORDER + 2],
}

impl Multipole {
    pub fn new(series: &Series, center: [f32; 3], radius: f32, order: usize) -> Multipole {
        let mut rows = [[[0.0f32; MAX_ORDER + 1]; MAX_ORDER + 2]; 2];
        let [cosines, sines] = &mut rows;
        let c = &series.coefficients;
        let mut set = |sign: f32, n: usize, cosine: &[f32], sine: &[f32]| {
            cosine.iter().enumerate().for_each(|(m, value)| cosines[m][n - 1] = sign * value);
            sine.iter().enumerate().for_each(|(m, value)| sines[m][n - 1] = sign * value);
        };
        set(-1.0, 1, &[c[2], c[1]], &[0.0, c[0]]);
        if order >= 1 {
            let (even_cosine, even_sine) = quadratic([c[3], c[4], c[5]]);
            set(3.0, 2, &[even_cosine[0], c[7], even_cosine[1]], &[0.0, c[6], even_sine]);
        }
        if order >= 2 {
            let (odd_cosine, odd_sine) = cubic([c[8], c[9], c[10], c[11]]);
            let (even_cosine, even_sine) = quadratic([c[12], c[13], c[14]]);
            let cosine = [even_cosine[0], odd_cosine[0], even_cosine[1], odd_cosine[1]];
            set(-15.0, 3, &cosine, &[0.0, odd_sine[0], even_sine, odd_sine[1]]);
        }
        if order >= 3 {
            let (even_cosine, even_sine) = quartic([c[15], c[16], c[17], c[18], c[19]]);
            let (odd_cosine, odd_sine) = cubic([c[20], c[21], c[22], c[23]]);
            let cosine = [even_cosine[0], odd_cosine[0], even_cosine[1], odd_cosine[1], even_cosine[2]];
            set(105.0, 4, &cosine, &[0.0, odd_sine[0], even_sine[0], odd_sine[1], even_sine[1]]);
        }
        let [cosines, sines] = rows.map(|r| r.map(|m| m.map(f32x4::splat)));
        Multipole {
            center: center.map(f32x4::splat),
            radius: f32x4::splat(radius),
            area: f32x4::splat(series.area),
            cosines,
            sines,
        }
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
        let (c, s) = (&self.cosines, &self.sines);
        // For each m the sum over n of t^(n−1) q_nm(z) times the coefficients, by Horner's scheme in t.
        let mut zero = c[0][0] * z;
        let (mut cosine_1, mut sine_1) = (c[1][0], s[1][0]);
        let mut sum = f32x4::ZERO;
        if ORDER >= 1 {
            let tt = t * t;
            let (tz, zz) = (t * z, z * z);
            let q20 = (zz - splat(1.0 / 3.0)) * t;
            zero += c[0][1] * q20;
            cosine_1 += c[1][1] * tz;
            sine_1 += s[1][1] * tz;
            let (xx_yy, xy) = (x * x - y * y, (x + x) * y);
            let (mut cosine_2, mut sine_2) = (c[2][1] * t, s[2][1] * t);
            if ORDER >= 2 {
                let (q30, q31) = ((zz - splat(0.6)) * (tt * z), (zz - splat(0.2)) * tt);
                let ttz = t * tz;
                zero += c[0][2] * q30;
                cosine_1 += c[1][2] * q31;
                sine_1 += s[1][2] * q31;
                cosine_2 += c[2][2] * ttz;
                sine_2 += s[2][2] * ttz;
                let (re_3, im_3) = (xx_yy * x - xy * y, xx_yy * y + xy * x);
                let (mut cosine_3, mut sine_3) = (c[3][2] * tt, s[3][2] * tt);
                if ORDER >= 3 {
                    let ttt = tt * t;
                    let tttz = ttt * z;
                    let q40 = (zz * (zz - splat(6.0 / 7.0)) + splat(3.0 / 35.0)) * ttt;
                    let q41 = (zz - splat(3.0 / 7.0)) * tttz;
                    let q42 = (zz - splat(1.0 / 7.0)) * ttt;
                    zero += c[0][3] * q40;
                    cosine_1 += c[1][3] * q41;
                    sine_1 += s[1][3] * q41;
                    cosine_2 += c[2][3] * q42;
                    sine_2 += s[2][3] * q42;
                    cosine_3 += c[3][3] * tttz;
                    sine_3 += s[3][3] * tttz;
                    let (re_4, im_4) = (xx_yy * xx_yy - xy * xy, (xx_yy + xx_yy) * xy);
                    sum += (c[4][3] * re_4 + s[4][3] * im_4) * ttt;
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

// The monomials x^a y^(n−a), a = 0 … n, in Re ξ^m and Im ξ^m, m of the parity of n.

fn quadratic([yy, xy, xx]: [f32; 3]) -> ([f32; 2], f32) {
    ([-0.5 * (xx + yy), 0.5 * (xx - yy)], 0.5 * xy)
}

fn cubic([yyy, xyy, xxy, xxx]: [f32; 4]) -> ([f32; 2], [f32; 2]) {
    (
        [-0.75 * xxx - 0.25 * xyy, 0.25 * (xxx - xyy)],
        [-0.25 * xxy - 0.75 * yyy, 0.25 * (xxy - yyy)],
    )
}

fn quartic([y4, xy3, x2y2, x3y, x4]: [f32; 5]) -> ([f32; 3], [f32; 2]) {
    (
        [0.375 * (x4 + y4) + 0.125 * x2y2, 0.5 * (y4 - x4), 0.125 * (x4 + y4 - x2y2)],
        [-0.25 * (x3y + xy3), 0.125 * (x3y - xy3)],
    )
}
