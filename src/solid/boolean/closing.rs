//! What closes a result that is open where the sides of its pieces do not tell.
use super::operands::Pieces;
use super::regions::Regions;
use super::sides::{Fate, directed};
use crate::math::{barycentre, squared_distance_to_triangle};
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

/// Regions that have another sheet as near as this, in the largest coordinate of the operands, may be on either side of it.
const NEAR: f64 = 1e-11;

/// How often edges, lower vertex first, are led up along, less how often down.
type Edges = BTreeMap<[u32; 2], i32>;

/// Regions in a result that is to be closed.
pub struct Closing<'a> {
    pub pieces: &'a Pieces,
    pub regions: &'a Regions,
    /// Of pieces in one place only one counts.
    pub is_first: &'a [bool],
    /// The largest coordinate of the operands.
    pub size: f64,
}

impl Closing<'_> {
    /// Gives the `thin` regions, which have no sides, the fates that leave the least boundary; and so, if it is open still, regions
    /// along that boundary to which others come so near that rounding decides which of them lies in front.
    pub fn close(&self, thin: &[usize], fates: &mut [Fate]) {
        thin.iter().for_each(|region| fates[*region] = Fate::Dropped);
        let mut net: FxHashMap<[u32; 2], i32> = FxHashMap::default();
        for (region, ends, turn) in self.edges() {
            *net.entry(ends).or_default() += turn * fates[region].turn();
        }
        let of_thin = self.edges_of(&thin.iter().copied().collect());
        of_thin.iter().for_each(|(region, own)| improve(*region, own, fates, &mut net));
        let at_boundary = |(region, ends, _)| (net.get(&ends) != Some(&0)).then_some(region);
        let open: BTreeSet<usize> = self.edges().filter_map(at_boundary).collect();
        for (region, own) in self.edges_of(&open) {
            if self.is_near_another(region) {
                improve(region, &own, fates, &mut net);
            }
        }
    }

    /// Directed edges of pieces that count, with the region of each.
    fn edges(&self) -> impl Iterator<Item = (usize, [u32; 2], i32)> {
        let counted = (0..self.pieces.corners.len()).filter(|piece| self.is_first[*piece]);
        counted.flat_map(|piece| {
            let region = self.regions.of[piece] as usize;
            directed(self.pieces.corners[piece]).map(|(ends, turn)| (region, ends, turn))
        })
    }

    fn edges_of(&self, regions: &BTreeSet<usize>) -> BTreeMap<usize, Edges> {
        let mut of: BTreeMap<usize, Edges> = BTreeMap::new();
        for (region, ends, turn) in self.edges().filter(|(region, ..)| regions.contains(region)) {
            *of.entry(region).or_default().entry(ends).or_default() += turn;
        }
        of
    }

    /// Whether a piece of another region lies next to the middle of a region's largest one.
    fn is_near_another(&self, region: usize) -> bool {
        let middle = barycentre(self.pieces.places(self.regions.largest[region] as usize));
        let reach = (NEAR * self.size).powi(2);
        (0..self.pieces.corners.len()).any(|piece| {
            self.regions.of[piece] as usize != region
                && squared_distance_to_triangle(middle, self.pieces.places(piece)) <= reach
        })
    }
}

/// Gives a region, of which these are the edges, the fate that leaves the least boundary, its own of equal ones.
fn improve(region: usize, own: &Edges, fates: &mut [Fate], net: &mut FxHashMap<[u32; 2], i32>) {
    let before = fates[region];
    let changed = |ends, n: &i32, fate: Fate| {
        net.get(ends).copied().unwrap_or_default() + n * (fate.turn() - before.turn())
    };
    let boundary = |fate: &Fate| own.iter().map(|(ends, n)| changed(ends, n, *fate).abs()).sum::<i32>();
    let candidates = [before, Fate::Dropped, Fate::Kept, Fate::Turned];
    let best = candidates.into_iter().min_by_key(boundary).unwrap_or(before);
    fates[region] = best;
    for (ends, n) in own {
        *net.entry(*ends).or_default() += n * (best.turn() - before.turn());
    }
}
