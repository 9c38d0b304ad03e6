use super::cloud_field::CloudField;
use super::config::{Accuracy, FieldConfig, FieldError, FieldReport};
use super::error_model::{CLOUD_ERROR, ErrorModel, SOUP_ERROR};
use super::many::{MANY, Many};
use super::soup_field::{HALF, SoupField};
use super::triangles::Triangles;
use crate::data::{
    BLOCK, Grid, Lattice, Monitor, Parts, Shape, fill_blocks, fill_in_blocks, for_each_lattice_block,
    set_bit, zeroed,
};
use crate::math::{Aabb, Vec3};
use crate::treecode::{
    DualAccuracy, LatticeTargets, Order, PointTargets, Scratch, Targets, Tree, TreeConfig,
};
use std::sync::OnceLock;

/// Inside tests that make a task: few need a sum, and these few are then summed together.
const INSIDE_TESTS: usize = 512;

/// A shape that can be asked how many times a point is inside it: built once, asked many times.
///
/// ```
/// use fast_winding::{TriangleSoup, WindingField, math::Vec3, winding::Accuracy};
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
/// let soup = TriangleSoup::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// let field = WindingField::new(soup, Default::default());
/// assert!((field.at(Vec3::splat(0.2), Accuracy::EXACT) - 1.0).abs() < 1e-12);
/// assert!(field.contains_point(Vec3::splat(0.2)) && !field.contains_point(Vec3::ONE));
/// # Ok::<(), fast_winding::data::SoupError>(())
/// ```
pub struct WindingField {
    shape: Shape,
    config: TreeConfig,
    engine: Engine,
    /// The paper's evaluator of a soup, built when its parameters are asked for.
    of_paper: OnceLock<Tree<Triangles>>,
    bounds: Aabb,
    report: FieldReport,
}

pub(super) enum Engine {
    Soup(Box<SoupField>),
    Cloud(Box<CloudField>),
}

/// Below this tolerance the far field's 32-bit floats are not good enough, and exact sums take over.
const FINEST_EXPANSION: f64 = 1e-5;

/// Up to so many points of a cloud are summed singly for a single query: no slower than by the tree, whose errors were measured
/// where there are many clusters and areas fit the distances between points.
const SMALL_CLOUD: usize = 128;

impl WindingField {
    /// Builds the field, in parallel, in time linear in the triangles or points; what single points need besides, when
    /// the first of them is asked for.
    pub fn new(shape: impl Into<Shape>, config: FieldConfig) -> WindingField {
        let shape = shape.into();
        let (bounded, config) = (config.bounded, TreeConfig { leaf_size: config.leaf_size });
        let engine = match &shape {
            Shape::Soup(soup) => Engine::Soup(Box::new(SoupField::new(soup.clone(), &config))),
            Shape::Cloud(cloud) => Engine::Cloud(Box::new(CloudField::new(cloud.clone(), config, bounded))),
        };
        WindingField::of_engine(shape, config, engine)
    }

    pub(super) fn of_engine(shape: Shape, config: TreeConfig, engine: Engine) -> WindingField {
        let report = report(&shape, &engine);
        WindingField { bounds: shape.bounds(), shape, config, engine, of_paper: OnceLock::new(), report }
    }

    /// How it was prepared.
    pub fn config(&self) -> FieldConfig {
        let bounded = matches!(&self.engine, Engine::Cloud(cloud) if cloud.is_bounded());
        FieldConfig { leaf_size: self.config.leaf_size, bounded }
    }

    pub(super) fn parts(&self) -> (&Engine, &TreeConfig) {
        (&self.engine, &self.config)
    }

    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The smallest box around the shape.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Whether it is the field of a soup without a boundary: w is an integer everywhere.
    pub fn is_closed(&self) -> bool {
        matches!(&self.engine, Engine::Soup(soup) if soup.is_closed())
    }

    /// Boxes around what bounds the openings of a soup: each cycle of boundary edges of the components that are capped, and all
    /// of those that are loose. None for closed soups and for clouds.
    pub fn openings(&self) -> Vec<Aabb> {
        match &self.engine {
            Engine::Soup(soup) => soup.openings(),
            Engine::Cloud(_) => Vec::new(),
        }
    }

    pub fn report(&self) -> &FieldReport {
        &self.report
    }

    /// Bytes that the field takes now, beside the shape: more than [`FieldReport::bytes`] once scattered points or the
    /// paper's evaluator were asked for.
    pub fn bytes(&self) -> usize {
        let of_paper = self.of_paper.get().map_or(0, Tree::bytes);
        of_paper
            + match &self.engine {
                Engine::Soup(soup) => soup.bytes(),
                Engine::Cloud(cloud) => cloud.bytes(),
            }
    }

    /// Points whose inside test needed an exact sum, in all tests so far.
    pub fn refined(&self) -> usize {
        match &self.engine {
            Engine::Soup(soup) => soup.refined(),
            Engine::Cloud(cloud) => cloud.refined(),
        }
    }

