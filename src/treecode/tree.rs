use super::expansion::{Expansion, Order, Query};
use super::kernel::{Kernel, Quadrature};
use super::moments::Moments;
use crate::bvh::{Bvh, Child, WIDTH};
use crate::math::{Aabb, Vec3};
use rayon::prelude::*;
use wide::{f32x4, f64x4};

/// How a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeConfig {
    /// Most sources in a leaf.
    pub leaf_size: usize,
}

/// Sources in a hierarchy, with the far field of every cluster: built once, asked many times.
pub struct Tree<K: Kernel> {
    bvh: Bvh,
    frame: Frame,
    expansions: Vec<Expansion>,
    /// The sources of the leaves, four to a block.
    blocks: Vec<K::Block>,
    /// Where the blocks of each leaf child begin, and how many there are.
    leaf_blocks: Vec<[(u32, u32); WIDTH]>,
}

/// Moves the sources into a unit cube about the origin. The winding number does not change with scale, but powers of
/// lengths in 32-bit floats would overflow.
#[derive(Clone, Copy)]
struct Frame {
    center: Vec3,
    scale: f64,
}

impl Frame {
    fn around(bounds: &Aabb) -> Frame {
        let longest = bounds.size().max_element();
        // A power of two: scaling is exact.
        let scale = if longest > 0.0 { (-longest.log2().ceil()).exp2() } else { 1.0 };
        Frame { center: bounds.center(), scale }
    }

    fn local(&self, p: Vec3) -> Vec3 {
        (p - self.center) * self.scale
    }
}

impl<K: Kernel> Tree<K> {
    /// Builds the tree, in parallel; the same sources give the same bits whatever the number of threads.
    pub fn build(kernel: &K, config: &TreeConfig) -> Tree<K> {
        let boxes: Vec<Aabb> =
            (0..kernel.len()).into_par_iter().map(|i| Aabb::around(kernel.corners(i))).collect();
        let bvh = Bvh::build(&boxes, config.leaf_size);
        let bounds = boxes.par_iter().copied().reduce(|| Aabb::EMPTY, Aabb::union);
        let frame = Frame::around(&bounds);
        let expansions = expand(kernel, &bvh, &frame);
        let (blocks, leaf_blocks) = pack_leaves(kernel, &bvh);
        Tree { bvh, frame, expansions, blocks, leaf_blocks }
    }

    /// The winding number at `q`: clusters farther than β times their radius by their expansion, the rest exactly
    /// (Barill et al. 2018, algorithm 1). NaN where `q` is not finite.
    pub fn at(&self, q: Vec3, order: Order, beta: f64, stack: &mut Vec<u32>) -> f64 {
        if !q.is_finite() {
            return f64::NAN;
        }
        let query = Query::new(self.frame.local(q));
        let lanes = q.to_array().map(f64x4::splat);
        let beta_squared = f32x4::splat((beta * beta) as f32);
        let mut far = f32x4::splat(0.0);
        let mut near = K::sum();
        let visit = |node: usize| {
            let (field, open) = self.expansions[node].far_field(&query, order, beta_squared);
            far += field;
            open
        };
        let leaf = |node: usize, child: usize| {
            let (first, count) = self.leaf_blocks[node][child];
            for block in &self.blocks[first as usize..(first + count) as usize] {
                K::add(&mut near, block, &lanes);
            }
        };
        self.bvh.traverse(stack, visit, leaf);
        let [a, b, c, d] = far.to_array().map(f64::from);
        K::total(near) + ((a + b) + (c + d))
    }

    /// The sum over every source singly: exact to rounding, and the slow way.
    pub fn direct(&self, q: Vec3) -> f64 {
        if !q.is_finite() {
            return f64::NAN;
        }
        let lanes = q.to_array().map(f64x4::splat);
        let mut sum = K::sum();
        self.blocks.iter().for_each(|block| K::add(&mut sum, block, &lanes));
        K::total(sum)
    }

