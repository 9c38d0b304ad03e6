//! The hierarchy once more, with boxes in 32-bit floats: four of them are looked at by one instruction.
use super::disc::Discs;
use super::{Bvh, Child, WIDTH};
use crate::data::{map_items, sort_keyed};
use crate::math::{Aabb, Vec3};
use wide::f32x4;

/// Half a unit in the last place of 1, as 32-bit floats round.
const ROUNDING: f64 = 1.0 / (1u64 << 24) as f64;
/// What bounds all rounding of a distance in 32-bit floats, in units of the largest coordinate: three for the place, three for what
/// it is measured to, the rest for products of their differences.
const SLACK: f64 = 64.0 * ROUNDING;
/// Scaled coordinates beyond this are cut off.
const FARTHEST: f64 = 1e15;
/// Most items of a part of the surface that is bounded by a disc: larger ones are seldom flat.
const ITEMS_OF_DISC: usize = 64;

const LEAF: u32 = 1 << 31;
const EMPTY: u32 = u32::MAX;

/// Four boxes, by axis, and what is in them: the number of a node, or that of a leaf with the highest bit set.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    children: [u32; WIDTH],
    has_discs: bool,
    discs: Discs,
}

/// A hierarchy with narrow boxes around those of a [`Bvh`], for searches of what is nearest.
#[derive(Clone, Debug)]
pub struct NarrowBvh {
    nodes: Vec<Node>,
    /// Coordinates are counted from here, and scaled by a power of two so that those of the boxes lie within ±1.
    origin: Vec3,
    scale: f64,
}

/// A place as [`NarrowBvh`] sees it.
#[derive(Clone, Copy, Debug)]
pub struct Narrowed {
    pub place: [f32; 3],
    scale: f64,
    /// What a scaled distance of something in the tree may be off by when it is computed in 32-bit floats.
    slack: f64,
}

impl Narrowed {
    /// Squared narrow distances above this are certainly longer than `distance`.
    #[inline]
    pub fn limit(&self, distance: f64) -> f32 {
        let reached = distance * self.scale + self.slack;
        // The factor is for rounding, here and in the sum of three squares.
        (reached * reached * (1.0 + 16.0 * ROUNDING)) as f32
    }
}

/// What is still to be looked at, with its least squared distance.
pub type Found = Vec<(f32, u32)>;

impl NarrowBvh {
    /// The same tree. Its leaves are numbered in the order of its items, as `leaf(its number, its items)` hears. `corners` are points
    /// whose convex hull holds an item, and its normal, or zero if it has none: parts of a surface are bounded by discs too.
    pub fn new(
        bvh: &Bvh,
        corners: impl Fn(u32) -> ([Vec3; 3], Vec3) + Sync,
        mut leaf: impl FnMut(usize, &[u32]),
    ) -> NarrowBvh {
        let all = bvh
            .nodes()
            .first()
            .map_or(Aabb::EMPTY, |root| root.bounds.iter().copied().fold(Aabb::EMPTY, Aabb::union));
        let (origin, reach) = (all.center(), 0.5 * all.size().max_element());
        // Below this the scale would not be finite.
        let scale = if reach > f64::MIN_POSITIVE { libm::exp2(-reach.log2().ceil()) } else { 1.0 };
        let mut tree = NarrowBvh { nodes: Vec::new(), origin, scale };
        tree.nodes = map_items(bvh.nodes().len(), |index| tree.narrowed(bvh, &bvh.nodes()[index], &corners));
        let mut firsts: Vec<(u64, u32)> = Vec::new();
        for (index, node) in bvh.nodes().iter().enumerate() {
            for (k, child) in node.children.iter().enumerate() {
                if let Child::Leaf { first, .. } = child {
                    firsts.push((u64::from(*first), (WIDTH * index + k) as u32));
                }
            }
        }
        sort_keyed(&mut firsts);
        for (number, (_, place)) in firsts.into_iter().enumerate() {
            let (index, k) = (place as usize / WIDTH, place as usize % WIDTH);
            tree.nodes[index].children[k] = LEAF | number as u32;
            leaf(number, &bvh.items()[bvh.places(bvh.nodes()[index].children[k])]);
        }
        tree
    }

