//! A bounding volume hierarchy of boxes, four children to a node. It owns *the* traversal of the crate; what is
//! looked for comes in as closures.
mod build;
mod disc;
mod first_hit;
mod morton;
mod narrow;
mod nearest;
mod overlaps;
mod sort;

pub use build::cut_at_highest_bit;
pub use first_hit::FirstHit;
pub use morton::{along_curve, morton_code};
pub use narrow::{Found, NarrowBvh, Narrowed};
pub use nearest::{Nearest, PointTree};
pub use sort::sorted_codes;

use crate::math::Aabb;
use std::ops::Range;

/// Children of a node: as many as 32-bit floats in a SIMD register of SSE, NEON and WebAssembly.
pub const WIDTH: usize = 4;

/// One of the four places under a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Child {
    #[default]
    Empty,
    /// The node with this index, always greater than its parent's.
    Inner(u32),
    /// `count` items from place `first` of [`Bvh::items`].
    Leaf { first: u32, count: u32 },
}

#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub children: [Child; WIDTH],
    /// [`Aabb::EMPTY`] for an empty child.
    pub bounds: [Aabb; WIDTH],
}

/// Scratch space of a walk: nodes still to visit, and what is carried to them.
pub type Stack<C = ()> = Vec<(u32, C)>;

/// The hierarchy. Node 0 is the root; items are in the order of the Morton curve through their box centres.
#[derive(Clone, Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    levels: Vec<Range<usize>>,
    items: Vec<u32>,
}

impl Bvh {
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Index ranges of the nodes of each depth, root first: children are always in the next range.
    pub fn levels(&self) -> &[Range<usize>] {
        &self.levels
    }

    /// Item numbers in tree order: those of a leaf, and of a whole subtree, are contiguous.
    pub fn items(&self) -> &[u32] {
        &self.items
    }

    /// The items below `child`, as places in [`Bvh::items`].
    pub fn places(&self, child: Child) -> Range<usize> {
        match child {
            Child::Empty => 0..0,
            Child::Leaf { first, count } => first as usize..(first + count) as usize,
            Child::Inner(node) => {
                let spans = self.nodes[node as usize].children.map(|c| self.places(c));
                let filled = spans.into_iter().filter(|s| !s.is_empty());
                filled.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)).unwrap_or(0..0)
            }
        }
    }

    /// Walks the tree from the root, in a fixed order, with something to carry: `root` at the root, and below it what
    /// `visit` hands to each child.
    ///
    /// `visit(node index, carried)` answers which children to open, bit k for child k, and what each gets. An opened
    /// leaf is given to `leaf(node index, child index, carried)`. `stack` is scratch space, kept by the caller so that
    /// many walks share it.
    pub fn traverse<C: Copy>(
        &self,
        stack: &mut Stack<C>,
        root: C,
        visit: impl FnMut(usize, C) -> (u32, [C; WIDTH]),
        leaf: impl FnMut(usize, usize, C),
    ) {
        if !self.items.is_empty() {
            self.traverse_below(0, stack, root, visit, leaf);
        }
    }

    /// [`Bvh::traverse`] of the part of the tree below `node`.
    pub fn traverse_below<C: Copy>(
        &self,
        node: u32,
        stack: &mut Stack<C>,
        root: C,
        mut visit: impl FnMut(usize, C) -> (u32, [C; WIDTH]),
        mut leaf: impl FnMut(usize, usize, C),
    ) {
        stack.clear();
        stack.push((node, root));
        while let Some((index, carried)) = stack.pop() {
            let (mut open, below) = visit(index as usize, carried);
            while open != 0 {
                let k = open.trailing_zeros() as usize;
                open &= open - 1;
                match self.nodes[index as usize].children[k] {
                    Child::Empty => {}
                    Child::Inner(node) => stack.push((node, below[k])),
                    Child::Leaf { .. } => leaf(index as usize, k, below[k]),
                }
            }
        }
    }

    /// Calls `found` with the number of every item in a leaf whose box satisfies `wanted`; boxes above it must satisfy
    /// it too.
    pub fn for_each(&self, wanted: impl Fn(&Aabb) -> bool, mut found: impl FnMut(usize)) {
        let visit = |index: usize, ()| {
            let node = &self.nodes[index];
            ((0..WIDTH).filter(|&k| wanted(&node.bounds[k])).fold(0, |mask, k| mask | 1 << k), [(); WIDTH])
        };
        self.traverse(&mut Vec::new(), (), visit, |node, k, ()| {
            let places = self.places(self.nodes[node].children[k]);
            self.items[places].iter().for_each(|&item| found(item as usize));
        });
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.items[..])
    }
}
