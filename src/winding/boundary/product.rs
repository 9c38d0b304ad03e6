//! The kernel of [`super::curtains`]: edges seen from rows of queries.
use super::curtains::{Grid, Region};
use super::loops::Polygons;
use crate::math::{Floats, Plain, Registers, Vec3, Work, in_widest_registers};
use std::f64::consts::TAU;
use std::ops::{Add, Mul, Sub};
use wide::f64x4;

/// Whether two vectors of queries at once pay for their code.
const SEVERAL: bool = cfg!(not(target_arch = "wasm32"));
/// Most queries taken together.
const MOST: usize = 16;

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
    counts: [usize; 3],
    /// Real and imaginary parts, and how often the product went around; empty if nothing was multiplied.
    parts: [Vec<T>; 3],
    row: Row<T>,
}

/// From where edges are seen: a region of a grid, from which they lie in a direction, the sign of an axis.
#[derive(Clone, Copy)]
pub struct Side<'a> {
    pub grid: &'a Grid,
    pub region: &'a Region,
    pub direction: (usize, f64),
    /// Positions are taken relative to this, and multiplied by the unit, a power of two.
    pub center: Vec3,
    pub unit: f64,
    /// Whether turns are counted: the sum of all angles so far may be half a turn or more.
    pub may_turn: bool,
}

impl<T: Number> Product<T> {
    pub fn of(counts: [usize; 3]) -> Product<T> {
        Product { counts, parts: Default::default(), row: Row::default() }
    }

    /// Multiplies by the factors of the edges of polygons.
    pub fn multiply(&mut self, polygons: &Polygons, side: &Side) {
        let len = self.counts.iter().product();
        if self.parts[0].is_empty() {
            self.parts = [T::ONE, T::default(), T::default()].map(|value| vec![value; len]);
        }
        T::row(&mut RowWork { product: self, polygons, side });
    }

    /// Adds the sums of the arguments, over 2π.
    pub fn add_to(&self, sums: &mut [f64]) {
        const LANES: usize = 4;
        let [real, imaginary, wraps] = self.parts.each_ref().map(|part| part.chunks(LANES));
        for (sums, ((real, imaginary), wraps)) in sums.chunks_mut(LANES).zip(real.zip(imaginary).zip(wraps)) {
            let lanes = |from: &[T], rest: f64| {
                f64x4::from(std::array::from_fn(|k| from.get(k).map_or(rest, |x| x.widened())))
            };
            let angles = lanes(imaginary, 0.0).atan2(lanes(real, 1.0)).to_array();
            let turns = angles.iter().zip(wraps).map(|(angle, wraps)| angle / TAU + wraps.widened());
            sums.iter_mut().zip(turns).for_each(|(sum, turns)| *sum += turns);
        }
    }
}

/// What is constant along a row, for each point of polygons, and for the edge that leads to it.
#[derive(Default)]
struct Row<T> {
    queries: Vec<T>,
    along: Vec<T>,
    beside: [Vec<T>; 2],
    squared: Vec<T>,
    real: Vec<T>,
    imaginary: Vec<T>,
}

/// The rows of a multiplication.
pub struct RowWork<'a, T> {
    product: &'a mut Product<T>,
    polygons: &'a Polygons,
    side: &'a Side<'a>,
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

impl Work for &mut RowWork<'_, f32> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.rows::<R::Singles, <Plain as Registers>::Singles>();
    }
}

impl Work for &mut RowWork<'_, f64> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.rows::<R::Doubles, R::Doubles>();
    }
}

impl<T: Number> RowWork<'_, T> {
    /// In registers of the kind `F`, the last few queries of a row in those of the kind `G`.
    #[inline(always)]
    fn rows<F: Floats<Number = T>, G: Floats<Number = T>>(&mut self) {
        let Side { grid, region, direction: (u, sign), center, unit, may_turn } = *self.side;
        let [v, w] = [(u + 1) % 3, (u + 2) % 3];
        let counts = self.product.counts;
        let strides = [1, counts[0], counts[0] * counts[1]];
        let Product { row, parts, .. } = &mut *self.product;
        let points = &self.polygons.points;
        row.along.clear();
        row.along.extend(points.iter().map(|p| T::of(sign * unit * (p[u] - center[u]))));
        row.queries.clear();
        row.queries.extend(grid[u][region[u].clone()].iter().map(|q| T::of(sign * unit * (q - center[u]))));
        for k in region[w].clone() {
            row.set_beside(1, points, w, grid[w][k], unit);
            for j in region[v].clone() {
                row.set_beside(0, points, v, grid[v][j], unit);
                row.set_edges(T::of(sign));
                let first = j * strides[v] + k * strides[w] + region[u].start * strides[u];
                let mut product = parts.each_mut().map(|part| &mut part[first..]);
                let mut start = 0;
                let ends = &self.polygons.ends;
                while start < row.queries.len() {
                    let rest = row.queries.len() - start;
                    let stride = strides[u];
                    let is_wide = F::COUNT > G::COUNT;
                    start += match (rest > F::COUNT + if is_wide { G::COUNT } else { 0 }, may_turn) {
                        (true, true) if SEVERAL => {
                            row.multiply::<F, 2, true>(ends, start, &mut product, stride)
                        }
                        (true, false) if SEVERAL => {
                            row.multiply::<F, 2, false>(ends, start, &mut product, stride)
                        }
                        (false, true) if is_wide && rest <= G::COUNT => {
                            row.multiply::<G, 1, true>(ends, start, &mut product, stride)
                        }
                        (false, false) if is_wide && rest <= G::COUNT => {
                            row.multiply::<G, 1, false>(ends, start, &mut product, stride)
                        }
                        (_, true) => row.multiply::<F, 1, true>(ends, start, &mut product, stride),
                        (_, false) => row.multiply::<F, 1, false>(ends, start, &mut product, stride),
                    };
                }
            }
        }
    }
}

