//! Loops seen from a block beside them, by curtains that hang away from it.
//!
//! A loop and a block whose boxes are apart along an axis: curtains from the loop's edges to infinity along that axis, away
//! from the block, close it as its caps do, and no ray from the block in the other direction meets either. So the winding
//! number of the caps is the sum of the curtains' solid angles over 4π. With a, b the ends of an edge relative to a query,
//! u the axis, s = |a| + a·u > 0 and ζ = the other two coordinates as a complex number, the half solid angle is the argument
//! of s_a s_b + ζ̄_a ζ_b (as in [`crate::winding::curtain`], where it may cancel; here its real part is positive). Along a row
//! of queries parallel to u, ζ̄_a ζ_b is constant: a square root and a complex product are left for each edge and query.
//!
//! Arguments are summed as one product, with the number of times that it went around.
use super::loops::Loop;
use crate::math::{Aabb, Floats, Registers, Vec3, Work, in_widest_registers};
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use wide::f64x4;

/// Queries taken together.
const LANES: usize = 4;
/// Whether two quads at once pay for their code.
const SEVERAL: bool = cfg!(not(target_arch = "wasm32"));
/// Edges between two corrections of the product's exponent.
const EDGES_PER_SCALE: usize = 8;
/// Boxes count as apart only if the gap is this share of the loop's size: nearer, chords between two loops of a cycle would
/// have to cancel to the last bit.
const GAP: f64 = 1.0 / 64.0;

/// Coordinates of a block of queries along the three axes.
pub type Grid = [Vec<f64>; 3];
/// Places in a grid.
pub type Region = [Range<usize>; 3];

pub fn all(grid: &Grid) -> Region {
    std::array::from_fn(|axis| 0..grid[axis].len())
}

pub fn box_of(grid: &Grid, region: &Region) -> Aabb {
    let at = |place: fn(&Range<usize>) -> usize| {
        Vec3::from_array(std::array::from_fn(|axis| grid[axis][place(&region[axis])]))
    };
    let (first, last) = (at(|r| r.start), at(|r| r.end - 1));
    Aabb { min: first.min(last), max: first.max(last) }
}

/// The direction from a block to a loop's box along the axis of the widest gap between them; none if they are not apart.
pub fn away(block: &Aabb, bounds: &Aabb) -> Option<(usize, f64)> {
    let least = GAP * bounds.size().max_element();
    let gaps = [(bounds.min - block.max, 1.0), (block.min - bounds.max, -1.0)];
    let all = gaps.iter().flat_map(|(gap, sign)| (0..3).map(move |axis| (axis, *sign, gap[axis])));
    let (axis, sign, gap) = all.max_by(|a, b| a.2.total_cmp(&b.2)).expect("there are six");
    (gap > 0.0 && gap >= least).then_some((axis, sign))
}

/// Largest magnitude of the winding number of caps of an area, in a box, seen from another.
pub fn largest(area: f64, bounds: &Aabb, block: &Aabb) -> f64 {
    let gap = (bounds.min - block.max).max(block.min - bounds.max).max(Vec3::ZERO);
    area / (4.0 * PI * gap.length_squared())
}

/// At each query of a grid, x fastest, a product of complex numbers.
pub struct Products {
    /// Lengths are multiplied by this power of two.
    unit: f64,
    counts: [usize; 3],
    real: Vec<f64>,
    imaginary: Vec<f64>,
    /// How often the product went around.
    wraps: Vec<f64>,
    row: Row,
}

/// What is constant along a row, for each vertex of all loops, one after the other, the last one of each once more before
/// its first; and for the edge that leads to it.
#[derive(Default)]
struct Row {
    points: Vec<Vec3>,
    queries: Vec<f64>,
    /// Where each loop ends.
    ends: Vec<usize>,
    along: Vec<f64>,
    beside: [Vec<f64>; 2],
    squared: Vec<f64>,
    real: Vec<f64>,
    imaginary: Vec<f64>,
}

impl Products {
    pub fn of(grid: &Grid, unit: f64) -> Products {
        let counts: [usize; 3] = std::array::from_fn(|axis| grid[axis].len());
        let len = counts.iter().product();
        let [ones, zeros] = [vec![1.0; len], vec![0.0; len]];
        Products { unit, counts, real: ones, imaginary: zeros.clone(), wraps: zeros, row: Row::default() }
    }

    /// Multiplies by the factors of loops that lie in a direction, the sign of an axis, from a region of the grid. Turns are
    /// counted only if they `may_turn`: the sum of all factors so far may be half a turn or more.
    pub fn multiply(
        &mut self,
        grid: &Grid,
        region: &Region,
        loops: &[&Loop],
        direction: (usize, f64),
        may_turn: bool,
    ) {
        in_widest_registers(Multiplication { products: self, grid, region, loops, direction, may_turn });
    }

    /// Adds the sums of the arguments, over 2π.
    pub fn add_to(&self, sums: &mut [f64]) {
        let parts = self.real.chunks(LANES).zip(self.imaginary.chunks(LANES)).zip(self.wraps.chunks(LANES));
        for (sums, ((real, imaginary), wraps)) in sums.chunks_mut(LANES).zip(parts) {
            let lanes = |from: &[f64], rest: f64| {
                f64x4::from(std::array::from_fn(|k| from.get(k).copied().unwrap_or(rest)))
            };
            let angles = lanes(imaginary, 0.0).atan2(lanes(real, 1.0)).to_array();
            let turns = angles.iter().zip(wraps).map(|(angle, wraps)| angle / TAU + wraps);
            sums.iter_mut().zip(turns).for_each(|(sum, turns)| *sum += turns);
        }
    }
}

