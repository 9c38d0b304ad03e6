use super::components::count_outer;
use super::{ProxyError, ProxySides, SAMPLES_OF_OFFSET, longest_side, trace};
use crate::data::Monitor;
use crate::winding::WindingField;

/// Offsets that are tried, in longest sides: smaller ones take more samples than a suggestion is worth.
const LEAST: f64 = 1.0 / 80.0;
const LARGEST: f64 = 1.0;
/// Halvings between them, on a scale of ratios: the last two differ by 4 %.
const HALVINGS: usize = 7;

/// The smallest offset, to 4 %, at which a soup has a proxy of one component; 1/80 of its longest side if that is enough. It is half of
/// the widest gap that has to be bridged.
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
    let quiet = |_: f64, _: &str| monitor.report(0.0, "suggested offset").is_ok();
    let is_one = |offset: f64| -> Result<bool, ProxyError> {
        let traced = trace(field, offset, offset / SAMPLES_OF_OFFSET, sides, &quiet)?;
        Ok(count_outer(traced, &quiet)? == 1)
    };
    let (mut low, mut high) = (LEAST * longest, LARGEST * longest);
    if is_one(low)? {
        return Ok(low);
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if is_one(middle)? {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(high)
}
