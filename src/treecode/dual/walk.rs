//! The walk down the blocks of queries, each with the clusters that its parents left to it.
use super::bounds::{self, ROUND_UP, ROUNDING_OF_MULTIPOLE, ROUNDING_OF_SUMS};
use super::clusters::Clusters;
use super::far::FarFields;
use super::local::Local;
use super::multipole::Multipole;
use super::place::{Block, Place};
use super::reach::{BlockReach, CLASSES, LONGEST, Reach};
use super::sources::NearLeaf;
use super::targets::Cells;
use super::tree::Decided;
use super::{BlockView, DualAccuracy, GROUPS, Sources, Targets, WIDTH};
use crate::data::BLOCK;
use crate::math::Vec3;
use wide::f32x4;

/// Least distance for a multipole series, in radii of the block: nearer, 32-bit positions relative to the block's centre would
/// give it a wrong direction.
const NEAREST_MULTIPOLE: f32 = 1.0 / 16.0;

/// What does not change during walks.
pub struct Walk<'a> {
    pub clusters: &'a Clusters,
    pub reaches: Vec<Reach>,
    pub sources: &'a dyn Sources,
    pub targets: &'a dyn Targets,
    pub accuracy: DualAccuracy,
    /// Whether a block needs no values, as the field there is known to be between two numbers.
    pub decided: Option<Decided<'a>>,
}

/// What is known of a block: its values follow each other in [`Findings::values`].
pub enum Finding {
    Values { bound: f64 },
    Within { low: f64, high: f64 },
}

/// What one task found.
pub struct Findings {
    pub blocks: Vec<(Cells, Finding)>,
    pub values: Vec<f64>,
}

/// Space for walks, used again and again.
#[derive(Default)]
pub struct Space {
    far_fields: FarFields,
    /// Clusters left to the blocks below, as a stack of lists.
    pending: Vec<u32>,
    work: Vec<u32>,
    /// Clusters far from the block, by their class.
    far: [Vec<u32>; CLASSES],
    /// Clusters and the groups of queries that they still have to act on.
    near: Vec<(u32, u32)>,
    leaves: Vec<NearLeaf>,
    points: Vec<Vec3>,
    block: Block,
}

/// What a block inherits.
#[derive(Clone, Copy)]
struct Inherited {
    place: Place,
    local: Local,
    /// A bound of the error of the polynomial.
    error: f64,
}

