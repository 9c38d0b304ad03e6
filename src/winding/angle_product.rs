use crate::bvh::WIDTH;
use crate::math::Floats;
use std::f64::consts::TAU;
use wide::f64x4;

/// A sum of half solid angles, kept as the product of complex numbers with those arguments, and the number of times
/// the product went around: one arctangent for a whole query instead of one for each triangle.
pub struct AngleProduct {
    real: f64x4,
    imaginary: f64x4,
    wraps: f64x4,
}

impl AngleProduct {
    pub const ONE: AngleProduct =
        AngleProduct { real: f64x4::ONE, imaginary: f64x4::ZERO, wraps: f64x4::ZERO };

    /// Multiplies by `real + i·imaginary`, four factors at once. A factor without an imaginary part counts as 1: its
    /// triangle holds the query in its plane.
    #[inline(always)]
    pub fn multiply(&mut self, real: f64x4, imaginary: f64x4) {
        let flat = imaginary.simd_eq(f64x4::ZERO);
        let real = flat.bitselect(f64x4::ONE, real);
        let new_real = self.real * real - self.imaginary * imaginary;
        let new_imaginary = self.real * imaginary + self.imaginary * real;
        let zero = f64x4::ZERO;
        let was_upper = self.imaginary.simd_ge(zero);
        let is_upper = new_imaginary.simd_ge(zero);
        // Upper half-plane turned by a positive angle into the lower one: past π, and its mirror.
        let up = !flat & was_upper & imaginary.simd_ge(zero) & !is_upper;
        let down = !was_upper & imaginary.simd_lt(zero) & is_upper;
        self.wraps += (up & f64x4::ONE) - (down & f64x4::ONE);
        let scale = (new_real.abs() + new_imaginary.abs()).reciprocal_power_of_two();
        self.real = new_real * scale;
        self.imaginary = new_imaginary * scale;
    }

    /// Multiplies one lane by more factors, which leaves the others as they are, and adds whole turns to it.
    pub fn multiply_lane(&mut self, lane: usize, factors: &[[f64; 2]], turns: f64) {
        let place = |value: f64, rest: f64| {
            f64x4::from(std::array::from_fn(|k| if k == lane { value } else { rest }))
        };
        factors.iter().for_each(|[real, imaginary]| self.multiply(place(*real, 1.0), place(*imaginary, 0.0)));
        self.wraps += place(turns, 0.0);
    }

    /// The sum over all lanes, over 2π.
    pub fn turns(self) -> f64 {
        let [real, imaginary, wraps] = [self.real, self.imaginary, self.wraps].map(|v| v.to_array());
        let mut sum = AngleProduct1 { real: real[0], imaginary: imaginary[0], wraps: wraps[0] };
        for k in 1..WIDTH {
            sum.multiply(AngleProduct1 { real: real[k], imaginary: imaginary[k], wraps: wraps[k] });
        }
        sum.turns()
    }

    /// The sums of the lanes, each over 2π.
    pub fn turns_of_lanes(self) -> [f64; WIDTH] {
        let [real, imaginary, wraps] = [self.real, self.imaginary, self.wraps].map(|v| v.to_array());
        std::array::from_fn(|k| {
            AngleProduct1 { real: real[k], imaginary: imaginary[k], wraps: wraps[k] }.turns()
        })
    }
}

/// `values` with the sign that `sign` gives, 1 or −1, in the lanes that are set in `open`; none of these becomes 0.
#[inline]
pub fn with_signs(values: f64x4, open: u32, sign: impl Fn(usize) -> f64) -> f64x4 {
    let mut parts = values.to_array();
    for k in (0..WIDTH).filter(|k| open >> k & 1 == 1) {
        parts[k] = sign(k) * parts[k].abs().max(f64::MIN_POSITIVE);
    }
    f64x4::from(parts)
}

/// One lane of an [`AngleProduct`].
struct AngleProduct1 {
    real: f64,
    imaginary: f64,
    wraps: f64,
}

impl AngleProduct1 {
    fn multiply(&mut self, other: AngleProduct1) {
        let real = self.real * other.real - self.imaginary * other.imaginary;
        let imaginary = self.real * other.imaginary + self.imaginary * other.real;
        let (was, with, is) = (self.imaginary >= 0.0, other.imaginary >= 0.0, imaginary >= 0.0);
        self.wraps += other.wraps;
        if was && with && !is {
            self.wraps += 1.0;
        }
        if !was && !with && is {
            self.wraps -= 1.0;
        }
        self.real = real;
        self.imaginary = imaginary;
    }

    fn turns(&self) -> f64 {
        // −0 would turn an angle of π into −π.
        libm::atan2(self.imaginary + 0.0, self.real) / TAU + self.wraps
    }
}
