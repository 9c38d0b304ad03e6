//! Two forms of the moments of a cluster: coefficients of monomials, as sources and Taylor polynomials want them, and factors
//! of waves around the z axis, as multipole fields want them.
//!
//! Modulo ξξ̄ + z² = 0, ξ = x + iy, the polynomials of degree n are spanned by Re ξ^m z^(n−m) and Im ξ^m z^(n−m), and
//! (∂x + i∂y)^m ∂z^(n−m) (1/r) = (−1)ⁿ (2n−1)!! (u_x + i u_y)^m q_nm(u_z) / r^(n+1), q_nm the m-th derivative of the Legendre
//! polynomial Pₙ, scaled to leading coefficient 1. A factor is what is before q_nm cos mφ or q_nm sin mφ.
use super::moments::COEFFICIENTS;
use crate::math::Floats;

/// (−1)ⁿ (2n−1)!!
const SCALES: [f64; 5] = [1.0, -1.0, 3.0, -15.0, 105.0];

/// Place of the factor for n and m: of the cosine, m = 0 … n, or of the sine, m = 1 … n.
pub const fn factor(n: usize, m: usize, sine: bool) -> usize {
    n * n - 1 + m + if sine { n } else { 0 }
}

/// Factors from coefficients in the order of [`super::harmonic`], without degree 0.
pub fn factors(c: &[f64; COEFFICIENTS]) -> [f64; COEFFICIENTS] {
    let mut factors = [0.0; COEFFICIENTS];
    let mut set = |n: usize, values: &[f64]| {
        let places = &mut factors[n * n - 1..n * n + 2 * n];
        places.iter_mut().zip(values).for_each(|(factor, value)| *factor = SCALES[n] * value);
    };
    set(1, &[c[2], c[1], c[0]]);
    let [c0, c2, s2] = quadratic([c[3], c[4], c[5]]);
    set(2, &[c0, c[7], c2, c[6], s2]);
    let [c1, c3, s1, s3] = cubic([c[8], c[9], c[10], c[11]]);
    let [c0, c2, s2] = quadratic([c[12], c[13], c[14]]);
    set(3, &[c0, c1, c2, c3, s1, s2, s3]);
    let [c0, c2, c4, s2, s4] = quartic([c[15], c[16], c[17], c[18], c[19]]);
    let [c1, c3, s1, s3] = cubic([c[20], c[21], c[22], c[23]]);
    set(4, &[c0, c1, c2, c3, c4, s1, s2, s3, s4]);
    factors
}

// Homogeneous polynomials in x and y, the powers of x rising, as factors of Re ξ^m z^(n−m), then of Im ξ^m z^(n−m), m of the
// parity of n.

fn quadratic([yy, xy, xx]: [f64; 3]) -> [f64; 3] {
    [-0.5 * (xx + yy), 0.5 * (xx - yy), 0.5 * xy]
}

fn cubic([yyy, xyy, xxy, xxx]: [f64; 4]) -> [f64; 4] {
    [-0.75 * xxx - 0.25 * xyy, 0.25 * (xxx - xyy), -0.25 * xxy - 0.75 * yyy, 0.25 * (xxy - yyy)]
}

fn quartic([y4, xy3, x2y2, x3y, x4]: [f64; 5]) -> [f64; 5] {
    [
        0.375 * (x4 + y4) + 0.125 * x2y2,
        0.5 * (y4 - x4),
        0.125 * (x4 + y4 - x2y2),
        -0.25 * (x3y + xy3),
        0.125 * (x3y - xy3),
    ]
}

/// Coefficients from factors, of degrees up to `order` + 1, those of degree n times `weight` · `ratio`^(n−1).
#[inline(always)]
pub fn coefficients<F: Floats<Number = f32>>(
    mut f: [F; COEFFICIENTS],
    weight: F,
    ratio: F,
    order: usize,
) -> [F; COEFFICIENTS] {
    let mut power = weight;
    for n in 1..order + 2 {
        let scale = power * F::splat((1.0 / SCALES[n]) as f32);
        for factor in &mut f[n * n - 1..n * n + 2 * n] {
            *factor = scale * *factor;
        }
        power = power * ratio;
    }
    let mut c = f;
    (c[0], c[2]) = (f[2], f[0]);
    if order >= 1 {
        (c[3], c[4], c[5]) = quadratic_of([f[3], f[5], f[7]]);
        (c[6], c[7]) = (f[6], f[4]);
    }
    if order >= 2 {
        (c[8], c[9], c[10], c[11]) = cubic_of([f[9], f[11], f[12], f[14]]);
        (c[12], c[13], c[14]) = quadratic_of([f[8], f[10], f[13]]);
    }
    if order >= 3 {
        (c[15], c[16], c[17], c[18], c[19]) = quartic_of([f[15], f[17], f[19], f[21], f[23]]);
        (c[20], c[21], c[22], c[23]) = cubic_of([f[16], f[18], f[20], f[22]]);
    }
    c
}

#[inline(always)]
fn quadratic_of<F: Floats<Number = f32>>([c0, c2, s2]: [F; 3]) -> (F, F, F) {
    (F::splat(0.0) - (c0 + c2), s2 + s2, c2 - c0)
}

#[inline(always)]
fn cubic_of<F: Floats<Number = f32>>([c1, c3, s1, s3]: [F; 4]) -> (F, F, F, F) {
    let three = F::splat(3.0);
    (F::splat(0.0) - (s1 + s3), F::splat(0.0) - (c1 + three * c3), three * s3 - s1, c3 - c1)
}

#[inline(always)]
fn quartic_of<F: Floats<Number = f32>>([c0, c2, c4, s2, s4]: [F; 5]) -> (F, F, F, F, F) {
    let (two, four, six) = (F::splat(2.0), F::splat(4.0), F::splat(6.0));
    let (sum, twice_s2, four_s4) = (c0 + c4, two * s2, four * s4);
    (sum + c2, F::splat(0.0) - (twice_s2 + four_s4), two * c0 - six * c4, four_s4 - twice_s2, sum - c2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x4;

    #[test]
    fn coefficients_are_found_again() {
        let given: [f64; COEFFICIENTS] = std::array::from_fn(|i| ((i * 7919 % 31) as f64 - 15.0) / 15.0);
        let of_waves = factors(&given).map(|f| f32x4::splat(f as f32));
        for order in 0..4 {
            let found = coefficients(of_waves, f32x4::splat(2.0), f32x4::splat(0.5), order);
            for n in 1..order + 2 {
                for k in n * n - 1..n * n + 2 * n {
                    let expected = given[k] * 2.0 * 0.5f64.powi(n as i32 - 1);
                    let value = f64::from(found[k].to_array()[3]);
                    assert!((value - expected).abs() < 1e-6, "{order} {k}: {value} instead of {expected}");
                }
            }
        }
    }
}
