//! Where planes cut triangles: directed segments, the inside on their left.
//!
//! Half open: a vertex on the plane counts as below it, so that a plane through vertices, edges or whole faces cuts as one an
//! infinitely small step above does. Each crossed edge gives one point, from its lower end to its upper one, so that triangles that
//! share an edge get the same bits.
use crate::data::{TriangleSoup, map_tasks};
use crate::math::{Vec2, Vec3};
use std::ops::Range;

pub(super) type Segment = [Vec2; 2];

/// Heights that are cut together: triangles are looked for once for all of them.
pub(super) const BLOCK: usize = 8;
/// Triangles that a task looks at.
const TRIANGLES_PER_TASK: usize = 1 << 16;

/// Which triangles meet which block of heights.
pub(super) struct Sections<'a> {
    soup: &'a TriangleSoup,
    /// Ascending.
    heights: Vec<f64>,
    /// By task, block and triangle: the number of the block, and that of the triangle.
    of_blocks: Vec<Vec<u32>>,
}

impl<'a> Sections<'a> {
    /// `heights` ascend.
    pub fn new(soup: &'a TriangleSoup, heights: Vec<f64>) -> Sections<'a> {
        let blocks = heights.len().div_ceil(BLOCK);
        let tasks = soup.len().div_ceil(TRIANGLES_PER_TASK);
        let parts = map_tasks(tasks, |task| {
            let first = task * TRIANGLES_PER_TASK;
            let mut met = vec![Vec::new(); blocks];
            for t in first..soup.len().min(first + TRIANGLES_PER_TASK) {
                let range = cut(&heights, soup.corners(t).map(|p| p.z));
                if !range.is_empty() {
                    (range.start / BLOCK..=(range.end - 1) / BLOCK).for_each(|b| met[b].push(t as u32));
                }
            }
            met
        });
        let mut of_blocks = vec![Vec::new(); blocks];
        for part in parts {
            of_blocks.iter_mut().zip(part).for_each(|(all, some): (&mut Vec<u32>, _)| all.extend(some));
        }
        Sections { soup, heights, of_blocks }
    }

    pub fn height(&self, place: usize) -> f64 {
        self.heights[place]
    }

    /// The segments at each height of a block, in the order of the triangles.
    pub fn block(&self, block: usize) -> Vec<Vec<Segment>> {
        let first = block * BLOCK;
        let heights = &self.heights[first..self.heights.len().min(first + BLOCK)];
        let mut segments = vec![Vec::new(); heights.len()];
        for &t in &self.of_blocks[block] {
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
    fn planes_through_vertices_are_half_open() {
        let heights: Vec<f64> = (0..40).map(|k| 0.5 * f64::from(k)).collect();
        assert_eq!(cut(&heights, [1.0, 2.0, 1.5]), 2..4);
        assert_eq!(cut(&heights, [1.0, 1.0, 1.0]), 2..2, "faces in the plane have no section");
        assert_eq!(cut(&heights, [-1.0, 9.6, 3.0]), 0..20);
        assert_eq!(cut(&heights, [50.0, 60.0, 51.0]), 40..40);
    }
}
