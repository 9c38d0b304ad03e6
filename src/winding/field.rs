use crate::data::{
    BLOCK, Cancelled, Grid, Lattice, LatticeError, Monitor, OrientedCloud, OutOfMemory, Shape, TriangleSoup,
    fill_in_blocks, for_each_lattice_block, zeroed,
};
use crate::math::{Aabb, Vec3};
use crate::treecode::{Order, Scratch, Tree, TreeConfig};
use serde::Serialize;

/// How a field is prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldConfig {
    /// Most triangles or points in a leaf of the tree. On the Stanford bunny, 4, 8 and 16 answer alike over a lattice;
    /// next to the surface 8 is fastest, and 16 builds a third faster in three quarters of the memory.
    pub leaf_size: usize,
}

impl Default for FieldConfig {
    fn default() -> Self {
        FieldConfig { leaf_size: 8 }
    }
}

/// How exact an answer has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Accuracy {
    /// Largest absolute error of w; 0 asks for the direct sum, exact to rounding.
    Tolerance(f64),
    /// The paper's own parameters: terms of the expansion, and β, the opening distance in cluster radii.
    Explicit { order: Order, beta: f64 },
}

impl Accuracy {
    pub const EXACT: Accuracy = Accuracy::Tolerance(0.0);

    /// The paper's choice: order 2, and β = 2 for triangles, 2.3 for points (Barill et al. 2018, section 4).
    pub fn of_paper(shape: &Shape) -> Accuracy {
        let beta = match shape {
            Shape::Soup(_) => 2.0,
            Shape::Cloud(_) => 2.3,
        };
        Accuracy::Explicit { order: Order::Two, beta }
    }
}

impl Default for Accuracy {
    fn default() -> Self {
        Accuracy::Tolerance(1e-3)
    }
}

/// What was built, and what it costs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FieldReport {
    /// How the field is evaluated, in words.
    pub method: &'static str,
    /// Triangles or points.
    pub elements: usize,
    pub nodes: usize,
    /// Memory the tree takes.
    pub bytes: usize,
}

/// Why values could not be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    #[error(transparent)]
    Lattice(#[from] LatticeError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}

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
    tree: AnyTree,
    bounds: Aabb,
    report: FieldReport,
}

enum AnyTree {
    Soup(Tree<TriangleSoup>),
    Cloud(Tree<OrientedCloud>),
}

/// β of the first and the second look of a classification.
const COARSE_BETA: f64 = 2.0;
const FINE_BETA: f64 = 6.0;
const COARSE: Accuracy = Accuracy::Explicit { order: Order::Two, beta: COARSE_BETA };

/// Below this tolerance the far field's 32-bit floats are not good enough, and the direct sum takes over.
const FINEST_EXPANSION: f64 = 1e-5;

impl WindingField {
    /// Builds the tree and its moments, in parallel: about one sort of the elements.
    pub fn new(shape: impl Into<Shape>, config: FieldConfig) -> WindingField {
        let shape = shape.into();
        let tree_config = TreeConfig { leaf_size: config.leaf_size };
        let tree = match &shape {
            Shape::Soup(soup) => AnyTree::Soup(Tree::build(&**soup, &tree_config)),
            Shape::Cloud(cloud) => AnyTree::Cloud(Tree::build(&**cloud, &tree_config)),
        };
        let (nodes, bytes) = match &tree {
            AnyTree::Soup(tree) => (tree.nodes(), tree.bytes()),
            AnyTree::Cloud(tree) => (tree.nodes(), tree.bytes()),
        };
        let method = match shape {
            Shape::Soup(_) => "fast winding number of triangles",
            Shape::Cloud(_) => "fast winding number of points",
        };
        let report = FieldReport { method, elements: shape.len(), nodes, bytes };
        WindingField { bounds: shape.bounds(), shape, tree, report }
    }

    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The smallest box around the shape.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    pub fn report(&self) -> &FieldReport {
        &self.report
    }

    /// The winding number at `q`: 1 inside a closed shape, 0 outside, NaN where `q` is not finite.
    pub fn at(&self, q: Vec3, accuracy: Accuracy) -> f64 {
        self.at_with(q, accuracy, &mut Scratch::default())
    }

    /// [`WindingField::at`] with scratch space that many queries share.
    pub fn at_with(&self, q: Vec3, accuracy: Accuracy, scratch: &mut Scratch) -> f64 {
        match (self.expansion_for(accuracy), &self.tree) {
            (None, _) => self.direct(q),
            (Some((order, beta)), AnyTree::Soup(tree)) => tree.at(q, order, beta, scratch),
            (Some((order, beta)), AnyTree::Cloud(tree)) => tree.at(q, order, beta, scratch),
        }
    }

    /// Winding numbers at up to 64 points that lie close together.
    fn at_block(&self, points: &[Vec3], values: &mut [f64], accuracy: Accuracy, scratch: &mut Scratch) {
        match (self.expansion_for(accuracy), &self.tree) {
            (None, _) => points.iter().zip(values).for_each(|(q, value)| *value = self.direct(*q)),
            (Some((order, beta)), AnyTree::Soup(tree)) => tree.at_block(points, values, order, beta, scratch),
            (Some((order, beta)), AnyTree::Cloud(tree)) => {
                tree.at_block(points, values, order, beta, scratch)
            }
        }
    }