impl<T: Number> Row<T> {
    #[inline(always)]
    fn set_beside(&mut self, side: usize, points: &[Vec3], axis: usize, query: f64, unit: f64) {
        let beside = &mut self.beside[side];
        beside.clear();
        beside.extend(points.iter().map(|p| T::of(unit * (p[axis] - query))));
    }

    #[inline(always)]
    fn set_edges(&mut self, sign: T) {
        let [v, w] = self.beside.each_ref().map(|b| &b[..]);
        let count = v.len();
        for part in [&mut self.squared, &mut self.real, &mut self.imaginary] {
            part.resize(count, T::default());
        }
        self.squared[0] = v[0] * v[0] + w[0] * w[0];
        let (av, aw, bv, bw) = (&v[..count - 1], &w[..count - 1], &v[1..], &w[1..]);
        let parts = self.squared[1..].iter_mut().zip(&mut self.real[1..]).zip(&mut self.imaginary[1..]);
        for (k, ((squared, real), imaginary)) in parts.enumerate() {
            *squared = bv[k] * bv[k] + bw[k] * bw[k];
            *real = av[k] * bv[k] + aw[k] * bw[k];
            *imaginary = sign * (av[k] * bw[k] - aw[k] * bv[k]);
        }
    }

    /// Multiplies by the factors of all edges at up to `N` vectors of queries of the row from one on; gives how many that is.
    #[inline(always)]
    fn multiply<F: Floats<Number = T>, const N: usize, const MAY_TURN: bool>(
        &self,
        ends: &[usize],
        start: usize,
        product: &mut [&mut [T]; 3],
        stride: usize,
    ) -> usize {
        let queries = &self.queries[start..];
        let last = queries.len().min(N * F::COUNT) - 1;
        let place = |i: usize| (start + i.min(last)) * stride;
        let mut lanes = [T::default(); MOST];
        (0..N * F::COUNT).for_each(|i| lanes[i] = queries[i.min(last)]);
        let q = vectors::<F, N>(&lanes);
        let [mut x, mut y, mut wraps] = [[F::splat(T::default()); N]; 3];
        for (part, vector) in product.iter().zip([&mut x, &mut y, &mut wraps]) {
            (0..N * F::COUNT).for_each(|i| lanes[i] = part[place(i)]);
            *vector = vectors::<F, N>(&lanes);
        }
        let count = self.along.len();
        assert!(ends.last() == Some(&count));
        let (along, squared) = (&self.along[..count], &self.squared[..count]);
        let (constants, turns) = (&self.real[..count], &self.imaginary[..count]);
        let quarter = F::splat(T::of(0.25));
        let mut start = 0;
        for end in ends {
            let mut from = q;
            for n in 0..N {
                from[n] = reach(along[start], squared[start], q[n]);
            }
            for k in start + 1..*end {
                let (constant, turn) = (F::splat(constants[k]), F::splat(turns[k]));
                for n in 0..N {
                    let to = reach(along[k], squared[k], q[n]);
                    let factor = from[n] * to + constant;
                    from[n] = to;
                    let was = y[n].with_signs_on(quarter);
                    let (re, im) = (x[n], y[n]);
                    x[n] = re * factor - im * turn;
                    y[n] = re * turn + im * factor;
                    if !MAY_TURN {
                        continue;
                    }
                    // By less than a quarter of a turn: out of the upper half-plane into the lower one, or back.
                    let passed = was - y[n].with_signs_on(quarter);
                    wraps[n] = wraps[n] + (passed + turn.with_signs_on(passed.abs()));
                }
                if k % T::EDGES_PER_SCALE == 0 || k == *end - 1 {
                    for n in 0..N {
                        let scale = (x[n].abs() + y[n].abs()).reciprocal_power_of_two();
                        (x[n], y[n]) = (x[n] * scale, y[n] * scale);
                    }
                }
            }
            start = *end;
        }
        for (part, result) in product.iter_mut().zip([x, y, wraps]) {
            for n in 0..N {
                result[n].store(&mut lanes[n * F::COUNT..]);
            }
            (0..last + 1).for_each(|i| part[place(i)] = lanes[i]);
        }
        last + 1
    }
}

#[inline(always)]
fn vectors<F: Floats, const N: usize>(lanes: &[F::Number]) -> [F; N] {
    let mut vectors = [F::load(lanes); N];
    for n in 1..N {
        vectors[n] = F::load(&lanes[n * F::COUNT..]);
    }
    vectors
}

/// |a| + a·u.
#[inline(always)]
fn reach<F: Floats>(along: F::Number, squared: F::Number, q: F) -> F {
    let along = F::splat(along) - q;
    along + (along * along + F::splat(squared)).sqrt()
}
