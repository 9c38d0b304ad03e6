//! What acts on the queries of one small block: clusters near it, by their multipole series on those groups of queries that are
//! far from them, and singly on the others.
use super::GROUPS;
use super::bounds::{self, ROUNDING_OF_MULTIPOLE};
use super::multipole::Multipole;
use super::octet::{Octet, parts};
use super::place::{Block, Place};
use super::reach::{BlockReach, LONGEST};
use super::sources::{NearLeaf, groups_of};
use super::walk::{Space, Walk};
use crate::math::{Floats, Registers, Work, in_widest_registers};
use std::ops::Range;
use wide::f32x4;

/// Least distance for a multipole series, in radii of the block: nearer, 32-bit positions relative to the block's centre would
/// give it a wrong direction.
const NEAREST_MULTIPOLE: f32 = 1.0 / 16.0;

/// So many sources of a leaf are summed singly wherever they are: a series would take as long. With 0, 2 and 4 the times are
/// equal to some percent.
const FEW: usize = 2;

/// Adds the fields of the clusters `space.pending[mark..]` at the queries of `space.block`: of those that turn out far from
/// the whole block to `space.far` for later, of those far from some groups of queries by their multipole series to `far`;
/// lists the rest in `space.leaves`, to be added singly.
pub struct Near<'a> {
    pub walk: &'a Walk<'a>,
    pub place: &'a Place,
    pub reach: &'a BlockReach,
    pub mark: usize,
    pub space: &'a mut Space,
    pub far: &'a mut [Octet; GROUPS],
    /// A bound of the error made.
    pub error: f64,
}

impl Near<'_> {
    pub fn add(&mut self) {
        in_widest_registers(Added(self));
    }
}

struct Added<'a, 'b>(&'a mut Near<'b>);

impl Work for Added<'_, '_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.0.run::<R::Singles>();
    }
}

impl Near<'_> {
    #[inline(always)]
    fn run<F: Floats<Number = f32>>(&mut self) {
        let Walk { clusters, sources, accuracy, .. } = self.walk;
        let all = self.space.block.all();
        self.space.leaves.clear();
        self.space.near.clear();
        let pending = &self.space.pending[self.mark..];
        self.space.near.extend(pending.iter().rev().map(|&c| (c, all)));
        while let Some((cluster, wanted)) = self.space.near.pop() {
            let link = &clusters.links[cluster as usize];
            let range = link.range();
            let mut rest = wanted;
            if !link.is_leaf() || range.len() > FEW {
                rest &= !self.add_multipole::<F>(cluster, wanted);
            }
            if rest == 0 {
                continue;
            }
            if link.is_leaf() {
                let leaf = NearLeaf { first: range.start as u32, count: range.len() as u32, wanted: rest };
                self.space.leaves.push(leaf);
                self.error += (sources.rounding() + f64::from(accuracy.of_source())) * range.len() as f64;
            } else if rest == all {
                self.open(range, all);
            } else {
                self.space.near.extend(range.rev().map(|c| (c as u32, rest)));
            }
        }
    }

    /// Puts clusters that are far from the whole block to the others of their class.
    #[inline(always)]
    fn open(&mut self, range: Range<usize>, all: u32) {
        let Walk { clusters, reaches, .. } = self.walk;
        let at = |k: usize| &clusters.balls[(range.start + k).min(range.end - 1)];
        let (offset, radius) = self.place.relative_to([at(0), at(1), at(2), at(3)]);
        let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
        let (distance, radius) = (square.sqrt().to_array(), radius.to_array());
        for (k, cluster) in range.enumerate().rev() {
            match self.reach.class(&reaches[cluster], distance[k], radius[k]) {
                Some(class) => self.space.far[class].push(cluster as u32),
                None => self.space.near.push((cluster as u32, all)),
            }
        }
    }

    /// Adds the field of a cluster at those of the `wanted` groups that are far enough from it, and answers which they are.
    #[inline(always)]
    fn add_multipole<F: Floats<Number = f32>>(&mut self, cluster: u32, wanted: u32) -> u32 {
        let (clusters, block) = (self.walk.clusters, &self.space.block);
        let ball = &clusters.balls[cluster as usize];
        let center = self.place.offset_of(ball).to_array().map(|x| x as f32);
        let distance = self.least_distance(cluster);
        let groups = wanted & block.queries.groups_beyond::<F>(center, distance * distance);
        if groups == 0 {
            return 0;
        }
        let multipole = Multipole { series: &clusters.series[cluster as usize], center, radius: ball[3] };
        match self.walk.accuracy.order {
            0 => multipole.add_at::<F, 0>(block, groups, self.far),
            1 => multipole.add_at::<F, 1>(block, groups, self.far),
            2 => multipole.add_at::<F, 2>(block, groups, self.far),
            _ => multipole.add_at::<F, 3>(block, groups, self.far),
        }
        if let Some(lacking) = self.walk.lacking {
            self.error += self.error_of_multipole(cluster, f64::from(lacking));
        }
        groups
    }

    /// From where on a cluster acts by its multipole series on queries of the block.
    #[inline(always)]
    fn least_distance(&self, cluster: u32) -> f32 {
        let least = NEAREST_MULTIPOLE * self.place.radius;
        self.walk.reaches[cluster as usize].multipole[LONGEST].max(least)
    }

    /// A bound of the error of a multipole series for those queries of the block that it acts on.
    #[cold]
    fn error_of_multipole(&self, cluster: u32, lacking: f64) -> f64 {
        let clusters = self.walk.clusters;
        let (series, ball) = (&clusters.series[cluster as usize], &clusters.balls[cluster as usize]);
        let distance = self.place.offset_of(ball).length() as f32;
        let closest = (distance - self.place.radius).max(self.least_distance(cluster)) * (1.0 - 1e-5);
        let order = self.walk.accuracy.order;
        let [area, spread, radius, closest] =
            [series.area, bounds::spread_of_order(series.spread, order), ball[3], closest].map(f32x4::splat);
        let left_out = bounds::multipole_tail(area, spread, radius, closest, order);
        let largest = bounds::largest_field(area, closest - radius);
        let one = |lanes: f32x4| f64::from(lanes.to_array()[0]);
        one(left_out) + (ROUNDING_OF_MULTIPOLE + lacking) * one(largest)
    }
}

impl Multipole<'_> {
    #[inline(always)]
    fn add_at<F: Floats<Number = f32>, const ORDER: usize>(
        &self,
        block: &Block,
        groups: u32,
        far: &mut [Octet; GROUPS],
    ) {
        for group in groups_of(groups) {
            for part in parts::<F>() {
                self.add::<F, ORDER>(&block.queries.offsets[group], part, &mut far[group]);
            }
        }
    }
}
