//! Winding numbers and their gradients: at a point, at many, on a lattice.
use super::{Engine, WindingField};
use crate::data::{
    BLOCK, Cancelled, Grid, Lattice, Monitor, Parts, Shape, fill_blocks, fill_in_blocks,
    for_each_lattice_block, zeroed,
};
use crate::math::Vec3;
use crate::treecode::{DualAccuracy, LatticeTargets, Order, PointTargets, Scratch, Targets};
use crate::winding::config::{Accuracy, FieldError};
use crate::winding::error_model::{CLOUD_ERROR, ErrorModel, SOUP_ERROR};
use crate::winding::many::{MANY, Many};

/// Below this tolerance the far field's 32-bit floats are not good enough, and exact sums take over.
const FINEST_EXPANSION: f64 = 1e-5;

/// Up to so many points of a cloud are summed singly for a single query: no slower than by the tree, whose errors were measured
/// where there are many clusters and areas fit the distances between points.
const SMALL_CLOUD: usize = 128;

impl WindingField {
    /// The winding number at `q`: 1 inside a closed shape, 0 outside, NaN where `q` is not finite.
    pub fn at(&self, q: Vec3, accuracy: Accuracy) -> f64 {
        self.at_with(q, accuracy, &mut Scratch::default())
    }

    /// [`WindingField::at`] with scratch space that many queries share.
    pub fn at_with(&self, q: Vec3, accuracy: Accuracy, scratch: &mut Scratch) -> f64 {
        if let (Engine::Cloud(cloud), Some((Order::Two, beta))) = (&self.engine, self.expansion_for(accuracy))
        {
            return cloud.few().bounded(q, beta, scratch).0;
        }
        let mut value = [0.0];
        self.at_block(&[q], &mut value, accuracy, scratch);
        value[0]
    }

    /// Winding numbers at up to 64 points that lie close together.
    pub(crate) fn at_block(
        &self,
        points: &[Vec3],
        values: &mut [f64],
        accuracy: Accuracy,
        scratch: &mut Scratch,
    ) {
        let expansion = self.expansion_for(accuracy);
        match (&self.engine, expansion, accuracy) {
            (Engine::Soup(_), Some((order, beta)), Accuracy::Explicit { .. }) => {
                self.of_paper().at_block(points, values, order, beta, scratch);
            }
            (Engine::Soup(soup), _, _) => soup.values(points, soup.fraction_by(expansion), values, scratch),
            (Engine::Cloud(cloud), Some((order, beta)), _) => {
                cloud.few().at_block(points, values, order, beta, scratch);
            }
            (Engine::Cloud(cloud), None, _) => {
                points.iter().zip(values).for_each(|(q, value)| *value = cloud.few().direct(*q));
            }
        }
    }

    /// Order and β that reach an accuracy; none where only an exact sum does.
    fn expansion_for(&self, accuracy: Accuracy) -> Option<(Order, f64)> {
        match accuracy {
            Accuracy::Explicit { order, beta } => Some((order, beta)),
            Accuracy::Tolerance(t) if t < FINEST_EXPANSION || self.is_small_cloud() => None,
            Accuracy::Tolerance(t) => {
                let beta = self.error_model().beta(t);
                let beta = if let Engine::Cloud(cloud) = &self.engine { cloud.beta(beta, t) } else { beta };
                Some((Order::Two, beta))
            }
        }
    }

    fn is_small_cloud(&self) -> bool {
        matches!(&self.shape, Shape::Cloud(cloud) if cloud.len() <= SMALL_CLOUD)
    }

    /// What evaluates many points at once, and with which parameters, if anything does.
    fn many_for(&self, accuracy: Accuracy) -> Option<(&Many, DualAccuracy)> {
        let Accuracy::Tolerance(tolerance) = accuracy else { return None };
        let many = self.many()?;
        DualAccuracy::within(tolerance).map(|accuracy| (many, accuracy))
    }

    fn error_model(&self) -> ErrorModel {
        match self.shape {
            Shape::Soup(_) => SOUP_ERROR,
            Shape::Cloud(_) => CLOUD_ERROR,
        }
    }

