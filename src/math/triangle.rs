//! The solid angle of a triangle: van Oosterom & Strackee 1983; Barill et al. 2018, eq. 1.
use super::{Place, Vec3};

/// The normal of triangle `abc` scaled by its area: ½ (b − a) × (c − a).
#[inline]
pub fn area_vector([a, b, c]: [Vec3; 3]) -> Vec3 {
    0.5 * (b - a).cross(c - a)
}

/// The unit normal of triangle `abc`, to rounding however thin it is, as far as numbers of twice the precision reach; zero where they
/// see no area.
pub fn normal(corners: [Vec3; 3]) -> Vec3 {
    let [a, b, c] = corners.map(Place::from);
    let exact = b.minus(a).cross(c.minus(a));
    if exact.is_finite() {
        exact.rounded().normalize_or_zero()
    } else {
        area_vector(corners).normalize_or_zero()
    }
}

/// The volume between triangle `abc` and `apex`, negative where the normal points to the side of `apex`: over all triangles of a
/// closed surface, the volume within, for any apex. It is subtracted first: stable far from the origin.
#[inline]
pub fn signed_volume(corners: [Vec3; 3], apex: Vec3) -> f64 {
    let [a, b, c] = corners.map(|p| p - apex);
    a.dot(b.cross(c)) / 6.0
}

pub fn barycentre([a, b, c]: [Vec3; 3]) -> Vec3 {
    (a + b + c) / 3.0
}

/// Distance from `q` to the nearest point of triangle `abc`; of a triangle without area, to its longest side or farther in
/// by rounding only.
pub fn distance_to_triangle(q: Vec3, [a, b, c]: [Vec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    let is_above = |s: Vec3, t: Vec3| normal.cross(t - s).dot(q - s) >= 0.0;
    if normal != Vec3::ZERO && is_above(a, b) && is_above(b, c) && is_above(c, a) {
        return (q - a).dot(normal).abs() / normal.length();
    }
    let to_side = |s: Vec3, t: Vec3| {
        let along = (q - s).dot(t - s) / (t - s).length_squared();
        // NaN for a side without length.
        let along = if along > 0.0 { along.min(1.0) } else { 0.0 };
        q.distance(s + along * (t - s))
    };
    to_side(a, b).min(to_side(b, c)).min(to_side(c, a))
}

/// Signed solid angle of triangle `abc` seen from `q`, in steradians, within ±2π.
///
/// Positive where the triangle's normal points away from `q`. Zero in the triangle's own plane, on the
/// triangle included: that is the principal value, so that a closed surface gives w = 1/2 on a face.
pub fn solid_angle(q: Vec3, [a, b, c]: [Vec3; 3]) -> f64 {
    // Edges are subtracted before the cross product: that stays accurate far from the triangle.
    let normal = (b - a).cross(c - a);
    let (a, b, c) = (a - q, b - q, c - q);
    let numerator = a.dot(normal);
    if numerator == 0.0 {
        return 0.0;
    }
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(numerator, denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn octant_triangle_spans_an_eighth_of_the_sphere() {
        let octant = [Vec3::X, Vec3::Y, Vec3::Z];
        assert!((solid_angle(Vec3::ZERO, octant) - PI / 2.0).abs() < 1e-15);
        let [a, b, c] = octant;
        assert!((solid_angle(Vec3::ZERO, [a, c, b]) + PI / 2.0).abs() < 1e-15);
    }

    #[test]
    fn the_thinnest_triangles_have_normals() {
        // Off the line by a unit in the last place, far from the origin: differences of rounded products see nothing of it.
        let end = Vec3::new(3.0, 3.0, 3.0);
        let aside = Vec3::new(1.0, 1.0 + f64::EPSILON, 1.0);
        let found = normal([Vec3::ZERO, end, aside]);
        assert!((found - Vec3::new(-1.0, 0.0, 1.0).normalize()).length() < 1e-15, "{found}");
        assert_eq!(normal([Vec3::ZERO, end, Vec3::ONE]), Vec3::ZERO);
    }

    #[test]
    fn the_nearest_point_may_be_inside_on_a_side_or_a_corner() {
        let t = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let cases = [
            (Vec3::new(0.2, 0.3, -2.0), 2.0),
            (Vec3::new(0.5, -3.0, 4.0), 5.0),
            (Vec3::new(1.0, 1.0, 0.0), 0.5f64.sqrt()),
            (Vec3::new(4.0, 0.0, 4.0), 5.0),
        ];
        for (q, expected) in cases {
            assert!((distance_to_triangle(q, t) - expected).abs() < 1e-15, "{q}");
        }
        assert_eq!(distance_to_triangle(Vec3::Z, [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]), 1.0);
    }

    #[test]
    fn own_plane_and_own_vertex_contribute_nothing() {
        let t = [Vec3::ZERO, Vec3::X, Vec3::Y];
        for q in [Vec3::ZERO, Vec3::new(0.25, 0.25, 0.0), Vec3::new(-3.0, 5.0, 0.0)] {
            assert_eq!(solid_angle(q, t), 0.0);
        }
    }
}
