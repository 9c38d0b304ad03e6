//! Queries in a tree of blocks: of a lattice, or of points in the order of the Morton curve.
use crate::bvh::{cut_at_highest_bit, morton_code, sorted_codes};
use crate::data::{BLOCK, Lattice, map_items};
use crate::math::{Aabb, Vec3};
use std::ops::Range;

/// Most samples in a block whose walk is one task.
const TASK: usize = 4096;

/// A block of queries: of samples of a lattice, the first and the one after the last along each axis, in units of blocks; of
/// sorted points, the range of their places in x.
pub type Cells = [Range<usize>; 3];

/// Queries that come as a tree of blocks, down to [`BLOCK`] queries that lie close together.
pub trait Targets: Sync {
    /// The block of all queries; none if there are none.
    fn whole(&self) -> Option<Cells>;
    fn len(&self, block: &Cells) -> usize;
    /// The smallest box around the queries of a block.
    fn bounds(&self, block: &Cells) -> Aabb;
    /// Calls `child` for each part of a block of more than [`BLOCK`] queries.
    fn split(&self, block: &Cells, child: &mut dyn FnMut(Cells));
    /// Calls `sample(index, position)` for each query of a block, neighbours after each other.
    fn for_each(&self, block: &Cells, sample: &mut dyn FnMut(usize, Vec3));
    /// Appends indices and positions of the queries of a block.
    fn gather(&self, block: &Cells, indices: &mut Vec<usize>, points: &mut Vec<Vec3>) {
        self.for_each(block, &mut |index, position| {
            indices.push(index);
            points.push(position);
        });
    }
    /// Indices of queries that are not finite, and in no block.
    fn outcasts(&self) -> &[u32];

    /// Blocks that are walked each from the top: one task each.
    fn tasks(&self) -> Vec<Cells> {
        let mut tasks = Vec::new();
        let mut stack: Vec<_> = self.whole().into_iter().collect();
        while let Some(block) = stack.pop() {
            if self.len(&block) <= TASK {
                tasks.push(block);
            } else {
                let first = stack.len();
                self.split(&block, &mut |child| stack.push(child));
                stack[first..].reverse();
            }
        }
        tasks
    }
}

/// The samples of a lattice, all of its coordinates finite.
pub struct LatticeTargets {
    lattice: Lattice,
    /// Samples along the axes of a block of [`BLOCK`].
    unit: [usize; 3],
    /// The samples of such a block in Morton order.
    order: [[u8; 3]; BLOCK],
    planes: Range<usize>,
}

impl LatticeTargets {
    pub fn new(lattice: &Lattice) -> LatticeTargets {
        LatticeTargets::of_planes(lattice, 0..lattice.counts[2])
    }

    /// The samples of some planes: from a multiple of four to another, or to the last plane.
    pub fn of_planes(lattice: &Lattice, planes: Range<usize>) -> LatticeTargets {
        let unit = if lattice.counts[2] == 1 { [8, 8, 1] } else { [4; 3] };
        LatticeTargets { lattice: *lattice, unit, order: order_within(unit), planes }
    }

    /// The samples of a block.
    fn samples(&self, block: &Cells) -> [Range<usize>; 3] {
        [0, 1, 2].map(|axis| {
            let end = (block[axis].end * self.unit[axis]).min(self.lattice.counts[axis]);
            block[axis].start * self.unit[axis]..end
        })
    }

    /// Calls `sample` for the samples of a block of up to [`BLOCK`].
    fn each_of_unit(&self, [xs, ys, zs]: [Range<usize>; 3], mut sample: impl FnMut(usize, Vec3)) {
        let first = self.lattice.index([xs.start, ys.start, zs.start]);
        let [along_y, along_z] = [self.lattice.counts[0], self.lattice.counts[0] * self.lattice.counts[1]];
        for place in self.order {
            let [i, j, k] = place.map(usize::from);
            let s = [xs.start + i, ys.start + j, zs.start + k];
            if s[0] < xs.end && s[1] < ys.end && s[2] < zs.end {
                sample(first + i + j * along_y + k * along_z, self.lattice.point(s));
            }
        }
    }
}

