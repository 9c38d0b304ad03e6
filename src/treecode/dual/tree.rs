use super::clusters::Clusters;
use super::reach::reaches;
use super::walk::{Finding, Findings, Space, Walk};
use super::{BlockView, DualAccuracy, Sources, Targets};
use crate::data::{Cancelled, Monitor, map_tasks};
use std::sync::Arc;

/// Tasks between two reports to the monitor: some 20 ms of work on one thread. Their values are kept until then.
const TASKS_PER_REPORT: usize = 32;

/// Sources in a hierarchy of clusters with multipole moments: built once, asked many times.
pub struct DualTree {
    sources: Arc<dyn Sources>,
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

/// What is to be proved beside the evaluation.
#[derive(Clone, Copy)]
pub enum Proof<'a> {
    /// Nothing: all bounds are infinite.
    Nothing,
    /// Bounds of the errors of values.
    Bounds,
    /// The same, and for blocks that is asked about, that the field there lies between two numbers: the walk does not go
    /// below those for which this is enough.
    Decisions(Decided<'a>),
}

/// Asked, on any thread, for blocks over which the field is proved to lie between two numbers: whether that is enough.
pub type Decided<'a> = &'a (dyn Fn(&BlockView<'_>, f64, f64) -> bool + Sync);

impl DualTree {
    /// Builds the tree, in parallel, with at most `leaf_size` sources in a leaf; the same sources give the same bits
    /// whatever the number of threads.
    pub fn build(sources: Arc<dyn Sources>, leaf_size: usize) -> DualTree {
        let clusters = Clusters::build(&*sources, leaf_size);
        DualTree { sources, clusters }
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
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn evaluate(
        &self,
        targets: &dyn Targets,
        accuracy: &DualAccuracy,
        monitor: &dyn Monitor,
        proof: Proof<'_>,
        store: &mut dyn FnMut(&[usize], Outcome<'_>),
    ) -> Result<(), Cancelled> {
        const STAGE: &str = "winding numbers";
        let accuracy = accuracy.sane();
        let walk = Walk {
            clusters: &self.clusters,
            reaches: reaches(&self.clusters, &accuracy),
            sources: &*self.sources,
            targets,
            accuracy,
            decided: if let Proof::Decisions(decided) = proof { Some(decided) } else { None },
            is_bounded: !matches!(proof, Proof::Nothing),
        };
        let tasks = targets.tasks();
        let mut indices = Vec::new();
        for (run, some) in tasks.chunks(TASKS_PER_REPORT).enumerate() {
            monitor.report((run * TASKS_PER_REPORT) as f64 / tasks.len() as f64, STAGE)?;
            let found = map_tasks(some.len(), |task| walk.run(&some[task], &mut Space::default()));
            found.into_iter().for_each(|f| give(targets, f, &mut indices, store));
        }
        let outcast = Outcome::Values { values: &[f64::NAN], bound: 0.0 };
        targets.outcasts().iter().for_each(|&i| store(&[i as usize], outcast));
        monitor.report(1.0, STAGE)
    }
}

/// Hands what a task found to the caller.
fn give(
    targets: &dyn Targets,
    findings: Findings,
    indices: &mut Vec<usize>,
    store: &mut dyn FnMut(&[usize], Outcome<'_>),
) {
    let (mut values, mut places) = (&findings.values[..], &findings.indices[..]);
    for (block, finding) in findings.blocks {
        match finding {
            Finding::Values { bound } => {
                let (own, others) = values.split_at(targets.len(&block));
                let (own_places, other_places) = places.split_at(own.len());
                (values, places) = (others, other_places);
                store(own_places, Outcome::Values { values: own, bound });
            }
            Finding::Within { low, high } => {
                indices.clear();
                targets.for_each(&block, &mut |index, _| indices.push(index));
                store(indices, Outcome::Within { low, high });
            }
        }
    }
}
