//! The kernel of [`super::curtains`]: edges seen from rows of queries.
use super::curtains::{Grid, Region};
use super::loops::Polygons;
use super::product::{Few, MOST, Number, Product, Target};
use crate::math::{Floats, Plain, Registers, Vec3, Work};

/// Vectors of queries that are treated at once, so that the processor need not wait for one; more than one do not pay for
/// their code everywhere.
const SEVERAL: usize = if cfg!(target_arch = "wasm32") { 1 } else { 2 };
/// Turns of zero are counted too where a second kernel would not pay for its code.
const ALWAYS_TURNS: bool = cfg!(target_arch = "wasm32");
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
    /// Multiplies by the factors of the edges of polygons.
    pub fn multiply(&mut self, polygons: &Polygons, side: &Side) {
        self.begin();
        T::row(&mut RowWork { product: self, polygons, side });
    }
}

/// Edges of polygons seen from rows of queries, for each point.
#[derive(Default)]
pub struct Rows<T> {
    queries: Vec<T>,
    along: Vec<T>,
    /// The other two coordinates of the points.
    across: [Vec<f64>; 2],
    /// The second of these from the rows that are treated together, and the first from the current one.
    beside: [Vec<T>; 2],
    edges: [Edges<T>; SEVERAL],
}

/// What is constant along a row: of each point the square of its distance from the row's line, and ζ̄_a ζ_b of the edge that
/// leads to it.
#[derive(Default)]
struct Edges<T> {
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
        let may_turn = may_turn || ALWAYS_TURNS;
        let [v, w] = [(u + 1) % 3, (u + 2) % 3];
        let counts = self.product.counts;
        let strides = [1, counts[0], counts[0] * counts[1]];
        let Product { rows, parts, .. } = &mut *self.product;
        let mut target = Target { parts, stride: strides[u] };
        let queries = grid[u][region[u].clone()].iter().map(|q| T::of(sign * unit * (q - center[u])));
        rows.set_points(&self.polygons.points, (u, sign * unit, center[u]), queries);
        let ends = &self.polygons.ends[..];
        let len = rows.queries.len();
        for k in region[w].clone() {
            rows.set_beside(1, grid[w][k], unit);
            for j in region[v].clone().step_by(SEVERAL) {
                let together = SEVERAL.min(region[v].end - j);
                let mut few = [Few::default(); SEVERAL];
                for (row, few) in few.iter_mut().enumerate().take(together) {
                    rows.set_beside(0, grid[v][j + row], unit);
                    rows.set_edges::<F>(row, T::of(sign));
                    few.row = row;
                    few.place = (j + row) * strides[v] + k * strides[w] + region[u].start * strides[u];
                }
                let mut start = 0;
                while start < len {
                    let is_short = F::COUNT > G::COUNT && len - start <= G::COUNT;
                    let width = if is_short { G::COUNT } else { F::COUNT };
                    let mut count = together;
                    few.iter_mut().for_each(|s| (s.start, s.count) = (start, width.min(len - start)));
                    if SEVERAL == 2 && together == 1 && !is_short && start + width < len {
                        count = 2;
                        few[1] =
                            Few { start: start + width, count: width.min(len - start - width), ..few[0] };
                    }
                    match (is_short, SEVERAL == 1 || count == SEVERAL, may_turn) {
                        (true, true, true) => rows.multiply::<G, SEVERAL, true>(ends, few, &mut target),
                        (true, true, false) => rows.multiply::<G, SEVERAL, false>(ends, few, &mut target),
                        (true, false, true) => rows.multiply::<G, 1, true>(ends, [few[0]], &mut target),
                        (true, false, false) => rows.multiply::<G, 1, false>(ends, [few[0]], &mut target),
                        (false, true, true) => rows.multiply::<F, SEVERAL, true>(ends, few, &mut target),
                        (false, true, false) => rows.multiply::<F, SEVERAL, false>(ends, few, &mut target),
                        (false, false, true) => rows.multiply::<F, 1, true>(ends, [few[0]], &mut target),
                        (false, false, false) => rows.multiply::<F, 1, false>(ends, [few[0]], &mut target),
                    }
                    start += width * if together == 1 { count } else { 1 };
                }
            }
        }
    }
}

