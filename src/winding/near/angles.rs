use crate::math::Floats;
use crate::treecode::Octet;
use std::f64::consts::TAU;
use wide::f32x4;

/// Sums of half solid angles at eight queries, kept as products of complex numbers with those arguments, and the number of
/// times each product went around: one arctangent for a query instead of one for each triangle.
#[derive(Clone, Copy)]
pub struct Angles {
    real: Octet,
    imaginary: Octet,
    wraps: Octet,
}

impl Angles {
    pub const ZERO: Angles = Angles { real: Octet([1.0; 8]), imaginary: Octet::ZERO, wraps: Octet::ZERO };

    /// Adds the arguments of `real + i·imaginary` to a part of the sums. An imaginary part of 0 must come with a positive real
    /// one: arguments are less than half a turn.
    #[inline(always)]
    pub fn add<F: Floats<Number = f32>>(&mut self, part: usize, real: F, imaginary: F) {
        let (x, y): (F, F) = (self.real.get(part), self.imaginary.get(part));
        let (new_x, new_y) = (x * real - y * imaginary, x * imaginary + y * real);
        // Out of the upper half-plane into the lower one by a positive angle is past π; back by a negative one, past −π.
        let quarter = F::splat(0.25);
        let passed = y.with_signs_on(quarter) - new_y.with_signs_on(quarter);
        self.wraps.add(part, passed + imaginary.with_signs_on(passed.abs()));
        // It keeps products from overflowing and rounds nothing.
        let scale = (new_x.abs() + new_y.abs()).reciprocal_power_of_two();
        self.real.put(part, new_x * scale);
        self.imaginary.put(part, new_y * scale);
    }

    /// Adds the arguments of imaginary and real parts to four sums.
    pub fn add_each(&mut self, part: usize, factors: [(f32, f32); 4]) {
        let [imaginary, real] = [factors.map(|f| f.0), factors.map(|f| f.1)].map(f32x4::from);
        self.add::<f32x4>(part, real, imaginary);
    }

    /// Adds the arguments of more factors, imaginary and real parts, to one sum, and whole turns.
    pub fn add_at(&mut self, place: usize, factors: &[(f32, f32)], turns: f32) {
        let (part, lane) = (place / 4 * 4, place % 4);
        for factor in factors {
            self.add_each(part, std::array::from_fn(|k| if k == lane { *factor } else { (0.0, 1.0) }));
        }
        self.wraps.0[place] += turns;
    }

    /// The winding numbers: the sums of half solid angles over 2π.
    pub fn turns(&self) -> [f64; 8] {
        let half = |octet: &Octet, first: usize| -> f32x4 { octet.get(first) };
        let angles = |first: usize| half(&self.imaginary, first).atan2(half(&self.real, first)).to_array();
        let halves = [angles(0), angles(4)];
        std::array::from_fn(|k| f64::from(halves[k / 4][k % 4]) / TAU + f64::from(self.wraps.0[k]))
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
            sums.add(4, lanes(f64::cos), lanes(f64::sin));
            expected.iter_mut().zip(turned).for_each(|(e, t)| *e += t / TAU);
            for (value, expected) in sums.turns()[4..].iter().zip(expected) {
                assert!((value - expected).abs() < 1e-5, "step {i}: {value} instead of {expected}");
            }
        }
    }
}
