//! Where planes cut triangles: directed segments, the inside on their left.
//!
//! Half open: a vertex on the plane counts as below it, so that a plane through vertices, edges or whole faces cuts as one an
//! infinitely small step above does. Each crossed edge gives one point, from its lower end to its upper one, so that triangles that
//! share an edge get the same bits.
use crate::data::{TriangleSoup, map_items};
use crate::math::{Vec2, Vec3};
use std::ops::Range;

pub(super) type Segment = [Vec2; 2];

/// Heights that are cut together: triangles are looked for once for all of them.
pub(super) const BLOCK: usize = 8;
/// The node of triangles that meet no height.
const NOWHERE: u32 = 0;

/// Which triangles meet which block of heights.
///
/// Blocks are the leaves of a binary tree, and each triangle is kept once, at the lowest node that is above all blocks it meets: so
/// what is kept does not grow with the heights. A block's triangles are at the nodes on its way to the root, with some that do not
/// meet it.
pub(super) struct Sections<'a> {
    soup: &'a TriangleSoup,
    /// Ascending.
    heights: Vec<f64>,
    /// Of the leaves, which are the last nodes; the root is node 1.
    first_leaf: usize,
    /// Where the triangles of each node begin, and where the last ones end.
    starts: Vec<u32>,
    /// By node, ascending.
    triangles: Vec<u32>,
}

impl<'a> Sections<'a> {
    /// `heights` ascend.
    pub fn new(soup: &'a TriangleSoup, heights: Vec<f64>) -> Sections<'a> {
        let first_leaf = heights.len().div_ceil(BLOCK).next_power_of_two();
        let nodes = map_items(soup.len(), |t| {
            let range = cut(&heights, soup.corners(t).map(|p| p.z));
            if range.is_empty() { NOWHERE } else { node(first_leaf, range) as u32 }
        });
        let mut starts = vec![0_u32; 2 * first_leaf + 1];
        nodes.iter().for_each(|node| starts[*node as usize + 1] += 1);
        (1..starts.len()).for_each(|node| starts[node] += starts[node - 1]);
        let mut next = starts.clone();
        let mut triangles = vec![0; soup.len()];
        for (t, node) in nodes.iter().enumerate() {
            let place = &mut next[*node as usize];
            triangles[*place as usize] = t as u32;
            *place += 1;
        }
        Sections { soup, heights, first_leaf, starts, triangles }
    }

    pub fn height(&self, place: usize) -> f64 {
        self.heights[place]
    }

    /// All triangles that meet a block, and some that do not; ascending.
    fn near(&self, block: usize) -> Vec<u32> {
        let mut near = Vec::new();
        let mut node = self.first_leaf + block;
        while node > 0 {
            near.extend(&self.triangles[self.starts[node] as usize..self.starts[node + 1] as usize]);
            node /= 2;
        }
        near.sort();
        near
    }

    /// The segments at each height of a block, in the order of the triangles.
    pub fn block(&self, block: usize) -> Vec<Vec<Segment>> {
        let first = block * BLOCK;
        let heights = &self.heights[first..self.heights.len().min(first + BLOCK)];
        let mut segments = vec![Vec::new(); heights.len()];
        for t in self.near(block) {
            let corners = self.soup.corners(t as usize);
            for k in cut(heights, corners.map(|p| p.z)) {
                let segment = segment(corners, heights[k]);
                if segment[0] != segment[1] {
                    segments[k].push(segment);
                }
            }
        }
        segments
    }
}

/// The lowest node above the blocks of these heights.
fn node(first_leaf: usize, heights: Range<usize>) -> usize {
    let (first, last) = (heights.start / BLOCK, (heights.end - 1) / BLOCK);
    let levels = usize::BITS - (first ^ last).leading_zeros();
    (first_leaf + first) >> levels
}

/// The heights that cut a triangle with corners at these.
fn cut(heights: &[f64], z: [f64; 3]) -> Range<usize> {
    let (low, high) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
    let first = heights.partition_point(|h| *h < low);
    let count = heights[first..].iter().take(4).take_while(|h| **h < high).count();
    let end = if count < 4 { first + count } else { heights.partition_point(|h| *h < high) };
    first..end
}

/// The segment of a triangle that has corners on both sides of a plane.
pub(super) fn segment(corners: [Vec3; 3], z: f64) -> Segment {
    let is_below = corners.map(|p| p.z <= z);
    let mut ends = [Vec2::ZERO; 2];
    for k in 0..3 {
        let next = (k + 1) % 3;
        if is_below[k] != is_below[next] {
            let (low, high) = if is_below[k] { (k, next) } else { (next, k) };
            // The surface is run through from where its edges go down to where they go up.
            ends[usize::from(is_below[k])] = at_height(corners[low], corners[high], z);
        }
    }
    ends
}

/// Where an edge from below a plane, or on it, to above meets it.
fn at_height(low: Vec3, high: Vec3, z: f64) -> Vec2 {
    let share = (z - low.z) / (high.z - low.z);
    // Zeros without a sign, so that equal points have equal bits.
    low.truncate() + share * (high - low).truncate() + Vec2::ZERO
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inside_is_on_the_left() {
        // On a wall that faces +x the section runs along +y.
        let wall = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(1.0, 0.5, 1.0)];
        assert_eq!(segment(wall, 0.5), [Vec2::new(1.0, 0.25), Vec2::new(1.0, 0.75)]);
    }

    #[test]
    fn blocks_meet_the_triangles_at_nodes_above_them() {
        //       1
        //    2     3
        //   4 5   6 7    blocks 0 to 3
        let cases = [(0..1, 4), (7..8, 4), (7..9, 2), (15..17, 1), (0..32, 1), (24..32, 7), (17..26, 3)];
        for (heights, expected) in cases {
            assert_eq!(node(4, heights), expected);
        }
        assert_eq!(node(1, 0..8), 1, "a single block");
    }

    #[test]
    fn planes_through_vertices_are_half_open() {
        let heights: Vec<f64> = (0..40).map(|k| 0.5 * f64::from(k)).collect();
        assert_eq!(cut(&heights, [1.0, 2.0, 1.5]), 2..4);
        assert_eq!(cut(&heights, [1.0, 1.0, 1.0]), 2..2, "faces in the plane have no section");
        assert_eq!(cut(&heights, [-1.0, 9.6, 3.0]), 0..20);
        assert_eq!(cut(&heights, [50.0, 60.0, 51.0]), 40..40);
    }
}
