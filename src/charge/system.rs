//! The linear system of the charges: potentials at all barycentres, as a matrix that is kept or by the tree.
use super::clusters::Clusters;
use super::influence::{Influence, Places};
use super::moments::Moments;
use super::multipole::SUMS;
use super::sum::add_far;
use super::walk::{Block, LANES, Lists, Opening, bits, roots};
use crate::data::{BLOCK, Cancelled, Monitor, OutOfMemory, map_parts, map_tasks, zeroed};
use crate::treecode::Octet;
use std::borrow::Cow;

/// Potentials at the barycentres of all elements, in their order, of charges on them.
pub trait System: Sync {
    fn potentials(&self, charges: &[f64]) -> Vec<f64>;
    /// The potentials of a charge of 1 on one element.
    fn column(&self, source: usize) -> Cow<'_, [f64]>;
}

/// Targets of one task.
const ROWS: usize = 512;

/// All entries, in columns.
pub struct Matrix {
    entries: Vec<f64>,
    len: usize,
}

impl Matrix {
    /// # Errors
    /// If and only if the matrix does not fit in memory.
    pub fn new(influence: &Influence) -> Result<Matrix, OutOfMemory> {
        let len = influence.elements.len();
        let places = Places::of(influence.elements);
        let mut entries = zeroed(len * len)?;
        map_parts(&mut entries, len, |source, column| influence.fill(&places, source, 0, column));
        Ok(Matrix { entries, len })
    }
}

impl System for Matrix {
    fn potentials(&self, charges: &[f64]) -> Vec<f64> {
        let tasks = map_tasks(self.len.div_ceil(ROWS), |task| {
            let rows = task * ROWS..self.len.min((task + 1) * ROWS);
            let mut sums = vec![0.0; rows.len()];
            let column = |j: usize| &self.entries[j * self.len + rows.start..j * self.len + rows.end];
            let mut sources = charges.chunks_exact(4);
            // Four columns at once: a quarter of the sums' traffic.
            for (j, four) in sources.by_ref().enumerate() {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| column(4 * j + k));
                for (i, sum) in sums.iter_mut().enumerate() {
                    *sum += (four[0] * a[i] + four[1] * b[i]) + (four[2] * c[i] + four[3] * d[i]);
                }
            }
            let first = charges.len() - sources.remainder().len();
            for (j, charge) in sources.remainder().iter().enumerate() {
                sums.iter_mut().zip(column(first + j)).for_each(|(sum, entry)| *sum += charge * entry);
            }
            sums
        });
        tasks.concat()
    }

    fn column(&self, source: usize) -> Cow<'_, [f64]> {
        Cow::Borrowed(&self.entries[source * self.len..(source + 1) * self.len])
    }
}

/// Far clusters by their series, near elements by entries that are kept.
pub struct Kept<'a> {
    influence: &'a Influence<'a>,
    clusters: &'a Clusters,
    own: &'a [Moments],
    places: Places,
    blocks: Vec<KeptBlock>,
}

struct KeptBlock {
    block: Block,
    lists: Lists,
    /// The entries of each near element and group.
    near: Vec<Octet>,
}

/// Where clusters act on barycentres as a whole.
const OPENING: Opening = Opening { beta: 3.0, near: f64::INFINITY };
/// Blocks between two reports to the monitor.
const BLOCKS_PER_REPORT: usize = 256;

impl<'a> Kept<'a> {
    pub fn new(
        influence: &'a Influence<'a>,
        clusters: &'a Clusters,
        own: &'a [Moments],
        monitor: &dyn Monitor,
    ) -> Result<Kept<'a>, Cancelled> {
        let elements = influence.elements;
        let count = elements.len().div_ceil(BLOCK);
        let mut blocks = Vec::with_capacity(count);
        while blocks.len() < count {
            monitor.report(blocks.len() as f64 / count as f64, "near charges")?;
            let first = blocks.len();
            let some = (count - first).min(BLOCKS_PER_REPORT);
            blocks.extend(map_tasks(some, |k| kept_block(influence, clusters, first + k)));
        }
        Ok(Kept { influence, clusters, own, places: Places::of(elements), blocks })
    }
}

fn kept_block(influence: &Influence, clusters: &Clusters, index: usize) -> KeptBlock {
    let elements = influence.elements;
    let targets = index * BLOCK..elements.len().min((index + 1) * BLOCK);
    let block = Block::new(&elements.centers[targets.clone()]);
    let mut lists = Lists::default();
    lists.find(&block, elements, clusters, &OPENING, roots(elements));
    let mut near = Vec::new();
    for (source, groups) in &lists.near {
        for g in bits(*groups) {
            let entry = |k: usize| {
                let target = targets.start + g * LANES + k;
                if target < targets.end { influence.entry(target, *source as usize) as f32 } else { 0.0 }
            };
            near.push(Octet(std::array::from_fn(entry)));
        }
    }
    KeptBlock { block, lists, near }
}

impl System for Kept<'_> {
    fn potentials(&self, charges: &[f64]) -> Vec<f64> {
        let series = self.clusters.series(self.influence.elements, self.own, charges);
        let tasks = map_tasks(self.blocks.len(), |k| {
            let KeptBlock { block, lists, near } = &self.blocks[k];
            let mut far = vec![[Octet::ZERO; SUMS]; block.groups.len()];
            for order in [0, 1] {
                let centers = &self.clusters.centers;
                add_far(block, &lists.clusters[order], centers, &series, order, &mut far);
            }
            let mut sums: Vec<f64> =
                (0..block.points.len()).map(|k| f64::from(far[k / LANES][0].0[k % LANES])).collect();
            let mut near = near.iter();
            for (source, groups) in &lists.near {
                let charge = charges[*source as usize];
                for (g, entries) in bits(*groups).zip(near.by_ref()) {
                    let own = &mut sums[g * LANES..];
                    own.iter_mut().zip(entries.0).for_each(|(sum, entry)| *sum += charge * f64::from(entry));
                }
            }
            sums
        });
        tasks.concat()
    }

    fn column(&self, source: usize) -> Cow<'_, [f64]> {
        let mut column = vec![0.0; self.influence.elements.len()];
        map_parts(&mut column, ROWS, |part, rows| {
            self.influence.fill(&self.places, source, part * ROWS, rows);
        });
        Cow::Owned(column)
    }
}