    /// Winding numbers at `points`, in their order.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the values do not fit in memory.
    pub fn evaluate(
        &self,
        points: &[Vec3],
        accuracy: Accuracy,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, FieldError> {
        let monitor = &Parts::new(monitor);
        if let Some((many, tolerance)) = self.many_for(accuracy).filter(|_| points.len() >= MANY) {
            if let Engine::Soup(soup) = &self.engine {
                soup.prepare_points();
                return Ok(soup.many_values(many, points, &tolerance, monitor)?);
            }
            let mut values = zeroed(points.len())?;
            many.add(&PointTargets::new(points), &tolerance, &mut values, monitor)?;
            return Ok(values);
        }
        let mut values = zeroed(points.len())?;
        monitor.report(0.0, "winding numbers")?;
        match (accuracy, &self.engine) {
            (Accuracy::Explicit { .. }, Engine::Soup(_)) => drop(self.of_paper()),
            _ => self.prepare_single_points(),
        }
        let block = |start: usize, values: &mut [f64], scratch: &mut Scratch| match &self.engine {
            Engine::Cloud(_) => {
                let singly = |(i, value): (usize, &mut f64)| {
                    *value = self.at_with(points[start + i], accuracy, scratch);
                };
                values.iter_mut().enumerate().for_each(singly);
            }
            Engine::Soup(_) => {
                self.at_block(&points[start..start + values.len()], values, accuracy, scratch);
            }
        };
        fill_blocks(&mut values, BLOCK, block, "winding numbers", monitor)?;
        Ok(values)
    }

    /// Winding numbers of a cloud at the targets, which are `count`, by their indices: with a largest error of `tolerance`, 1e-5 or
    /// more. However few they are, single points are not prepared for. 0 everywhere for a soup, and for a smaller tolerance.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the values do not fit in memory.
    pub(crate) fn evaluate_targets(
        &self,
        targets: &dyn Targets,
        count: usize,
        tolerance: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, FieldError> {
        let mut values = zeroed(count)?;
        if let (Engine::Cloud(cloud), Some(accuracy)) = (&self.engine, DualAccuracy::within(tolerance)) {
            cloud.many.add(targets, &accuracy, &mut values, monitor)?;
        }
        Ok(values)
    }

    /// Winding numbers at every sample of a lattice.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the values do not fit in memory.
    pub fn evaluate_lattice(
        &self,
        lattice: &Lattice,
        accuracy: Accuracy,
        monitor: &dyn Monitor,
    ) -> Result<Grid<f64>, FieldError> {
        if let (Engine::Soup(soup), Accuracy::Tolerance(tolerance)) = (&self.engine, accuracy) {
            let by = soup.fraction_by(self.expansion_for(accuracy));
            let values = soup.lattice_values(lattice, tolerance, by, self.many_for(accuracy), monitor)?;
            return Ok(Grid { lattice: *lattice, values });
        }
        if let Some((many, accuracy)) = self.many_for(accuracy) {
            let mut values = zeroed(lattice.len())?;
            many.add(&LatticeTargets::new(lattice), &accuracy, &mut values, monitor)?;
            return Ok(Grid { lattice: *lattice, values });
        }
        let mut values = zeroed(lattice.len())?;
        self.for_each_sample(lattice, accuracy, |index, value| values[index] = value, monitor)?;
        Ok(Grid { lattice: *lattice, values })
    }

    /// Hands to `store` the winding number at each sample of a lattice, with its index, by the tree that single points are
    /// evaluated with.
    pub(super) fn for_each_sample(
        &self,
        lattice: &Lattice,
        accuracy: Accuracy,
        store: impl FnMut(usize, f64),
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        match &self.engine {
            Engine::Soup(_) => drop(self.of_paper()),
            Engine::Cloud(cloud) => drop(cloud.few()),
        }
        let block = |points: &[Vec3], results: &mut [f64], scratch: &mut Scratch| {
            self.at_block(points, results, accuracy, scratch);
        };
        for_each_lattice_block(lattice, block, store, "winding numbers", monitor)
    }

    /// The gradient of the winding number at `q`, per millimetre: it points inward. NaN where `q` is not finite.
    ///
    /// `accuracy` chooses the clusters as it does for w; where only the direct sum reaches it, so does the gradient's
    /// (see [`crate::winding::winding_gradient`] for what it is on the surface).
    pub fn gradient(&self, q: Vec3, accuracy: Accuracy) -> Vec3 {
        self.gradient_with(q, accuracy, &mut Scratch::default())
    }

    fn gradient_with(&self, q: Vec3, accuracy: Accuracy, scratch: &mut Scratch) -> Vec3 {
        match (&self.engine, self.expansion_for(accuracy), accuracy) {
            (Engine::Soup(_), Some((order, beta)), Accuracy::Explicit { .. }) => {
                self.of_paper().gradient(q, order, beta, scratch)
            }
            (Engine::Soup(soup), expansion, _) => soup.gradient(q, soup.fraction_by(expansion), scratch),
            (Engine::Cloud(cloud), Some((order, beta)), _) => cloud.few().gradient(q, order, beta, scratch),
            (Engine::Cloud(cloud), None, _) => cloud.few().direct_gradient(q),
        }
    }

    /// Gradients of the winding number at `points`, in their order.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the gradients do not fit in memory.
    pub fn gradients(
        &self,
        points: &[Vec3],
        accuracy: Accuracy,
        monitor: &dyn Monitor,
    ) -> Result<Vec<Vec3>, FieldError> {
        // Once, not by every thread.
        match (accuracy, &self.engine) {
            (Accuracy::Explicit { .. }, Engine::Soup(_)) => drop(self.of_paper()),
            _ => self.prepare_single_points(),
        }
        let value = |i: usize, scratch: &mut Scratch| self.gradient_with(points[i], accuracy, scratch);
        let mut gradients = zeroed(points.len())?;
        fill_in_blocks(&mut gradients, value, "gradients", monitor)?;
        Ok(gradients)
    }
}
