//! The field of a cloud: the dual tree for many points, the tree of Barill et al. 2018 for few.
use super::dipoles::Dipoles;
use super::many::{InsideTest, Many};
use crate::data::{Cancelled, Lazy, Loader, Monitor, OrientedCloud, SavedError};
use crate::math::Vec3;
use crate::treecode::{Scratch, Targets, Tree, TreeConfig, direct_sums};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

pub struct CloudField {
    dipoles: Arc<Dipoles>,
    config: TreeConfig,
    pub many: Many,
    few: Lazy<Tree<Dipoles>>,
    refined: AtomicUsize,
}

impl CloudField {
    pub fn new(cloud: Arc<OrientedCloud>, config: TreeConfig, is_bounded: bool) -> CloudField {
        let dipoles = Arc::new(Dipoles::new(cloud, is_bounded));
        let many = Many::new(dipoles.clone());
        CloudField::with(dipoles, many, config)
    }

    /// # Errors
    /// If and only if the bytes end early or hold no field of as many points.
    pub fn load(
        cloud: Arc<OrientedCloud>,
        config: TreeConfig,
        is_bounded: bool,
        loader: &mut Loader,
    ) -> Result<CloudField, SavedError> {
        let dipoles = Arc::new(Dipoles::new(cloud, is_bounded));
        let many = Many::load(dipoles.clone(), loader)?;
        Ok(CloudField::with(dipoles, many, config))
    }

    fn with(dipoles: Arc<Dipoles>, many: Many, config: TreeConfig) -> CloudField {
        CloudField { dipoles, config, many, few: Lazy::new(), refined: AtomicUsize::new(0) }
    }

    /// The tree for few points.
    pub fn few(&self) -> &Tree<Dipoles> {
        self.few.get_or_build(|| Tree::build(&*self.dipoles, &self.config))
    }

    /// The β for which the tree for few points stays within an error: `of_dipoles`, or more for bounded points, which lack up to
    /// 3 / 4π(4β)² of dipoles; 0.7 of the error is left to that.
    pub fn beta(&self, of_dipoles: f64, error: f64) -> f64 {
        if self.is_bounded() { of_dipoles.max((0.0214 / error).sqrt()) } else { of_dipoles }
    }

    pub fn is_bounded(&self) -> bool {
        self.dipoles.is_bounded
    }

    pub fn bytes(&self) -> usize {
        self.many.bytes() + self.few.get().map_or(0, Tree::bytes)
    }

    /// Points whose inside test needed the direct sum, in all tests so far.
    pub fn refined(&self) -> usize {
        self.refined.load(Relaxed)
    }

    /// Hands to `set` whether w ≥ `threshold` at each target, with its index.
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn classify(
        &self,
        targets: &dyn Targets,
        point: &dyn Fn(usize) -> Vec3,
        threshold: f64,
        monitor: &dyn Monitor,
        set: &mut dyn FnMut(usize, bool),
    ) -> Result<(), Cancelled> {
        let exactly = |_: &[usize], points: &[Vec3]| -> Vec<bool> {
            direct_sums(&*self.dipoles, 0..self.dipoles.cloud.len(), points)
                .into_iter()
                .map(|w| w >= threshold)
                .collect()
        };
        let test = InsideTest { threshold, offset: &|_| 0.0, point, exactly: &exactly };
        self.refined.fetch_add(self.many.classify(targets, &test, monitor, set)?, Relaxed);
        Ok(())
    }

    /// Whether w ≥ `threshold` at `q`, by bounds, at last by the direct sum.
    pub fn exceeds(&self, q: Vec3, threshold: f64, scratch: &mut Scratch) -> bool {
        let tree = self.few();
        let reaches = tree.reaches(q, threshold, scratch);
        if reaches.is_proven {
            return reaches.threshold;
        }
        self.refined.fetch_add(1, Relaxed);
        tree.direct(q) >= threshold
    }
}
