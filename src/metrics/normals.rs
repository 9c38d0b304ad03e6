use super::{MetricError, check_lengths, mean};
use crate::math::Vec3;

/// The share of normals within 90° of the true ones, from 0 to 1: the percentage of good points (PGP) of *Leaps and Bounds*
/// and of Xu et al. 2023 (GCNO), over 100. Normals may have any length; one of length zero is not good.
///
/// # Errors
/// If and only if the normals are not as many as the true ones, or none.
pub fn good_points(normals: &[Vec3], truth: &[Vec3]) -> Result<f64, MetricError> {
    check_lengths(normals.len(), truth.len())?;
    Ok(mean(normals.iter().zip(truth).map(|(n, t)| f64::from(u8::from(n.dot(*t) > 0.0)))))
}

/// The root mean square of the angles between normals and true ones, in degrees, from 0 to 180: √(Σ θᵢ² / n). Normals may
/// have any length; one of length zero counts as 90° off.
///
/// # Errors
/// If and only if the normals are not as many as the true ones, or none.
pub fn angle_rmse(normals: &[Vec3], truth: &[Vec3]) -> Result<f64, MetricError> {
    check_lengths(normals.len(), truth.len())?;
    let squares = normals.iter().zip(truth).map(|(n, t)| {
        let (n, t) = (n.normalize_or_zero(), t.normalize_or_zero());
        // Unlike the cosine's inverse, accurate for small angles.
        let angle = libm::atan2(n.cross(t).length(), n.dot(t));
        let is_undefined = n == Vec3::ZERO || t == Vec3::ZERO;
        if is_undefined { 90.0f64.powi(2) } else { angle.to_degrees().powi(2) }
    });
    Ok(mean(squares).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turned_normals_are_measured() {
        let truth = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::X];
        let at = |degrees: f64| Vec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0);
        assert_eq!(good_points(&truth, &truth), Ok(1.0));
        assert_eq!(angle_rmse(&truth, &truth), Ok(0.0));
        let turned = [at(30.0), at(90.0), -Vec3::Z, 7.0 * at(89.0)];
        assert_eq!(good_points(&turned, &truth), Ok(0.75));
        let expected = ((30.0f64.powi(2) + 180.0f64.powi(2) + 89.0f64.powi(2)) / 4.0).sqrt();
        assert!((angle_rmse(&turned, &truth).unwrap() - expected).abs() < 1e-12);
    }

    #[test]
    fn normals_without_length_are_neither_good_nor_wrong() {
        assert_eq!(good_points(&[Vec3::ZERO, Vec3::X], &[Vec3::X; 2]), Ok(0.5));
        assert_eq!(angle_rmse(&[Vec3::ZERO], &[Vec3::X]), Ok(90.0));
        assert_eq!(angle_rmse(&[], &[]), Err(MetricError::Empty));
        let mismatch = MetricError::LengthMismatch { found: 1, expected: 0 };
        assert_eq!(good_points(&[Vec3::X], &[]), Err(mismatch));
    }
}
