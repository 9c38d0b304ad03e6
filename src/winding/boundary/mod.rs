//! The field of a closure's caps on a lattice, to a proven tolerance or to rounding.
//!
//! Away from its loops the field is smooth: over a block of samples it is summed at a few Chebyshev nodes and interpolated,
//! with a bound of the error from the loop's area and distance; what is too near for that is passed on to the parts of the
//! block, at last summed at the samples themselves. So most of a lattice costs some multiplications for each sample.
mod caps;
mod curtains;
mod direct;
mod interpolant;
mod loops;
mod need;
mod plan;
mod product;
mod rows;

use crate::data::Lattice;
use crate::math::{Aabb, Floats, Nodes, Vec3, lebesgue};
use curtains::{Grid, Region, Sums, all, box_of};
use direct::{Direct, by_direction, each_part, within_half_a_turn};
use interpolant::Interpolant;
use loops::{Loop, loops};
use need::Allowance;
pub use need::Need;
use plan::{Plan, Separated};
use wide::f64x4;

/// Axes with up to this many samples are not divided.
const FEW: usize = 4;
/// What one size of block may take of the bound of the error that is left.
const SHARE: f64 = 0.6;

/// The loops of a closure.
#[derive(Clone, Debug, Default)]
pub struct BoundaryField {
    loops: Vec<Loop>,
    /// A power of two that brings lengths to about 1.
    unit: f64,
}

impl BoundaryField {
    pub fn new(cycles: &[Vec<Vec3>], caps: &[[Vec3; 3]]) -> BoundaryField {
        let loops = loops(cycles, caps);
        let size = loops.iter().map(|l| l.bounds).fold(Aabb::EMPTY, Aabb::union).size().max_element();
        let unit = f64x4::splat(size).reciprocal_power_of_two().to_array()[0];
        BoundaryField { loops, unit }
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.loops.iter().map(|l| size_of::<Loop>() + size_of_val(&l.points[..])).sum()
    }

    /// The winding number of `caps`, those that this was made of, at the samples low ≤ i < high of a lattice, x fastest.
    pub fn block(
        &self,
        caps: &[[Vec3; 3]],
        lattice: &Lattice,
        [low, high]: [[usize; 3]; 2],
        need: Need,
    ) -> Vec<f64> {
        let sample = |axis: usize, i: usize| lattice.point([i; 3])[axis];
        let grid: Grid =
            std::array::from_fn(|axis| (low[axis]..high[axis]).map(|i| sample(axis, i)).collect());
        let counts: [usize; 3] = std::array::from_fn(|axis| grid[axis].len());
        let mut block =
            Block { field: self, caps, values: vec![0.0; counts.iter().product()], need, grid, counts };
        let counts = |l: &u32| !self.loops[*l as usize].is_flat;
        let loops: Vec<u32> = (0..self.loops.len() as u32).filter(counts).collect();
        block.divide(all(&block.grid), &loops, None, need.allowance());
        block.values
    }
}

struct Block<'a> {
    field: &'a BoundaryField,
    caps: &'a [[Vec3; 3]],
    grid: Grid,
    counts: [usize; 3],
    values: Vec<f64>,
    need: Need,
}

