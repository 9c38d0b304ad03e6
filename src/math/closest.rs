//! The nearest point of a triangle.
use super::Vec3;

/// The part of a triangle abc that a point lies on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Feature {
    #[default]
    Face,
    /// Side k goes from corner k to the next: 0 is ab, 1 is bc, 2 is ca.
    Edge(u8),
    /// Corner k: 0 is a.
    Vertex(u8),
}

impl Feature {
    /// 0 for the face, 1 to 3 for the sides ab, bc and ca, 4 to 6 for the corners a, b and c.
    pub fn code(self) -> u8 {
        match self {
            Feature::Face => 0,
            Feature::Edge(k) => 1 + k,
            Feature::Vertex(k) => 4 + k,
        }
    }
}

/// A point of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnTriangle {
    pub point: Vec3,
    /// Squared distance to the point that it is nearest to.
    pub squared: f64,
    /// Weights of the corners, not negative, with sum 1.
    pub barycentric: [f64; 3],
    pub feature: Feature,
}

/// Where the foot of the perpendicular from `q` lies in the triangle's plane, as weights of the corners that are all above 0, and
/// the scaled normal; nothing if it lies outside the triangle or on its outline, or if the triangle has no area.
#[inline(always)]
fn foot(q: Vec3, [a, b, c]: [Vec3; 3]) -> Option<([f64; 3], Vec3, f64)> {
    let normal = (b - a).cross(c - a);
    let square = normal.length_squared();
    let weight = |s: Vec3, t: Vec3| normal.cross(t - s).dot(q - s);
    let weights = [weight(b, c), weight(c, a), weight(a, b)];
    let [wa, wb, wc] = weights;
    let is_within = wa > 0.0 && wb > 0.0 && wc > 0.0 && square > f64::MIN_POSITIVE && square.is_finite();
    is_within.then_some((weights, normal, square))
}

/// How far along side `st` the point nearest to `q` is, from 0 to 1; 0 for a side without length.
#[inline]
fn along(q: Vec3, s: Vec3, t: Vec3) -> f64 {
    let share = (q - s).dot(t - s) / (t - s).length_squared();
    // NaN for a side without length.
    if share > 0.0 { share.min(1.0) } else { 0.0 }
}

/// The square of the distance from `q` to the nearest point of triangle `abc`; of a triangle without area, to its longest side.
#[inline]
pub fn squared_distance_to_triangle(q: Vec3, [a, b, c]: [Vec3; 3]) -> f64 {
    if let Some((_, normal, square)) = foot(q, [a, b, c]) {
        let height = (q - a).dot(normal);
        return height * height / square;
    }
    let to_side = |s: Vec3, t: Vec3| q.distance_squared(s + along(q, s, t) * (t - s));
    to_side(a, b).min(to_side(b, c)).min(to_side(c, a))
}

/// The point of triangle `abc` nearest to `q`; of a triangle without area, that of its sides. Its squared distance is that of
/// [`squared_distance_to_triangle`], bit by bit. On a corner, the first of those in its place.
pub fn closest_on_triangle(q: Vec3, [a, b, c]: [Vec3; 3]) -> OnTriangle {
    if let Some((weights, normal, square)) = foot(q, [a, b, c]) {
        let height = (q - a).dot(normal);
        let sum: f64 = weights.iter().sum();
        return OnTriangle {
            point: q - height / square * normal,
            squared: height * height / square,
            barycentric: weights.map(|w| w / sum),
            feature: Feature::Face,
        };
    }
    let corners = [a, b, c];
    let on_side = |side: usize| {
        let next = (side + 1) % 3;
        let (s, t) = (corners[side], corners[next]);
        let share = along(q, s, t);
        let mut barycentric = [0.0; 3];
        (barycentric[side], barycentric[next]) = (1.0 - share, share);
        let point = s + share * (t - s);
        let feature = match share {
            0.0 => Feature::Vertex(side as u8),
            1.0 => Feature::Vertex(next as u8),
            _ => Feature::Edge(side as u8),
        };
        OnTriangle { point, squared: q.distance_squared(point), barycentric, feature }
    };
    let nearer = |one: OnTriangle, other: OnTriangle| if other.squared < one.squared { other } else { one };
    nearer(nearer(on_side(0), on_side(1)), on_side(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::distance_to_triangle;

    #[test]
    fn the_nearest_point_has_its_feature_and_weights() {
        let t = [Vec3::ZERO, 2.0 * Vec3::X, 2.0 * Vec3::Y];
        let cases = [
            ([0.5, 0.5, 3.0], [0.5, 0.5, 0.0], 9.0, Feature::Face),
            ([1.0, -2.0, 0.0], [1.0, 0.0, 0.0], 4.0, Feature::Edge(0)),
            ([2.0, 2.0, 1.0], [1.0, 1.0, 0.0], 3.0, Feature::Edge(1)),
            ([-1.0, 0.5, 0.0], [0.0, 0.5, 0.0], 1.0, Feature::Edge(2)),
            ([-1.0, -1.0, 1.0], [0.0, 0.0, 0.0], 3.0, Feature::Vertex(0)),
            ([5.0, 0.0, 0.0], [2.0, 0.0, 0.0], 9.0, Feature::Vertex(1)),
            ([-1.0, 4.0, 0.0], [0.0, 2.0, 0.0], 5.0, Feature::Vertex(2)),
        ];
        for (q, point, squared, feature) in cases {
            let (q, found) = (Vec3::from_array(q), closest_on_triangle(Vec3::from_array(q), t));
            assert_eq!(
                (found.point, found.squared, found.feature),
                (Vec3::from_array(point), squared, feature)
            );
            let weighed: Vec3 = t.iter().zip(found.barycentric).map(|(p, w)| w * *p).sum();
            assert!(weighed.distance(found.point) < 1e-15, "{q}");
            assert_eq!(squared_distance_to_triangle(q, t), found.squared);
        }
        let codes: Vec<u8> = cases.iter().map(|case| case.3.code()).collect();
        assert_eq!(codes, [0, 1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn triangles_without_area_are_their_sides() {
        let segment = [Vec3::ZERO, Vec3::X, 3.0 * Vec3::X];
        let found = closest_on_triangle(Vec3::new(2.0, 1.0, 0.0), segment);
        assert_eq!((found.point, found.squared, found.feature), (2.0 * Vec3::X, 1.0, Feature::Edge(1)));
        let point = closest_on_triangle(Vec3::Y, [Vec3::ZERO; 3]);
        assert_eq!((point.point, point.feature), (Vec3::ZERO, Feature::Vertex(0)));
    }

    #[test]
    fn it_is_as_far_as_the_plain_distance_says() {
        let place = |i: u32| Vec3::from_array([0.37, 1.73, 2.91].map(|s| (f64::from(i) * s).sin()));
        for i in 0..2000 {
            let t = [place(3 * i), place(3 * i + 1), 0.1 * place(3 * i + 2)];
            let q = 2.0 * place(7 * i + 5);
            let found = closest_on_triangle(q, t);
            assert!((found.squared.sqrt() - distance_to_triangle(q, t)).abs() < 1e-14);
            assert!((found.point.distance(q) - found.squared.sqrt()).abs() < 1e-14);
            assert_eq!(squared_distance_to_triangle(q, t), found.squared);
            assert!(found.barycentric.iter().all(|w| *w >= 0.0));
        }
    }
}
