//! Polynomials in x, y, z modulo x² + y² + z²: the form that derivatives of a harmonic function take.
//!
//! Derivatives of 1/r satisfy ∂x² + ∂y² + ∂z² = 0, so a sum Σ A_γ ∂^γ of degree n is determined by 2n + 1 numbers: the
//! coefficients of the monomials of degree 0 and 1 in z. Degree n lies at places n² to n² + 2n:
//! ```text
//! n²        x^a y^(n−a),     a = 0 … n
//! n² + n+1  x^a y^(n−1−a) z, a = 0 … n−1
//! ```
use std::ops::{Add, Mul, Sub};

/// Place of x^a y^(n−a−z) z^z, z = 0 or 1.
pub const fn place(n: usize, z: usize, a: usize) -> usize {
    n * n + z * (n + 1) + a
}

/// Numbers, or lanes of them.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}
impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Number for T {}

/// Adds the product of a polynomial of degree `N`, given by its 2N + 1 coefficients, and of the linear form
/// f₀x + f₁y + f₂z to the 2N + 3 coefficients of `output`.
#[inline(always)]
pub fn add_product<T: Number, const N: usize>(input: &[T], form: [T; 3], output: &mut [T]) {
    let (plain, times_z) = input[..2 * N + 1].split_at(N + 1);
    let (out_plain, out_times_z) = output[..2 * N + 3].split_at_mut(N + 2);
    for a in 0..=N {
        out_plain[a + 1] = out_plain[a + 1] + form[0] * plain[a];
        out_plain[a] = out_plain[a] + form[1] * plain[a];
        out_times_z[a] = out_times_z[a] + form[2] * plain[a];
    }
    for a in 0..N {
        // z · z = −x² − y²
        let squared = form[2] * times_z[a];
        out_plain[a + 2] = out_plain[a + 2] - squared;
        out_plain[a] = out_plain[a] - squared;
        out_times_z[a + 1] = out_times_z[a + 1] + form[0] * times_z[a];
        out_times_z[a] = out_times_z[a] + form[1] * times_z[a];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(n: usize, coefficients: &[f64], [x, y, z]: [f64; 3]) -> f64 {
        let term = |z_degree: usize, a: usize| {
            let b = n - z_degree - a;
            coefficients[place(n, z_degree, a) - n * n]
                * x.powi(a as i32)
                * y.powi(b as i32)
                * z.powi(z_degree as i32)
        };
        (0..=n).map(|a| term(0, a)).sum::<f64>() + (0..n).map(|a| term(1, a)).sum::<f64>()
    }

    #[test]
    fn product_agrees_on_the_cone_where_the_squares_sum_to_zero() {
        // On x² + y² = z² with z replaced by i z the relation holds; real and imaginary parts separate by parity in z.
        // There a polynomial P + z Q has the real part P and the imaginary part z Q.
        let input = [0.3, -1.0, 2.0, 0.7, 1.1];
        let form = [0.5, -0.25, 1.5];
        let mut output = [0.0; 7];
        add_product::<f64, 2>(&input, form, &mut output);
        let [x, y] = [0.6f64, -1.3];
        let z = (x * x + y * y).sqrt();
        let parts = |n: usize, c: &[f64]| {
            let plain = value(n, c, [x, y, 0.0]);
            (plain, value(n, c, [x, y, z]) - plain)
        };
        let ((p, q), (f, g)) = (parts(2, &input), (form[0] * x + form[1] * y, form[2] * z));
        let (real, imaginary) = parts(3, &output);
        assert!((real - (p * f - q * g)).abs() < 1e-14);
        assert!((imaginary - (p * g + q * f)).abs() < 1e-14);
    }
}
