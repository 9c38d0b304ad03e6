use std::f64::consts::TAU;
use wide::{f32x4, i32x4};

/// Sums of half solid angles at four queries, kept as products of complex numbers with those arguments, and the number of
/// times each product went around: one arctangent for a query instead of one for each triangle.
#[derive(Clone, Copy)]
pub struct Angles {
    real: f32x4,
    imaginary: f32x4,
    wraps: i32x4,
}

/// The exponent of a 32-bit float, and twice its bias.
const EXPONENT: i32x4 = i32x4::new([0x7f80_0000; 4]);
const TWICE_BIAS: i32x4 = i32x4::new([0x7f00_0000; 4]);
const ONE: i32x4 = i32x4::new([1; 4]);

impl Angles {
    pub const ZERO: Angles =
        Angles { real: f32x4::new([1.0; 4]), imaginary: f32x4::new([0.0; 4]), wraps: i32x4::new([0; 4]) };

    /// Adds the arguments of `real + i·imaginary`. An imaginary part of 0 must come with a positive real one.
    #[inline(always)]
    pub fn add(&mut self, real: f32x4, imaginary: f32x4) {
        let new_real = self.real * real - self.imaginary * imaginary;
        let new_imaginary = self.real * imaginary + self.imaginary * real;
        let bits = |x: f32x4| -> i32x4 { wide::bytemuck::cast(x) };
        let (old, turn, new) = (bits(self.imaginary), bits(imaginary), bits(new_imaginary));
        // Signs are in the highest bits: upper half-plane turned by a positive angle into the lower one is past π; its
        // mirror, past −π.
        let past: i32x4 = ((old ^ new) & !(old ^ turn)) >> 31;
        // +1 where the new sign is negative, −1 where it is positive.
        self.wraps += past & ((!new >> 31) | ONE);
        let size = bits(new_real.abs() + new_imaginary.abs());
        // 2⁻ᵉ for an exponent e: it keeps products from overflowing and rounds nothing.
        let scale: f32x4 = wide::bytemuck::cast(TWICE_BIAS - (size & EXPONENT));
        self.real = new_real * scale;
        self.imaginary = new_imaginary * scale;
    }

    /// The winding numbers: the sums of half solid angles over 2π.
    pub fn turns(&self) -> [f64; 4] {
        let (angles, wraps) = (self.imaginary.atan2(self.real).to_array(), self.wraps.to_array());
        std::array::from_fn(|k| f64::from(angles[k]) / TAU + f64::from(wraps[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_many_angles_count_every_turn() {
        let mut sums = Angles::ZERO;
        let mut expected = [0.0; 4];
        let steps = [0.7, -0.9, 3.1, -3.1];
        for i in 0..300 {
            let turned = steps.map(|s| s * (0.3 + 0.7 * f64::from(i % 5) / 4.0));
            let length = 10f64.powi(i % 9 - 4);
            let lanes = |f: fn(f64) -> f64| f32x4::from(turned.map(|t| (length * f(t)) as f32));
            sums.add(lanes(f64::cos), lanes(f64::sin));
            expected.iter_mut().zip(turned).for_each(|(e, t)| *e += t / TAU);
            for (value, expected) in sums.turns().into_iter().zip(expected) {
                assert!((value - expected).abs() < 1e-5, "step {i}: {value} instead of {expected}");
            }
        }
    }
}
