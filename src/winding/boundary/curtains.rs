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
use crate::math::{Aabb, Vec3, widest};
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use wide::f64x4;

/// Edges between two corrections of the product's exponent.
const EDGES_PER_SCALE: usize = 4;
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

/// What is constant along a row, for each vertex of a loop and the edge that leads to it.
#[derive(Default)]
struct Row {
    queries: Vec<f64>,
    along: Vec<f64>,
    /// Of the vertices, the last one once more before the first.
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

    /// Multiplies by the factors of a loop that lies in a direction, the sign of an axis, from a region of the grid.
    pub fn multiply(&mut self, grid: &Grid, region: &Region, points: &[Vec3], direction: (usize, f64)) {
        widest(
            #[inline(always)]
            || self.multiply_here(grid, region, points, direction),
        );
    }

    #[inline(always)]
    fn multiply_here(&mut self, grid: &Grid, region: &Region, points: &[Vec3], (u, sign): (usize, f64)) {
        let [v, w] = [(u + 1) % 3, (u + 2) % 3];
        let strides = [1, self.counts[0], self.counts[0] * self.counts[1]];
        let (row, unit) = (&mut self.row, self.unit);
        row.along.clear();
        row.along.extend(points.iter().map(|p| sign * unit * p[u]));
        row.queries.clear();
        row.queries.extend(grid[u][region[u].clone()].iter().map(|q| sign * unit * q));
        for k in region[w].clone() {
            row.set_beside(1, points, w, grid[w][k], unit);
            for j in region[v].clone() {
                row.set_beside(0, points, v, grid[v][j], unit);
                row.set_edges(sign);
                let first = j * strides[v] + k * strides[w] + region[u].start * strides[u];
                let mut product =
                    [&mut self.real[first..], &mut self.imaginary[first..], &mut self.wraps[first..]];
                let mut start = 0;
                while start < row.queries.len() {
                    start += if row.queries.len() - start > 4 {
                        row.multiply::<8>(start, &mut product, strides[u])
                    } else {
                        row.multiply::<4>(start, &mut product, strides[u])
                    };
                }
            }
        }
    }

    /// Adds the sums of the arguments, over 2π.
    pub fn add_to(&self, sums: &mut [f64]) {
        const FOUR: usize = 4;
        let parts = self.real.chunks(FOUR).zip(self.imaginary.chunks(FOUR)).zip(self.wraps.chunks(FOUR));
        for (sums, ((real, imaginary), wraps)) in sums.chunks_mut(FOUR).zip(parts) {
            let lanes = |from: &[f64], rest: f64| {
                f64x4::from(std::array::from_fn(|k| from.get(k).copied().unwrap_or(rest)))
            };
            let angles = lanes(imaginary, 0.0).atan2(lanes(real, 1.0)).to_array();
            let turns = angles.iter().zip(wraps).map(|(angle, wraps)| angle / TAU + wraps);
            sums.iter_mut().zip(turns).for_each(|(sum, turns)| *sum += turns);
        }
    }
}

impl Row {
    #[inline(always)]
    fn set_beside(&mut self, side: usize, points: &[Vec3], axis: usize, query: f64, unit: f64) {
        let relative = |p: &Vec3| unit * (p[axis] - query);
        let beside = &mut self.beside[side];
        beside.clear();
        beside.extend(points.last().map(relative));
        beside.extend(points.iter().map(relative));
    }

    #[inline(always)]
    fn set_edges(&mut self, sign: f64) {
        let [v, w] = self.beside.each_ref().map(|b| &b[..]);
        let count = v.len() - 1;
        for part in [&mut self.squared, &mut self.real, &mut self.imaginary] {
            part.resize(count, 0.0);
        }
        let (av, aw, bv, bw) = (&v[..count], &w[..count], &v[1..], &w[1..]);
        let parts = self.squared.iter_mut().zip(&mut self.real).zip(&mut self.imaginary);
        for (k, ((squared, real), imaginary)) in parts.enumerate() {
            *squared = bv[k] * bv[k] + bw[k] * bw[k];
            *real = av[k] * bv[k] + aw[k] * bw[k];
            *imaginary = sign * (av[k] * bw[k] - aw[k] * bv[k]);
        }
    }

    /// Multiplies by the factors of all edges at up to `W` queries of the row from one on; gives `W`.
    #[inline(always)]
    fn multiply<const W: usize>(&self, start: usize, product: &mut [&mut [f64]; 3], stride: usize) -> usize {
        let queries = &self.queries[start..];
        let last = queries.len().min(W) - 1;
        let place = |lane: usize| (start + lane.min(last)) * stride;
        let q: [f64; W] = std::array::from_fn(|lane| queries[lane.min(last)]);
        let [mut x, mut y, mut wraps]: [[f64; W]; 3] =
            product.each_ref().map(|part| std::array::from_fn(|lane| part[place(lane)]));
        let count = self.along.len();
        let (along, squared) = (&self.along[..count], &self.squared[..count]);
        let (constants, turns) = (&self.real[..count], &self.imaginary[..count]);
        let s = |k: usize| -> [f64; W] {
            std::array::from_fn(|lane| {
                let along = along[k] - q[lane];
                along + (along * along + squared[k]).sqrt()
            })
        };
        let mut from = s(count - 1);
        for k in 0..count {
            let to = s(k);
            let turn = turns[k];
            let before = y;
            for lane in 0..W {
                let factor = from[lane] * to[lane] + constants[k];
                let (re, im) = (x[lane], y[lane]);
                x[lane] = re * factor - im * turn;
                y[lane] = re * turn + im * factor;
            }
            // By less than a quarter of a turn: out of the upper half-plane into the lower one, or back.
            for lane in 0..W {
                let (was_upper, is_upper) = (before[lane] >= 0.0, y[lane] >= 0.0);
                let up = turn >= 0.0;
                wraps[lane] += if up && was_upper && !is_upper { 1.0 } else { 0.0 };
                wraps[lane] -= if !up && !was_upper && is_upper { 1.0 } else { 0.0 };
            }
            from = to;
            if k % EDGES_PER_SCALE == EDGES_PER_SCALE - 1 || k == count - 1 {
                for lane in 0..W {
                    let scale = reciprocal_power_of_two(x[lane].abs() + y[lane].abs());
                    x[lane] *= scale;
                    y[lane] *= scale;
                }
            }
        }
        for (part, result) in product.iter_mut().zip([x, y, wraps]) {
            (0..=last).for_each(|lane| part[place(lane)] = result[lane]);
        }
        W
    }
}

/// 2⁻ᵉ for a positive normal number with exponent e: it keeps products from overflowing and rounds nothing.
#[inline(always)]
fn reciprocal_power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    const TWICE_BIAS: u64 = 0x7fe0_0000_0000_0000;
    f64::from_bits(TWICE_BIAS - (x.to_bits() & EXPONENT))
}
