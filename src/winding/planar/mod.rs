//! The winding number of oriented points of a plane, plain or bounded, summed directly or fast: near points singly, far
//! clusters by the moments of their plain field (*Leaps and Bounds*, supplement A.1; Barill et al. 2018, section 3, in two
//! dimensions). That a cluster is plain, and cut after some terms, is taken from the tolerance by a proven bound.
mod cloud;
mod cluster;
mod dipole;

pub use cloud::{PlanarCloud, PlanarError};

use super::FieldError;
use crate::bvh::{Bvh, Child, Stack, WIDTH};
use crate::data::{Monitor, fill_in_blocks, map_items, set_each, zeroed};
use crate::math::{Aabb, Vec2};
use cluster::{Cluster, Quantity};
use dipole::Dipole;

/// Clusters that one task sums the moments of.
const CLUSTERS_PER_TASK: usize = 16;

/// A cluster counts as at least this part of its parent's radius away where a tolerance is divided: copies of a point right
/// at the query would take all of it, though they are summed singly. From 0.01 to 0.25 queries take the same terms, to 2 %.
const NEAREST: f64 = 1.0 / 16.0;

/// How a field of a plane is prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarConfig {
    /// Most points in a leaf of the tree, which are summed singly: about as many as terms of a cluster in their place. Of
    /// 4, 8 and 16 none takes a tenth more terms and points than another.
    pub leaf_size: usize,
    /// Whether points are bounded: none adds more than a half, as if each were a straight piece seen along its axis.
    pub bounded: bool,
}

impl Default for PlanarConfig {
    fn default() -> Self {
        PlanarConfig { leaf_size: 8, bounded: false }
    }
}

/// What one value takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PlanarCost {
    /// Clusters taken as a whole.
    pub clusters: usize,
    /// Terms of their expansions, in all.
    pub terms: usize,
    /// Points summed singly.
    pub points: usize,
}

/// The winding number of points of a plane, p with unit normal n and length l: built once, asked many times.
///
/// At q it is Σ l n·(p − q) / 2π|p − q|² (*Leaps and Bounds*, eq. 28), or if bounded Σ (1/π) arctan(l n·(p − q) / 2|p − q|²)
/// (eq. 35): a number without unit, for a closed curve with outward normals near 1 inside, near 0 outside. A point at q
/// contributes 0. Gradients are per millimetre, and point to where w grows.
///
/// `tolerance` is the largest absolute error of w, and per millimetre of the length of its gradient: proven, beside the
/// rounding of the direct sum. 0 asks for the direct sum, as does a negative number or NaN.
///
/// ```
/// use fast_winding::data::Silent;
/// use fast_winding::math::Vec2;
/// use fast_winding::winding::{PlanarCloud, PlanarConfig, PlanarField};
/// let circle: Vec<Vec2> = (0..1000).map(|i| Vec2::from_angle(f64::from(i) * std::f64::consts::TAU / 1000.0)).collect();
/// let lengths = vec![std::f64::consts::TAU / 1000.0; 1000];
/// let cloud = PlanarCloud::new(circle.clone(), circle, lengths)?;
/// let field = PlanarField::new(&cloud, PlanarConfig { bounded: true, ..Default::default() });
/// let w = field.evaluate(&[Vec2::ZERO, Vec2::new(2.0, 1.0)], 1e-3, &Silent)?;
/// assert!((w[0] - 1.0).abs() < 2e-3 && w[1].abs() < 2e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct PlanarField {
    tree: Bvh,
    /// In the order of the tree.
    dipoles: Vec<Dipole>,
    /// Those of the tree's nodes.
    clusters: Vec<Cluster>,
    is_bounded: bool,
}

impl PlanarField {
    /// Costs one sort, and a pass over the points for each level of the tree.
    pub fn new(cloud: &PlanarCloud, config: PlanarConfig) -> PlanarField {
        let boxes = map_items(cloud.len(), |i| Aabb::around([cloud.points()[i].extend(0.0)]));
        let tree = Bvh::build(&boxes, config.leaf_size);
        let dipole = |place: usize| {
            let i = tree.items()[place] as usize;
            let moment = cloud.lengths()[i] / std::f64::consts::TAU * cloud.normals()[i];
            Dipole { point: cloud.points()[i], moment }
        };
        let dipoles = map_items(cloud.len(), dipole);
        let mut clusters = vec![Cluster::default(); tree.nodes().len()];
        set_each(&mut clusters, CLUSTERS_PER_TASK, |node, cluster| {
            *cluster = Cluster::of(&dipoles[tree.places(Child::Inner(node as u32))]);
        });
        PlanarField { tree, dipoles, clusters, is_bounded: config.bounded }
    }

    /// The winding number at `q`; NaN where `q` is not finite.
    pub fn at(&self, q: Vec2, tolerance: f64) -> f64 {
        self.at_with(q, tolerance, &mut Stack::new())
    }

