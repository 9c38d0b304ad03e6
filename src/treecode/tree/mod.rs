mod bounded;
mod gradient;

use super::expansion::{Cluster, Expansion, Order, Positions, sum_of_lanes};
use super::frame::Frame;
use super::kernel::{Kernel, Quadrature};
use super::moments::Moments;
use crate::bvh::{Bvh, Child, Stack, WIDTH};
use crate::data::{BLOCK, map_items, ones, set_each};
use crate::math::{Aabb, Vec3};
use wide::{f32x4, f64x4};

/// Nodes whose moments one task computes.
const NODES_PER_TASK: usize = 64;

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
    mode: K::Mode,
    /// Whether sources are bounded points.
    is_bounded: bool,
}

/// A cluster of bounded points counts as no smaller than this times their largest extent, √a. Dipoles lack 3x² of each,
/// x = a cos / 4πd², altogether no more than 3 / 4π(4β)² where all of a closed surface is d = 4β √a away, as in the middle of a
/// sphere; next to a plane an eighth of that.
const LEAST_RADIUS: f64 = 4.0;

/// Scratch space of evaluations, kept by the caller so that many share it.
#[derive(Default)]
pub struct Scratch {
    single: Stack,
    block: Stack<u64>,
}

// A walk for a block carries one bit for each query.
const _: () = assert!(BLOCK == u64::BITS as usize);

/// Queries of one walk, relative to their middle, in the tree's unit frame.
struct Block {
    center: Vec3,
    /// Distance from the middle to the farthest query, rounded up.
    radius: f32,
    /// One bit for each query that is finite.
    active: u64,
    positions: [[f32x4; 3]; BLOCK / WIDTH],
    groups: usize,
    /// Each query alone, not relative to the middle.
    singly: Vec<Positions>,
}

/// Up to this many queries of a block are taken one by one, against the four children of a node at once; more of them
/// four at a time, against one child after the other. A quarter of the block: where both cost the same.
const FEW: u32 = 16;

impl Block {
    fn new(queries: &[Vec3], frame: &Frame) -> Block {
        let active = (0..queries.len()).filter(|&i| queries[i].is_finite()).fold(0, |bits, i| bits | 1 << i);
        let local: Vec<Vec3> = queries.iter().map(|q| frame.local(*q)).collect();
        let bounds = Aabb::around(local.iter().copied().filter(|q| q.is_finite()));
        let center = bounds.center();
        // Lanes without a query take part in the arithmetic, from the middle, and are left out at the end.
        let offset = |i: usize| match local.get(i) {
            Some(q) if q.is_finite() => *q - center,
            _ => Vec3::ZERO,
        };
        let lanes =
            |g: usize, axis: usize| f32x4::new(std::array::from_fn(|k| offset(WIDTH * g + k)[axis] as f32));
        Block {
            center,
            radius: (0.5 * bounds.diagonal() * (1.0 + 1e-6)) as f32,
            active,
            positions: std::array::from_fn(|g| [0, 1, 2].map(|axis| lanes(g, axis))),
            groups: queries.len().div_ceil(WIDTH),
            singly: local.iter().map(|q| Positions::splat(*q)).collect(),
        }
    }

    /// Adds the field of a cluster to the sums of those `wanted` queries that are farther than β radii; answers which.
    #[inline(always)]
    fn add_far(&self, cluster: &Cluster, sums: &mut [f32x4], order: Order, beta: f64, wanted: u64) -> u64 {
        let groups = self.positions[..self.groups].iter().zip(sums);
        if wanted == self.active && cluster.is_far_from_all(self.radius, beta as f32) {
            groups.for_each(|(positions, sum)| *sum += cluster.field(positions, order));
            return wanted;
        }
        let beta_squared = f32x4::splat((beta * beta) as f32);
        groups.enumerate().fold(0, |far, (g, (positions, sum))| {
            let four = (wanted >> (WIDTH * g)) as u32 & 0b1111;
            let (field, is_far) = cluster.far_field(positions, order, beta_squared, four);
            *sum += field;
            far | u64::from(is_far) << (WIDTH * g)
        })
    }
}

