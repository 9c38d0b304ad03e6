//! Signed distances: how far the shape is, negative inside.
//!
//! The length is that to the nearest triangle or point, exact to rounding ([`crate::distance`]); the sign is the winding field's
//! (Barill et al. 2018, section 4), so that open, overlapping and partly flipped shapes have the right one. Inside means w ≥ 1/2; on the
//! surface the distance is 0. Triangles within a solid count too: there, distances are those to the nearest triangle, not to the outside.
mod lattice;

use crate::bvh::along_curve;
use crate::data::{Cancelled, Monitor, OutOfMemory, Parts, fill_blocks, zeroed};
use crate::distance::{Closest, DistanceTree, Search};
use crate::math::{Feature, Vec3};
use crate::winding::{Accuracy, FieldError, WindingField};
use std::sync::Arc;

pub use lattice::Slab;

/// The part of the progress that measuring tells; signing tells the rest.
const MEASURED: f64 = 0.7;
/// Places that make a task: one after the other along a curve, each search begins near where the last one ended.
const RUN: usize = 256;
/// Places from which on they are sorted along a curve.
const MANY: usize = 64;

/// How inside and outside are told apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DistanceSign {
    /// Negative where w ≥ 1/2.
    #[default]
    Hard,
    /// The distance times 1 − 2 w: it changes its sign without a jump where openings are. Beyond a band, the band times that.
    Smooth,
    /// Never negative.
    None,
}

/// How distances are measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DistanceConfig {
    pub sign: DistanceSign,
    /// Distances up to this are exact; what is farther has this distance and the right sign. Far places then cost next to nothing.
    pub band: Option<f64>,
}

/// Why distances could not be measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DistanceError {
    #[error("there is nothing to be near to: the shape is empty")]
    EmptyShape,
    #[error("a band of {0} is not possible: it must be a number above 0")]
    BadBand(f64),
    #[error(transparent)]
    Field(#[from] FieldError),
}

impl From<Cancelled> for DistanceError {
    fn from(cancelled: Cancelled) -> DistanceError {
        FieldError::from(cancelled).into()
    }
}

impl From<OutOfMemory> for DistanceError {
    fn from(out_of_memory: OutOfMemory) -> DistanceError {
        FieldError::from(out_of_memory).into()
    }
}

/// A shape, to be asked for signed distances: its field and a tree over its triangles or points.
///
/// ```
/// use fast_winding::{TriangleSoup, WindingField, math::Vec3, solid::SignedDistance};
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
/// let soup = TriangleSoup::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// let field = WindingField::new(soup, Default::default());
/// let distance = SignedDistance::new(&field);
/// assert_eq!(distance.at(Vec3::new(0.2, 0.2, 0.1)), -0.1);
/// assert_eq!(distance.at(Vec3::new(0.2, 0.2, -2.0)), 2.0);
/// # Ok::<(), fast_winding::data::SoupError>(())
/// ```
pub struct SignedDistance<'a> {
    field: &'a WindingField,
    tree: Arc<DistanceTree>,
}

/// A nearest point, with what depends on the sign.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SignedClosest {
    /// Its distance is never negative.
    pub closest: Closest,
    /// Negative inside.
    pub signed: f64,
    /// Unit, the direction in which the signed distance rises: away from the nearest point outside, toward it inside; on the surface
    /// the normal there.
    pub gradient: Vec3,
}

