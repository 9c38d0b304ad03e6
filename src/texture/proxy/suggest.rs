use super::components::count_outer;
use super::{ProxyError, ProxySides, SAMPLES_OF_OFFSET, longest_side, trace};
use crate::data::{Monitor, Parts};
use crate::winding::WindingField;
use std::cell::Cell;

/// Offsets that are tried, in longest sides: smaller ones take more samples than a suggestion is worth.
const LEAST: f64 = 1.0 / 80.0;
const LARGEST: f64 = 1.0;
/// Halvings between them, on a scale of ratios: the last two differ by 4 %.
const HALVINGS: usize = 7;
const STEP: f64 = 1.04;
/// Offsets that are tried in all, unless few samples bridge less than many.
const TRIALS: f64 = 2.0 + HALVINGS as f64;
/// Samples for each offset: gaps are told to half of a sample.
const FINE: f64 = 2.0 * SAMPLES_OF_OFFSET;

/// The smallest offset at which a soup has a proxy of one component; 1/80 of its longest side if that is enough. It is half of the
/// widest gap that has to be bridged, to 4 % and an eighth less where samples bridge the rest.
///
/// # Errors
/// If and only if the soup is empty or has no size, or the monitor cancels.
pub fn smallest_single_offset(
    field: &WindingField,
    sides: ProxySides,
    monitor: &dyn Monitor,
) -> Result<f64, ProxyError> {
    let longest = longest_side(field)?;
    if longest == 0.0 {
        return Err(ProxyError::BadOffset(0.0));
    }
    let parts = Parts::new(monitor);
    let trial = Cell::new(0.0);
    let heard = |fraction: f64, _: &str| parts.report(fraction, "suggested offset").is_ok();
    let is_one = |offset: f64, samples: f64| -> Result<bool, ProxyError> {
        parts.begin(trial.get() / TRIALS, ((trial.get() + 1.0) / TRIALS).min(1.0));
        trial.set(trial.get() + 1.0);
        let traced = trace(field, offset, offset / samples, sides, &heard)?;
        Ok(count_outer(traced, &heard)? == 1)
    };
    let (mut low, mut high) = (LEAST * longest, LARGEST * longest);
    if is_one(low, SAMPLES_OF_OFFSET)? {
        return Ok(low);
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if is_one(middle, FINE)? {
            high = middle;
        } else {
            low = middle;
        }
    }
    // What few samples bridge depends on where they lie.
    while high < LARGEST * longest && !is_one(high, SAMPLES_OF_OFFSET)? {
        high *= STEP;
    }
    Ok(high)
}
