use crate::math::{Aabb, Vec3};

/// Moves the sources into a unit cube about the origin. The winding number does not change with scale, but powers of
/// lengths in 32-bit floats would overflow.
#[derive(Clone, Copy)]
pub struct Frame {
    pub center: Vec3,
    pub scale: f64,
}

impl Frame {
    pub fn around(bounds: &Aabb) -> Frame {
        let longest = bounds.size().max_element();
        // A power of two: scaling is exact.
        let scale = if longest > 0.0 { 1.0 / power_of_two_above(longest) } else { 1.0 };
        Frame { center: bounds.center(), scale }
    }

    #[inline]
    pub fn local(&self, p: Vec3) -> Vec3 {
        (p - self.center) * self.scale
    }
}

/// The lowest power of two above `x` > 0, within what has an inverse. From the bits of `x`: a logarithm and a power would
/// bring tables.
fn power_of_two_above(x: f64) -> f64 {
    let exponent = x.to_bits() >> (f64::MANTISSA_DIGITS - 1);
    f64::from_bits((exponent + 1).min(2 * f64::MAX_EXP as u64 - 4) << (f64::MANTISSA_DIGITS - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_are_exact_and_have_an_inverse() {
        for (x, power) in
            [(1.0, 2.0), (0.75, 1.0), (3.9, 4.0), (1e-9, 2f64.powi(-29)), (5e-324, f64::MIN_POSITIVE)]
        {
            assert_eq!(power_of_two_above(x), power, "{x}");
        }
        assert!((1.0 / power_of_two_above(f64::MAX)).is_normal());
    }
}
