//! The bounded winding number of points (*Leaps and Bounds*, section 4): no point contributes more than half a turn, as if each
//! were a disk seen along its axis.
use crate::data::OrientedCloud;
use crate::math::{Vec2, Vec3};
use std::f64::consts::PI;

/// c(x) = ½ sign(x) (1 − 1/√(1 + 4|x|)): what becomes of the winding number x of one point. That of a disk of area a seen
/// along its axis at a distance d, where x = a / 4πd² (eq. 41). Far from a point it is x − 3x|x|.
#[inline]
pub fn bounded(x: f64) -> f64 {
    (0.5 - 0.5 / (1.0 + 4.0 * x.abs()).sqrt()).copysign(x)
}

/// c'(x) = (1 + 4|x|)^(−3/2), by which the gradients of points are multiplied (eq. 49).
#[inline]
pub fn bounded_slope(x: f64) -> f64 {
    let square = 1.0 + 4.0 * x.abs();
    1.0 / (square * square.sqrt())
}

/// The bounded winding number of a cloud at `q`, summed directly: Σ c(a n·(p − q) / 4π|p − q|³). A point at `q` contributes 0.
/// NaN where `q` is not finite.
pub fn bounded_winding_of_cloud(cloud: &OrientedCloud, q: Vec3) -> f64 {
    terms(cloud, q).map(|(x, _)| if q.is_finite() { bounded(x) } else { f64::NAN }).sum()
}

/// The gradient of [`bounded_winding_of_cloud`] at `q`, per millimetre: Σ c'(x) ∇x. A point at `q` contributes 0. NaN where `q`
/// is not finite.
pub fn bounded_gradient_of_cloud(cloud: &OrientedCloud, q: Vec3) -> Vec3 {
    if !q.is_finite() {
        return Vec3::NAN;
    }
    // Next to a point ∇x grows as 1/r³, and c' falls as r³.
    let part =
        |(x, gradient): (f64, Vec3)| if x.is_finite() { bounded_slope(x) * gradient } else { Vec3::ZERO };
    terms(cloud, q).map(part).sum()
}

/// The winding numbers of the points that are not at `q`, and their gradients.
fn terms(cloud: &OrientedCloud, q: Vec3) -> impl Iterator<Item = (f64, Vec3)> {
    let term = move |((p, n), a): ((&Vec3, &Vec3), &f64)| {
        let r = *p - q;
        let (square, strength) = (r.length_squared(), a / (4.0 * PI));
        let cube = square * square.sqrt();
        let gradient = strength * (3.0 * n.dot(r) / square * r - *n) / cube;
        (strength * n.dot(r) / cube, gradient)
    };
    let is_apart = move |((p, _), _): &((&Vec3, &Vec3), &f64)| **p != q;
    cloud.points().iter().zip(cloud.normals()).zip(cloud.areas()).filter(is_apart).map(term)
}

/// The bounded winding number of points of a plane with unit normals and lengths, summed directly:
/// Σ (1/π) arctan(l n·(p − q) / 2|p − q|²), that of a straight piece seen along its axis. A point at `q` contributes 0.
///
/// # Panics
/// If there are not as many normals and lengths as points.
pub fn bounded_winding_in_plane(points: &[Vec2], normals: &[Vec2], lengths: &[f64], q: Vec2) -> f64 {
    assert!(points.len() == normals.len() && points.len() == lengths.len(), "one of each for every point");
    let part = |((p, n), length): ((&Vec2, &Vec2), &f64)| {
        let r = *p - q;
        let square = r.length_squared();
        // Both are 0 at a point: atan2 gives 0 there, and ±π/2 where the square underflows.
        libm::atan2(length * n.dot(r), 2.0 * square) / PI
    };
    points.iter().zip(normals).zip(lengths).map(part).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_seen_along_its_normal_is_a_disk() {
        let area: f64 = 0.3;
        let cloud = OrientedCloud::new(vec![Vec3::ZERO], vec![Vec3::Z], vec![area]).unwrap();
        let radius = (area / PI).sqrt();
        for d in [1e-9_f64, 1e-3, 0.1, 1.0, 30.0] {
            // Half the share of the sphere that the disk covers, negative on the side its normal points to.
            let disk = 0.5 * (1.0 - d / d.hypot(radius));
            let w = bounded_winding_of_cloud(&cloud, d * Vec3::Z);
            assert!((w + disk).abs() < 1e-15, "{w} and {disk} at {d}");
            assert_eq!(bounded_winding_of_cloud(&cloud, -d * Vec3::Z), -w);
        }
        assert_eq!(bounded_winding_of_cloud(&cloud, Vec3::ZERO), 0.0);
        assert!(bounded_winding_of_cloud(&cloud, Vec3::NAN).is_nan());
    }

    #[test]
    fn gradients_are_slopes() {
        let points = vec![Vec3::ZERO, Vec3::new(0.3, -0.2, 0.1)];
        let cloud = OrientedCloud::new(points, vec![Vec3::Z, Vec3::X], vec![2.0, 0.5]).unwrap();
        for q in [Vec3::new(0.1, 0.05, 0.2), Vec3::new(0.0, 0.0, 1e-3), Vec3::new(3.0, 1.0, -2.0)] {
            let (found, h) = (bounded_gradient_of_cloud(&cloud, q), 1e-4 * q.length());
            for axis in Vec3::AXES {
                let at = |t: f64| bounded_winding_of_cloud(&cloud, q + t * axis);
                let slope = (at(h) - at(-h)) / (2.0 * h);
                assert!((found.dot(axis) - slope).abs() < 1e-5 * found.length().max(slope.abs()), "{q}");
            }
        }
    }

    #[test]
    fn a_circle_of_points_in_the_plane_has_the_inside_of_a_disk() {
        let count = 400;
        let on = |i: usize| Vec2::from_angle(2.0 * PI * i as f64 / f64::from(count as u32));
        let points: Vec<Vec2> = (0..count).map(on).collect();
        let lengths = vec![2.0 * PI / count as f64; count];
        let at = |q: Vec2| bounded_winding_in_plane(&points, &points, &lengths, q);
        assert!((at(Vec2::ZERO) - 1.0).abs() < 1e-4 && (at(Vec2::new(0.5, 0.3)) - 1.0).abs() < 1e-3);
        assert!(at(Vec2::new(2.0, -1.0)).abs() < 1e-3);
        assert!((at(points[7]) - 0.5).abs() < 0.01, "a point on it contributes nothing: {}", at(points[7]));
        // Right at a point the others give ½, it another half to the one side.
        assert!((at((1.0 - 1e-9) * points[7]) - 1.0).abs() < 0.01);
    }
}