struct Multiplication<'a> {
    products: &'a mut Products,
    grid: &'a Grid,
    region: &'a Region,
    loops: &'a [&'a Loop],
    direction: (usize, f64),
    may_turn: bool,
}

impl Work for Multiplication<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        let Multiplication { products, grid, region, loops, direction: (u, sign), may_turn } = self;
        let [v, w] = [(u + 1) % 3, (u + 2) % 3];
        let strides = [1, products.counts[0], products.counts[0] * products.counts[1]];
        let (row, unit) = (&mut products.row, products.unit);
        row.set_loops(loops);
        let points = std::mem::take(&mut row.points);
        row.along.clear();
        row.along.extend(points.iter().map(|p| sign * unit * p[u]));
        row.queries.clear();
        row.queries.extend(grid[u][region[u].clone()].iter().map(|q| sign * unit * q));
        for k in region[w].clone() {
            row.set_beside(1, &points, w, grid[w][k], unit);
            for j in region[v].clone() {
                row.set_beside(0, &points, v, grid[v][j], unit);
                row.set_edges(sign);
                let first = j * strides[v] + k * strides[w] + region[u].start * strides[u];
                let parts = [&mut products.real, &mut products.imaginary, &mut products.wraps];
                let mut product = parts.map(|part| &mut part[first..]);
                let mut start = 0;
                while start < row.queries.len() {
                    start += match (SEVERAL && row.queries.len() - start > LANES, may_turn) {
                        (true, true) => row.multiply::<R::Doubles, 2, true>(start, &mut product, strides[u]),
                        (true, false) => {
                            row.multiply::<R::Doubles, 2, false>(start, &mut product, strides[u])
                        }
                        (false, true) => row.multiply::<R::Doubles, 1, true>(start, &mut product, strides[u]),
                        (false, false) => {
                            row.multiply::<R::Doubles, 1, false>(start, &mut product, strides[u])
                        }
                    };
                }
            }
        }
    }
}

impl Row {
    fn set_loops(&mut self, loops: &[&Loop]) {
        self.points.clear();
        self.ends.clear();
        for one in loops {
            self.points.extend(one.points.last());
            self.points.extend(&one.points);
            self.ends.push(self.points.len());
        }
    }

    #[inline(always)]
    fn set_beside(&mut self, side: usize, points: &[Vec3], axis: usize, query: f64, unit: f64) {
        let beside = &mut self.beside[side];
        beside.clear();
        beside.extend(points.iter().map(|p| unit * (p[axis] - query)));
    }

    #[inline(always)]
    fn set_edges(&mut self, sign: f64) {
        let [v, w] = self.beside.each_ref().map(|b| &b[..]);
        let count = v.len();
        for part in [&mut self.squared, &mut self.real, &mut self.imaginary] {
            part.resize(count, 0.0);
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

    /// Multiplies by the factors of all edges at up to `N` quads of queries of the row from one on; gives how many that is.
    #[inline(always)]
    fn multiply<Q: Floats<Number = f64>, const N: usize, const MAY_TURN: bool>(
        &self,
        start: usize,
        product: &mut [&mut [f64]; 3],
        stride: usize,
    ) -> usize {
        let queries = &self.queries[start..];
        let last = queries.len().min(N * LANES) - 1;
        let place = |i: usize| (start + i.min(last)) * stride;
        let quads = |at: &dyn Fn(usize) -> f64| -> [Q; N] {
            std::array::from_fn(|n| {
                Q::load(&std::array::from_fn::<f64, LANES, _>(|lane| at(n * LANES + lane)))
            })
        };
        let q = quads(&|i| queries[i.min(last)]);
        let [mut x, mut y, mut wraps] = product.each_ref().map(|part| quads(&|i| part[place(i)]));
        let count = self.along.len();
        assert!(self.ends.last() == Some(&count));
        let (along, squared) = (&self.along[..count], &self.squared[..count]);
        let (constants, turns) = (&self.real[..count], &self.imaginary[..count]);
        let s = |k: usize, q: Q| {
            let along = Q::splat(along[k]) - q;
            along + (along * along + Q::splat(squared[k])).sqrt()
        };
        let quarter = Q::splat(0.25);
        let mut start = 0;
        for end in &self.ends {
            let mut from = q.map(|q| s(start, q));
            for k in start + 1..*end {
                let (constant, turn) = (Q::splat(constants[k]), Q::splat(turns[k]));
                for n in 0..N {
                    let to = s(k, q[n]);
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
                if k % EDGES_PER_SCALE == 0 || k == *end - 1 {
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
                let mut values = [0.0; LANES];
                result[n].store(&mut values);
                (0..LANES)
                    .filter(|lane| n * LANES + lane <= last)
                    .for_each(|lane| part[place(n * LANES + lane)] = values[lane]);
            }
        }
        N * LANES
    }
}
