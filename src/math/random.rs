//! Numbers as if drawn at random, the same for the same seed: SplitMix64 (Steele et al. 2014).

/// From one state to the next.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// A sequence of numbers.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(STEP);
        mixed(self.0)
    }

    /// Evenly distributed in [0, 1).
    pub fn below_one(&mut self) -> f64 {
        fraction(self.bits())
    }

    /// Evenly distributed in (0, 1].
    pub fn above_zero(&mut self) -> f64 {
        ((self.bits() >> 11) + 1) as f64 / (1u64 << 53) as f64
    }

    /// A whole number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }
}

/// A number in which all bits depend on all of another.
pub fn mixed(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The number in [0, 1) that the upper bits spell.
pub fn fraction(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

/// A number in [0, 1) that depends on all of some numbers.
pub fn hashed<const N: usize>(numbers: [u64; N]) -> f64 {
    let mix = |hash: u64, number: u64| mixed((hash ^ number).wrapping_add(STEP));
    fraction(numbers.into_iter().fold(0, mix))
}
