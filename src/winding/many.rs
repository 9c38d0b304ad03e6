//! Winding numbers at many points at once, by the dual tree, and inside tests made of them: coarse ones first, finer ones for
//! the points that these leave open, at last the direct sum.
use crate::data::{Cancelled, Monitor, fill_in_blocks};
use crate::math::Vec3;
use crate::treecode::{DualAccuracy, DualTree, Outcome, PointTargets, Proof, Sources, Targets};
use std::sync::Arc;

/// From so many scattered points on they are sorted into blocks; fewer are walked one by one.
pub const MANY: usize = 1024;
/// Most sources in a leaf. Leaves of 6 to 14 need about as much work on the bunny; the larger ones take less memory.
const LEAF: usize = 12;
/// Largest errors of the looks that an inside test takes before the direct sum.
const LOOKS: [f64; 3] = [2.5e-2, 2e-3, 1e-4];

/// Sources whose field is asked for at many points at once.
pub struct Many {
    tree: DualTree,
}

/// An inside test at many points: w = `offset` + the field of the sources.
pub struct InsideTest<'a> {
    pub threshold: f64,
    /// By the index of a query.
    pub offset: &'a dyn Fn(usize) -> f64,
    pub point: &'a dyn Fn(usize) -> Vec3,
    /// Whether w ≥ the threshold by the direct sum, with the index and the place of a query.
    pub exactly: &'a (dyn Fn(usize, Vec3) -> bool + Sync),
}

impl Many {
    pub fn new(sources: Arc<dyn Sources>) -> Many {
        Many { tree: DualTree::build(sources, LEAF) }
    }

    pub fn bytes(&self) -> usize {
        self.tree.bytes()
    }

    pub fn clusters(&self) -> usize {
        self.tree.clusters()
    }

    /// Adds the field at all targets to the `values` of the queries' indices; NaN where a query is not finite.
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn add(
        &self,
        targets: &dyn Targets,
        accuracy: &DualAccuracy,
        values: &mut [f64],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        self.each(targets, accuracy, monitor, &mut |indices, found| {
            indices.iter().zip(found).for_each(|(index, w)| values[*index] += w);
        })
    }

    fn each(
        &self,
        targets: &dyn Targets,
        accuracy: &DualAccuracy,
        monitor: &dyn Monitor,
        give: &mut dyn FnMut(&[usize], &[f64]),
    ) -> Result<(), Cancelled> {
        self.tree.evaluate(targets, accuracy, monitor, Proof::Nothing, &mut |indices, outcome| {
            if let Outcome::Values { values, .. } = outcome {
                give(indices, values);
            }
        })
    }

    /// Hands to `set` whether w ≥ the threshold at each target, with its index, perhaps again after a finer look; false
    /// where a query is not finite. Answers how many needed the direct sum.
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn classify(
        &self,
        targets: &dyn Targets,
        test: &InsideTest,
        monitor: &dyn Monitor,
        set: &mut dyn FnMut(usize, bool),
    ) -> Result<usize, Cancelled> {
        let named = |fraction: f64, _: &str| monitor.report(fraction, "inside test").is_ok();
        let again = |_: f64, _: &str| monitor.report(1.0, "inside test").is_ok();
        let mut open: Vec<usize> = Vec::new();
        for (look, error) in LOOKS.into_iter().enumerate() {
            let accuracy = DualAccuracy::within(error).expect("a coarse look is possible");
            let mut left = Vec::new();
            let mut judge = |index: usize, w: f64| {
                let above = (test.offset)(index) + w - test.threshold;
                set(index, above >= 0.0);
                if above.abs() <= error {
                    left.push(index);
                }
            };
            if look == 0 {
                self.each(targets, &accuracy, &named, &mut |indices, found| {
                    indices.iter().zip(found).for_each(|(index, w)| judge(*index, *w));
                })?;
            } else {
                let points: Vec<Vec3> = open.iter().map(|&index| (test.point)(index)).collect();
                let targets = PointTargets::new(&points);
                self.each(&targets, &accuracy, &again, &mut |places, found| {
                    places.iter().zip(found).for_each(|(k, w)| judge(open[*k], *w));
                })?;
            }
            open = left;
        }
        let mut inside = vec![false; open.len()];
        let points: Vec<Vec3> = open.iter().map(|&index| (test.point)(index)).collect();
        let exactly = |k: usize, (): &mut ()| (test.exactly)(open[k], points[k]);
        fill_in_blocks(&mut inside, exactly, "inside test", &again)?;
        open.iter().zip(inside).for_each(|(index, inside)| set(*index, inside));
        Ok(open.len())
    }
}