    /// Builds ahead of time what queries at scattered points need that are asked for one by one.
    pub fn prepare_points(&self) {
        if let Engine::Soup(soup) = &self.engine {
            soup.prepare_points();
        }
    }

    /// Builds ahead of time what single points and small batches of them need too, as tracing a level set asks for: for
    /// clouds and loose triangles the tree of Barill et al. 2018, some 220 bytes for each of them.
    pub fn prepare_single_points(&self) {
        match &self.engine {
            Engine::Soup(soup) => soup.prepare_single_points(),
            Engine::Cloud(cloud) => drop(cloud.few()),
        }
    }

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

    /// The paper's evaluator. Built outside of the cell that holds it: a thread that waited for another to build could be
    /// the one whose help that other waits for.
    fn of_paper(&self) -> &Tree<Triangles> {
        let Shape::Soup(soup) = &self.shape else { unreachable!("clouds have their tree from the start") };
        if let Some(tree) = self.of_paper.get() {
            return tree;
        }
        let _ = self.of_paper.set(Tree::build(&Triangles::new(soup.clone()), &self.config));
        self.of_paper.get().expect("it was set just now, here or by another thread")
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

    fn many(&self) -> Option<&Many> {
        match &self.engine {
            Engine::Soup(soup) => soup.many.as_ref(),
            Engine::Cloud(cloud) => Some(&cloud.many),
        }
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
        match &self.engine {
            Engine::Soup(_) => drop(self.of_paper()),
            Engine::Cloud(cloud) => drop(cloud.few()),
        }
        let block = |points: &[Vec3], results: &mut [f64], scratch: &mut Scratch| {
            self.at_block(points, results, accuracy, scratch);
        };
        let store = |index: usize, value: f64| values[index] = value;
        for_each_lattice_block(lattice, block, store, "winding numbers", monitor)?;
        Ok(Grid { lattice: *lattice, values })
    }

    /// The gradient of the winding number at `q`, per millimetre: it points inward. NaN where `q` is not finite.
    ///
    /// `accuracy` chooses the clusters as it does for w; where only the direct sum reaches it, so does the gradient's
    /// (see [`super::winding_gradient`] for what it is on the surface).
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

    /// Whether each of `points` is inside, w ≥ 1/2; for soups the solid counts as closed: a point on the surface is inside
    /// if and only if some region that touches it is.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the answers do not fit in memory.
    pub fn contains(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<bool>, FieldError> {
        self.classify(points, HALF, monitor)
    }

    /// Whether w ≥ `threshold` at each of `points`, as in [`WindingField::contains`].
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the answers do not fit in memory.
    pub fn classify(
        &self,
        points: &[Vec3],
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<bool>, FieldError> {
        let monitor = &Parts::new(monitor);
        let mut inside = zeroed(points.len())?;
        monitor.report(0.0, "inside test")?;
        match &self.engine {
            _ if points.len() < MANY => {}
            Engine::Cloud(cloud) => {
                let mut set = |i: usize, is_inside: bool| inside[i] = is_inside;
                cloud.classify(&PointTargets::new(points), &|i| points[i], threshold, monitor, &mut set)?;
                return Ok(inside);
            }
            Engine::Soup(soup) => {
                if let Some(many) = &soup.many {
                    soup.prepare_points();
                    return Ok(soup.many_inside(many, points, threshold, monitor)?);
                }
            }
        }
        self.prepare_single_points();
        let block = |start: usize, results: &mut [bool], scratch: &mut Scratch| match &self.engine {
            Engine::Cloud(_) => {
                let singly = |(i, result): (usize, &mut bool)| {
                    *result = self.exceeds(points[start + i], threshold, scratch);
                };
                results.iter_mut().enumerate().for_each(singly);
            }
            Engine::Soup(soup) => {
                soup.classify(&points[start..start + results.len()], threshold, true, results, scratch);
            }
        };
        fill_blocks(&mut inside, INSIDE_TESTS, block, "inside test", monitor)?;
        Ok(inside)
    }

    /// Which samples of a lattice have w ≥ `threshold`: one bit for each, lowest first, x fastest. Samples on the surface
    /// count as in [`WindingField::contains`].
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the bits do not fit in memory.
    pub fn classify_lattice(
        &self,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u8>, FieldError> {
        let monitor = &Parts::new(monitor);
        match &self.engine {
            Engine::Soup(soup) => match &soup.many {
                Some(many) => soup.many_bits(many, lattice, threshold, monitor),
                None => soup.lattice_bits(lattice, threshold, monitor),
            },
            Engine::Cloud(cloud) => {
                let mut bits = zeroed(lattice.len().div_ceil(8))?;
                let mut set = |index: usize, inside: bool| set_bit(&mut bits, index, inside);
                let point = |index: usize| lattice.point(lattice.sample(index));
                let targets = LatticeTargets::new(lattice);
                cloud.classify(&targets, &point, threshold, monitor, &mut set)?;
                Ok(bits)
            }
        }
    }

    /// [`WindingField::classify_lattice`], handed to `store` some planes at a time with the first of them, which is a multiple of
    /// eight. Those of clouds and loose triangles come all at once.
    ///
    /// # Errors
    /// As [`WindingField::classify_lattice`].
    pub(crate) fn classify_planes(
        &self,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
        store: &mut dyn FnMut(usize, &[u8]),
    ) -> Result<(), FieldError> {
        match &self.engine {
            Engine::Soup(soup) if soup.many.is_none() => {
                soup.for_each_group_of_planes(lattice, threshold, monitor, store)
            }
            _ => {
                store(0, &self.classify_lattice(lattice, threshold, monitor)?);
                Ok(())
            }
        }
    }

    /// Which samples of a lattice have w ≥ `threshold` as the evaluator of Barill et al. 2018 has it, with its parameters and
    /// without proof: one bit for each, as of [`WindingField::classify_lattice`].
    ///
    /// # Errors
    /// As [`WindingField::classify_lattice`].
    pub fn classify_lattice_fast(
        &self,
        lattice: &Lattice,
        (order, beta): (Order, f64),
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u8>, FieldError> {
        let mut bits = zeroed(lattice.len().div_ceil(8))?;
        match &self.engine {
            Engine::Soup(_) => drop(self.of_paper()),
            Engine::Cloud(cloud) => drop(cloud.few()),
        }
        let accuracy = Accuracy::Explicit { order, beta };
        let block = |points: &[Vec3], results: &mut [f64], scratch: &mut Scratch| {
            self.at_block(points, results, accuracy, scratch);
        };
        let store = |index: usize, w: f64| set_bit(&mut bits, index, w >= threshold);
        for_each_lattice_block(lattice, block, store, "winding numbers", monitor)?;
        Ok(bits)
    }

    /// Whether `q` is inside.
    pub fn contains_point(&self, q: Vec3) -> bool {
        self.exceeds(q, HALF, &mut Scratch::default())
    }

    /// Whether w ≥ `threshold` at `q`, as in [`WindingField::contains`].
    pub fn exceeds(&self, q: Vec3, threshold: f64, scratch: &mut Scratch) -> bool {
        match &self.engine {
            Engine::Soup(soup) => {
                let mut result = [false];
                soup.classify(&[q], threshold, true, &mut result, scratch);
                result[0]
            }
            Engine::Cloud(cloud) => cloud.exceeds(q, threshold, scratch),
        }
    }

    /// Whether w ≥ `level` at `q`, for tracing level sets: the same answer each time. For soups as [`WindingField::exceeds`]; for
    /// clouds without the direct sum that this falls back on next to the level set, where tracing spends its time.
    pub fn is_above(&self, q: Vec3, level: f64, scratch: &mut Scratch) -> bool {
        match &self.engine {
            Engine::Soup(_) => self.exceeds(q, level, scratch),
            Engine::Cloud(_) => self.at_with(q, Accuracy::of_paper(&self.shape), scratch) >= level,
        }
    }

    /// As [`WindingField::is_above`], but a soup's loose triangles are not summed directly either: what is next to the level set may
    /// be on either side, by some 1e-5 of w. For where an edge crosses it.
    pub fn is_nearly_above(&self, q: Vec3, level: f64, scratch: &mut Scratch) -> bool {
        match &self.engine {
            Engine::Soup(soup) => {
                let mut result = [false];
                soup.classify(&[q], level, false, &mut result, scratch);
                result[0]
            }
            Engine::Cloud(_) => self.is_above(q, level, scratch),
        }
    }
}

fn report(shape: &Shape, engine: &Engine) -> FieldReport {
    match engine {
        Engine::Cloud(cloud) => FieldReport {
            method: match cloud.is_bounded() {
                true => "fast bounded winding number of points",
                false => "fast winding number of points",
            },
            elements: shape.len(),
            nodes: cloud.many.clusters(),
            bytes: cloud.bytes(),
            ..FieldReport::default()
        },
        Engine::Soup(soup) => {
            let counts = soup.counts();
            let method = match (soup.is_closed(), counts.loose_components > 0, counts.capped_components > 0) {
                (true, ..) => "crossings: every component is closed",
                (_, false, _) => "crossings, and the field of caps over the openings",
                (_, true, false) => "solid angles: every open component has too many openings to be capped",
                (_, true, true) => "crossings and caps, and solid angles of components with many openings",
            };
            FieldReport {
                method,
                elements: shape.len(),
                boundary_edges: counts.boundary_edges,
                caps: soup.closure.caps.len(),
                capped_components: counts.capped_components,
                loose_components: counts.loose_components,
                nodes: soup.nodes(),
                bytes: soup.bytes(),
            }
        }
    }
}
