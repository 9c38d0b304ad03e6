use super::WIDTH;
use crate::math::Floats;

/// Eight numbers, such as one for each query of a group: as many as the widest registers hold. Narrower ones take them part
/// by part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub struct Octet(pub [f32; WIDTH]);

/// Where the parts of an octet begin that a register holds.
#[inline(always)]
pub fn parts<F: Floats<Number = f32>>() -> impl Iterator<Item = usize> {
    (0..WIDTH / F::COUNT).map(|part| part * F::COUNT)
}

impl Octet {
    pub const ZERO: Octet = Octet([0.0; WIDTH]);

    #[inline(always)]
    pub fn get<F: Floats<Number = f32>>(&self, part: usize) -> F {
        F::load(&self.0[part..])
    }

    #[inline(always)]
    pub fn put<F: Floats<Number = f32>>(&mut self, part: usize, numbers: F) {
        numbers.store(&mut self.0[part..]);
    }

    #[inline(always)]
    pub fn add<F: Floats<Number = f32>>(&mut self, part: usize, numbers: F) {
        self.put(part, self.get::<F>(part) + numbers);
    }
}
