//! Linear build: sort along the Morton curve, then split where the highest bit of the code changes.
use super::{Bvh, Child, Node, WIDTH, morton_code, sorted_codes};
use crate::data::{map_items, set_each};
use crate::math::Aabb;
use std::ops::Range;

/// Nodes that one task fits boxes to.
const NODES_PER_TASK: usize = 256;

impl Bvh {
    /// Builds the hierarchy over `boxes`; leaves hold at most `leaf_size` (1 or more) of them.
    ///
    /// The same boxes give the same tree whatever the number of threads. Costs one sort.
    pub fn build(boxes: &[Aabb], leaf_size: usize) -> Bvh {
        let bounds = Aabb::around(boxes.iter().map(|b| b.center()));
        let codes = map_items(boxes.len(), |item| morton_code(boxes[item].center(), &bounds));
        let mut bvh = Bvh::along_curve(codes, leaf_size);
        fit_boxes(&mut bvh.nodes, &bvh.levels, &bvh.items, boxes);
        bvh
    }

    /// The hierarchy over items with these codes, without boxes.
    pub fn along_curve(codes: Vec<u64>, leaf_size: usize) -> Bvh {
        let (codes, items) = sorted_codes(codes);
        let (nodes, levels) = split_levels(&codes, leaf_size.max(1));
        Bvh { nodes, levels, items }
    }
}

/// Makes the nodes level by level, so that equal input gives equal numbering.
fn split_levels(codes: &[u64], leaf_size: usize) -> (Vec<Node>, Vec<Range<usize>>) {
    let mut nodes = Vec::new();
    let mut levels = Vec::new();
    let whole = 0..codes.len();
    let mut frontier = if codes.is_empty() { vec![] } else { vec![whole] };
    while !frontier.is_empty() {
        let start = nodes.len();
        let mut next = start + frontier.len();
        let families: Vec<_> = map_items(frontier.len(), |k| split(codes, &frontier[k], leaf_size));
        let mut below = Vec::new();
        for family in families {
            let mut children = [Child::Empty; WIDTH];
            for (child, range) in children.iter_mut().zip(family.into_iter().filter(|r| !r.is_empty())) {
                *child = if range.len() <= leaf_size {
                    Child::Leaf { first: range.start as u32, count: range.len() as u32 }
                } else {
                    next += 1;
                    below.push(range);
                    Child::Inner(next as u32 - 1)
                };
            }
            nodes.push(Node { children, bounds: [Aabb::EMPTY; WIDTH] });
        }
        levels.push(start..nodes.len());
        frontier = below;
    }
    (nodes, levels)
}

/// Cuts a range into at most four in order, the longest first, until they are short enough for leaves.
fn split(codes: &[u64], range: &Range<usize>, leaf_size: usize) -> [Range<usize>; WIDTH] {
    let mut parts = [range.clone(), 0..0, 0..0, 0..0];
    for used in 1..WIDTH {
        let longest = (0..used).rev().max_by_key(|&k| parts[k].len()).expect("a part is there");
        if parts[longest].len() <= leaf_size {
            break;
        }
        let cut = cut_at_highest_bit(codes, &parts[longest]);
        parts[longest + 1..=used].rotate_right(1);
        parts[longest + 1] = cut..parts[longest].end;
        parts[longest].end = cut;
    }
    parts
}

/// Where the highest bit in which the codes of a range differ turns from 0 to 1; the middle when all are equal.
pub fn cut_at_highest_bit(codes: &[u64], range: &Range<usize>) -> usize {
    let differ = codes[range.start] ^ codes[range.end - 1];
    if differ == 0 {
        return range.start + range.len() / 2;
    }
    let bit = 1 << (63 - differ.leading_zeros());
    range.start + codes[range.clone()].partition_point(|code| code & bit == 0)
}

fn fit_boxes(nodes: &mut [Node], levels: &[Range<usize>], items: &[u32], boxes: &[Aabb]) {
    for level in levels.iter().rev() {
        let (upper, lower) = nodes.split_at_mut(level.end);
        set_each(&mut upper[level.clone()], NODES_PER_TASK, |_, node| {
            for (bounds, child) in node.bounds.iter_mut().zip(node.children) {
                *bounds = match child {
                    Child::Empty => Aabb::EMPTY,
                    Child::Inner(index) => {
                        let below = &lower[index as usize - level.end];
                        below.bounds.iter().copied().fold(Aabb::EMPTY, Aabb::union)
                    }
                    Child::Leaf { first, count } => {
                        let leaf = &items[first as usize..(first + count) as usize];
                        leaf.iter().map(|&i| boxes[i as usize]).fold(Aabb::EMPTY, Aabb::union)
                    }
                };
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    fn scattered_boxes(count: usize) -> Vec<Aabb> {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / (1u64 << 24) as f64
        };
        (0..count)
            .map(|_| {
                let p = Vec3::new(random(), random(), random());
                Aabb { min: p, max: p + 0.1 * random() * Vec3::ONE }
            })
            .collect()
    }

    #[test]
    fn every_item_is_in_exactly_one_leaf_and_inside_every_box_above() {
        for count in [0, 1, 3, 8, 9, 500] {
            let boxes = scattered_boxes(count);
            let bvh = Bvh::build(&boxes, 4);
            let mut seen = vec![0; count];
            bvh.for_each(|_| true, |item| seen[item] += 1);
            assert_eq!(seen, vec![1; count]);
            for node in bvh.nodes() {
                for (child, bounds) in node.children.iter().zip(node.bounds) {
                    for &item in &bvh.items()[bvh.places(*child)] {
                        assert_eq!(bounds.union(boxes[item as usize]), bounds);
                    }
                }
            }
        }
    }

    #[test]
    fn equal_boxes_split_evenly() {
        let bvh = Bvh::build(&vec![Aabb { min: Vec3::ONE, max: Vec3::ONE }; 1000], 4);
        assert!(bvh.levels().len() <= 6, "{:?}", bvh.levels());
    }

    #[test]
    fn overlap_search_equals_brute_force() {
        let boxes = scattered_boxes(300);
        let overlaps = |b: &Aabb| b.min.x <= 0.5 && 0.5 <= b.max.x;
        let mut found = Vec::new();
        Bvh::build(&boxes, 4).for_each(overlaps, |i| found.push(i));
        found.retain(|&i| overlaps(&boxes[i]));
        found.sort();
        let expected: Vec<usize> = (0..300).filter(|&i| overlaps(&boxes[i])).collect();
        assert_eq!(found, expected);
    }
}
