//! What hangs below each cluster of a hierarchy.
use crate::bvh::{Bvh, Child};
use std::ops::Range;

/// What a cluster holds: items of the tree's order, or clusters.
#[derive(Clone, Copy)]
pub struct Link {
    first: u32,
    /// The highest bit is set for items.
    count: u32,
}

const LEAF: u32 = 1 << 31;

impl Link {
    pub fn is_leaf(&self) -> bool {
        self.count & LEAF != 0
    }

    pub fn range(&self) -> Range<usize> {
        self.first as usize..(self.first + (self.count & !LEAF)) as usize
    }
}

/// Links of all clusters, the children of one node after those of another, and the ranges of the levels.
pub fn link(bvh: &Bvh) -> (Vec<Link>, Vec<Range<usize>>) {
    let mut first_child = Vec::with_capacity(bvh.nodes().len());
    let mut count = 0;
    for node in bvh.nodes() {
        first_child.push(count);
        count += node.children.iter().filter(|c| **c != Child::Empty).count() as u32;
    }
    first_child.push(count);
    let links = (bvh.nodes().iter().flat_map(|node| node.children))
        .filter_map(|child| match child {
            Child::Empty => None,
            Child::Leaf { first, count } => Some(Link { first, count: count | LEAF }),
            Child::Inner(node) => {
                let (first, end) = (first_child[node as usize], first_child[node as usize + 1]);
                Some(Link { first, count: end - first })
            }
        })
        .collect();
    let place = |node: usize| first_child[node] as usize;
    let levels = bvh.levels().iter().map(|l| place(l.start)..place(l.end)).collect();
    (links, levels)
}

/// The items below each cluster. Children come after their parents.
pub fn spans(links: &[Link]) -> Vec<Range<usize>> {
    let mut spans = vec![0..0; links.len()];
    for (at, link) in links.iter().enumerate().rev() {
        let range = link.range();
        spans[at] = if link.is_leaf() { range } else { spans[range.start].start..spans[range.end - 1].end };
    }
    spans
}