    /// Order and β that reach an accuracy; none where only the direct sum does.
    fn expansion_for(&self, accuracy: Accuracy) -> Option<(Order, f64)> {
        match accuracy {
            Accuracy::Explicit { order, beta } => Some((order, beta)),
            Accuracy::Tolerance(t) if t < FINEST_EXPANSION => None,
            Accuracy::Tolerance(t) => Some((Order::Two, self.error_model().beta(t))),
        }
    }

    fn direct(&self, q: Vec3) -> f64 {
        match &self.tree {
            AnyTree::Soup(tree) => tree.direct(q),
            AnyTree::Cloud(tree) => tree.direct(q),
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
        let value = |i: usize, scratch: &mut Scratch| self.at_with(points[i], accuracy, scratch);
        let mut values = zeroed(points.len())?;
        fill_in_blocks(&mut values, value, "winding numbers", monitor)?;
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
        let mut values = zeroed(lattice.len())?;
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
        match (self.expansion_for(accuracy), &self.tree) {
            (None, AnyTree::Soup(tree)) => tree.direct_gradient(q),
            (None, AnyTree::Cloud(tree)) => tree.direct_gradient(q),
            (Some((order, beta)), AnyTree::Soup(tree)) => tree.gradient(q, order, beta, scratch),
            (Some((order, beta)), AnyTree::Cloud(tree)) => tree.gradient(q, order, beta, scratch),
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
        let value = |i: usize, scratch: &mut Scratch| self.gradient_with(points[i], accuracy, scratch);
        let mut gradients = zeroed(points.len())?;
        fill_in_blocks(&mut gradients, value, "gradients", monitor)?;
        Ok(gradients)
    }

    /// Whether w ≥ 1/2 at each of `points`.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the answers do not fit in memory.
    pub fn contains(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<bool>, FieldError> {
        let mut inside = zeroed(points.len())?;
        let value = |i: usize, scratch: &mut Scratch| self.exceeds(points[i], 0.5, scratch);
        fill_in_blocks(&mut inside, value, "inside test", monitor)?;
        Ok(inside)
    }

    /// Whether w ≥ 1/2 at `q`.
    pub fn contains_point(&self, q: Vec3) -> bool {
        self.exceeds(q, 0.5, &mut Scratch::default())
    }

    /// Whether w ≥ `threshold` at `q`: asked coarsely first, and finer only while the answer is within the error of
    /// the threshold, at last by the direct sum.
    pub fn exceeds(&self, q: Vec3, threshold: f64, scratch: &mut Scratch) -> bool {
        let w = self.at_with(q, COARSE, scratch);
        self.decide(q, w, threshold, scratch)
    }

    /// [`WindingField::exceeds`] at up to 64 points that lie close together.
    pub fn exceeds_block(
        &self,
        points: &[Vec3],
        threshold: f64,
        results: &mut [bool],
        scratch: &mut Scratch,
    ) {
        let mut values = [0.0; BLOCK];
        self.at_block(points, &mut values[..points.len()], COARSE, scratch);
        for ((q, w), result) in points.iter().zip(values).zip(results) {
            *result = self.decide(*q, w, threshold, scratch);
        }
    }

    /// Decides by the coarse value `w` at `q`, or by finer ones.
    fn decide(&self, q: Vec3, w: f64, threshold: f64, scratch: &mut Scratch) -> bool {
        let certain =
            |w: f64, beta: f64| (w - threshold).abs() > self.error_model().error(beta) || w.is_nan();
        if certain(w, COARSE_BETA) {
            return w >= threshold;
        }
        let w = self.at_with(q, Accuracy::Explicit { order: Order::Two, beta: FINE_BETA }, scratch);
        if certain(w, FINE_BETA) { w >= threshold } else { self.direct(q) >= threshold }
    }

    /// Whether w ≥ `level` at `q` by the paper's evaluator, for tracing level sets: the same answer each time, without
    /// the direct sum that [`WindingField::exceeds`] falls back on next to the level set, where tracing spends its time.
    pub fn is_above(&self, q: Vec3, level: f64, scratch: &mut Scratch) -> bool {
        self.at_with(q, Accuracy::of_paper(&self.shape), scratch) >= level
    }
}

/// Largest error of order 2 on a lattice over the bounds: `at_two` (β / 2)^−power. Measured with a margin of 1.5 to 2:
/// on the Stanford bunny 3.8e-3, 6.3e-4, 1.4e-4, 2.4e-5 at β = 2, 3, 4, 6; on a cloud of 35k of its barycentres 1.8e-2
/// (2.7e-2 with leaves of 4), 2.0e-3, 4.6e-4, 7.4e-5.
#[derive(Clone, Copy)]
struct ErrorModel {
    at_two: f64,
    power: f64,
}

impl ErrorModel {
    fn error(&self, beta: f64) -> f64 {
        self.at_two * (beta / 2.0).powf(-self.power)
    }

    fn beta(&self, error: f64) -> f64 {
        2.0 * (self.at_two / error).powf(1.0 / self.power).max(1.0)
    }
}

const SOUP_ERROR: ErrorModel = ErrorModel { at_two: 8e-3, power: 4.2 };
const CLOUD_ERROR: ErrorModel = ErrorModel { at_two: 3e-2, power: 4.3 };
