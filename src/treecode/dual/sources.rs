use super::GROUPS;
use crate::math::Vec3;
use std::sync::Arc;
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

/// A kind of source for a [`super::DualTree`]: what its far field is made of and how its near field is summed.
pub trait Sources: Sync {
    /// The near field of four queries while it is being summed.
    type Sum: Copy + Send + Sync;
    /// Whether all three corners of every source are the same.
    const POINTS: bool;
    /// A bound of the error that [`Sources::add`] makes for one source at one query.
    const ROUNDING: f64;

    fn len(&self) -> usize;
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The points whose hull is the source; finite.
    fn corners(&self, index: usize) -> [Vec3; 3];
    /// Area times normal.
    fn area_vector(&self, index: usize) -> Vec3;

    /// The sum of no sources.
    fn zero() -> Self::Sum;
    /// Adds the fields of the `members` to the sums of those groups of queries whose bit is set in `wanted`.
    fn add(&self, members: &[u32], queries: &QueryBlock, wanted: u32, sums: &mut [Self::Sum; GROUPS]);
    /// The winding numbers of all sources added.
    fn total(sum: &Self::Sum) -> [f64; 4];
}

impl<S: Sources + Send> Sources for Arc<S> {
    type Sum = S::Sum;
    const POINTS: bool = S::POINTS;
    const ROUNDING: f64 = S::ROUNDING;

    #[inline]
    fn len(&self) -> usize {
        S::len(self)
    }

    #[inline]
    fn corners(&self, index: usize) -> [Vec3; 3] {
        S::corners(self, index)
    }

    #[inline]
    fn area_vector(&self, index: usize) -> Vec3 {
        S::area_vector(self, index)
    }

    #[inline]
    fn zero() -> S::Sum {
        S::zero()
    }

    #[inline]
    fn add(&self, members: &[u32], queries: &QueryBlock, wanted: u32, sums: &mut [S::Sum; GROUPS]) {
        S::add(self, members, queries, wanted, sums);
    }

    #[inline]
    fn total(sum: &S::Sum) -> [f64; 4] {
        S::total(sum)
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// Dipoles for tests, without a near field.
    pub struct Dipoles(pub Vec<(Vec3, Vec3)>);

    impl Sources for Dipoles {
        type Sum = ();
        const POINTS: bool = true;
        const ROUNDING: f64 = 0.0;

        fn len(&self) -> usize {
            self.0.len()
        }

        fn corners(&self, index: usize) -> [Vec3; 3] {
            [self.0[index].0; 3]
        }

        fn area_vector(&self, index: usize) -> Vec3 {
            self.0[index].1
        }

        fn zero() {}

        fn add(&self, _: &[u32], _: &QueryBlock, _: u32, _: &mut [(); GROUPS]) {}

        fn total((): &()) -> [f64; 4] {
            [0.0; 4]
        }
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
