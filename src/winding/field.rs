use crate::data::{
    Cancelled, Grid, Lattice, LatticeError, Monitor, OrientedCloud, OutOfMemory, Shape, TriangleSoup,
    fill_in_blocks, zeroed,
};
use crate::math::{Aabb, Vec3};
use crate::treecode::{Order, Tree, TreeConfig};
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

/// Why a lattice of values could not be made.
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
        self.at_with(q, accuracy, &mut Vec::new())
    }

    /// [`WindingField::at`] with scratch space that many queries share.
    pub fn at_with(&self, q: Vec3, accuracy: Accuracy, stack: &mut Vec<u32>) -> f64 {
        let (order, beta) = match accuracy {
            Accuracy::Explicit { order, beta } => (order, beta),
            Accuracy::Tolerance(t) if t < FINEST_EXPANSION => return self.direct(q),
            Accuracy::Tolerance(t) => (Order::Two, self.error_model().beta(t)),
        };
        match &self.tree {
            AnyTree::Soup(tree) => tree.at(q, order, beta, stack),
            AnyTree::Cloud(tree) => tree.at(q, order, beta, stack),
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
    /// If and only if `monitor` cancels.
    pub fn evaluate(
        &self,
        points: &[Vec3],
        accuracy: Accuracy,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, Cancelled> {
        let value = |i: usize, stack: &mut Vec<u32>| self.at_with(points[i], accuracy, stack);
        let mut values = vec![0.0; points.len()];
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
        let value =
            |i: usize, stack: &mut Vec<u32>| self.at_with(lattice.point(lattice.sample(i)), accuracy, stack);
        fill_in_blocks(&mut values, value, "winding numbers", monitor)?;
        Ok(Grid { lattice: *lattice, values })
    }

    /// Whether w ≥ 1/2 at each of `points`.
    ///
    /// # Errors
    /// If and only if `monitor` cancels.
    pub fn contains(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<bool>, Cancelled> {
        let mut inside = vec![false; points.len()];
        let value = |i: usize, stack: &mut Vec<u32>| self.exceeds(points[i], 0.5, stack);
        fill_in_blocks(&mut inside, value, "inside test", monitor)?;
        Ok(inside)
    }

    /// Whether w ≥ 1/2 at `q`.
    pub fn contains_point(&self, q: Vec3) -> bool {
        self.exceeds(q, 0.5, &mut Vec::new())
    }

    /// Whether w ≥ `threshold` at `q`: asked coarsely first, and finer only while the answer is within the error of
    /// the threshold, at last by the direct sum.
    pub fn exceeds(&self, q: Vec3, threshold: f64, stack: &mut Vec<u32>) -> bool {
        for beta in [2.0, 6.0] {
            let error = self.error_model().error(beta);
            let w = self.at_with(q, Accuracy::Explicit { order: Order::Two, beta }, stack);
            if (w - threshold).abs() > error || w.is_nan() {
                return w >= threshold;
            }
        }
        self.direct(q) >= threshold
    }

    /// Whether w ≥ `level` at `q` by the paper's evaluator, for tracing level sets: the same answer each time, without
    /// the direct sum that [`WindingField::exceeds`] falls back on next to the level set, where tracing spends its time.
    pub fn is_above(&self, q: Vec3, level: f64, stack: &mut Vec<u32>) -> bool {
        self.at_with(q, Accuracy::of_paper(&self.shape), stack) >= level
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
