//! The points on edges of triangles, in their order: all triangles of an edge see the same.
use super::points::Points;
use super::triangulate::SIDE;
use rustc_hash::{FxHashMap, FxHashSet};

/// For edges, lower vertex first: the points between their ends, in order from the lower one, and how many steps of [`SIDE`]
/// each is along, all different.
#[derive(Default)]
pub struct Edges {
    chains: FxHashMap<[u32; 2], Vec<(u32, i64)>>,
}

impl Edges {
    /// Adds points to edges; gives the edges that have new ones.
    pub fn add(&mut self, mut found: Vec<([u32; 2], u32)>, points: &Points) -> FxHashSet<[u32; 2]> {
        found.sort_unstable();
        found.dedup();
        let mut changed = FxHashSet::default();
        for of_edge in found.chunk_by(|a, b| a.0 == b.0) {
            let edge = of_edge[0].0;
            let known: Vec<u32> = self.chain(edge).iter().map(|(point, _)| *point).collect();
            let is_new = |point: &u32| !edge.contains(point) && !known.contains(point);
            let new: Vec<u32> = of_edge.iter().map(|(_, point)| *point).filter(is_new).collect();
            if !new.is_empty() {
                let all = known.into_iter().chain(new);
                self.chains.insert(edge, in_steps(edge, all, points));
                changed.insert(edge);
            }
        }
        changed
    }

    /// The edges that have points.
    pub fn all(&self) -> FxHashSet<[u32; 2]> {
        self.chains.keys().copied().collect()
    }

    pub fn chain(&self, edge: [u32; 2]) -> &[(u32, i64)] {
        self.chains.get(&edge).map_or(&[], |chain| chain)
    }

    /// Whether a point lies on an edge, its ends included.
    pub fn holds(&self, edge: [u32; 2], point: u32) -> bool {
        edge.contains(&point) || self.chain(edge).iter().any(|(on, _)| *on == point)
    }
}

fn in_steps(edge: [u32; 2], of_edge: impl Iterator<Item = u32>, points: &Points) -> Vec<(u32, i64)> {
    let side = SIDE as f64;
    let mut placed: Vec<(f64, f64, u32)> = of_edge
        .map(|point| {
            let share = points.share_at(edge, point);
            (share.high, share.low, point)
        })
        .collect();
    placed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut chain: Vec<(u32, i64)> = placed
        .iter()
        .map(|(share, _, point)| (*point, (share * side).round().clamp(0.0, side) as i64))
        .collect();
    let mut least = 1;
    for (_, step) in &mut chain {
        *step = (*step).max(least);
        least = *step + 1;
    }
    let mut most = SIDE - 1;
    for (_, step) in chain.iter_mut().rev() {
        *step = (*step).min(most);
        most = *step - 1;
    }
    chain
}