impl<'a> SignedDistance<'a> {
    /// Builds the tree; the field tells inside from outside.
    pub fn new(field: &'a WindingField) -> SignedDistance<'a> {
        SignedDistance::with_tree(field, Arc::new(DistanceTree::new(field.shape())))
    }

    /// With a tree that was built before, of the same shape.
    pub fn with_tree(field: &'a WindingField, tree: Arc<DistanceTree>) -> SignedDistance<'a> {
        SignedDistance { field, tree }
    }

    pub fn field(&self) -> &'a WindingField {
        self.field
    }

    /// The distances without their signs.
    pub fn unsigned(&self) -> &DistanceTree {
        &self.tree
    }

    /// The signed distance at `q`, with a hard sign: infinite for an empty shape, NaN where `q` is not finite.
    pub fn at(&self, q: Vec3) -> f64 {
        let distance = match self.tree.closest(q) {
            Some(found) => found.distance,
            None if q.is_finite() => f64::INFINITY,
            None => f64::NAN,
        };
        hard(distance, self.field.contains_point(q))
    }

    /// Signed distances at `points`, in their order; NaN where one is not finite.
    ///
    /// # Errors
    /// If and only if the shape is empty, the band is not a number above 0, `monitor` cancels, or memory does not suffice.
    pub fn distances(
        &self,
        points: &[Vec3],
        config: &DistanceConfig,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, DistanceError> {
        let band = self.check(config)?;
        let monitor = &Parts::new(monitor);
        monitor.begin(0.0, if config.sign == DistanceSign::None { 1.0 } else { MEASURED });
        let (order, sorted) = along_the_curve(points);
        let mut found = zeroed(points.len())?;
        let measure = |first: usize, found: &mut [f64], search: &mut Search| {
            for (found, place) in found.iter_mut().zip(&sorted[first..]) {
                let beyond = if place.is_finite() { band } else { f64::NAN };
                *found = self.tree.distance_within(*place, band, search).unwrap_or(beyond);
            }
        };
        fill_blocks(&mut found, RUN, measure, "distances", monitor)?;
        monitor.begin(MEASURED, 1.0);
        match config.sign {
            DistanceSign::None => {}
            DistanceSign::Hard => {
                let inside = self.field.contains(&sorted, monitor)?;
                found.iter_mut().zip(inside).for_each(|(d, inside)| *d = hard(*d, inside));
            }
            DistanceSign::Smooth => {
                let values = self.field.evaluate(&sorted, Accuracy::default(), monitor)?;
                found.iter_mut().zip(values).for_each(|(d, w)| *d = smooth(*d, w));
            }
        }
        Ok(in_order(&order, &found)?)
    }

    /// The nearest point of the shape for each of `points`, in their order; NaN where one is not finite.
    ///
    /// # Errors
    /// If and only if the shape is empty, `monitor` cancels, or memory does not suffice.
    pub fn closest(
        &self,
        points: &[Vec3],
        monitor: &dyn Monitor,
    ) -> Result<Vec<SignedClosest>, DistanceError> {
        self.check(&DistanceConfig::default())?;
        let monitor = &Parts::new(monitor);
        monitor.begin(0.0, MEASURED);
        let (order, sorted) = along_the_curve(points);
        let mut found = zeroed(points.len())?;
        let measure = |first: usize, found: &mut [SignedClosest], search: &mut Search| {
            for (found, place) in found.iter_mut().zip(&sorted[first..]) {
                *found = match self.tree.closest_within(*place, f64::INFINITY, search) {
                    Some(closest) => SignedClosest { closest, ..SignedClosest::default() },
                    None => SignedClosest::UNKNOWN,
                };
            }
        };
        fill_blocks(&mut found, RUN, measure, "distances", monitor)?;
        monitor.begin(MEASURED, 1.0);
        let inside = self.field.contains(&sorted, monitor)?;
        for ((found, place), inside) in found.iter_mut().zip(&sorted).zip(inside) {
            found.signed = hard(found.closest.distance, inside);
            found.gradient = self.gradient(*place, &found.closest, inside);
        }
        Ok(in_order(&order, &found)?)
    }

    /// The direction in which the signed distance rises at `place`.
    fn gradient(&self, place: Vec3, closest: &Closest, inside: bool) -> Vec3 {
        if closest.distance.is_nan() {
            return Vec3::NAN;
        }
        let away = (place - closest.point).normalize_or_zero();
        if closest.distance == 0.0 || away == Vec3::ZERO {
            return self.tree.normal(closest.element);
        }
        if inside { -away } else { away }
    }

    /// The band, infinite where there is none.
    fn check(&self, config: &DistanceConfig) -> Result<f64, DistanceError> {
        if self.field.shape().is_empty() {
            return Err(DistanceError::EmptyShape);
        }
        match config.band {
            Some(band) if band > 0.0 => Ok(band),
            Some(band) => Err(DistanceError::BadBand(band)),
            None => Ok(f64::INFINITY),
        }
    }
}

impl SignedClosest {
    const UNKNOWN: SignedClosest = SignedClosest {
        closest: Closest {
            distance: f64::NAN,
            point: Vec3::NAN,
            element: 0,
            barycentric: [f64::NAN; 3],
            feature: Feature::Face,
        },
        signed: f64::NAN,
        gradient: Vec3::NAN,
    };
}

fn hard(distance: f64, inside: bool) -> f64 {
    // Never -0.
    if inside && distance != 0.0 { -distance } else { distance }
}

fn smooth(distance: f64, winding: f64) -> f64 {
    // Not NaN for what is infinitely far: there, w is 0.
    if distance.is_infinite() { distance } else { (1.0 - 2.0 * winding) * distance }
}

/// Points along a curve through them, if they are many, and where each of them comes from.
fn along_the_curve(points: &[Vec3]) -> (Vec<u32>, Vec<Vec3>) {
    if points.len() < MANY {
        return ((0..points.len() as u32).collect(), points.to_vec());
    }
    let order = along_curve(points);
    let sorted = order.iter().map(|i| points[*i as usize]).collect();
    (order, sorted)
}

fn in_order<T: Copy + Default>(order: &[u32], sorted: &[T]) -> Result<Vec<T>, OutOfMemory> {
    let mut values = zeroed(sorted.len())?;
    order.iter().zip(sorted).for_each(|(i, value)| values[*i as usize] = *value);
    Ok(values)
}
