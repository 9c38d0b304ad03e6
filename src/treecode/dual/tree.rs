use super::clusters::Clusters;
use super::walk::{Finding, Findings, Space, Walk};
use super::{BlockView, DualAccuracy, Sources, Targets};
use crate::data::{Cancelled, Monitor};
use rayon::prelude::*;

/// Tasks between two reports to the monitor: some 20 ms of work on one thread. Their values are kept until then.
const TASKS_PER_REPORT: usize = 32;

/// Sources in a hierarchy of clusters with multipole moments: built once, asked many times.
pub struct DualTree<S> {
    sources: S,
    clusters: Clusters,
}

/// What is known of the queries of one block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome<'a> {
    /// Winding numbers, none farther than `bound` from the exact one.
    Values { values: &'a [f64], bound: f64 },
    /// Everywhere in the block the field is between these, which the caller found to be enough.
    Within { low: f64, high: f64 },
}

impl<S: Sources> DualTree<S> {
    /// Builds the tree, in parallel, with at most `leaf_size` sources in a leaf; the same sources give the same bits
    /// whatever the number of threads.
    pub fn build(sources: S, leaf_size: usize) -> DualTree<S> {
        let clusters = Clusters::build(&sources, leaf_size);
        DualTree { sources, clusters }
    }

    pub fn sources(&self) -> &S {
        &self.sources
    }

    /// Number of clusters.
    pub fn clusters(&self) -> usize {
        self.clusters.balls.len()
    }

    /// Bytes held, without the sources.
    pub fn bytes(&self) -> usize {
        self.clusters.bytes()
    }

    /// Evaluates the field at all `targets`, block by block, in parallel, and gives each block's outcome with the indices
    /// of its queries to `store`, on the calling thread and in a fixed order. The values are the same bits whatever the
    /// number of threads; NaN where a query is not finite.
    ///
    /// `decided(block, low, high)` is asked, on any thread, for blocks over which the field is proved to lie within
    /// [low, high]; the walk does not go below those for which it answers true.
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn evaluate<T: Targets>(
        &self,
        targets: &T,
        accuracy: &DualAccuracy,
        monitor: &dyn Monitor,
        decided: impl Fn(&BlockView<'_, T>, f64, f64) -> bool + Sync,
        mut store: impl FnMut(&[usize], Outcome<'_>),
    ) -> Result<(), Cancelled> {
        const STAGE: &str = "winding numbers";
        let walk = Walk {
            clusters: &self.clusters,
            sources: &self.sources,
            targets,
            accuracy: accuracy.sane(),
            decided: &decided,
        };
        let tasks = targets.tasks();
        let mut indices = Vec::new();
        for (run, some) in tasks.chunks(TASKS_PER_REPORT).enumerate() {
            monitor.report((run * TASKS_PER_REPORT) as f64 / tasks.len() as f64, STAGE)?;
            let found: Vec<_> =
                some.par_iter().map_init(Space::default, |space, task| walk.run(task, space)).collect();
            found.into_iter().for_each(|f| give(targets, f, &mut indices, &mut store));
        }
        let outcast = Outcome::Values { values: &[f64::NAN], bound: 0.0 };
        targets.outcasts().iter().for_each(|&i| store(&[i as usize], outcast));
        monitor.report(1.0, STAGE)
    }
}

/// Hands what a task found to the caller.
fn give<T: Targets>(
    targets: &T,
    findings: Findings<T::Block>,
    indices: &mut Vec<usize>,
    store: &mut impl FnMut(&[usize], Outcome<'_>),
) {
    let mut rest = &findings.values[..];
    for (block, finding) in findings.blocks {
        indices.clear();
        targets.for_each(&block, |index, _| indices.push(index));
        match finding {
            Finding::Values { bound } => {
                let (values, others) = rest.split_at(indices.len());
                rest = others;
                store(indices, Outcome::Values { values, bound });
            }
            Finding::Within { low, high } => store(indices, Outcome::Within { low, high }),
        }
    }
}
