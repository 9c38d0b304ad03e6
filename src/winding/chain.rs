//! The net boundary chain ∂M of a soup: the edges that its triangles run through more often in one direction than in the
//! other, vertices welded by exact position. A closed, consistently oriented soup has none.
//!
//! Linear in the number of triangles: vertices and edges are distributed over buckets that fit in a cache, never kept in
//! one large hash map.
use super::buckets::{Buckets, counting_sort};
use crate::data::{Sets, TriangleSoup, map_tasks, sorted_pairs};
use crate::math::Vec3;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Vertices that a bucket holds on average: a table of them fits in the first-level cache.
const BUCKET_BITS: u32 = 11;

/// For each vertex, the lowest index of those in exactly the same place; −0 is 0.
pub fn weld(positions: &[Vec3]) -> Vec<u32> {
    let bits = (positions.len() >> BUCKET_BITS).max(1).ilog2();
    let vertices: Buckets<(u32, u32)> = Buckets::collect(positions.len(), 1 << bits, |i, put| {
        let hash = hash(positions[i]);
        put((hash >> 32 >> (32 - bits)) as usize, (hash as u32, i as u32));
    });
    let first: Vec<AtomicU32> = (0..positions.len()).map(|_| AtomicU32::new(0)).collect();
    map_tasks(1 << bits, |bucket| {
        // Open addressing, half full: the slots of a bucket hold the tag of a hash and the first vertex that had it.
        let mask = (2 * vertices.count(bucket)).next_power_of_two() - 1;
        let mut slots = vec![(0, u32::MAX); mask + 1];
        for (tag, vertex) in vertices.bucket(bucket) {
            let mut slot = tag as usize & mask;
            let place = |v: u32| positions[v as usize];
            while slots[slot].1 != u32::MAX && (slots[slot].0 != tag || place(slots[slot].1) != place(vertex))
            {
                slot = (slot + 1) & mask;
            }
            if slots[slot].1 == u32::MAX {
                slots[slot] = (tag, vertex);
            }
            first[vertex as usize].store(slots[slot].1, Relaxed);
        }
    });
    first.into_iter().map(AtomicU32::into_inner).collect()
}

/// Mixes all bits of a position; equal positions, −0 and 0 too, give equal numbers.
fn hash(p: Vec3) -> u64 {
    const ODD: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0xc2b2_ae3d_27d4_eb4f, 0x1656_67b1_9e37_79f9];
    let mix = |h: u64, x: f64, odd: u64| {
        let h = (h ^ (x + 0.0).to_bits()).wrapping_mul(odd);
        h ^ (h >> 32)
    };
    mix(mix(mix(0, p.x, ODD[0]), p.y, ODD[1]), p.z, ODD[2])
}

/// Lower vertices of edges that a bucket holds.
const EDGE_BUCKET_BITS: u32 = 12;

/// The net boundary chain, as directed edges between welded vertices, sorted by their lower and then their higher vertex;
/// an edge with a net count of n comes n times. Triangles without area take part, edges without length do not.
pub fn net_edges(soup: &TriangleSoup, welded: &[u32]) -> Vec<[u32; 2]> {
    let buckets = (welded.len() >> EDGE_BUCKET_BITS) + 1;
    let edges: Buckets<(u32, u32, bool)> = Buckets::collect(soup.len(), buckets, |t, put| {
        let [a, b, c] = soup.triangles()[t].map(|i| welded[i as usize]);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (lower, higher) = (from.min(to), from.max(to));
            if lower != higher {
                put((lower >> EDGE_BUCKET_BITS) as usize, (lower, higher, from < to));
            }
        }
    });
    map_tasks(buckets, |bucket| net_of_bucket(&edges, bucket)).concat()
}

fn net_of_bucket(edges: &Buckets<(u32, u32, bool)>, bucket: usize) -> Vec<[u32; 2]> {
    let first = (bucket as u32) << EDGE_BUCKET_BITS;
    let found: Vec<(u32, u64)> = (edges.bucket(bucket))
        .map(|(lower, higher, upward)| (lower - first, u64::from(higher) << 1 | u64::from(upward)))
        .collect();
    let (mut halves, starts) = counting_sort(&found, 1 << EDGE_BUCKET_BITS);
    let mut net = Vec::new();
    for local in 0..1usize << EDGE_BUCKET_BITS {
        let around = &mut halves[starts[local] as usize..starts[local + 1] as usize];
        around.sort_unstable();
        for same in around.chunk_by(|a, b| a >> 1 == b >> 1) {
            let upward = same.iter().filter(|half| **half & 1 == 1).count();
            let downward = same.len() - upward;
            let (lower, higher) = (first + local as u32, (same[0] >> 1) as u32);
            let edge = if upward > downward { [lower, higher] } else { [higher, lower] };
            net.extend(std::iter::repeat_n(edge, upward.abs_diff(downward)));
        }
    }
    net
}