    /// Its gradient at `q`, per millimetre; NaN where `q` is not finite. Right next to a plain point it grows without
    /// bound, and next to a bounded one across its normal.
    pub fn gradient(&self, q: Vec2, tolerance: f64) -> Vec2 {
        self.gradient_with(q, tolerance, &mut Stack::new())
    }

    /// What [`PlanarField::at`] takes at `q`.
    pub fn cost(&self, q: Vec2, tolerance: f64) -> PlanarCost {
        let (mut clusters, mut terms, mut points) = (0, 0, 0);
        let far = |_: &Cluster, _, count| {
            clusters += 1;
            terms += count;
        };
        self.walk(q, tolerance, Quantity::Value, &mut Stack::new(), far, |_| points += 1);
        PlanarCost { clusters, terms, points }
    }

    /// Winding numbers at `points`, in their order.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the values do not fit in memory.
    pub fn evaluate(
        &self,
        points: &[Vec2],
        tolerance: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, FieldError> {
        let mut values = zeroed(points.len())?;
        let value = |i: usize, stack: &mut Stack<f64>| self.at_with(points[i], tolerance, stack);
        fill_in_blocks(&mut values, value, "winding numbers", monitor)?;
        Ok(values)
    }

    /// Gradients of the winding number at `points`, in their order.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the gradients do not fit in memory.
    pub fn gradients(
        &self,
        points: &[Vec2],
        tolerance: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<Vec2>, FieldError> {
        let mut gradients = zeroed(points.len())?;
        let value = |i: usize, stack: &mut Stack<f64>| self.gradient_with(points[i], tolerance, stack);
        fill_in_blocks(&mut gradients, value, "gradients", monitor)?;
        Ok(gradients)
    }

    fn at_with(&self, q: Vec2, tolerance: f64, stack: &mut Stack<f64>) -> f64 {
        if !q.is_finite() {
            return f64::NAN;
        }
        let (mut of_clusters, mut of_points) = (0.0, 0.0);
        let far = |cluster: &Cluster, z, terms| of_clusters += cluster.value(z, terms);
        let near = |dipole: &Dipole| of_points += dipole.value(q, self.is_bounded);
        self.walk(q, tolerance, Quantity::Value, stack, far, near);
        of_clusters + of_points
    }

    fn gradient_with(&self, q: Vec2, tolerance: f64, stack: &mut Stack<f64>) -> Vec2 {
        if !q.is_finite() {
            return Vec2::NAN;
        }
        let (mut of_clusters, mut of_points) = (Vec2::ZERO, Vec2::ZERO);
        let far = |cluster: &Cluster, z, terms| of_clusters += cluster.gradient(z, terms);
        let near = |dipole: &Dipole| of_points += dipole.gradient(q, self.is_bounded);
        self.walk(q, tolerance, Quantity::Gradient, stack, far, near);
        of_clusters + of_points
    }

    /// Hands to `far` the clusters that may be taken as a whole, with the place of `q` as seen from their centre and the
    /// terms they need, and to `near` all other points. The tolerance is divided among the parts of a cluster that is
    /// opened, so the errors of all that are taken add up to no more.
    fn walk(
        &self,
        q: Vec2,
        tolerance: f64,
        quantity: Quantity,
        stack: &mut Stack<f64>,
        mut far: impl FnMut(&Cluster, Vec2, usize),
        mut near: impl FnMut(&Dipole),
    ) {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return self.dipoles.iter().for_each(near);
        }
        let visit = |node: usize, share: f64| {
            let cluster = &self.clusters[node];
            let z = q - cluster.centre;
            if let Some(terms) = cluster.terms(z.length(), share, quantity, self.is_bounded) {
                far(cluster, z, terms);
                return (0, [0.0; WIDTH]);
            }
            ((1 << WIDTH) - 1, self.shares(node, q, share, quantity))
        };
        let leaf = |node: usize, k: usize, _| {
            let places = self.tree.places(self.tree.nodes()[node].children[k]);
            self.dipoles[places].iter().for_each(&mut near);
        };
        self.tree.traverse(stack, tolerance, visit, leaf);
    }

    /// Divides the share of a node's error among those below it that are clusters, by how much they add to the field or
    /// its gradient: the same number of terms will do for all.
    fn shares(&self, node: usize, q: Vec2, share: f64, quantity: Quantity) -> [f64; WIDTH] {
        let nearest = NEAREST * self.clusters[node].radius;
        let weights = self.tree.nodes()[node].children.map(|child| {
            let Child::Inner(below) = child else { return 0.0 };
            let cluster = &self.clusters[below as usize];
            let distance = q.distance(cluster.centre).max(cluster.radius).max(nearest);
            match quantity {
                Quantity::Value => cluster.strength / distance,
                Quantity::Gradient => cluster.strength / (distance * distance),
            }
        });
        let total: f64 = weights.iter().sum();
        weights.map(|weight| share * (weight / total))
    }
}