impl Block<'_> {
    /// Adds the field of `loops` and of the interpolant of what has been summed already to a region.
    fn divide(&mut self, region: Region, loops: &[u32], from: Option<&Interpolant>, allowed: Allowance) {
        let grid: Grid = std::array::from_fn(|axis| self.grid[axis][region[axis].clone()].to_vec());
        let counts: [usize; 3] = std::array::from_fn(|axis| grid[axis].len());
        let bounds = box_of(&self.grid, &region);
        let largest = |l: &u32| {
            let one = &self.field.loops[*l as usize];
            curtains::largest(one.area, &one.bounds, &bounds)
        };
        let spread: f64 = loops.iter().map(largest).sum();
        if self.need.may_be_met(spread) {
            let values = from.map_or_else(|| vec![0.0], |f| f.at(&grid));
            if self.need.is_met(&values, spread) {
                if from.is_some() {
                    self.add(&region, &values);
                }
                return;
            }
        }
        let least = from.map_or([0; 3], |f| [0, 1, 2].map(|axis| f.nodes[axis].count()));
        let Some(plan) = self.field.plan(loops, counts, least, &bounds, SHARE * allowed.interpolation) else {
            self.add_interpolant(&region, &grid, from);
            self.add_directly(&region, &grid, loops, allowed.rounding);
            return;
        };
        let mut rest = allowed;
        let own = self.interpolant(&grid, &plan, from, &mut rest.rounding);
        let from = own.as_ref().or(from);
        let Separated { near, spent, .. } = &plan.loops;
        rest.interpolation -= spent;
        if near.is_empty() {
            self.add_interpolant(&region, &grid, from);
        } else {
            each_part(&region, FEW, |part| self.divide(part, near, from, rest));
        }
    }

    /// The sum of an interpolant and of the loops that are far, at the nodes of a plan; none if there are no such loops.
    fn interpolant(
        &self,
        grid: &Grid,
        plan: &Plan,
        from: Option<&Interpolant>,
        rounding: &mut f64,
    ) -> Option<Interpolant> {
        if plan.loops.far.is_empty() {
            return None;
        }
        let nodes: [Nodes; 3] = std::array::from_fn(|axis| {
            let (first, last) = (grid[axis][0], grid[axis][grid[axis].len() - 1]);
            match plan.nodes[axis] {
                Some(count) => Nodes::chebyshev(0.5 * (first + last), 0.5 * (last - first), count),
                None => Nodes::exact(&grid[axis]),
            }
        });
        let points: Grid = std::array::from_fn(|axis| nodes[axis].points.clone());
        let len = points.iter().map(Vec::len).product();
        let mut values = from.map_or_else(|| vec![0.0; len], |f| f.at(&points));
        let region = all(&points);
        let bounds = box_of(grid, &all(grid));
        // Interpolation may enlarge errors at the nodes.
        let growth: f64 = plan.nodes.iter().flatten().map(|count| lebesgue(*count)).product();
        let mut sums = self.sums(&points, &plan.loops.far, SHARE * *rounding / growth);
        let (few, rest) = within_half_a_turn(&self.field.loops, &bounds, &plan.loops.far);
        for (some, may_turn) in [(few, false), (rest, true)] {
            for (direction, some) in by_direction(&self.field.loops, &bounds, &some).0 {
                sums.add(&region, &some, direction, may_turn);
            }
        }
        *rounding -= growth * sums.rounding_spent();
        sums.add_to(&mut values);
        Some(Interpolant { nodes, values })
    }

    /// Of `some` loops, rounded to 32 bits where that adds no more than `rounding` in all.
    fn sums<'b>(&'b self, grid: &'b Grid, some: &[u32], rounding: f64) -> Sums<'b> {
        let edges: usize = some.iter().map(|l| self.field.loops[*l as usize].points.len()).sum();
        Sums::new(&self.field.loops, grid, self.field.unit, rounding / edges as f64)
    }

    fn add_interpolant(&mut self, region: &Region, grid: &Grid, interpolant: Option<&Interpolant>) {
        if let Some(interpolant) = interpolant {
            self.add(region, &interpolant.at(grid));
        }
    }

    /// Adds values to those of a region.
    fn add(&mut self, region: &Region, values: &[f64]) {
        let rows = region[2].clone().flat_map(|k| region[1].clone().map(move |j| (j, k)));
        for ((j, k), row) in rows.zip(values.chunks_exact(region[0].len())) {
            let first = (k * self.counts[1] + j) * self.counts[0] + region[0].start;
            self.values[first..first + row.len()].iter_mut().zip(row).for_each(|(value, add)| *value += add);
        }
    }

    fn add_directly(&mut self, region: &Region, grid: &Grid, loops: &[u32], rounding: f64) {
        if loops.is_empty() {
            return;
        }
        let values = Direct::new(self.field, self.caps, grid, self.sums(grid, loops, rounding)).sum(loops);
        self.add(region, &values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::solid_angle;
    use std::f64::consts::{PI, TAU};

    /// A closed polygon that waves around a circle, capped by halves.
    fn wavy(count: usize, center: Vec3, radius: f64) -> (Vec<Vec<Vec3>>, Vec<[Vec3; 3]>) {
        let at = |k: usize| {
            let angle = TAU * k as f64 / count as f64;
            center + radius * Vec3::new(angle.cos(), angle.sin(), 0.2 * (5.0 * angle).sin())
        };
        let cycle: Vec<Vec3> = (0..count).map(at).collect();
        let mut caps = Vec::new();
        crate::winding::closure::cap(&cycle, 0, count - 1, &mut caps);
        (vec![cycle], caps)
    }

    fn direct(caps: &[[Vec3; 3]], q: Vec3) -> f64 {
        caps.iter().map(|cap| solid_angle(q, *cap)).sum::<f64>() / (4.0 * PI)
    }

    fn check(cycles: &[Vec<Vec3>], caps: &[[Vec3; 3]], lattice: &Lattice, tolerance: f64) {
        let field = BoundaryField::new(cycles, caps);
        let all = [[0; 3], lattice.counts];
        let values = field.block(caps, lattice, all, Need::Value { tolerance });
        assert_eq!(values.len(), lattice.len());
        let mut worst: f64 = 0.0;
        for (index, value) in values.iter().enumerate() {
            let q = lattice.point(lattice.sample(index));
            worst = worst.max((value - direct(caps, q)).abs());
        }
        let expected = tolerance.max(1e-12);
        assert!(worst <= expected, "{worst} for {tolerance}, {} loops", field.loops.len());
        let sides = field.block(caps, lattice, all, Need::Side { threshold: 0.5, error: 0.02 });
        for (index, side) in sides.iter().enumerate() {
            let w = direct(caps, lattice.point(lattice.sample(index)));
            let least = |fraction: f64| (0.5 - fraction).ceil();
            let is_decided = least(side - 0.02) == least(side + 0.02);
            assert!(
                if is_decided { least(w) == least(*side) } else { (w - side).abs() < 0.02 },
                "{w} {side}"
            );
        }
    }

    #[test]
    fn tolerances_are_kept_near_and_far() {
        for (count, center, radius) in [
            (7, Vec3::ZERO, 0.4),
            (90, Vec3::ZERO, 0.7),
            (40, Vec3::splat(1.3), 0.1),
            (500, Vec3::splat(0.3), 0.7),
            (30, Vec3::ZERO, 0.1),
            (60, Vec3::X, 0.2),
        ] {
            let (cycles, caps) = wavy(count, center, radius);
            let lattice = Lattice {
                origin: Vec3::splat(-1.0),
                spacing: Vec3::new(0.061, 0.083, 0.1),
                counts: [32, 24, 20],
            };
            for tolerance in [0.0, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
                check(&cycles, &caps, &lattice, tolerance);
            }
        }
    }

    #[test]
    fn samples_in_the_plane_of_the_caps_and_flat_lattices_are_right() {
        // A square rim of 64 edges in a plane of the lattice, its vertices and chords on rows. On the caps themselves the
        // field takes the side of q', where the oracle has the principal value: these samples are left out.
        let corner = |k: usize| [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)][k % 4];
        let rim: Vec<Vec3> = (0..64)
            .map(|k| {
                let ((y0, z0), (y1, z1), t) = (corner(k / 16), corner(k / 16 + 1), (k % 16) as f64 / 16.0);
                Vec3::new(0.25, y0 + t * (y1 - y0), z0 + t * (z1 - z0))
            })
            .collect();
        let mut caps = Vec::new();
        crate::winding::closure::cap(&rim, 0, 63, &mut caps);
        let field = BoundaryField::new(&[rim], &caps);
        for counts in [[9, 25, 25], [1, 25, 25], [9, 1, 25], [9, 25, 1]] {
            let spacing = Vec3::from_array(counts.map(|c| if c == 1 { 0.0 } else { 0.0625 }));
            let lattice = Lattice { origin: Vec3::new(0.0, -0.25, -0.25), spacing, counts };
            for tolerance in [0.0, 1e-4] {
                let values = field.block(&caps, &lattice, [[0; 3], counts], Need::Value { tolerance });
                for (index, value) in values.iter().enumerate() {
                    let q = lattice.point(lattice.sample(index));
                    let is_on = q.x == 0.25 && (0.0..=1.0).contains(&q.y) && (0.0..=1.0).contains(&q.z);
                    let error = (value - direct(&caps, q)).abs();
                    assert!(is_on || error < tolerance.max(1e-12), "{q}: {value}, off by {error}");
                    let is_inner = is_on && q.y > 0.0 && q.y < 1.0 && q.z > 0.0 && q.z < 1.0;
                    assert!(!is_inner || (value.abs() - 0.5).abs() < 0.5);
                }
            }
        }
    }

    #[test]
    fn lengths_of_any_size_are_possible() {
        for scale in [1e-30, 1e12, 1e30] {
            let (cycles, caps) = wavy(50, Vec3::splat(0.1) * scale, 0.5 * scale);
            let spacing = Vec3::splat(0.2 * scale);
            // No sample lies on a cap: there the oracle has the principal value.
            let lattice = Lattice { origin: Vec3::splat(-0.87 * scale), spacing, counts: [10, 10, 10] };
            check(&cycles, &caps, &lattice, 0.0);
        }
    }
}