impl Targets for LatticeTargets {
    fn whole(&self) -> Option<Cells> {
        let cells =
            |axis: usize, start: usize, end: usize| start / self.unit[axis]..end.div_ceil(self.unit[axis]);
        let [x, y, _] = self.lattice.counts;
        let cells = [cells(0, 0, x), cells(1, 0, y), cells(2, self.planes.start, self.planes.end)];
        (!self.lattice.is_empty()).then_some(cells)
    }

    fn len(&self, block: &Cells) -> usize {
        self.samples(block).iter().map(|r| r.len()).product()
    }

    fn bounds(&self, block: &Cells) -> Aabb {
        let samples = self.samples(block);
        let first = self.lattice.point([0, 1, 2].map(|axis| samples[axis].start));
        let last = self.lattice.point([0, 1, 2].map(|axis| samples[axis].end - 1));
        Aabb { min: first.min(last), max: first.max(last) }
    }

    /// Halves the axes that are not much shorter than the longest.
    fn split(&self, block: &Cells, child: &mut dyn FnMut(Cells)) {
        let size = [0, 1, 2]
            .map(|axis| (block[axis].len() * self.unit[axis]) as f64 * self.lattice.spacing[axis].abs());
        let divisible = |axis: usize| block[axis].len() > 1;
        let longest = (0..3).filter(|a| divisible(*a)).map(|a| size[a]).fold(0.0, f64::max);
        let parts = [0, 1, 2].map(|axis| {
            let Range { start, end } = block[axis];
            let is_short = size[axis] < 0.6 * longest;
            let cut = divisible(axis) && !is_short;
            let middle = if cut { start + (end - start).div_ceil(2) } else { end };
            [start..middle, middle..end]
        });
        for corner in 0..8 {
            let cells = [0, 1, 2].map(|axis| parts[axis][corner >> axis & 1].clone());
            if cells.iter().all(|r| !r.is_empty()) {
                child(cells);
            }
        }
    }

    fn for_each(&self, block: &Cells, sample: &mut dyn FnMut(usize, Vec3)) {
        let [xs, ys, zs] = self.samples(block);
        if block.iter().all(|r| r.len() == 1) {
            return self.each_of_unit([xs, ys, zs], sample);
        }
        for k in zs {
            for j in ys.clone() {
                xs.clone().for_each(|i| sample(self.lattice.index([i, j, k]), self.lattice.point([i, j, k])));
            }
        }
    }

    fn gather(&self, block: &Cells, indices: &mut Vec<usize>, points: &mut Vec<Vec3>) {
        let mut take = |index: usize, position: Vec3| {
            indices.push(index);
            points.push(position);
        };
        if block.iter().all(|r| r.len() == 1) {
            return self.each_of_unit(self.samples(block), take);
        }
        self.for_each(block, &mut take);
    }

    fn outcasts(&self) -> &[u32] {
        &[]
    }
}

/// Places within a block in Morton order, so that the first four and eight lie close together too.
fn order_within(unit: [usize; 3]) -> [[u8; 3]; BLOCK] {
    let flat = unit[2] == 1;
    let step = if flat { 2 } else { 3 };
    let bit = |place: usize, axis: usize| {
        (0..3).fold(0, |c, level| c | (place >> (step * level + axis) & 1) << level) as u8
    };
    std::array::from_fn(|p| [bit(p, 0), bit(p, 1), if flat { 0 } else { bit(p, 2) }])
}

/// Points anywhere, sorted along the Morton curve: 12 bytes for each.
pub struct PointTargets<'a> {
    points: &'a [Vec3],
    order: Vec<u32>,
    codes: Vec<u64>,
    outcasts: Vec<u32>,
}

