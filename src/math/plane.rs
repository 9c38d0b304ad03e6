use super::{Mat3, Vec3};

/// The least-squares plane of a set of points.
#[derive(Clone, Copy, Debug)]
pub struct PlaneFit {
    pub center: Vec3,
    /// Unit normal, up to sign: the direction of least spread.
    pub normal: Vec3,
    /// Unit direction of greatest spread, perpendicular to `normal`.
    pub tangent: Vec3,
    /// Variance of the points along the normal, the middle axis and the tangent, ascending.
    pub variances: [f64; 3],
}

/// Fits a plane through the mean of `points` by principal component analysis.
///
/// Any set is accepted: for collinear or equal points the normal is one of the many that fit.
pub fn fit_plane(points: &[Vec3]) -> PlaneFit {
    let count = points.len().max(1) as f64;
    let center = points.iter().copied().sum::<Vec3>() / count;
    let mut covariance = [[0.0; 3]; 3];
    for p in points {
        let d = *p - center;
        for (row, di) in covariance.iter_mut().zip(d.to_array()) {
            for (entry, dj) in row.iter_mut().zip(d.to_array()) {
                *entry += di * dj / count;
            }
        }
    }
    let (variances, axes) = symmetric_eigen(covariance);
    PlaneFit { center, normal: axes.x_axis, tangent: axes.z_axis, variances }
}

/// Eigenvalues, ascending, and unit eigenvectors (columns, right-handed) of a symmetric 3×3 matrix by cyclic
/// Jacobi rotations: slower than the closed form, but accurate when eigenvalues coincide.
fn symmetric_eigen(mut m: [[f64; 3]; 3]) -> ([f64; 3], Mat3) {
    const SWEEPS: usize = 12; // convergence is quadratic: 4 to 6 are used, the rest is a stop for NaN
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]; // rows are eigenvectors
    for _ in 0..SWEEPS {
        let off = m[0][1].abs() + m[0][2].abs() + m[1][2].abs();
        if off <= f64::EPSILON * 1e-3 * (m[0][0].abs() + m[1][1].abs() + m[2][2].abs()) {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut m, &mut v, p, q);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| m[i][i].total_cmp(&m[j][j]));
    let [x, y, _] = order.map(|i| Vec3::from_array(v[i]).normalize_or(Vec3::AXES[i]));
    (order.map(|i| m[i][i]), Mat3::from_cols(x, y, x.cross(y)))
}

/// One Jacobi rotation that makes `m[p][q]` zero.
fn rotate(m: &mut [[f64; 3]; 3], v: &mut [[f64; 3]; 3], p: usize, q: usize) {
    if m[p][q] == 0.0 {
        return;
    }
    let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    for row in m.iter_mut() {
        let (a, b) = (row[p], row[q]);
        (row[p], row[q]) = (c * a - s * b, s * a + c * b);
    }
    for k in 0..3 {
        let (a, b) = (m[p][k], m[q][k]);
        (m[p][k], m[q][k]) = (c * a - s * b, s * a + c * b);
        let (a, b) = (v[p][k], v[q][k]);
        (v[p][k], v[q][k]) = (c * a - s * b, s * a + c * b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane_of_tilted_grid_is_found() {
        let n = Vec3::new(1.0, 2.0, -3.0).normalize();
        let (u, w) = n.any_orthonormal_pair();
        let points: Vec<Vec3> =
            (0..35).map(|i| Vec3::ONE + (i % 7) as f64 * u + 0.5 * (i / 7) as f64 * w).collect();
        let fit = fit_plane(&points);
        assert!(fit.normal.dot(n).abs() > 1.0 - 1e-14);
        assert!(fit.tangent.dot(u).abs() > 1.0 - 1e-12);
        assert!(fit.variances[0].abs() < 1e-14);
    }

    #[test]
    fn equal_and_collinear_points_give_a_unit_normal() {
        for points in [vec![Vec3::ONE; 5], (0..5).map(|i| i as f64 * Vec3::ONE).collect(), vec![]] {
            let fit = fit_plane(&points);
            assert!((fit.normal.length() - 1.0).abs() < 1e-12);
            assert!(fit.normal.dot(fit.tangent).abs() < 1e-12);
        }
    }
}
