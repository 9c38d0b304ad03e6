//! What hangs below each cluster of a hierarchy.
use crate::bvh::{Bvh, Child, WIDTH};
use std::ops::Range;

/// What a cluster holds: items of the tree's order, or clusters.
#[derive(Clone, Copy)]
pub struct Link {
    first: u32,
    /// The highest bit is set for items.
    count: u32,
}

const LEAF: u32 = 1 << 31;
/// A split ends a bit of a Morton code or, where all are equal, halves what is left.
const DEEPEST: u8 = 100;

impl Link {
    pub fn is_leaf(&self) -> bool {
        self.count & LEAF != 0
    }

    /// The two numbers that make it.
    pub fn parts(&self) -> [u32; 2] {
        [self.first, self.count]
    }

    /// Of [`Link::parts`]; none where they give no range, or one that is empty.
    pub fn of_parts([first, count]: [u32; 2]) -> Option<Link> {
        let len = count & !LEAF;
        (len > 0 && first.checked_add(len).is_some()).then_some(Link { first, count })
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

/// As [`spans`] of links that may be anything: none unless they are a tree as [`link`] makes it, with `roots` at its top, no
/// deeper than one over Morton codes, of which each item is in one leaf.
pub fn checked_spans(links: &[Link], roots: usize, items: usize) -> Option<Vec<Range<usize>>> {
    // The children of clusters follow each other in the order of the clusters, after the roots.
    let mut next = roots;
    let mut depths = vec![0u8; links.len()];
    let mut held = vec![false; items];
    if (roots == 0) != links.is_empty() || roots > WIDTH {
        return None;
    }
    for (at, link) in links.iter().enumerate() {
        let range = link.range();
        if link.is_leaf() {
            let own = held.get_mut(range)?;
            if own.contains(&true) {
                return None;
            }
            own.fill(true);
        } else {
            if range.start != next || range.len() > WIDTH || depths[at] >= DEEPEST || next <= at {
                return None;
            }
            next = range.end;
            let depth = depths[at] + 1;
            depths.get_mut(range)?.fill(depth);
        }
    }
    if next != links.len() || held.contains(&false) {
        return None;
    }
    let spans = spans(links);
    let is_joined = |link: &Link| {
        let children = &spans[link.range()];
        children.windows(2).all(|pair| pair[0].end == pair[1].start)
    };
    links.iter().all(|link| link.is_leaf() || is_joined(link)).then_some(spans)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn links(parts: &[[u32; 2]]) -> Vec<Link> {
        parts.iter().map(|p| Link::of_parts(*p).unwrap()).collect()
    }

    #[test]
    fn only_trees_have_spans() {
        // Two clusters at the top, the second with two leaves below.
        let good = [[0, LEAF | 3], [2, 2], [3, LEAF | 2], [5, LEAF | 1]];
        assert_eq!(checked_spans(&links(&good), 2, 6), Some(vec![0..3, 3..6, 3..5, 5..6]));
        let bvh = Bvh::along_curve((0..5000u64).map(|i| i.wrapping_mul(0x9e37_79b9) % 4096).collect(), 3);
        let (made, levels) = link(&bvh);
        let found = checked_spans(&made, levels[0].len(), 5000).unwrap();
        assert_eq!(found, spans(&made));
        for (k, bad) in [[0, LEAF | 4], [1, 2], [2, LEAF | 2], [5, LEAF | 2]].into_iter().enumerate() {
            let mut parts = good;
            parts[k] = bad;
            assert_eq!(checked_spans(&links(&parts), 2, 6), None, "{parts:?}");
        }
        assert_eq!(checked_spans(&links(&good), 2, 7), None);
        assert_eq!(checked_spans(&links(&good), 1, 6), None);
        assert_eq!(checked_spans(&[], 0, 0), Some(vec![]));
        assert!(Link::of_parts([u32::MAX, 1]).is_none() && Link::of_parts([3, LEAF]).is_none());
    }
}
