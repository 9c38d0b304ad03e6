//! What of the loops around a region is interpolated, between how many nodes.
use super::curtains::away;
use super::interpolant::interpolation_error;
use super::{BoundaryField, FEW};
use crate::math::Aabb;

/// Numbers of Chebyshev nodes along an axis to choose from.
const NODES: [usize; 9] = [2, 3, 4, 6, 8, 10, 12, 14, 16];
/// Costs of a sample or node, in those of an edge seen from it: of interpolation, for each node along an axis; of the
/// arctangent.
const INTERPOLATION_COST: f64 = 0.15;
const ANGLE_COST: f64 = 10.0;
/// How often what is left of the bound of an error is given to loops that need more than the others.
const ROUNDS: usize = 3;
/// What the chords of a loop cost, in edges: most of them are left out.
const EDGES_OF_CHORD: f64 = 0.7;

/// What is done with the loops of a region.
pub struct Plan {
    /// Nodes along each axis; none where the samples are no more.
    pub nodes: [Option<usize>; 3],
    pub loops: Separated,
    cost: f64,
}

pub struct Separated {
    pub far: Vec<u32>,
    pub near: Vec<u32>,
    /// Bound of the error of interpolating those that are far.
    pub spent: f64,
}

impl BoundaryField {
    /// The least costly plan for some loops at the samples of a region, as many as `counts` along each axis, if one costs less than
    /// to sum them there: with no fewer nodes than `least` along an axis, and an error of interpolation of `most`.
    pub(super) fn plan(
        &self,
        loops: &[u32],
        counts: [usize; 3],
        least: [usize; 3],
        bounds: &Aabb,
        most: f64,
    ) -> Option<Plan> {
        if loops.is_empty() {
            return None;
        }
        let samples = counts.iter().product::<usize>() as f64;
        let edges = |loops: &[u32]| -> f64 { loops.iter().map(|l| self.cost(*l)).sum() };
        // Of what is near some part will be far from the parts of the region.
        let share = if counts.iter().any(|c| *c > 2 * FEW) { 0.5 } else { 1.0 };
        let mut plan: Option<Plan> = None;
        for count in NODES {
            let nodes = counts.map(|c| (c > count).then_some(count));
            let keeps = |axis: usize| nodes[axis].is_none_or(|n| n >= least[axis]);
            if nodes == [None; 3] || !(0..3).all(keeps) {
                continue;
            }
            let loops = self.separate(loops, bounds, nodes, most);
            let (far, near) = (&loops.far, &loops.near);
            let sums: f64 = (0..3).map(|a| nodes[a].unwrap_or(counts[a]) as f64).product();
            let rest = if near.is_empty() { 0.0 } else { samples * (ANGLE_COST + share * edges(near)) };
            let interpolation =
                if far.is_empty() { 0.0 } else { INTERPOLATION_COST * count as f64 * samples };
            let cost = sums * (edges(far) + ANGLE_COST) + rest + interpolation;
            if plan.as_ref().is_none_or(|p| cost < p.cost) {
                plan = Some(Plan { nodes, loops, cost });
            }
        }
        let direct = samples * (edges(loops) + ANGLE_COST);
        plan.filter(|p| p.cost < direct)
    }

    /// Of a loop at a sample, in edges.
    fn cost(&self, l: u32) -> f64 {
        EDGES_OF_CHORD + self.loops[l as usize].edges() as f64
    }

    /// Loops that can be interpolated within a bound of the error, as many edges as possible, and the others; with the bound
    /// of what that takes.
    fn separate(&self, loops: &[u32], bounds: &Aabb, nodes: [Option<usize>; 3], most: f64) -> Separated {
        let error = |l: &u32| {
            let one = &self.loops[*l as usize];
            if away(bounds, &one.bounds).is_none() {
                return f64::INFINITY;
            }
            interpolation_error(one.area, &one.bounds, bounds, nodes)
        };
        let mut near: Vec<(u32, f64)> = loops.iter().map(|l| (*l, error(l))).collect();
        let (mut far, mut spent) = (Vec::new(), 0.0);
        // Each edge may take the same, and what is left is for those that need more.
        for _ in 0..ROUNDS {
            let per_edge = (most - spent) / near.iter().map(|(l, _)| self.cost(*l)).sum::<f64>();
            near.retain(|(l, error)| {
                let is_far = *error <= per_edge * self.cost(*l);
                if is_far {
                    spent += error;
                    far.push(*l);
                }
                !is_far
            });
        }
        far.sort_unstable();
        Separated { far, near: near.into_iter().map(|(l, _)| l).collect(), spent }
    }
}
