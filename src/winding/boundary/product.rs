//! Sums of angles at the queries of a grid, kept as products of complex numbers and the number of times that each went around:
//! one arctangent for a query.
use super::rows::{RowWork, Rows};
use crate::math::{Floats, in_widest_registers};
use std::f64::consts::TAU;
use std::ops::{Add, Mul, Sub};
use wide::f64x4;

/// Most queries in a vector.
pub const MOST: usize = 8;

/// 32-bit or 64-bit floats.
pub trait Number: Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    const ONE: Self;
    /// Edges between two corrections of a product's exponent.
    const EDGES_PER_SCALE: usize;
    fn of(x: f64) -> Self;
    fn widened(self) -> f64;
    fn row(work: &mut RowWork<Self>);
}

/// At each query of a grid, x fastest, a product of complex numbers.
pub struct Product<T> {
    pub(super) counts: [usize; 3],
    /// Real and imaginary parts, and how often the product went around; empty if nothing was multiplied.
    pub(super) parts: [Vec<T>; 3],
    /// Space for multiplications.
    pub(super) rows: Rows<T>,
}

impl<T: Number> Product<T> {
    pub fn of(counts: [usize; 3]) -> Product<T> {
        Product { counts, parts: Default::default(), rows: Rows::default() }
    }

    pub(super) fn begin(&mut self) {
        let len = self.counts.iter().product();
        if self.parts[0].is_empty() {
            self.parts = [T::ONE, T::default(), T::default()].map(|value| vec![value; len]);
        }
    }

    /// Adds the sums of the arguments, over 2π.
    pub fn add_to(&self, sums: &mut [f64]) {
        let [real, imaginary, wraps] = self.parts.each_ref().map(|part| part.chunks(ANGLES));
        for (sums, ((real, imaginary), wraps)) in sums.chunks_mut(ANGLES).zip(real.zip(imaginary).zip(wraps))
        {
            let four =
                |from: &[T], rest: f64| std::array::from_fn(|k| from.get(k).map_or(rest, |x| x.widened()));
            let turns = turns(four(real, 1.0), four(imaginary, 0.0));
            sums.iter_mut().zip(turns).zip(wraps).for_each(|((sum, turns), w)| *sum += turns + w.widened());
        }
    }
}

/// Products at four queries.
#[derive(Clone, Copy)]
pub struct Four<F> {
    real: F,
    imaginary: F,
    wraps: F,
}

impl<F: Floats<Number = f64>> Four<F> {
    /// By factors that turn by less than half a turn.
    #[inline(always)]
    pub fn multiply(&mut self, real: F, imaginary: F) {
        let quarter = F::splat(0.25);
        let was = self.imaginary.with_signs_on(quarter);
        let new_real = self.real * real - self.imaginary * imaginary;
        let new_imaginary = self.real * imaginary + self.imaginary * real;
        // Out of the upper half-plane into the lower one the long way, or back.
        let passed = was - new_imaginary.with_signs_on(quarter);
        self.wraps = self.wraps + (passed + imaginary.with_signs_on(passed.abs()));
        let scale = (new_real.abs() + new_imaginary.abs()).reciprocal_power_of_two();
        (self.real, self.imaginary) = (new_real * scale, new_imaginary * scale);
    }
}

impl Product<f64> {
    /// Products at up to four queries that follow each other along x from a place of the grid on.
    #[inline(always)]
    pub fn four<F: Floats<Number = f64>>(&mut self, [i, j, k]: [usize; 3], count: usize) -> Four<F> {
        self.begin();
        let target = Target { parts: &mut self.parts, stride: 1 };
        let place = (k * self.counts[1] + j) * self.counts[0] + i;
        let few = Few { row: 0, start: 0, count, place };
        Four { real: target.load(0, &few), imaginary: target.load(1, &few), wraps: target.load(2, &few) }
    }

    /// Puts them back.
    #[inline(always)]
    pub fn set_four<F: Floats<Number = f64>>(&mut self, [i, j, k]: [usize; 3], count: usize, four: Four<F>) {
        let mut target = Target { parts: &mut self.parts, stride: 1 };
        let place = (k * self.counts[1] + j) * self.counts[0] + i;
        let few = Few { row: 0, start: 0, count, place };
        target.store(0, &few, four.real);
        target.store(1, &few, four.imaginary);
        target.store(2, &few, four.wraps);
    }
}

/// Arguments that are taken at once.
const ANGLES: usize = 4;

/// The arguments of complex numbers, over 2π.
#[inline(never)]
fn turns(real: [f64; ANGLES], imaginary: [f64; ANGLES]) -> [f64; ANGLES] {
    (f64x4::from(imaginary).atan2(f64x4::from(real)) / f64x4::splat(TAU)).to_array()
}

/// Queries of a row that are treated together.
#[derive(Clone, Copy, Default)]
pub struct Few {
    /// Whose edges they see.
    pub row: usize,
    /// The first one and how many, in the row.
    pub start: usize,
    pub count: usize,
    /// The place of the row's first query in the product.
    pub place: usize,
}

impl Number for f32 {
    const ONE: f32 = 1.0;
    const EDGES_PER_SCALE: usize = 4;

    #[inline(always)]
    fn of(x: f64) -> f32 {
        x as f32
    }

    #[inline(always)]
    fn widened(self) -> f64 {
        f64::from(self)
    }

    fn row(work: &mut RowWork<f32>) {
        in_widest_registers(work);
    }
}

impl Number for f64 {
    const ONE: f64 = 1.0;
    const EDGES_PER_SCALE: usize = 8;

    #[inline(always)]
    fn of(x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn widened(self) -> f64 {
        self
    }

    fn row(work: &mut RowWork<f64>) {
        in_widest_registers(work);
    }
}

/// Where products are.
pub struct Target<'a, T> {
    pub parts: &'a mut [Vec<T>; 3],
    /// Between the queries of a row.
    pub stride: usize,
}

impl<T: Number> Target<'_, T> {
    #[inline(always)]
    pub fn load<F: Floats<Number = T>>(&self, part: usize, few: &Few) -> F {
        let mut lanes = [T::default(); MOST];
        let from = &self.parts[part];
        for i in 0..F::COUNT {
            lanes[i] = from[few.place + (few.start + i.min(few.count - 1)) * self.stride];
        }
        F::load(&lanes)
    }

    #[inline(always)]
    pub fn store<F: Floats<Number = T>>(&mut self, part: usize, few: &Few, values: F) {
        let mut lanes = [T::default(); MOST];
        values.store(&mut lanes);
        let to = &mut self.parts[part];
        for i in 0..few.count {
            to[few.place + (few.start + i) * self.stride] = lanes[i];
        }
    }
}
