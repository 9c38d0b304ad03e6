//! Faces that go through each other or lie on each other.
use super::faces::Face;
use crate::bvh::Bvh;
use crate::data::{Cancelled, Monitor, TriangleSoup, map_tasks};
use crate::math::{Aabb, triangles_meet};

/// Faces that one task looks around.
const FACES: usize = 512;
/// Tasks between two reports.
const TASKS: usize = 64;

/// All pairs of faces whose insides meet, the lower number first, ascending; `first_copies` names the faces with the same
/// corners, which are no news.
pub fn crossings(
    soup: &TriangleSoup,
    faces: &[Face],
    first_copies: &[u32],
    bvh: &Bvh,
    limit: usize,
    monitor: &dyn Monitor,
) -> Result<(usize, Vec<[u32; 2]>), Cancelled> {
    let tasks = soup.len().div_ceil(FACES);
    let is_plain = |t: usize| !faces[t].is_degenerate && first_copies[t] == t as u32;
    let (mut count, mut list) = (0, Vec::new());
    for first in (0..tasks).step_by(TASKS) {
        monitor.report(first as f64 / tasks as f64, "self-intersections")?;
        // Neighbours in the order of the tree meet the same nodes.
        let found = map_tasks(TASKS.min(tasks - first), |task| {
            let start = (first + task) * FACES;
            let mut pairs = Vec::new();
            for t in bvh.items()[start..soup.len().min(start + FACES)].iter().map(|t| *t as usize) {
                if !is_plain(t) {
                    continue;
                }
                let corners = soup.corners(t);
                let around = Aabb::around(corners);
                bvh.for_each(
                    |bounds| bounds.overlaps(&around),
                    |other| {
                        if t < other && is_plain(other) && triangles_meet(corners, soup.corners(other)) {
                            pairs.push([t as u32, other as u32]);
                        }
                    },
                );
            }
            pairs
        });
        count += found.iter().map(Vec::len).sum::<usize>();
        list.extend(found.into_iter().flatten());
        keep_least(&mut list, limit);
    }
    list.sort_unstable();
    Ok((count, list))
}

/// The lowest pairs stay, once there are many more.
fn keep_least(list: &mut Vec<[u32; 2]>, limit: usize) {
    if list.len() > limit {
        list.sort_unstable();
        list.truncate(limit);
    }
}
