use super::octet::{Octet, parts};
use super::{GROUPS, SourceKind, WIDTH};
use crate::data::BLOCK;
use crate::math::{Floats, Vec3};
use crate::treecode::Lanes;
use std::panic::RefUnwindSafe;

/// Coordinates of eight queries near the middle of their block.
pub type QueryGroup = [Octet; 3];

/// Up to 64 queries that lie close together, eight in each group; places without a query repeat the first of their group.
#[derive(Clone)]
pub struct QueryBlock {
    /// Of four queries each.
    pub positions: [Lanes; BLOCK / 4],
    /// A point amid the queries.
    pub center: Vec3,
    /// Positions relative to the centre, times `scale`, which makes the sources about as large as 1.
    pub offsets: [QueryGroup; GROUPS],
    pub scale: f64,
    /// A bound of the lengths of the offsets.
    pub reach: f32,
    /// Groups with a query, the first ones.
    pub groups: usize,
    /// Boxes around the offsets of the groups, one in each lane: their middles and half their edges.
    pub middles: [Octet; 3],
    pub halves: [Octet; 3],
}

impl QueryBlock {
    /// The groups all of whose queries are farther from a place than a distance, a bit for each.
    #[inline(always)]
    pub fn groups_beyond<F: Floats<Number = f32>>(&self, place: [f32; 3], distance_squared: f32) -> u32 {
        const { assert!(GROUPS == WIDTH) };
        let mut groups = 0;
        for part in parts::<F>() {
            let x = self.gap::<F>(0, part, place[0]);
            let y = self.gap::<F>(1, part, place[1]);
            let z = self.gap::<F>(2, part, place[2]);
            groups |= (x * x + y * y + z * z).greater(F::splat(distance_squared)) << part;
        }
        groups
    }

    /// How far a place is from the boxes around some of the groups, along an axis.
    #[inline(always)]
    fn gap<F: Floats<Number = f32>>(&self, axis: usize, part: usize, place: f32) -> F {
        let from_middle = (self.middles[axis].get::<F>(part) - F::splat(place)).abs();
        (from_middle - self.halves[axis].get(part)).max(F::splat(0.0))
    }
}

/// The queries of a part of a group, relative to a place.
#[inline(always)]
pub fn relative<F: Floats<Number = f32>>(queries: &QueryGroup, part: usize, place: [f32; 3]) -> [F; 3] {
    [
        queries[0].get::<F>(part) - F::splat(place[0]),
        queries[1].get::<F>(part) - F::splat(place[1]),
        queries[2].get::<F>(part) - F::splat(place[2]),
    ]
}

/// A kind of source for a [`super::DualTree`]: what its far field is made of and how its near field is summed. A panic leaves
/// it as it was.
pub trait Sources: Send + Sync + RefUnwindSafe {
    fn len(&self) -> usize;
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Of points all three corners are the same.
    fn kind(&self) -> SourceKind;
    /// The points whose hull is the source; finite.
    fn corners(&self, index: usize) -> [Vec3; 3];
    /// Area times normal.
    fn area_vector(&self, index: usize) -> Vec3;

    /// √a of a point of area a, if points are bounded: nearer than some times this, its field is not a dipole's.
    fn extent(&self, _index: usize) -> Option<f64> {
        None
    }

    /// A bound of the rounding error that [`Sources::add`] makes for one source at one query.
    fn rounding(&self) -> f64;
    /// Adds the fields of the sources `near` a block to the `values` at its queries, each with an error of up to `error` and
    /// its rounding.
    fn add(
        &self,
        near: &[NearLeaf],
        items: &[u32],
        queries: &QueryBlock,
        error: f32,
        values: &mut [f64; BLOCK],
    );
}

/// Sources that act singly on some queries of a block.
#[derive(Clone, Copy, Debug)]
pub struct NearLeaf {
    /// They are `items[first..first + count]`.
    pub first: u32,
    pub count: u32,
    /// A bit for each group of queries that they act on.
    pub wanted: u32,
}

impl NearLeaf {
    pub fn members<'a>(&self, items: &'a [u32]) -> &'a [u32] {
        &items[self.first as usize..][..self.count as usize]
    }

    /// The groups of queries that the sources act on.
    #[inline(always)]
    pub fn groups(&self) -> impl Iterator<Item = usize> + use<> {
        groups_of(self.wanted)
    }
}

/// The groups whose bits are set.
#[inline(always)]
pub fn groups_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        // Within the block, as the compiler sees with this.
        let lowest = (bits != 0).then(|| bits.trailing_zeros() as usize % GROUPS);
        bits &= bits.wrapping_sub(1);
        lowest
    })
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// Dipoles for tests, without a near field.
    pub struct Dipoles(pub Vec<(Vec3, Vec3)>);

    impl Sources for Dipoles {
        fn len(&self) -> usize {
            self.0.len()
        }

        fn kind(&self) -> SourceKind {
            SourceKind::Points
        }

        fn corners(&self, index: usize) -> [Vec3; 3] {
            [self.0[index].0; 3]
        }

        fn area_vector(&self, index: usize) -> Vec3 {
            self.0[index].1
        }

        fn rounding(&self) -> f64 {
            0.0
        }

        fn add(&self, _: &[NearLeaf], _: &[u32], _: &QueryBlock, _: f32, _: &mut [f64; BLOCK]) {}
    }

    /// Numbers in [−1, 1).
    pub fn random(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1);
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let mixed = (state ^ (state >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
            (mixed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }
}
