//! Derivatives of 1/r, and with them Taylor coefficients of far fields (M2L), for several clusters at once.
use super::bounds::highest;
use super::harmonic::place;
use super::local::MAX_DEGREE;
use super::moments::{COEFFICIENTS, MAX_ORDER};
use super::octet::Octet;
use crate::math::Floats;

/// Highest order of derivative.
const TOP: usize = highest(MAX_ORDER, MAX_DEGREE);

/// Where degree n begins in the table: three rows of n + 1, n and n − 1 entries.
const fn start(n: usize) -> usize {
    if n == 0 { 0 } else { 1 + 3 * n * (n - 1) / 2 }
}

/// Where the row of degree `z` in z begins.
const fn row(n: usize, z: usize) -> usize {
    start(n) + [0, n + 1, 2 * n + 1][z]
}

/// A power of two: any place modulo this, with the longest row behind it, is inside, which saves checks.
const PLACES: usize = start(TOP + 1).next_power_of_two();
const ENTRIES: usize = PLACES + MAX_DEGREE + 1;
/// Zeros before and after each row, so that the recursion needs no special cases.
const MARGIN: usize = 2;
const ROW: usize = TOP + 1 + 2 * MARGIN;

/// Derivatives D_γ of 1/r at a unit vector, γ of degree 0, 1 and 2 in z, with the space to compute them.
pub struct Derivatives {
    /// With 2 in z, the negatives.
    table: [Octet; ENTRIES],
    /// E_γ below, of degree 0 and 1 in z.
    plain: [[Octet; ROW]; TOP + 1],
    times_z: [[Octet; ROW]; TOP + 1],
}

/// D_γ = γ! sₙ E_γ with sₙ = (−1)ⁿ (2n−1)!!/n!: the E_γ are of the order of 1 and satisfy
/// E_γ = Σ xᵢ E_(γ−eᵢ) − κₙ Σ E_(γ−2eᵢ) on the unit sphere, n = |γ|, κₙ = (n−1)²/((2n−1)(2n−3)).
const fn kappa(n: usize) -> f32 {
    let n = n as f32;
    (n - 1.0) * (n - 1.0) / ((2.0 * n - 1.0) * (2.0 * n - 3.0))
}

const KAPPA: [f32; TOP + 1] = {
    let mut values = [0.0; TOP + 1];
    let mut n = 2;
    while n <= TOP {
        values[n] = kappa(n);
        n += 1;
    }
    values
};

const fn factorial(n: usize) -> f64 {
    if n == 0 { 1.0 } else { n as f64 * factorial(n - 1) }
}

/// sₙ a! b! of the entry of degree n with a in x and b in y.
const SCALE: [[f32; TOP + 1]; 2 * (TOP + 1)] = {
    let mut values = [[0.0; TOP + 1]; 2 * (TOP + 1)];
    let (mut n, mut s) = (0, 1.0);
    while n <= TOP {
        if n > 0 {
            s *= -((2 * n - 1) as f64) / n as f64;
        }
        let mut z = 0;
        while z < 2 {
            let mut a = 0;
            while a + z <= n {
                values[2 * n + z][a] = (s * factorial(a) * factorial(n - z - a)) as f32;
                a += 1;
            }
            z += 1;
        }
        n += 1;
    }
    values
};

impl Default for Derivatives {
    fn default() -> Self {
        let rows = [[Octet::ZERO; ROW]; TOP + 1];
        Derivatives { table: [Octet::ZERO; ENTRIES], plain: rows, times_z: rows }
    }
}

impl Derivatives {
    /// Computes all derivatives up to order `top`, 6 at most, at the unit vectors `u`.
    #[inline(always)]
    pub fn compute<F: Floats<Number = f32>>(&mut self, u: [F; 3], top: usize) {
        let one = F::splat(1.0);
        self.plain[0][MARGIN].put(0, one);
        self.table[0].put(0, one);
        for n in 1..=top {
            match n {
                1 => self.compute_order::<F, 1>(u),
                2 => self.compute_order::<F, 2>(u),
                3 => self.compute_order::<F, 3>(u),
                4 => self.compute_order::<F, 4>(u),
                5 => self.compute_order::<F, 5>(u),
                _ => self.compute_order::<F, TOP>(u),
            }
        }
    }

