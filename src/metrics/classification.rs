use super::{MetricError, check_lengths};

/// Intersection over union of the insides that two classifications of the same places find: |A ∧ B| / |A ∨ B|, from 0 to 1;
/// 1 if neither finds any.
///
/// # Errors
/// If and only if they are not equally long, or empty.
pub fn intersection_over_union(found: &[bool], truth: &[bool]) -> Result<f64, MetricError> {
    check_lengths(found.len(), truth.len())?;
    let count = |holds: fn(bool, bool) -> bool| {
        found.iter().zip(truth).filter(|&(&found, &truth)| holds(found, truth)).count() as f64
    };
    let union = count(|a, b| a | b);
    Ok(if union == 0.0 { 1.0 } else { count(|a, b| a & b) / union })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_three_quarters_overlap() {
        let [a, b] = [[true, true, true, false], [false, true, true, false]];
        assert_eq!(intersection_over_union(&a, &b), Ok(2.0 / 3.0));
        assert_eq!(intersection_over_union(&[false], &[false]), Ok(1.0));
        assert_eq!(intersection_over_union(&[], &[]), Err(MetricError::Empty));
        let mismatch = MetricError::LengthMismatch { found: 4, expected: 1 };
        assert_eq!(intersection_over_union(&a, &b[..1]), Err(mismatch));
    }
}