impl Walk<'_> {
    /// Walks everything below a block, from the top of the tree of sources.
    pub fn run(&self, block: &Cells, space: &mut Space) -> Findings {
        let mut findings = Findings { blocks: Vec::new(), values: Vec::new() };
        space.pending.clear();
        space.pending.extend(self.clusters.roots.clone().map(|c| c as u32));
        let place = Place::new(&self.targets.bounds(block), &self.clusters.frame);
        let inherited = Inherited { place, local: Local::ZERO, error: 0.0 };
        self.descend(block, &inherited, 0, space, &mut findings);
        findings
    }

    /// Treats one block, whose parent's clusters are `space.pending[from..]`.
    fn descend(
        &self,
        block: &Cells,
        inherited: &Inherited,
        from: usize,
        space: &mut Space,
        findings: &mut Findings,
    ) {
        let bounds = self.targets.bounds(block);
        let place = Place::new(&bounds, &self.clusters.frame);
        let mut own = inherited.moved_to(place, self.accuracy.degree);
        let mark = space.pending.len();
        let touches = self.sift(&place, from, space);
        let is_leaf = self.targets.len(block) <= BLOCK;
        if !(is_leaf && touches) {
            self.add_far(&mut own, space);
        }
        if let Some(decided) = self.decided.filter(|_| !touches) {
            let (low, high) = self.range(&own, &space.pending[mark..]);
            if decided(&BlockView { targets: self.targets, block }, low, high) {
                findings.blocks.push((block.clone(), Finding::Within { low, high }));
                space.pending.truncate(mark);
                return;
            }
        }
        if is_leaf {
            space.points.clear();
            self.targets.for_each(block, &mut |_, p| space.points.push(p));
            space.block.set(&space.points, &bounds, &place, &self.clusters.frame);
            let bound = self.values(&mut own, mark, space, &mut findings.values);
            findings.blocks.push((block.clone(), Finding::Values { bound }));
        } else {
            self.targets.split(block, &mut |child| self.descend(&child, &own, mark, space, findings));
        }
        space.pending.truncate(mark);
    }

    /// Sorts the clusters `space.pending[from..]` into those far from the block (`space.far`) and those left to the blocks
    /// below (appended to `space.pending`), opening the large ones. Answers whether one of the latter touches the block.
    fn sift(&self, place: &Place, from: usize, space: &mut Space) -> bool {
        let Space { pending, work, far, .. } = space;
        work.clear();
        work.extend_from_slice(&pending[from..]);
        let (reach, small) = (f32x4::splat(place.radius), 0.5 * place.radius);
        let of_block = BlockReach::new(place.radius, &self.accuracy);
        let mut touches = false;
        let mut next = 0;
        while next < work.len() {
            let count = WIDTH.min(work.len() - next);
            let at = |k: usize| work[next + if k < count { k } else { 0 }];
            let four = [at(0), at(1), at(2), at(3)];
            next += count;
            let (offset, radius) = place.relative_to(four.map(|c| &self.clusters.balls[c as usize]));
            let distance = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]).sqrt();
            let is_apart = (distance * f32x4::splat(1.0 - 1e-6)).simd_gt(radius + reach).to_bitmask();
            let (distance, radius) = (distance.to_array(), radius.to_array());
            for (k, cluster) in four.into_iter().enumerate().take(count) {
                let link = &self.clusters.links[cluster as usize];
                let class = of_block.class(&self.reaches[cluster as usize], distance[k], radius[k]);
                if let Some(class) = class {
                    far[class].push(cluster);
                } else if link.is_leaf() || radius[k] < small {
                    touches |= is_apart >> k & 1 == 0;
                    pending.push(cluster);
                } else {
                    work.extend(link.range().map(|c| c as u32));
                }
            }
        }
        touches
    }

    fn add_far(&self, own: &mut Inherited, space: &mut Space) {
        let Space { far_fields, far, .. } = space;
        own.error += far_fields.add(self.clusters, far, &own.place, &self.accuracy, &mut own.local);
        far.iter_mut().for_each(Vec::clear);
    }

    /// Bounds of the field over a block that no pending cluster touches.
    fn range(&self, own: &Inherited, pending: &[u32]) -> (f64, f64) {
        let radius = f64::from(own.place.radius);
        let half = (own.place.half / radius).to_array();
        let (middle, spread) = own.local.range(half, self.accuracy.degree);
        let rest: f64 = (pending.iter())
            .map(|&c| {
                let (ball, area) = (&self.clusters.balls[c as usize], self.clusters.series[c as usize].area);
                let gap = own.place.offset_of(ball).length() - f64::from(ball[3]) - radius;
                f64::from(area) / (4.0 * std::f64::consts::PI * gap * gap)
            })
            .sum();
        let around = ROUND_UP * (spread + own.error + rest) + ROUNDING_OF_SUMS;
        (middle - around, middle + around)
    }

    /// Appends the values at the queries of a leaf; answers a bound of their errors.
    fn values(&self, own: &mut Inherited, mark: usize, space: &mut Space, values: &mut Vec<f64>) -> f64 {
        let mut far = [f32x4::ZERO; GROUPS];
        let error = self.near(&own.place, mark, space, &mut far);
        own.error += ROUND_UP * error + ROUNDING_OF_SUMS;
        self.add_far(own, space);
        let (block, count) = (&space.block, space.points.len());
        let groups = block.queries.groups;
        own.local.values(&block.scaled[..groups], self.accuracy.degree, &mut far[..groups]);
        let mut all: [f64; BLOCK] = std::array::from_fn(|i| f64::from(far[i / WIDTH].to_array()[i % WIDTH]));
        self.sources.add(&space.leaves, &self.clusters.items, &block.queries, &mut all);
        values.extend(&all[..count]);
        if block.beyond != 0 {
            let first = values.len() - count;
            (0..count).filter(|i| block.beyond >> i & 1 == 1).for_each(|i| values[first + i] = 0.0);
        }
        own.error
    }

    /// Adds the fields of the pending clusters: of those that turn out far from the whole block to `space.far` for later,
    /// of those far from some groups of queries by their multipole series to `far`; lists the rest in `space.leaves`, to
    /// be added singly. Answers a bound of the error made.
    fn near(&self, place: &Place, mark: usize, space: &mut Space, far: &mut [f32x4; GROUPS]) -> f64 {
        let Space { near, far: far_from_all, leaves, pending, block, .. } = space;
        let all = block.all();
        leaves.clear();
        near.clear();
        near.extend(pending[mark..].iter().rev().map(|&c| (c, all)));
        let of_block = BlockReach::new(place.radius, &self.accuracy);
        let mut error = 0.0;
        while let Some((cluster, wanted)) = near.pop() {
            let (ball, link) =
                (&self.clusters.balls[cluster as usize], &self.clusters.links[cluster as usize]);
            let offset = place.offset_of(ball);
            let (reach, distance) = (&self.reaches[cluster as usize], offset.length() as f32);
            if wanted == all
                && let Some(class) = of_block.class(reach, distance, ball[3])
            {
                far_from_all[class].push(cluster);
                continue;
            }
            let center = offset.to_array().map(|x| x as f32);
            let is_far = self.far_groups(block, center, cluster, wanted);
            if is_far != 0 {
                self.add_multipole(block, cluster, center, is_far, far);
                error += self.error_of_multipole(cluster, offset.length() as f32, place.radius);
            }
            let rest = wanted & !is_far;
            if rest == 0 {
                continue;
            }
            if link.is_leaf() {
                let range = link.range();
                leaves.push(NearLeaf { first: range.start as u32, count: range.len() as u32, wanted: rest });
                error += self.sources.rounding() * range.len() as f64;
            } else {
                near.extend(link.range().rev().map(|c| (c as u32, rest)));
            }
        }
        error
    }

    /// From where on a cluster acts by its multipole series on queries of a block.
    fn least_distance(&self, cluster: u32, radius: f32) -> f32 {
        self.reaches[cluster as usize].multipole[LONGEST].max(NEAREST_MULTIPOLE * radius)
    }

    /// Which of the `wanted` groups of queries lie farther than that from a cluster.
    #[inline(always)]
    fn far_groups(&self, block: &Block, center: [f32; 3], cluster: u32, wanted: u32) -> u32 {
        let distance = self.least_distance(cluster, block.queries.reach);
        let (center, square) = (center.map(f32x4::splat), f32x4::splat(distance * distance));
        bits(wanted)
            .filter(|&g| Multipole::is_farther(&center, &block.queries.offsets[g], square))
            .fold(0, |groups, g| groups | 1 << g)
    }

    fn add_multipole(
        &self,
        block: &Block,
        cluster: u32,
        center: [f32; 3],
        groups: u32,
        far: &mut [f32x4; GROUPS],
    ) {
        let cluster = cluster as usize;
        let (series, radius) = (&self.clusters.series[cluster], self.clusters.balls[cluster][3]);
        let multipole = Multipole::new(series, center, radius, self.accuracy.order);
        match self.accuracy.order {
            0 => bits(groups).for_each(|g| far[g] += multipole.at::<0>(&block.queries.offsets[g])),
            1 => bits(groups).for_each(|g| far[g] += multipole.at::<1>(&block.queries.offsets[g])),
            2 => bits(groups).for_each(|g| far[g] += multipole.at::<2>(&block.queries.offsets[g])),
            _ => bits(groups).for_each(|g| far[g] += multipole.at::<3>(&block.queries.offsets[g])),
        }
    }

    /// A bound of the error of a multipole series for those queries of a block that it acts on.
    fn error_of_multipole(&self, cluster: u32, distance: f32, reach: f32) -> f64 {
        let (series, radius) =
            (&self.clusters.series[cluster as usize], self.clusters.balls[cluster as usize][3]);
        let closest = (distance - reach).max(self.least_distance(cluster, reach)) * (1.0 - 1e-5);
        let order = self.accuracy.order;
        let [area, spread, radius, closest] =
            [series.area, bounds::spread_of_order(series.spread, order), radius, closest].map(f32x4::splat);
        let left_out = bounds::multipole_tail(area, spread, radius, closest, order);
        let rounding = bounds::largest_field(area, closest - radius);
        let one = |lanes: f32x4| f64::from(lanes.to_array()[0]);
        one(left_out) + ROUNDING_OF_MULTIPOLE * one(rounding)
    }
}

impl Inherited {
    fn moved_to(&self, place: Place, degree: usize) -> Inherited {
        let radius = f64::from(self.place.radius);
        let d = ((place.center - self.place.center) / radius).to_array();
        let local = self.local.moved(d, f64::from(place.radius) / radius, degree);
        Inherited { place, local, error: self.error }
    }
}

fn bits(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (mask != 0).then(|| mask.trailing_zeros() as usize);
        mask &= mask.wrapping_sub(1);
        lowest
    })
}
