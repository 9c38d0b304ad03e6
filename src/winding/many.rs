//! Winding numbers at many points at once, by the dual tree, and inside tests made of them: coarse ones first, finer ones for
//! the points that these leave open, at last the direct sum.
use crate::data::{Cancelled, Loader, Monitor, SavedError, Saver, map_tasks};
use crate::math::Vec3;
use crate::treecode::{DualAccuracy, DualTree, PointTargets, Proof, Sources, Targets};
use std::sync::Arc;

/// From so many scattered points on they are sorted into blocks; fewer are walked one by one.
pub const MANY: usize = 1024;
/// Most sources in a leaf. Leaves of 6 to 14 need about as much work on the bunny; the larger ones take less memory.
const LEAF: usize = 12;
/// What clusters may leave out in the looks that an inside test takes before the direct sum. What decides is the bound of all
/// that they leave out together, some hundred times that. On a soup of loose triangles the first look leaves 0.3 % of a lattice
/// open, the second 0.01 %.
const LOOKS: [f64; 2] = [7e-4, 1e-5];
/// Queries that are summed directly together.
pub const TOGETHER: usize = 64;

/// Sources whose field is asked for at many points at once.
pub struct Many {
    tree: DualTree,
}

/// Answers for the queries of those indices, at those places.
pub type Exactly<'a> = dyn Fn(&[usize], &[Vec3]) -> Vec<bool> + Sync + 'a;

/// An inside test at many points: w = `offset` + the field of the sources.
pub struct InsideTest<'a> {
    pub threshold: f64,
    /// By the index of a query.
    pub offset: &'a dyn Fn(usize) -> f64,
    pub point: &'a dyn Fn(usize) -> Vec3,
    /// Whether w ≥ the threshold by the direct sum, with the indices and the places of up to [`TOGETHER`] queries.
    pub exactly: &'a Exactly<'a>,
}

impl Many {
    pub fn new(sources: Arc<dyn Sources>) -> Many {
        Many { tree: DualTree::build(sources, LEAF) }
    }

    pub fn save(&self, saver: &mut Saver) {
        self.tree.save(saver);
    }

    /// # Errors
    /// If and only if the bytes end early or hold no tree over as many sources.
    pub fn load(sources: Arc<dyn Sources>, loader: &mut Loader) -> Result<Many, SavedError> {
        Ok(Many { tree: DualTree::load(sources, LEAF, loader)? })
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
        self.tree.evaluate(targets, accuracy, monitor, Proof::Nothing, &mut |indices, found, _| {
            indices.iter().zip(found).for_each(|(index, w)| values[*index] += w);
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
            let accuracy = DualAccuracy { error, ..DualAccuracy::DEFAULT };
            let mut left = Vec::new();
            let mut judge = |index: usize, w: f64, bound: f64| {
                let above = (test.offset)(index) + w - test.threshold;
                set(index, above >= 0.0);
                if above.abs() <= bound {
                    left.push(index);
                }
            };
            if look == 0 {
                self.tree.evaluate(
                    targets,
                    &accuracy,
                    &named,
                    Proof::Bounds,
                    &mut |indices, found, bound| {
                        indices.iter().zip(found).for_each(|(index, w)| judge(*index, *w, bound));
                    },
                )?;
            } else {
                let points: Vec<Vec3> = open.iter().map(|&index| (test.point)(index)).collect();
                let targets = PointTargets::new(&points);
                self.tree.evaluate(
                    &targets,
                    &accuracy,
                    &again,
                    Proof::Bounds,
                    &mut |places, found, bound| {
                        places.iter().zip(found).for_each(|(k, w)| judge(open[*k], *w, bound));
                    },
                )?;
            }
            open = left;
        }
        let points: Vec<Vec3> = open.iter().map(|&index| (test.point)(index)).collect();
        let parts = open.len().div_ceil(TOGETHER);
        let inside = map_tasks(parts, |part| {
            let range = part * TOGETHER..open.len().min((part + 1) * TOGETHER);
            (test.exactly)(&open[range.clone()], &points[range])
        });
        open.iter().zip(inside.into_iter().flatten()).for_each(|(index, inside)| set(*index, inside));
        Ok(open.len())
    }
}
