//! Consistent orientation of normals by propagation along a minimum spanning tree of the neighbour graph, whose edges
//! cost 1 − |nᵢ · nⱼ| (Hoppe et al. 1992, *Surface reconstruction from unorganized points*, section 3.3).
use super::neighbours::Neighbourhoods;
use crate::data::{Cancelled, Monitor, ascending, sorted_pairs};
use crate::math::Vec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Flips normals so that neighbours agree. In each connected part the highest point looks up: the surface of a solid
/// faces outward there.
pub(super) fn propagate(
    points: &[Vec3],
    normals: &mut [Vec3],
    neighbourhoods: &Neighbourhoods,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    const REPORT_EVERY: usize = 50_000;
    let graph = symmetric_graph(points.len(), neighbourhoods);
    let mut reached = vec![false; points.len()];
    let mut done = 0;
    for seed in ascending(points.iter().map(|p| -p.z)) {
        if reached[seed as usize] {
            continue;
        }
        if normals[seed as usize].z < 0.0 {
            normals[seed as usize] *= -1.0;
        }
        // Prim's algorithm: the cheapest edge out of what is reached; ties by index, so the result is unique.
        let mut frontier = BinaryHeap::from([Reverse((Cost(0.0), seed, seed))]);
        while let Some(Reverse((_, point, parent))) = frontier.pop() {
            if std::mem::replace(&mut reached[point as usize], true) {
                continue;
            }
            let normal = normals[point as usize];
            if normal.dot(normals[parent as usize]) < 0.0 {
                normals[point as usize] = -normal;
            }
            done += 1;
            if done % REPORT_EVERY == 1 {
                monitor.report(done as f64 / points.len() as f64, "orientation")?;
            }
            for &next in graph.of(point).iter().filter(|&&next| !reached[next as usize]) {
                let cost = Cost(1.0 - normal.dot(normals[next as usize]).abs());
                frontier.push(Reverse((cost, next, point)));
            }
        }
    }
    monitor.report(1.0, "orientation")
}

/// An edge's cost, ordered.
#[derive(Clone, Copy, PartialEq)]
struct Cost(f64);

impl Eq for Cost {}

impl PartialOrd for Cost {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Cost {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Adjacency lists, one after the other.
struct Graph {
    starts: Vec<usize>,
    targets: Vec<u32>,
}

impl Graph {
    fn of(&self, point: u32) -> &[u32] {
        &self.targets[self.starts[point as usize]..self.starts[point as usize + 1]]
    }
}

/// The neighbour graph with every edge both ways.
fn symmetric_graph(count: usize, neighbourhoods: &Neighbourhoods) -> Graph {
    let both_ways = |i: u32| neighbourhoods.of(i as usize).iter().flat_map(move |&j| [[i, j], [j, i]]);
    let mut edges = sorted_pairs((0..count as u32).flat_map(both_ways));
    edges.dedup();
    let starts = (0..=count as u32).map(|i| edges.partition_point(|e| e[0] < i)).collect();
    Graph { starts, targets: edges.into_iter().map(|e| e[1]).collect() }
}
