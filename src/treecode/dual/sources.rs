use super::{GROUPS, SourceKind};
use crate::data::BLOCK;
use crate::math::Vec3;
use std::panic::RefUnwindSafe;
use wide::{f32x4, f64x4};

/// Coordinates of four queries near the middle of their block.
pub type QueryLanes = [f32x4; 3];

/// Up to 64 queries that lie close together, four in each group; lanes without a query are in the middle.
#[derive(Clone)]
pub struct QueryBlock {
    pub positions: [[f64x4; 3]; GROUPS],
    /// A point amid the queries.
    pub center: Vec3,
    /// Positions relative to the centre, times `scale`, which makes the sources about as large as 1.
    pub offsets: [QueryLanes; GROUPS],
    pub scale: f64,
    /// A bound of the lengths of the offsets.
    pub reach: f32,
    /// Groups with a query, the first ones.
    pub groups: usize,
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

    /// A bound of the error that [`Sources::add`] makes for one source at one query.
    fn rounding(&self) -> f64;
    /// Adds the fields of the sources `near` a block to the `values` at its queries.
    fn add(&self, near: &[NearLeaf], items: &[u32], queries: &QueryBlock, values: &mut [f64; BLOCK]);
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
    pub fn groups(&self) -> impl Iterator<Item = usize> + use<> {
        let mut rest = self.wanted;
        std::iter::from_fn(move || {
            let lowest = (rest != 0).then(|| rest.trailing_zeros() as usize);
            rest &= rest.wrapping_sub(1);
            lowest
        })
    }
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

        fn add(&self, _: &[NearLeaf], _: &[u32], _: &QueryBlock, _: &mut [f64; BLOCK]) {}
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
