//! Winding number normal consistency (Lin et al. 2024), and its bounded variants (*Leaps and Bounds*).
use super::Widths;
use crate::data::Monitor;
use crate::estimate::{EstimateError, roughness};
use crate::math::{Aabb, Vec3};
use crate::treecode::Mutual;
use std::f64::consts::PI;

/// Which sums are bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Bounded {
    /// None: Lin et al. 2024, {SD, A, G} in *Leaps and Bounds*.
    Nothing,
    /// The gradients, {SD, A, G_B}: the better the noisier a cloud is and the narrower the widths.
    #[default]
    Gradients,
    /// Gradients and field, {LM, A_B, G_B}: as the field is no longer linear in the area vectors, they move by the method of
    /// Levenberg and Marquardt.
    Everything,
}

/// How consistency is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConsistencyConfig {
    pub bounded: Bounded,
    /// Those that spacing and noise of the cloud ask for, if none are given.
    pub widths: Option<Widths>,
    /// The paper takes 40.
    pub iterations: usize,
}

impl Default for ConsistencyConfig {
    fn default() -> Self {
        ConsistencyConfig { bounded: Bounded::default(), widths: None, iterations: 40 }
    }
}

/// A cluster acts as a whole beyond so many of its radii.
const OPENING: f64 = 2.0;
/// The longest half edge of the cloud's box where widths are measured.
const HALF_EXTENT: f64 = 1.0 / 1.1;

/// Area vectors, outward normals times areas in square millimetres, of points without normals, by winding number normal
/// consistency (Lin et al. 2024).
///
/// In every iteration the area vectors μ move by steepest descent towards w = ½ at all points, where w = Aμ; then each is
/// turned to −∇w, as w falls outward, and keeps its length.
///
/// # Errors
/// If and only if there are no points or `monitor` cancels.
pub fn consistent_area_vectors(
    points: &[Vec3],
    config: &ConsistencyConfig,
    monitor: &dyn Monitor,
) -> Result<Vec<Vec3>, EstimateError> {
    watched_area_vectors(points, config, monitor, &|_| ())
}

/// [`consistent_area_vectors`], which shows them to `watch` after each iteration, in a unit of its own.
pub(super) fn watched_area_vectors(
    points: &[Vec3],
    config: &ConsistencyConfig,
    monitor: &dyn Monitor,
    watch: &dyn Fn(&[Vec3]),
) -> Result<Vec<Vec3>, EstimateError> {
    let bounds = Aabb::around(points.iter().copied());
    let extent = bounds.size().max_element();
    let scale = if extent > 0.0 { 2.0 * HALF_EXTENT / extent } else { 1.0 };
    let scaled: Vec<Vec3> = points.iter().map(|p| (*p - bounds.center()) * scale).collect();
    let widths = match config.widths {
        Some(widths) => widths,
        None => Widths::for_roughness(&roughness(&scaled, &|_: f64, stage: &str| {
            monitor.report(0.0, stage).is_ok()
        })?),
    };
    let mutual = Mutual::new(&scaled, OPENING);
    let mut area_vectors = vec![Vec3::ZERO; points.len()];
    for iteration in 0..config.iterations {
        monitor.report(iteration as f64 / config.iterations as f64, "normals")?;
        let width = widths.at(iteration, config.iterations);
        match config.bounded {
            Bounded::Everything => descend_bounded(&mutual, &mut area_vectors, width),
            _ => descend(&mutual, &mut area_vectors, width),
        }
        let gradients = mutual.gradients(&area_vectors, width, config.bounded != Bounded::Nothing);
        for (vector, gradient) in area_vectors.iter_mut().zip(gradients) {
            if let Some(inward) = gradient.try_normalize() {
                *vector = -vector.length() * inward;
            }
        }
        watch(&area_vectors);
    }
    area_vectors.iter_mut().for_each(|v| *v /= scale * scale);
    monitor.report(1.0, "normals")?;
    Ok(area_vectors)
}

/// A step of steepest descent of ‖Aμ − ½‖².
fn descend(mutual: &Mutual, area_vectors: &mut [Vec3], width: f64) {
    // Potentials are 4πw.
    let rest: Vec<f64> = mutual.potentials(area_vectors, width).iter().map(|w| 2.0 * PI - w).collect();
    let slope = mutual.fields(&rest, width);
    let change = mutual.potentials(&slope, width);
    let along: f64 = slope.iter().map(|s| s.length_squared()).sum();
    let across: f64 = change.iter().map(|c| c * c).sum();
    if across > 0.0 {
        area_vectors.iter_mut().zip(&slope).for_each(|(v, s)| *v += along / across * *s);
    }
}

/// Steps of conjugate gradients for one of Levenberg and Marquardt.
const STEPS: usize = 2;
/// Its damping, in Rayleigh quotients of the direction of steepest descent.
const DAMPING: f64 = 0.1;

/// A step of Levenberg and Marquardt for ‖w_B(μ) − ½‖²: (JᵀJ + λ) δ = Jᵀ (½ − w_B), solved roughly.
fn descend_bounded(mutual: &Mutual, area_vectors: &mut [Vec3], width: f64) {
    let potentials = mutual.bounded_potentials(area_vectors, width);
    let rest: Vec<f64> = potentials.iter().map(|w| 2.0 * PI - w).collect();
    let mut residual = mutual.bounded_fields(area_vectors, &rest, width);
    let mut direction = residual.clone();
    let mut step = vec![Vec3::ZERO; residual.len()];
    let square = |vectors: &[Vec3]| vectors.iter().map(|v| v.length_squared()).sum::<f64>();
    let (mut size, mut damping) = (square(&residual), None);
    for _ in 0..STEPS {
        let change = mutual.bounded_change(area_vectors, &direction, width);
        let across: f64 = change.iter().map(|c| c * c).sum();
        let along = square(&direction);
        if !(across > 0.0 && along > 0.0) {
            break;
        }
        let damping = *damping.get_or_insert(DAMPING * across / along);
        let length = size / (across + damping * along);
        step.iter_mut().zip(&direction).for_each(|(s, d)| *s += length * *d);
        let image = mutual.bounded_fields(area_vectors, &change, width);
        for ((r, i), d) in residual.iter_mut().zip(image).zip(&direction) {
            *r -= length * (i + damping * *d);
        }
        let next = square(&residual);
        direction.iter_mut().zip(&residual).for_each(|(d, r)| *d = *r + next / size * *d);
        size = next;
    }
    area_vectors.iter_mut().zip(step).for_each(|(v, s)| *v += s);
}
