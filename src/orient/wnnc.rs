//! Winding number normal consistency (Lin et al. 2024), and its bounded variants (*Leaps and Bounds*).
use super::Widths;
use crate::data::{Cancelled, Monitor};
use crate::math::{Aabb, Vec3};
use crate::treecode::Mutual;
use std::f64::consts::PI;

/// Which sums are bounded (papers' names in brackets).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum WnncVariant {
    /// None: Lin et al. 2024 {SD, A, G}.
    Plain,
    /// The gradients {SD, A, G_B}.
    #[default]
    BoundedGradient,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WnncConfig {
    pub variant: WnncVariant,
    pub widths: Widths,
    pub iterations: usize,
}

impl Default for WnncConfig {
    fn default() -> Self {
        WnncConfig { variant: WnncVariant::default(), widths: Widths::CLEAN, iterations: 40 }
    }
}

/// A cluster acts as a whole beyond so many of its radii.
const OPENING: f64 = 2.0;
/// The longest half edge of the cloud's box where widths are measured.
const HALF: f64 = 1.0 / 1.1;

/// Area vectors, normals times areas in square millimetres, for points without normals; outward.
///
/// In every iteration the area vectors μ move by steepest descent towards w = ½ at all points, where w = Aμ; then each is
/// turned to −∇w, as w falls outward, and keeps its length.
///
/// # Errors
/// If and only if `monitor` cancels.
pub fn wnnc(points: &[Vec3], config: &WnncConfig, monitor: &dyn Monitor) -> Result<Vec<Vec3>, Cancelled> {
    let bounds = Aabb::around(points.iter().copied());
    let scale = 2.0 * HALF / bounds.size().max_element();
    let scaled: Vec<Vec3> = points.iter().map(|p| (*p - bounds.center()) * scale).collect();
    let mutual = Mutual::new(&scaled, OPENING);
    let mut area_vectors = vec![Vec3::ZERO; points.len()];
    for iteration in 0..config.iterations {
        monitor.report(iteration as f64 / config.iterations as f64, "normals")?;
        let width = config.widths.at(iteration, config.iterations);
        // 4π times what is left to ½.
        let rest: Vec<f64> = mutual.potentials(&area_vectors, width).iter().map(|w| 2.0 * PI - w).collect();
        let descent = mutual.fields(&rest, width);
        let change = mutual.potentials(&descent, width);
        let squares = |sum: f64, x: f64| sum + x * x;
        let (along, across) = (
            descent.iter().map(|d| d.length_squared()).sum::<f64>(),
            change.iter().copied().fold(0.0, squares),
        );
        if across > 0.0 {
            area_vectors.iter_mut().zip(&descent).for_each(|(v, d)| *v += along / across * *d);
        }
        let gradients =
            mutual.gradients(&area_vectors, width, config.variant == WnncVariant::BoundedGradient);
        for (vector, gradient) in area_vectors.iter_mut().zip(gradients) {
            if let Some(inward) = gradient.try_normalize() {
                *vector = -vector.length() * inward;
            }
        }
    }
    let area = 1.0 / (scale * scale);
    area_vectors.iter_mut().for_each(|v| *v *= area);
    monitor.report(1.0, "normals")?;
    Ok(area_vectors)
}