    /// The derivatives of order `N` from those of the two orders below. A function for each order, so that its loops are
    /// unrolled.
    #[inline(always)]
    fn compute_order<F: Floats<Number = f32>, const N: usize>(&mut self, [x, y, z]: [F; 3]) {
        let kappa = F::splat(KAPPA[N]);
        let (below, from) = self.plain.split_at_mut(N);
        let (below_z, from_z) = self.times_z.split_at_mut(N);
        let (first, second) = (&below[N - 1], &below[N.saturating_sub(2)]);
        let (first_z, second_z) = (&below_z[N - 1], &below_z[N.saturating_sub(2)]);
        let (rows, scale) = (&mut self.table[start(N)..start(N + 1)], &SCALE[2 * N..2 * N + 2]);
        for a in 0..N + 1 {
            let i = a + MARGIN;
            let e = (x * first[i - 1].get::<F>(0) + y * first[i].get::<F>(0))
                - kappa * (second[i - 2].get::<F>(0) + second[i].get::<F>(0));
            from[0][i].put(0, e);
            rows[a].put(0, e * F::splat(scale[0][a]));
        }
        for a in 0..N {
            let i = a + MARGIN;
            let e = (x * first_z[i - 1].get::<F>(0) + y * first_z[i].get::<F>(0) + z * first[i].get::<F>(0))
                - kappa * (second_z[i - 2].get::<F>(0) + second_z[i].get::<F>(0));
            from_z[0][i].put(0, e);
            rows[N + 1 + a].put(0, e * F::splat(scale[1][a]));
        }
        for a in 0..N - 1 {
            rows[2 * N + 1 + a].put(0, rows[a + 2].get::<F>(0) + rows[a].get::<F>(0));
        }
    }

    /// Adds s^|β| Σ A_γ D_(γ+β) to a part of `sums`, for all β up to `degree` with 0 or 1 in z, A_γ up to degree
    /// `order` + 1, and γ + β up to [`highest`].
    #[inline(always)]
    pub fn add_taylor<F: Floats<Number = f32>>(
        &self,
        (order, degree): (usize, usize),
        coefficients: &[F; COEFFICIENTS],
        s: F,
        part: usize,
        sums: &mut [Octet; REDUCED],
    ) {
        let mut power = F::splat(1.0);
        for m in 0..=degree {
            let longest = (order + 1).min(highest(order, degree) - m);
            let coefficients = &coefficients[..place(longest + 1, 0, 0) - 1];
            match m {
                0 => self.add_degree::<F, 0, 1>(coefficients, power, part, sums),
                1 => self.add_degree::<F, 1, 2>(coefficients, power, part, sums),
                2 => self.add_degree::<F, 2, 3>(coefficients, power, part, sums),
                3 => self.add_degree::<F, 3, 4>(coefficients, power, part, sums),
                4 => self.add_degree::<F, 4, 5>(coefficients, power, part, sums),
                _ => self.add_degree::<F, 5, 6>(coefficients, power, part, sums),
            }
            power = power * s;
        }
    }

    /// Degree `M` of the above; `N` = `M` + 1. The sums of one degree stay in registers.
    #[inline(always)]
    fn add_degree<F: Floats<Number = f32>, const M: usize, const N: usize>(
        &self,
        coefficients: &[F],
        scale: F,
        part: usize,
        sums: &mut [Octet; REDUCED],
    ) {
        let (mut plain, mut times_z) = ([F::splat(0.0); N], [F::splat(0.0); M]);
        for (c, [at, at_z, is_in_z]) in coefficients.iter().zip(&STARTS[M]) {
            let place = |at: &u8| *at as usize % PLACES;
            let (d, d_z) = (&self.table[place(at)..][..N], &self.table[place(at_z)..][..M]);
            for (sum, d) in plain.iter_mut().zip(d) {
                *sum = *sum + *c * d.get(0);
            }
            // z² = −x² − y²: the table has the negative.
            if *is_in_z == 0 {
                for (sum, d) in times_z.iter_mut().zip(d_z) {
                    *sum = *sum + *c * d.get(0);
                }
            } else {
                for (sum, d) in times_z.iter_mut().zip(d_z) {
                    *sum = *sum - *c * d.get(0);
                }
            }
        }
        let (to_plain, to_times_z) = sums[place(M, 0, 0)..place(M + 1, 0, 0)].split_at_mut(N);
        for (sum, term) in to_plain.iter_mut().zip(&plain) {
            sum.add(part, scale * *term);
        }
        for (sum, term) in to_times_z.iter_mut().zip(&times_z) {
            sum.add(part, scale * *term);
        }
    }
}

