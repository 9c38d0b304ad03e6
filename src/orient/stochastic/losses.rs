//! The losses of a step by what is found at its samples (*Leaps and Bounds*, appendix F.3).
use super::LossWeights;
use super::samples::Samples;
use crate::math::Vec3;

/// What is found at the samples of a step.
pub struct Found {
    pub winding: Vec<f64>,
    /// The gradients of the winding number; those at fine samples count.
    pub gradients: Vec<Vec3>,
    /// The normals of the points that samples are around.
    pub normals: Vec<Vec3>,
}

/// The weighted sum of losses and its slopes.
pub struct Losses {
    pub sum: f64,
    /// Along the winding number at each sample.
    pub along_winding: Vec<f64>,
    /// Along the normal of each point that samples are around, winding numbers unchanged.
    pub along_normals: Vec<Vec3>,
}

/// Height a and summit c of the double wells for coarse samples, more of which are inside, and for fine ones.
const WELLS: [(f64, f64); 2] = [(8.0, 0.41), (8.0, 0.5)];

/// The losses of all terms but that of areas.
pub fn losses(samples: &Samples, found: &Found, weights: &LossWeights) -> Losses {
    let count = samples.numbers.len() as f64;
    let (fine, coarse) = (samples.all_fine(), samples.all_coarse());
    let mut losses =
        Losses { sum: 0.0, along_winding: vec![0.0; found.winding.len()], along_normals: vec![] };
    let terms = found.winding.iter().zip(&mut losses.along_winding);
    for (k, (w, along)) in terms.enumerate() {
        let (weight, (value, slope)) = if k < fine + coarse {
            (0.5 * weights.zero_or_one, double_well(*w, WELLS[usize::from(k < fine)]))
        } else {
            (weights.surface, ((w - 0.5).abs(), (w - 0.5).signum()))
        };
        losses.sum += weight / count * value;
        *along = weight / count * slope;
    }
    for (own, along) in
        found.winding[..fine].chunks(samples.fine).zip(losses.along_winding.chunks_mut(samples.fine))
    {
        losses.sum += balance(own, along, weights, count);
    }
    for (gradients, normal) in found.gradients[..fine].chunks(samples.fine).zip(&found.normals) {
        let inward: Vec3 = gradients.iter().map(|g| g.normalize_or_zero()).sum();
        let outward = -inward / samples.fine as f64;
        losses.sum += weights.alignment / count * (1.0 - outward.dot(*normal));
        losses.along_normals.push(-weights.alignment / count * outward);
    }
    losses
}

/// Eq. 63, which has minima at 0 and 1, and its slope.
fn double_well(x: f64, (a, c): (f64, f64)) -> (f64, f64) {
    let value = x * x * (a / 4.0 * x * x - (a + a * c) / 3.0 * x + a * c / 2.0);
    (value, a * x * (x - 1.0) * (x - c))
}

/// Eqs. 65 and 66 for the fine samples of one point: half of them are to be inside. Adds to the slopes.
fn balance(winding: &[f64], along: &mut [f64], weights: &LossWeights, points: f64) -> f64 {
    let count = winding.len() as f64;
    let mean = winding.iter().sum::<f64>() / count;
    let variance = winding.iter().map(|w| (w - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let excess = variance - count / (4.0 * (count - 1.0));
    for (w, along) in winding.iter().zip(along) {
        *along += weights.mean / points * 2.0 * (mean - 0.5) / count;
        *along += weights.variance / points * excess.signum() * 2.0 * (w - mean) / (count - 1.0);
    }
    (weights.mean * (mean - 0.5).powi(2) + weights.variance * excess.abs()) / points
}