    fn narrowed(&self, bvh: &Bvh, node: &super::Node, corners: &dyn Fn(u32) -> ([Vec3; 3], Vec3)) -> Node {
        let mut narrow = Node {
            low: [[0.0; WIDTH]; 3],
            high: [[0.0; WIDTH]; 3],
            children: [EMPTY; WIDTH],
            has_discs: false,
            discs: Discs::ENDLESS,
        };
        for (k, (child, bounds)) in node.children.iter().zip(&node.bounds).enumerate() {
            let relative = |p: Vec3| self.scale * (p - self.origin);
            let (low, high) = (relative(bounds.min).to_array(), relative(bounds.max).to_array());
            for axis in 0..3 {
                narrow.low[axis][k] = low[axis] as f32;
                narrow.high[axis][k] = high[axis] as f32;
            }
            if let Child::Inner(index) = child {
                narrow.children[k] = *index;
            }
            let places = bvh.places(*child);
            if !places.is_empty() && places.len() <= ITEMS_OF_DISC {
                let items = &bvh.items()[places];
                let normal = items.iter().map(|item| corners(*item).1).sum::<Vec3>().normalize_or_zero();
                let points = items.iter().flat_map(|item| corners(*item).0).map(relative);
                narrow.discs.set(k, relative(bounds.center()), normal, points);
                narrow.has_discs = true;
            }
        }
        narrow
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
    }

    /// A place as those are that [`NarrowBvh::search`] starts from.
    #[inline]
    pub fn narrow(&self, place: Vec3) -> Narrowed {
        let offset = self.scale * (place - self.origin);
        let slack = SLACK * (offset.abs().max_element() + 1.0);
        // What is so far away that squares overflow is looked at from nearer: nothing gets farther by that.
        let place = offset.to_array().map(|c| c.clamp(-FARTHEST, FARTHEST) as f32);
        Narrowed { place, scale: self.scale, slack }
    }

    /// The same for the difference of two places.
    pub fn narrow_offset(&self, offset: Vec3) -> [f32; 3] {
        (self.scale * offset).to_array().map(|c| c as f32)
    }

    /// Hands leaves near a place to `leaf(its number, limit)`, nearer ones first, which answers a new limit: those whose squared
    /// distance is certainly above it are left out. `open` is scratch space.
    #[inline]
    pub fn search(
        &self,
        from: &Narrowed,
        mut limit: f32,
        open: &mut Found,
        mut leaf: impl FnMut(usize, f32) -> f32,
    ) {
        open.clear();
        if !self.nodes.is_empty() {
            open.push((0.0, 0));
        }
        let [x, y, z] = from.place;
        let place = [f32x4::splat(x), f32x4::splat(y), f32x4::splat(z)];
        while let Some((least, child)) = open.pop() {
            if least > limit {
                continue;
            }
            if child & LEAF != 0 {
                limit = leaf((child & !LEAF) as usize, limit);
                continue;
            }
            let node = &self.nodes[child as usize];
            let mut squared = node.squared_distances(&place);
            if node.has_discs && squared.simd_le(f32x4::splat(limit)).any() {
                squared = squared.fast_max(node.discs.squared_distances(&place));
            }
            let before = open.len();
            let squared = squared.to_array();
            for (&least, &child) in squared.iter().zip(&node.children) {
                if least <= limit && child != EMPTY {
                    open.push((least, child));
                    // The nearest is taken next.
                    let mut at = open.len() - 1;
                    while at > before && open[at - 1].0 < least {
                        open.swap(at - 1, at);
                        at -= 1;
                    }
                }
            }
        }
    }
}

impl Node {
    #[inline(always)]
    fn squared_distances(&self, place: &[f32x4; 3]) -> f32x4 {
        let along = |axis: usize| {
            let (low, high) = (f32x4::new(self.low[axis]), f32x4::new(self.high[axis]));
            (low - place[axis]).fast_max(place[axis] - high).fast_max(f32x4::ZERO)
        };
        let (x, y, z) = (along(0), along(1), along(2));
        x * x + y * y + z * z
    }
}
