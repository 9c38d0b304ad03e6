//! Edges of triangles whose corners may coincide.
use crate::data::{by_edge, edge_of_key, ends, sides_by_edge};

/// The sides of triangles with the keys of their edges; those without length are left out.
pub fn sides_with_length(triangles: &[[u32; 3]]) -> Vec<(u64, u32)> {
    sides_by_edge(triangles, |_, [from, to]| from != to)
}

/// The edges that are run through more often in one direction than in the other, in that direction and as often.
pub fn net_edges(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let sides = sides_with_length(triangles);
    let mut net = Vec::new();
    for same in by_edge(&sides) {
        let [lower, higher] = edge_of_key(same[0].0);
        let upward = same.iter().filter(|(_, side)| ends(triangles, *side)[0] == lower).count();
        let downward = same.len() - upward;
        let edge = if upward > downward { [lower, higher] } else { [higher, lower] };
        net.extend(std::iter::repeat_n(edge, upward.abs_diff(downward)));
    }
    net
}