    pub fn nodes(&self) -> usize {
        self.bvh.nodes().len()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.bvh.bytes()
            + size_of_val(&self.expansions[..])
            + size_of_val(&self.blocks[..])
            + size_of_val(&self.leaf_blocks[..])
    }
}

/// Moments bottom-up, level by level, packed into expansions.
fn expand<K: Kernel>(kernel: &K, bvh: &Bvh, frame: &Frame) -> Vec<Expansion> {
    let mut moments: Vec<[Option<Moments>; WIDTH]> = vec![[None; WIDTH]; bvh.nodes().len()];
    for level in bvh.levels().iter().rev() {
        let (upper, lower) = moments.split_at_mut(level.end);
        upper[level.clone()].par_iter_mut().enumerate().for_each(|(offset, slots)| {
            let node = &bvh.nodes()[level.start + offset];
            for ((slot, child), bounds) in slots.iter_mut().zip(node.children).zip(node.bounds) {
                let middle = frame.local(bounds.center());
                *slot = match child {
                    Child::Empty => None,
                    Child::Inner(index) => {
                        let parts: Vec<Moments> =
                            lower[index as usize - level.end].iter().flatten().copied().collect();
                        Some(Moments::of_clusters(&parts, middle))
                    }
                    Child::Leaf { .. } => {
                        let leaf = &bvh.items()[bvh.places(child)];
                        let sources: Vec<Quadrature> =
                            leaf.iter().map(|&i| localised(kernel.quadrature(i as usize), frame)).collect();
                        Some(Moments::of_sources(&sources, middle))
                    }
                };
            }
        });
    }
    (bvh.nodes().par_iter().zip(&moments))
        .map(|(node, slots)| {
            let mut packed = [None; WIDTH];
            for (place, (slot, bounds)) in packed.iter_mut().zip(slots.iter().zip(&node.bounds)) {
                *place = slot.map(|m| (m, radius(&m, bounds, frame)));
            }
            Expansion::pack(&packed)
        })
        .collect()
}

/// Distance from a cluster's centre to the farthest corner of its box: an upper bound of the paper's radius, as in the
/// paper's reference implementation. The exact radius is 10 to 20 % smaller, which makes the same β less accurate.
fn radius(moments: &Moments, bounds: &Aabb, frame: &Frame) -> f64 {
    let (low, high) = (frame.local(bounds.min), frame.local(bounds.max));
    (moments.center - low).abs().max((high - moments.center).abs()).length()
}

fn localised(source: Quadrature, frame: &Frame) -> Quadrature {
    let area_scale = frame.scale * frame.scale;
    Quadrature {
        points: source.points.map(|p| frame.local(p)),
        area_vector: source.area_vector * area_scale,
        area: source.area * area_scale,
    }
}

type LeafBlocks = Vec<[(u32, u32); WIDTH]>;

fn pack_leaves<K: Kernel>(kernel: &K, bvh: &Bvh) -> (Vec<K::Block>, LeafBlocks) {
    let mut chunks: Vec<&[u32]> = Vec::new();
    let mut leaf_blocks = vec![[(0, 0); WIDTH]; bvh.nodes().len()];
    for (node, starts) in bvh.nodes().iter().zip(&mut leaf_blocks) {
        for (child, start) in node.children.into_iter().zip(starts) {
            if let Child::Leaf { .. } = child {
                let first = chunks.len();
                chunks.extend(bvh.items()[bvh.places(child)].chunks(WIDTH));
                *start = (first as u32, (chunks.len() - first) as u32);
            }
        }
    }
    let member = |chunk: &[u32], lane: usize| chunk.get(lane).map(|&i| i as usize);
    let blocks =
        chunks.par_iter().map(|chunk| kernel.block([0, 1, 2, 3].map(|lane| member(chunk, lane)))).collect();
    (blocks, leaf_blocks)
}
