//! Bytes as choices and numbers: every input means something, and an input that ends means zeros.
use fast_winding::math::Vec3;

/// What is left of an input.
pub struct Source<'a> {
    pub rest: &'a [u8],
}

/// Numbers that computations stumble over.
const STRANGE: [f64; 20] = [
    0.0,
    -0.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    1e300,
    -1e300,
    f64::MAX,
    f64::MIN,
    1e-300,
    -1e-300,
    5e-324,
    1e154,
    1e-154,
    1e38,
    f64::EPSILON,
    1.0 + f64::EPSILON,
    1e16,
    -1.0,
    0.1,
];

impl<'a> Source<'a> {
    pub fn new(bytes: &'a [u8]) -> Source<'a> {
        Source { rest: bytes }
    }

    pub fn byte(&mut self) -> u8 {
        match self.rest {
            [first, rest @ ..] => {
                self.rest = rest;
                *first
            }
            [] => 0,
        }
    }

    /// A number below `count`, of 256 at most.
    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// Evenly in (0, 1), on no multiple of a short fraction.
    pub fn share(&mut self) -> f64 {
        (f64::from(self.byte()) + std::f64::consts::FRAC_1_PI) / 256.0
    }

    /// Any number: small whole ones, strange ones, and those that eight bytes can be.
    pub fn number(&mut self) -> f64 {
        match self.below(4) {
            0 | 1 => f64::from(self.byte() as i8),
            2 => self.pick(&STRANGE),
            _ => f64::from_le_bytes(std::array::from_fn(|_| self.byte())),
        }
    }

    /// One of the usual values of a setting, and in one of eight cases any number.
    pub fn setting(&mut self, usual: &[f64]) -> f64 {
        match self.below(8) {
            0 => self.number(),
            _ => self.pick(usual),
        }
    }

    /// As [`Source::setting`], or none.
    pub fn option(&mut self, usual: &[f64]) -> Option<f64> {
        self.flag().then(|| self.setting(usual))
    }

    /// A point of a grid with four places along each axis: where coincidences happen.
    pub fn grid_point(&mut self) -> Vec3 {
        let bits = self.byte();
        Vec3::new(f64::from(bits & 3), f64::from(bits >> 2 & 3), f64::from(bits >> 4 & 3))
    }

    pub fn any_point(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }
}
