use super::clusters::Clusters;
use super::reach::reaches;
use super::walk::{Findings, Space, Walk};
use super::{DualAccuracy, Sources, Targets};
use crate::data::{Cancelled, Loader, Monitor, SavedError, Saver, map_tasks};
use std::sync::Arc;

/// Tasks between two reports to the monitor: some 20 ms of work on one thread. Their values are kept until then.
const TASKS_PER_REPORT: usize = 32;

/// Sources in a hierarchy of clusters with multipole moments: built once, asked many times.
pub struct DualTree {
    sources: Arc<dyn Sources>,
    clusters: Clusters,
}

/// What is to be proved beside the evaluation.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// Nothing: all bounds are infinite.
    Nothing,
    /// Bounds of the errors of values.
    Bounds,
}

/// Takes the indices of some queries, the values there and a bound of their errors.
pub type Store<'a> = &'a mut dyn FnMut(&[usize], &[f64], f64);

impl DualTree {
    /// Builds the tree, in parallel, with at most `leaf_size` sources in a leaf; the same sources give the same bits
    /// whatever the number of threads.
    pub fn build(sources: Arc<dyn Sources>, leaf_size: usize) -> DualTree {
        let clusters = Clusters::build(&*sources, leaf_size);
        DualTree { sources, clusters }
    }

    /// Adds all that was built to saved bytes.
    pub(crate) fn save(&self, saver: &mut Saver) {
        self.clusters.save(saver);
    }

    /// The tree that was saved, over the same sources.
    ///
    /// # Errors
    /// If and only if the bytes end early or hold no tree over as many sources, with as many in a leaf.
    pub(crate) fn load(
        sources: Arc<dyn Sources>,
        leaf_size: usize,
        loader: &mut Loader,
    ) -> Result<DualTree, SavedError> {
        let clusters = Clusters::load(&*sources, leaf_size, loader)?;
        Ok(DualTree { sources, clusters })
    }

    /// Number of clusters.
    pub fn clusters(&self) -> usize {
        self.clusters.balls.len()
    }

    /// Bytes held, without the sources.
    pub fn bytes(&self) -> usize {
        self.clusters.bytes()
    }

    /// Evaluates the field at all `targets`, block by block, in parallel, and gives the indices of each block's queries,
    /// the values there and a bound of their errors to `store`, on the calling thread and in a fixed order. The values are the
    /// same bits whatever the number of threads; NaN where a query is not finite.
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn evaluate(
        &self,
        targets: &dyn Targets,
        accuracy: &DualAccuracy,
        monitor: &dyn Monitor,
        proof: Proof,
        store: Store,
    ) -> Result<(), Cancelled> {
        const STAGE: &str = "winding numbers";
        let accuracy = accuracy.sane();
        let lacking =
            if self.clusters.extents.is_empty() { 0.0 } else { accuracy.of_bounded_points().lacking };
        let walk = Walk {
            clusters: &self.clusters,
            reaches: reaches(&self.clusters, &accuracy),
            sources: &*self.sources,
            targets,
            accuracy,
            lacking: (proof == Proof::Bounds).then_some(lacking),
        };
        let tasks = targets.tasks();
        for (run, some) in tasks.chunks(TASKS_PER_REPORT).enumerate() {
            monitor.report((run * TASKS_PER_REPORT) as f64 / tasks.len() as f64, STAGE)?;
            let found = map_tasks(some.len(), |task| walk.run(&some[task], &mut Space::default()));
            found.into_iter().for_each(|f| give(&f, store));
        }
        targets.outcasts().iter().for_each(|&i| store(&[i as usize], &[f64::NAN], 0.0));
        monitor.report(1.0, STAGE)
    }
}

/// Hands what a task found to the caller.
fn give(findings: &Findings, store: Store) {
    let (mut values, mut indices) = (&findings.values[..], &findings.indices[..]);
    for (len, bound) in &findings.blocks {
        let (own, others) = values.split_at(*len);
        let (own_indices, other_indices) = indices.split_at(*len);
        (values, indices) = (others, other_indices);
        store(own_indices, own, *bound);
    }
}