/// For Taylor coefficients of degree M, and for each coefficient A_γ: where D_(γ+β) lies for the first β without z, for the
/// first with z (the others follow), and whether γ has z.
const STARTS: [[[u8; 3]; COEFFICIENTS]; MAX_DEGREE + 1] = {
    let mut places = [[[0; 3]; COEFFICIENTS]; MAX_DEGREE + 1];
    let mut m = 0;
    while m <= MAX_DEGREE {
        let (mut n, mut k) = (1, 0);
        while n <= MAX_ORDER + 1 {
            let mut z = 0;
            while z < 2 {
                let mut a = 0;
                while a + z <= n {
                    let [at, at_z] = [row(n + m, z) + a, row(n + m, z + 1) + a];
                    places[m][k] = [at as u8, at_z as u8, z as u8];
                    a += 1;
                    k += 1;
                }
                z += 1;
            }
            n += 1;
        }
        m += 1;
    }
    places
};

/// Taylor coefficients of degrees 0 to 5 with 0 or 1 in z.
pub const REDUCED: usize = place(MAX_DEGREE + 1, 0, 0);

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x4;

    /// D_γ by differences of the closed form of one lower order would lose digits; the classical recursion in f64 does
    /// not: n R² D_γ = −(2n−1) Σ γᵢ xᵢ D_(γ−eᵢ) − (n−1) Σ γᵢ(γᵢ−1) D_(γ−2eᵢ).
    fn classical(x: [f64; 3], gamma: [i32; 3]) -> f64 {
        if gamma.iter().any(|g| *g < 0) {
            return 0.0;
        }
        let n: i32 = gamma.iter().sum();
        if n == 0 {
            return 1.0 / x.map(|x| x * x).iter().sum::<f64>().sqrt();
        }
        let minus = |axis: usize, by: i32| {
            let mut lower = gamma;
            lower[axis] -= by;
            lower
        };
        let mut sum = 0.0;
        for axis in 0..3 {
            let g = f64::from(gamma[axis]);
            if gamma[axis] > 0 {
                sum -= f64::from(2 * n - 1) * g * x[axis] * classical(x, minus(axis, 1));
            }
            if gamma[axis] > 1 {
                sum -= f64::from(n - 1) * g * (g - 1.0) * classical(x, minus(axis, 2));
            }
        }
        sum / (f64::from(n) * x.map(|x| x * x).iter().sum::<f64>())
    }

    #[test]
    fn classical_recursion_equals_finite_differences() {
        let x = [0.36, 0.48, -0.8];
        let h = 1e-5;
        for gamma in [[0, 0, 0], [1, 0, 0], [1, 2, 0], [3, 1, 1]] {
            for axis in 0..3 {
                let [mut up, mut down] = [x, x];
                up[axis] += h;
                down[axis] -= h;
                let mut higher = gamma;
                higher[axis] += 1;
                let difference = (classical(up, gamma) - classical(down, gamma)) / (2.0 * h);
                let exact = classical(x, higher);
                assert!((difference - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{gamma:?} {axis}");
            }
        }
    }

    #[test]
    fn derivatives_equal_the_classical_recursion() {
        let u = [0.36f64, 0.48, -0.8];
        let mut derivatives = Derivatives::default();
        derivatives.compute(u.map(|x| f32x4::splat(x as f32)), TOP);
        for n in 0..=TOP {
            for z in 0..=2.min(n) {
                for a in 0..=n - z {
                    let sign = if z == 2 { -1.0 } else { 1.0 };
                    let value = sign * f64::from(derivatives.table[row(n, z) + a].0[2]);
                    let exact = classical(u, [a as i32, (n - z - a) as i32, z as i32]);
                    // Derivatives of order n are of the order of n!.
                    assert!((value - exact).abs() < 1e-6 * factorial(n), "{n} {z} {a}: {value} {exact}");
                }
            }
        }
    }
}