impl<T: Number> Rows<T> {
    #[inline(always)]
    fn set_points(
        &mut self,
        points: &[Vec3],
        (u, scale, center): (usize, f64, f64),
        queries: impl Iterator<Item = T>,
    ) {
        self.queries.clear();
        self.queries.extend(queries);
        self.along.clear();
        self.along.extend(points.iter().map(|p| T::of(scale * (p[u] - center))));
        for (side, across) in self.across.iter_mut().enumerate() {
            across.clear();
            across.extend(points.iter().map(|p| p[(u + 1 + side) % 3]));
        }
        let parts = self.edges.iter_mut().flat_map(|e| [&mut e.squared, &mut e.real, &mut e.imaginary]);
        parts.chain(&mut self.beside).for_each(|part| part.resize(points.len() + MOST, T::default()));
    }

    #[inline(always)]
    fn set_beside(&mut self, side: usize, query: f64, unit: f64) {
        let each = self.beside[side].iter_mut().zip(&self.across[side]);
        each.for_each(|(beside, p)| *beside = T::of(unit * (p - query)));
    }

    #[inline(always)]
    fn set_edges<F: Floats<Number = T>>(&mut self, row: usize, sign: T) {
        let (v, w) = (&self.beside[0][..], &self.beside[1][..]);
        let Edges { squared, real, imaginary } = &mut self.edges[row];
        squared[0] = v[0] * v[0] + w[0] * w[0];
        let sign = F::splat(sign);
        // Beyond the last edge there is room, of which nothing is used.
        for a in (0..self.along.len() - 1).step_by(F::COUNT) {
            let b = a + 1;
            let (av, aw) = (F::load(&v[a..]), F::load(&w[a..]));
            let (bv, bw) = (F::load(&v[b..]), F::load(&w[b..]));
            (bv * bv + bw * bw).store(&mut squared[b..]);
            (av * bv + aw * bw).store(&mut real[b..]);
            (sign * (av * bw - aw * bv)).store(&mut imaginary[b..]);
        }
    }

    /// Multiplies by the factors of all edges at some queries.
    #[inline(always)]
    fn multiply<F: Floats<Number = T>, const N: usize, const MAY_TURN: bool>(
        &self,
        ends: &[usize],
        few: [Few; N],
        target: &mut Target<T>,
    ) {
        let zero = F::splat(T::default());
        let [mut q, mut x, mut y, mut wraps, mut from] = [[zero; N]; 5];
        let count = self.along.len();
        let mut edges = [[&self.along[..count]; 3]; N];
        for n in 0..N {
            let mut lanes = [T::default(); MOST];
            let queries = &self.queries[few[n].start..][..few[n].count];
            lanes.iter_mut().enumerate().for_each(|(i, lane)| *lane = queries[i.min(few[n].count - 1)]);
            q[n] = F::load(&lanes);
            (x[n], y[n]) = (target.load(0, &few[n]), target.load(1, &few[n]));
            wraps[n] = target.load(2, &few[n]);
            let own = &self.edges[few[n].row];
            edges[n] = [&own.squared[..count], &own.real[..count], &own.imaginary[..count]];
        }
        assert!(ends.last() == Some(&count));
        let quarter = F::splat(T::of(0.25));
        let mut start = 0;
        for end in ends {
            for n in 0..N {
                from[n] = reach(self.along[start], edges[n][0][start], q[n]);
            }
            for k in start + 1..*end {
                for n in 0..N {
                    let [squared, real, imaginary] = edges[n];
                    let (constant, turn) = (F::splat(real[k]), F::splat(imaginary[k]));
                    let to = reach(self.along[k], squared[k], q[n]);
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
        for n in 0..N {
            target.store(0, &few[n], x[n]);
            target.store(1, &few[n], y[n]);
            target.store(2, &few[n], wraps[n]);
        }
    }
}

/// |a| + a·u.
#[inline(always)]
fn reach<F: Floats>(along: F::Number, squared: F::Number, q: F) -> F {
    let along = F::splat(along) - q;
    along + (along * along + F::splat(squared)).sqrt()
}
