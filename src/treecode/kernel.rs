use crate::bvh::WIDTH;
use crate::math::Vec3;
use std::ops::Range;
use wide::f64x4;

/// Four points, one in each SIMD lane.
pub type Lanes = [f64x4; 3];

/// A rule that integrates polynomials of degree 2 over one source: the mean over `points`, times the area.
#[derive(Clone, Copy, Debug)]
pub struct Quadrature {
    /// Edge midpoints of a triangle (Barill et al. 2018, eq. 29); three times the same for a point.
    pub points: [Vec3; 3],
    pub area_vector: Vec3,
    pub area: f64,
    /// √a of a bounded point of area a, 0 of what is not bounded: nearer than some times this, its field is not a dipole's.
    pub extent: f64,
}

/// A kind of source: what its far field is made of and how its near field is summed.
pub trait Kernel: Sync {
    /// Four sources, ready to be summed together.
    type Block: Clone + Send + Sync;
    /// A near field while it is being summed.
    type Sum;
    /// How the sources are summed.
    type Mode: Copy + Send + Sync;

    /// Number of sources.
    fn len(&self) -> usize;
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The points whose hull is the source.
    fn corners(&self, index: usize) -> [Vec3; 3];
    fn quadrature(&self, index: usize) -> Quadrature;
    /// Whether sources are bounded points.
    fn is_bounded(&self) -> bool {
        false
    }
    /// Packs up to four sources; a lane without a source must add nothing.
    fn block(&self, members: [Option<usize>; WIDTH]) -> Self::Block;

    fn mode(&self) -> Self::Mode;
    fn sum(mode: Self::Mode) -> Self::Sum;
    fn add(sum: &mut Self::Sum, block: &Self::Block, query: &Lanes);
    /// The winding number of all blocks added.
    fn total(sum: Self::Sum) -> f64;

    /// Adds the gradients of the winding numbers of a block, times 4π, each source in a lane of its own.
    fn add_gradient(sum: &mut Lanes, block: &Self::Block, query: &Lanes, mode: Self::Mode);
}

/// Winding numbers at points by the direct sum of a range of sources, in f64: each four of these are packed once.
pub fn direct_sums<K: Kernel>(sources: &K, range: Range<usize>, points: &[Vec3]) -> Vec<f64> {
    let mut sums: Vec<(Lanes, K::Sum)> =
        points.iter().map(|q| (q.to_array().map(f64x4::splat), K::sum(sources.mode()))).collect();
    for first in range.clone().step_by(WIDTH) {
        let member = |k: usize| Some(first + k).filter(|m| *m < range.end);
        let block = sources.block(std::array::from_fn(member));
        sums.iter_mut().for_each(|(q, sum)| K::add(sum, &block, q));
    }
    sums.into_iter().map(|(_, sum)| K::total(sum)).collect()
}
