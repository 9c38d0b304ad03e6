//! The loss of one step as a function of what is found at its samples, and its slopes (*Leaps and Bounds*, appendix F.3).
use super::Weights;
use super::samples::Samples;
use crate::math::Vec3;

/// What the loss changes by.
pub struct Slopes {
    pub loss: f64,
    /// With the winding number at each sample.
    pub winding: Vec<f64>,
    /// With the normal of each point of the step, as to alignment.
    pub normals: Vec<Vec3>,
}

/// The double well of eq. 63, with minima at 0 and 1 and a summit at `c`, and its slope.
fn double_well(x: f64, a: f64, c: f64) -> (f64, f64) {
    let value = x * x * (a / 4.0 * x * x - (a + a * c) / 3.0 * x + a * c / 2.0);
    (value, a * x * (x - 1.0) * (x - c))
}

/// Height and summit of the wells of coarse samples, most of which are to be inside, and of fine ones.
const WELLS: [(f64, f64); 2] = [(8.0, 0.41), (8.0, 0.5)];

/// Given the winding numbers at all samples, their gradients at the fine ones and the normals of the step's points.
pub fn slopes(samples: &Samples, winding: &[f64], gradients: &[Vec3], normals: &[Vec3], weights: &Weights) -> Slopes {
    let count = samples.points.len() as f64;
    let (fine, rest) = winding.split_at(samples.all_fine());
    let coarse = rest.len() - samples.points.len();
    let mut slopes = Slopes { loss: 0.0, winding: vec![0.0; winding.len()], normals: vec![] };
    for (k, w) in winding[..fine.len() + coarse].iter().enumerate() {
        let (a, c) = WELLS[usize::from(k < fine.len())];
        let (value, slope) = double_well(*w, a, c);
        slopes.loss += 0.5 * weights.zero_or_one / count * value;
        slopes.winding[k] = 0.5 * weights.zero_or_one / count * slope;
    }
    for (own, slope) in fine.chunks(samples.fine).zip(slopes.winding.chunks_mut(samples.fine)) {
        slopes.loss += balance(own, slope, weights, count);
    }
    let at_points = fine.len() + coarse;
    for (w, slope) in winding[at_points..].iter().zip(&mut slopes.winding[at_points..]) {
        slopes.loss += weights.surface / count * (w - 0.5).abs();
        *slope = weights.surface / count * (w - 0.5).signum();
    }
    for (gradients, normal) in gradients.chunks(samples.fine).zip(normals) {
        let inward: Vec3 = gradients.iter().map(|g| g.normalize_or_zero()).sum();
        let outward = -inward / samples.fine as f64;
        slopes.loss += weights.alignment / count * (1.0 - outward.dot(*normal));
        slopes.normals.push(-weights.alignment / count * outward);
    }
    slopes
}

/// Eqs. 65 and 66 for the fine samples of one point: half of them are to be inside.
fn balance(winding: &[f64], slopes: &mut [f64], weights: &Weights, points: f64) -> f64 {
    let count = winding.len() as f64;
    let mean = winding.iter().sum::<f64>() / count;
    let variance = winding.iter().map(|w| (w - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let excess = variance - count / (4.0 * (count - 1.0));
    for (w, slope) in winding.iter().zip(slopes) {
        *slope += weights.mean / points * 2.0 * (mean - 0.5) / count;
        *slope += weights.variance / points * excess.signum() * 2.0 * (w - mean) / (count - 1.0);
    }
    (weights.mean * (mean - 0.5).powi(2) + weights.variance * excess.abs()) / points
}
