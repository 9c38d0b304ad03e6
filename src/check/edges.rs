//! Edges and vertices at which faces do not meet as they should.
use super::report::{Boundary, List, Loop};
use crate::data::{Edge, Topology, TriangleSoup, map_items, next_side};
use crate::math::Vec3;

pub fn edges_where(topology: &Topology, limit: usize, wanted: impl Fn(&Edge) -> bool) -> List<[u32; 2]> {
    List::new(topology.edges.iter().filter(|edge| wanted(edge)).map(|edge| edge.ends), limit)
}

/// Whether the two faces of an edge run along it in the same direction.
pub fn is_inconsistent(topology: &Topology, edge: &Edge) -> bool {
    edge.count == 2 && {
        let sides = topology.sides(edge);
        topology.ends(sides[0]) == topology.ends(sides[1])
    }
}

/// Vertices whose faces fall apart into several fans, joined across any edges.
pub fn non_manifold_vertices(topology: &Topology, vertices: usize, limit: usize) -> List<u32> {
    let mut fans = topology.fans(true);
    // The first fan found at each vertex.
    let mut first = vec![Topology::NONE; vertices];
    let mut is_shared = vec![false; vertices];
    for t in (0..topology.corners.len()).filter(|t| topology.is_kept(*t)) {
        for (k, vertex) in topology.corners[t].iter().enumerate() {
            let (fan, first) = (fans.find((3 * t + k) as u32), &mut first[*vertex as usize]);
            if *first == Topology::NONE {
                *first = fan;
            }
            is_shared[*vertex as usize] |= *first != fan;
        }
    }
    List::new((0..vertices as u32).filter(|v| is_shared[*v as usize]), limit)
}

/// The loops of edges with a single face: around the end of an edge, the next is the other end of the fan of faces there, so
/// that two holes that touch in a vertex stay apart.
pub fn boundary(topology: &Topology, soup: &TriangleSoup, limit: usize) -> Boundary {
    let open: Vec<u32> =
        topology.edges.iter().filter(|edge| edge.count == 1).map(|edge| topology.sides(edge)[0]).collect();
    let mut fans = topology.fans(false);
    // Two ends of open edges at each fan, or one where the fan ends at an edge of many faces: place in `open`, and which end.
    let mut ends: Vec<(u32, u32)> = Vec::with_capacity(2 * open.len());
    for (place, side) in open.iter().enumerate() {
        ends.push((fans.find(*side), 2 * place as u32));
        ends.push((fans.find(next_side(*side)), 2 * place as u32 + 1));
    }
    ends.sort_unstable();
    let mut across = vec![Topology::NONE; ends.len()];
    for pair in ends.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 2) {
        across[pair[0].1 as usize] = pair[1].1;
        across[pair[1].1 as usize] = pair[0].1;
    }
    let vertex = |end: u32| topology.ends(open[end as usize / 2])[end as usize % 2];
    let mut is_seen = vec![false; open.len()];
    let mut loops = Vec::new();
    // Walks that end somewhere begin there; what is left goes around.
    let starts = (0..ends.len() as u32).filter(|end| across[*end as usize] == Topology::NONE);
    for start in starts.chain((0..open.len() as u32).map(|place| 2 * place)) {
        if is_seen[start as usize / 2] {
            continue;
        }
        let (mut at, mut vertices) = (start, vec![vertex(start)]);
        let is_closed = loop {
            is_seen[at as usize / 2] = true;
            let end = at ^ 1;
            match across[end as usize] {
                next if next == start => break true,
                Topology::NONE => {
                    vertices.push(vertex(end));
                    break false;
                }
                next => {
                    vertices.push(vertex(next));
                    at = next;
                }
            }
        };
        loops.push((vertices, is_closed));
    }
    let mut loops = map_items(loops.len(), |k| measured(&loops[k].0, loops[k].1, soup.positions(), limit));
    loops.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.vertices.cmp(&b.vertices)));
    let length = loops.iter().map(|l| l.length).sum();
    Boundary { edges: open.len(), length, loops: List::new(loops, limit) }
}

fn measured(vertices: &[u32], is_closed: bool, positions: &[Vec3], limit: usize) -> Loop {
    let place = |k: usize| positions[vertices[k % vertices.len()] as usize];
    let edges = vertices.len() - usize::from(!is_closed);
    let length = (0..edges).map(|k| place(k).distance(place(k + 1))).sum();
    let fan = |k: usize| (place(k) - place(0)).cross(place(k + 1) - place(0));
    let area = if is_closed { 0.5 * (1..edges).map(fan).sum::<Vec3>().length() } else { 0.0 };
    Loop { edges, length, area, is_closed, vertices: vertices[..vertices.len().min(limit)].to_vec() }
}