/// The chain as simple cycles: closed walks that visit no vertex twice. Cut off a walk whenever it comes back to one of
/// its vertices; as many edges of a net chain leave a vertex as enter it, so a walk never gets stuck.
pub fn cycles(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let outgoing = sorted_pairs(edges.iter().copied());
    let mut vertices: Vec<u32> = outgoing.iter().map(|e| e[0]).collect();
    vertices.dedup();
    let local = |v: u32| vertices.binary_search(&v).expect("every vertex of a cycle is left");
    let ends: Vec<u32> = outgoing.iter().map(|e| local(e[1]) as u32).collect();
    let mut next: Vec<usize> =
        vertices.iter().map(|v| outgoing.partition_point(|e| e[0] < *v)).chain([edges.len()]).collect();
    let last = next[1..].to_vec();

    const OFF: usize = usize::MAX;
    let mut place = vec![OFF; vertices.len()];
    let mut found = Vec::new();
    for start in 0..vertices.len() {
        let mut walk = vec![start];
        place[start] = 0;
        while let Some(&at) = walk.last() {
            if next[at] == last[at] {
                break; // only ever at the start, with nothing left of the walk
            }
            let to = ends[next[at]] as usize;
            next[at] += 1;
            if place[to] == OFF {
                place[to] = walk.len();
                walk.push(to);
            } else {
                let closed = walk.split_off(place[to] + 1);
                closed.iter().for_each(|v| place[*v] = OFF);
                found.push(std::iter::once(to).chain(closed).map(|v| vertices[v]).collect());
            }
        }
        place[start] = OFF;
    }
    found
}

/// For each vertex, the lowest vertex of its component: two triangles belong together if a chain of triangles that share
/// welded vertices leads from one to the other.
pub fn components(soup: &TriangleSoup, welded: &[u32]) -> Vec<u32> {
    let mut sets = Sets::of(welded.to_vec());
    soup.triangles().iter().for_each(|corners| sets.join_all(*corners));
    sets.into_least()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loose(faces: &[[Vec3; 3]]) -> TriangleSoup {
        let triangles = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        TriangleSoup::new(faces.concat(), triangles).unwrap()
    }

    #[test]
    fn equal_positions_get_the_lowest_index() {
        let place = |i: usize| Vec3::new((i % 17) as f64, (i % 23) as f64, -((i % 2) as f64) * 0.0);
        let positions: Vec<Vec3> = (0..30_000).map(place).collect();
        let welded = weld(&positions);
        for (i, label) in welded.iter().enumerate() {
            assert_eq!(*label as usize, i % (17 * 23), "vertex {i}");
        }
        assert!(weld(&[]).is_empty());
    }

    #[test]
    fn opposite_edges_cancel_and_repeated_ones_add_up() {
        let [o, x, y, z] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
        let chain = |faces: &[[Vec3; 3]]| {
            let soup = loose(faces);
            let mut edges: Vec<[[f64; 3]; 2]> = net_edges(&soup, &weld(soup.positions()))
                .into_iter()
                .map(|e| e.map(|v| soup.positions()[v as usize].to_array()))
                .collect();
            edges.sort_by(|a, b| a.partial_cmp(b).unwrap());
            edges
        };
        assert!(chain(&faces).is_empty());
        assert!(chain(&[[-o, y, x], [o, x, z], [-o, z, y], [x, y, z]]).is_empty());
        let [x, y, z] = [x, y, z].map(|p| p.to_array());
        assert_eq!(chain(&faces[..3]), [[z, y], [y, x], [x, z]]);
        let twice = chain(&[&faces[..3], &faces[..3]].concat());
        assert_eq!(twice, [[z, y], [z, y], [y, x], [y, x], [x, z], [x, z]]);
        assert!(chain(&[[o, o, o], [o, Vec3::X, o]]).is_empty());
    }

    #[test]
    fn a_figure_of_eight_becomes_two_cycles() {
        let edges = [[5, 7], [7, 9], [9, 5], [5, 1], [1, 2], [2, 5]];
        let mut found = cycles(&edges);
        found.iter_mut().for_each(|c| {
            let lowest = (0..c.len()).min_by_key(|&i| c[i]).unwrap();
            c.rotate_left(lowest);
        });
        found.sort();
        assert_eq!(found, [vec![1, 2, 5], vec![5, 7, 9]]);
        let doubled = cycles(&[edges, edges].concat());
        assert_eq!(doubled.iter().map(Vec::len).sum::<usize>(), 12);
        assert!(doubled.iter().all(|c| c.len() == 3));
    }

    #[test]
    fn triangles_that_share_a_place_are_one_component() {
        let shift = Vec3::splat(9.0);
        let [o, x, y, z] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let soup = loose(&[[o, x, y], [o + shift, x + shift, y + shift], [y, z, -z]]);
        let roots = components(&soup, &weld(soup.positions()));
        assert_eq!(roots[soup.triangles()[2][1] as usize], roots[0]);
        assert_ne!(roots[3], roots[0]);
    }
}