impl<K: Kernel> Tree<K> {
    /// Builds the tree, in parallel; the same sources give the same bits whatever the number of threads.
    pub fn build(kernel: &K, config: &TreeConfig) -> Tree<K> {
        let boxes = map_items(kernel.len(), |i| Aabb::around(kernel.corners(i)));
        let bvh = Bvh::build(&boxes, config.leaf_size);
        let bounds = boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union);
        let frame = Frame::around(&bounds);
        let expansions = expand(kernel, &bvh, &frame);
        let (blocks, leaf_blocks) = pack_leaves(kernel, &bvh);
        let (mode, is_bounded) = (kernel.mode(), kernel.is_bounded());
        Tree { bvh, frame, expansions, blocks, leaf_blocks, mode, is_bounded }
    }

    /// Winding numbers at up to [`BLOCK`] queries that lie close together, in one walk: each query takes the same clusters
    /// as in [`Tree::bounded`], but a cluster is evaluated for four queries at a time.
    pub fn at_block(
        &self,
        queries: &[Vec3],
        values: &mut [f64],
        order: Order,
        beta: f64,
        scratch: &mut Scratch,
    ) {
        let block = Block::new(queries, &self.frame);
        let beta_squared = f32x4::splat((beta * beta) as f32);
        let mut far = [f32x4::ZERO; BLOCK / WIDTH];
        let mut near: Vec<K::Sum> = queries.iter().map(|_| K::sum(self.mode)).collect();
        let mut far_singly = [f32x4::ZERO; BLOCK];
        let visit = |node: usize, wanted: u64| {
            let expansion = &self.expansions[node];
            let mut below = [0; WIDTH];
            if wanted.count_ones() <= FEW {
                for i in ones(wanted) {
                    let (field, is_far) = expansion.far_field(&block.singly[i], order, beta_squared);
                    far_singly[i] += field;
                    below
                        .iter_mut()
                        .enumerate()
                        .for_each(|(k, rest)| *rest |= u64::from(!is_far >> k & 1) << i);
                }
            } else {
                for (k, rest) in below.iter_mut().enumerate() {
                    if self.bvh.nodes()[node].children[k] != Child::Empty {
                        let cluster = expansion.cluster(k, block.center);
                        *rest = wanted & !block.add_far(&cluster, &mut far, order, beta, wanted);
                    }
                }
            }
            ((0..WIDTH).fold(0, |open, k| open | u32::from(below[k] != 0) << k), below)
        };
        let leaf = |node: usize, child: usize, wanted: u64| {
            for i in ones(wanted) {
                let lanes = queries[i].to_array().map(f64x4::splat);
                self.leaf(node, child).iter().for_each(|block| K::add(&mut near[i], block, &lanes));
            }
        };
        self.bvh.traverse(&mut scratch.block, block.active, visit, leaf);
        let far = far.map(|f| f.to_array());
        for (i, (value, near)) in values.iter_mut().zip(near).enumerate() {
            let far = f64::from(far[i / WIDTH][i % WIDTH]) + sum_of_lanes(far_singly[i]);
            *value = if block.active >> i & 1 == 1 { K::total(near) + far } else { f64::NAN };
        }
    }

    fn leaf(&self, node: usize, child: usize) -> &[K::Block] {
        let (first, count) = self.leaf_blocks[node][child];
        &self.blocks[first as usize..(first + count) as usize]
    }

    /// The sum over every source singly: exact to rounding, and the slow way.
    pub fn direct(&self, q: Vec3) -> f64 {
        if !q.is_finite() {
            return f64::NAN;
        }
        let lanes = q.to_array().map(f64x4::splat);
        let mut sum = K::sum(self.mode);
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
        set_each(&mut upper[level.clone()], NODES_PER_TASK, |offset, slots| {
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
    map_items(bvh.nodes().len(), |index| {
        let bounds = &bvh.nodes()[index].bounds;
        let pack = |k: usize| moments[index][k].map(|m| (m, radius(&m, &bounds[k], frame)));
        Expansion::pack(&std::array::from_fn(pack))
    })
}

/// Distance from a cluster's centre to the farthest corner of its box: an upper bound of the paper's radius, as in the
/// paper's reference implementation. The exact radius is 10 to 20 % smaller, which makes the same β less accurate. More where
/// points are bounded.
fn radius(moments: &Moments, bounds: &Aabb, frame: &Frame) -> f64 {
    let (low, high) = (frame.local(bounds.min), frame.local(bounds.max));
    let corner = (moments.center - low).abs().max((high - moments.center).abs()).length();
    corner.max(LEAST_RADIUS * moments.extent)
}

fn localised(source: Quadrature, frame: &Frame) -> Quadrature {
    let area_scale = frame.scale * frame.scale;
    Quadrature {
        points: source.points.map(|p| frame.local(p)),
        area_vector: source.area_vector * area_scale,
        area: source.area * area_scale,
        extent: source.extent * frame.scale,
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
    let block = |k: usize| kernel.block([0, 1, 2, 3].map(|lane| member(chunks[k], lane)));
    let blocks = map_items(chunks.len(), block);
    (blocks, leaf_blocks)
}