impl<'a> PointTargets<'a> {
    pub fn new(points: &'a [Vec3]) -> PointTargets<'a> {
        let (finite, outcasts): (Vec<u32>, Vec<u32>) =
            (0..points.len() as u32).partition(|i| points[*i as usize].is_finite());
        let bounds = Aabb::around(finite.iter().map(|&i| points[i as usize]));
        let codes = map_items(finite.len(), |k| morton_code(points[finite[k] as usize], &bounds));
        let (codes, places) = sorted_codes(codes);
        let order = places.into_iter().map(|place| finite[place as usize]).collect();
        PointTargets { points, order, codes, outcasts }
    }
}

impl Targets for PointTargets<'_> {
    fn whole(&self) -> Option<Cells> {
        (!self.order.is_empty()).then_some([0..self.order.len(), 0..1, 0..1])
    }

    fn len(&self, [places, ..]: &Cells) -> usize {
        places.len()
    }

    fn bounds(&self, [places, ..]: &Cells) -> Aabb {
        Aabb::around(self.order[places.clone()].iter().map(|&i| self.points[i as usize]))
    }

    /// Cuts where the codes change, in up to eight, as long as they are too long for a block.
    fn split(&self, [places, ..]: &Cells, child: &mut dyn FnMut(Cells)) {
        let mut parts = vec![places.clone()];
        for _ in 0..3 {
            let cut = |part: Range<usize>| {
                if part.len() <= BLOCK {
                    return [part, 0..0];
                }
                let middle = cut_at_highest_bit(&self.codes, &part);
                [part.start..middle, middle..part.end]
            };
            parts = parts.into_iter().flat_map(cut).filter(|p| !p.is_empty()).collect();
        }
        parts.into_iter().for_each(|part| child([part, 0..1, 0..1]));
    }

    fn for_each(&self, [places, ..]: &Cells, sample: &mut dyn FnMut(usize, Vec3)) {
        for &i in &self.order[places.clone()] {
            sample(i as usize, self.points[i as usize]);
        }
    }

    fn outcasts(&self) -> &[u32] {
        &self.outcasts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(targets: &dyn Targets, count: usize) {
        let mut seen = vec![0; count];
        let mut stack = targets.tasks();
        assert!(stack.iter().all(|t| targets.len(t) <= TASK));
        while let Some(block) = stack.pop() {
            let bounds = targets.bounds(&block);
            let mut inside = 0;
            targets.for_each(&block, &mut |_, p| inside += usize::from(bounds.contains(p)));
            assert_eq!(inside, targets.len(&block));
            if inside <= BLOCK {
                targets.for_each(&block, &mut |i, _| seen[i] += 1);
            } else {
                targets.split(&block, &mut |child| stack.push(child));
            }
        }
        targets.outcasts().iter().for_each(|&i| seen[i as usize] += 1);
        assert!(seen.iter().all(|s| *s == 1));
    }

    #[test]
    fn every_sample_of_a_lattice_is_in_one_block() {
        for counts in [[9, 5, 7], [17, 20, 1], [1, 1, 1], [3, 1, 40], [0, 3, 3], [40, 33, 35], [1, 300, 1]] {
            let lattice = Lattice { origin: Vec3::ZERO, spacing: Vec3::new(1.0, 0.1, 3.0), counts };
            check(&LatticeTargets::new(&lattice), lattice.len());
        }
    }

    #[test]
    fn every_point_is_in_one_block_or_cast_out() {
        let mut points: Vec<Vec3> = (0..5000).map(|i| Vec3::new(f64::from(i * i % 97), 0.5, 1.0)).collect();
        check(&PointTargets::new(&points), 5000);
        points[17].x = f64::NAN;
        points[4].y = f64::INFINITY;
        check(&PointTargets::new(&points), 5000);
        assert_eq!(PointTargets::new(&points).outcasts(), [4, 17]);
        check(&PointTargets::new(&[Vec3::NAN]), 1);
        check(&PointTargets::new(&[]), 0);
    }
}
