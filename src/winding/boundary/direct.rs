//! Loops summed at the samples of a block themselves: from beside where a part of the block is apart from the loop, cap by
//! cap where it is not.
use super::BoundaryField;
use super::caps::Doubt;
use super::curtains::{Grid, Region, Sums, all, away, box_of, largest};
use super::loops::Loop;
use crate::math::{Aabb, Vec3};
use crate::winding::closure::crossings_of_caps;
use crate::winding::curtain::{LANES, fractions_of};
use std::ops::Range;

/// Axes with up to this many samples are not divided in the box of a loop.
const FEW_INSIDE: usize = 4;
/// Loops of up to this many caps are summed by their caps all through a block amid them.
const FEW_CAPS: usize = 4;

/// Loops summed at the samples of a grid.
pub struct Direct<'a> {
    field: &'a BoundaryField,
    /// All of the closure's.
    caps: &'a [[Vec3; 3]],
    grid: &'a Grid,
    sums: Sums<'a>,
    /// What is not in the sums.
    values: Vec<f64>,
    doubts: Vec<Doubt>,
}

impl<'a> Direct<'a> {
    pub fn new(
        field: &'a BoundaryField,
        caps: &'a [[Vec3; 3]],
        grid: &'a Grid,
        sums: Sums<'a>,
    ) -> Direct<'a> {
        let values = vec![0.0; grid.iter().map(Vec::len).product()];
        Direct { field, caps, grid, sums, values, doubts: Vec::new() }
    }

    /// The field of loops at the samples, x fastest.
    pub fn sum(mut self, loops: &[u32]) -> Vec<f64> {
        let everywhere = all(self.grid);
        let bounds = box_of(self.grid, &everywhere);
        let (few, rest) = within_half_a_turn(&self.field.loops, &bounds, loops);
        let (apart, others) = by_direction(&self.field.loops, &bounds, &few);
        for (direction, loops) in apart {
            self.sums.add(&everywhere, &loops, direction, false);
        }
        let mut rest = [rest, others].concat();
        rest.sort_unstable();
        self.add(&everywhere, &rest);
        self.add_doubts();
        self.sums.add_to(&mut self.values);
        self.values
    }

    /// Adds the field of loops at the samples of a region: to the sums where they are apart, else to the values.
    fn add(&mut self, region: &Region, loops: &[u32]) {
        let (apart, others) = by_direction(&self.field.loops, &box_of(self.grid, region), loops);
        for (direction, loops) in apart {
            self.sums.add(region, &loops, direction, true);
        }
        let (few, many) = others.iter().partition(|l| self.field.loops[**l as usize].caps.len() <= FEW_CAPS);
        let (mut few, many): (Vec<u32>, Vec<u32>) = (few, many);
        if region.iter().any(|range| range.len() > FEW_INSIDE) {
            if !many.is_empty() {
                each_part(region, FEW_INSIDE, |part| self.add(&part, &many));
            }
        } else {
            few.extend(many);
        }
        let numbers = few.iter().flat_map(|l| self.field.loops[*l as usize].caps.clone());
        self.sums.add_caps(region, self.caps, numbers, &mut self.doubts);
    }

    /// Adds what was in doubt, which is little: cap and crossings are decided together, by exact predicates.
    fn add_doubts(&mut self) {
        for Doubt { sample: [i, j, k], cap } in &self.doubts {
            let cap = self.caps[*cap];
            let q = Vec3::new(self.grid[0][*i], self.grid[1][*j], self.grid[2][*k]);
            let [fraction, ..] = fractions_of(&cap, &[q; LANES]);
            let place = (k * self.grid[1].len() + j) * self.grid[0].len() + i;
            self.values[place] += fraction - f64::from(crossings_of_caps(&[cap], q));
        }
    }
}

/// Those of some loops whose winding numbers add up to less than a half all through a block; and the others.
pub fn within_half_a_turn(loops: &[Loop], block: &Aabb, some: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut turns = 0.0;
    some.iter().partition(|l| {
        let one = &loops[**l as usize];
        let most = largest(one.area, &one.bounds, block);
        let fits = turns + most < 0.49;
        turns += if fits { most } else { 0.0 };
        fits
    })
}

pub type ByDirection = Vec<((usize, f64), Vec<u32>)>;

/// Those of some loops that are apart from a block, by the direction in which they lie; and the others.
pub fn by_direction(loops: &[Loop], block: &Aabb, some: &[u32]) -> (ByDirection, Vec<u32>) {
    let (mut apart, mut others): (ByDirection, _) = (Vec::new(), Vec::new());
    for &l in some {
        match away(block, &loops[l as usize].bounds) {
            None => others.push(l),
            Some(direction) => match apart.iter_mut().find(|(d, _)| *d == direction) {
                Some((_, loops)) => loops.push(l),
                None => apart.push((direction, vec![l])),
            },
        }
    }
    (apart, others)
}

/// Calls `each` for the parts of a region, halved along each axis of many samples.
pub fn each_part(region: &Region, few: usize, mut each: impl FnMut(Region)) {
    let halves = |axis: usize| {
        let Range { start, end } = region[axis].clone();
        // Whole vector registers in the first half.
        let half =
            if end - start > 2 * few { ((end - start) / 2).next_multiple_of(4) } else { (end - start) / 2 };
        let middle = if end - start > few { start + half } else { start };
        [start..middle, middle..end]
    };
    let [x, y, z] = [0, 1, 2].map(halves);
    for part in 0..8 {
        let part = [x[part & 1].clone(), y[part >> 1 & 1].clone(), z[part >> 2].clone()];
        if part.iter().all(|range| !range.is_empty()) {
            each(part);
        }
    }
}
