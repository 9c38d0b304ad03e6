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
use super::caps::Doubt;
use super::loops::{Loop, Polygons};
use super::product::Product;
use super::rows::Side;
use crate::math::{Aabb, Vec3};
use std::f64::consts::PI;
use std::ops::Range;

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

/// Loops seen from a grid of queries, x fastest: their angles, summed as products of complex numbers, in 32-bit floats where
/// these are good enough.
pub struct Sums<'a> {
    loops: &'a [Loop],
    grid: &'a Grid,
    /// What rounding to 32 bits may add for each edge, in units of 2⁻²⁴ turns.
    rounding: f64,
    rounding_spent: f64,
    unit: f64,
    coarse: Product<f32>,
    fine: Product<f64>,
    polygons: Polygons,
}

/// Whether products of 32-bit floats pay for their code.
const SINGLES: bool = cfg!(not(target_arch = "wasm32"));
/// 1/ε for 32-bit floats.
const ROUNDINGS_PER_TURN: f64 = (1 << 24) as f64;
/// How far the farthest point of all loops may be, in units of the distance to the nearest point of any, for products of
/// 32-bit floats to be numbers.
const FARTHEST: f64 = 1000.0;

impl<'a> Sums<'a> {
    /// Of some of the `loops` at the queries of a grid; `rounding` is what 32-bit floats may add for each edge, in turns, and
    /// `unit` a power of two that brings lengths to about 1.
    pub fn new(loops: &'a [Loop], grid: &'a Grid, unit: f64, rounding: f64) -> Sums<'a> {
        let counts: [usize; 3] = std::array::from_fn(|axis| grid[axis].len());
        let rounding = rounding * ROUNDINGS_PER_TURN;
        let polygons = Polygons::default();
        Sums {
            loops,
            grid,
            rounding,
            rounding_spent: 0.0,
            unit,
            coarse: Product::of(counts),
            fine: Product::of(counts),
            polygons,
        }
    }

    /// Adds what is seen of loops that lie in a direction, the sign of an axis, from a region of the grid. Turns are counted
    /// only if they `may_turn`: the sum of all so far may be half a turn or more.
    pub fn add(&mut self, region: &Region, loops: &[u32], direction: (usize, f64), may_turn: bool) {
        let block = box_of(self.grid, region);
        let all = loops.iter().fold(block, |all, l| all.union(self.loops[*l as usize].bounds));
        let farthest = all.size().length();
        let mut spent = 0.0;
        let is_coarse = |l: &&u32| {
            let one = &self.loops[**l as usize];
            let gap = gap(&block, &one.bounds, direction);
            let of_edge = rounding(block.union(one.bounds).size().length() / gap);
            let is_coarse = SINGLES && of_edge <= self.rounding && farthest <= FARTHEST * gap;
            spent += if is_coarse { of_edge * one.points.len() as f64 } else { 0.0 };
            is_coarse
        };
        let (coarse, fine): (Vec<u32>, Vec<u32>) = loops.iter().partition(is_coarse);
        self.rounding_spent += spent;
        let side =
            Side { grid: self.grid, region, direction, center: block.center(), unit: self.unit, may_turn };
        if SINGLES && !coarse.is_empty() {
            self.polygons.set(self.loops, &coarse);
            // Exact as a power of two, and so that products of 32-bit floats stay numbers.
            let unit = power_of_two_near(1.0 / farthest);
            self.coarse.multiply(&self.polygons, &Side { unit, ..side });
        }
        if !fine.is_empty() {
            self.polygons.set(self.loops, &fine);
            self.fine.multiply(&self.polygons, &side);
        }
    }

    /// A bound of what 32-bit floats have added anywhere, in turns.
    pub fn rounding_spent(&self) -> f64 {
        self.rounding_spent / ROUNDINGS_PER_TURN
    }

    /// Adds what is seen of single caps, those with these numbers of all, from a region amid them; where that is in doubt it is
    /// left out, and listed.
    pub fn add_caps(
        &mut self,
        region: &Region,
        caps: &[[Vec3; 3]],
        numbers: impl Iterator<Item = usize>,
        doubts: &mut Vec<Doubt>,
    ) {
        let caps = numbers.map(|number| (number, caps[number]));
        super::caps::multiply(&mut self.fine, self.grid, region, caps, self.unit, doubts);
    }

    /// Adds the sums to values, in turns.
    pub fn add_to(&self, values: &mut [f64]) {
        if SINGLES {
            self.coarse.add_to(values);
        }
        self.fine.add_to(values);
    }
}

/// A bound of what 32-bit floats add to an edge's angle, in units of ε = 2⁻²⁴ turns, where all distances are up to `x` times
/// the gap g between queries and loop along u.
///
/// With lengths up to D = x g, positions about the middle of the block are known to ε D, so a·u to 3 ε D, s_a = |a| + a·u to
/// 3 ε x + 5 ε of itself and ζ̄_a ζ_b to 4 ε |ζ_a||ζ_b| in each part. With ρ = |ζ_a||ζ_b| / s_a s_b ≤ (D − g)/(D + g) the argument
/// turns by up to ρ/(1 − ρ²) ≤ x/4 for each relative change of s, and by 1/(1 − ρ) ≤ x/2 for each of ζ̄_a ζ_b. The sum of all
/// that is ε (1.5 x² + 6 x + 1), and a product of complex numbers turns by up to 3 ε more.
fn rounding(x: f64) -> f64 {
    (0.25 * x + 1.0) * x + 1.0
}

fn power_of_two_near(x: f64) -> f64 {
    libm::exp2(libm::floor(libm::log2(x)))
}

/// The gap between a block and a box in a direction from the block.
fn gap(block: &Aabb, bounds: &Aabb, (axis, sign): (usize, f64)) -> f64 {
    if sign > 0.0 { bounds.min[axis] - block.max[axis] } else { block.min[axis] - bounds.max[axis] }
}
