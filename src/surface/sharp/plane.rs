//! Planes that the data has near a place, and where they meet.
use crate::math::Vec3;

/// Of two normals nearer to opposite than this cosine, the planes meet too far away to tell where.
const OPPOSITE: f64 = -0.94;
/// Squared sine from which planes are not parallel.
const PARALLEL: f64 = 1e-4;
/// Least volume spanned by three unit normals that meet in a corner.
const LEAST_VOLUME: f64 = 0.1;

/// A plane that a part of the data lies in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Amid that part of the data.
    pub point: Vec3,
    /// Unit, outward.
    pub normal: Vec3,
}

impl Plane {
    /// Positive outside.
    pub fn distance(&self, place: Vec3) -> f64 {
        (place - self.point).dot(self.normal)
    }

    pub fn projected(&self, place: Vec3) -> Vec3 {
        place - self.distance(place) * self.normal
    }

    /// 1 where the surface bends away from its outside between this plane's data and another's, -1 where it bends toward it; 0 where
    /// the data of one lies on both sides of the other, as around saddles, so that it does not tell.
    pub fn bend(&self, other: &Plane) -> f64 {
        match [other.distance(self.point) <= 0.0, self.distance(other.point) <= 0.0] {
            [true, true] => 1.0,
            [false, false] => -1.0,
            _ => 0.0,
        }
    }

    /// A place in this plane moved within it, away from the line where it meets another, so that it is on the side where this plane's
    /// data is. What is less than `margin` away from the line, or beyond it, keeps its order: no two places fall together.
    pub fn kept_off(&self, place: Vec3, other: &Plane, margin: f64) -> Vec3 {
        let away = -self.bend(other) * (other.normal - other.normal.dot(self.normal) * self.normal);
        // Parallel planes, of the two sides of a wall, meet nowhere.
        if away.length_squared() < PARALLEL {
            return place;
        }
        let sine = away.length();
        let distance = -self.bend(other) * other.distance(place) / sine;
        // The hyperbola goes on from the straight line without a kink, and never reaches 0.
        let wanted = if distance < margin { margin / (2.0 - distance / margin) } else { distance };
        place + (wanted - distance) / sine * away
    }
}

/// The place nearest to `near` in two planes; nothing where they are nearly parallel.
pub fn edge_of(a: &Plane, b: &Plane, near: Vec3) -> Option<Vec3> {
    let cosine = a.normal.dot(b.normal);
    let (da, db) = (a.distance(near), b.distance(near));
    let square = 1.0 - cosine * cosine;
    let place = near + ((cosine * db - da) * a.normal + (cosine * da - db) * b.normal) / square;
    (cosine > OPPOSITE && square > PARALLEL).then_some(place)
}

/// The place in three planes; nothing where they do not span space well.
pub fn corner_of([a, b, c]: &[Plane; 3], near: Vec3) -> Option<Vec3> {
    let [da, db, dc] = [a, b, c].map(|plane| plane.distance(near));
    let volume = a.normal.dot(b.normal.cross(c.normal));
    let sum = da * b.normal.cross(c.normal) + db * c.normal.cross(a.normal) + dc * a.normal.cross(b.normal);
    (volume.abs() > LEAST_VOLUME).then(|| near - sum / volume)
}

/// The edge or the corner of two or three planes.
pub fn meeting_of(planes: &[Plane], near: Vec3) -> Option<Vec3> {
    match planes {
        [a, b] => edge_of(a, b, near),
        [a, b, c] => corner_of(&[*a, *b, *c], near),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(point: [f64; 3], normal: [f64; 3]) -> Plane {
        Plane { point: Vec3::from_array(point), normal: Vec3::from_array(normal).normalize() }
    }

    #[test]
    fn planes_meet_where_all_distances_vanish() {
        let planes = [
            plane([1.0, 2.0, 3.0], [1.0, 0.2, 0.1]),
            plane([0.0, 1.0, 0.0], [0.3, 1.0, 0.0]),
            plane([0.5; 3], [-0.2, 0.4, 1.0]),
        ];
        let corner = corner_of(&planes, Vec3::ONE).unwrap();
        assert!(planes.iter().all(|p| p.distance(corner).abs() < 1e-14));
        let edge = edge_of(&planes[0], &planes[1], Vec3::ONE).unwrap();
        assert!(planes[..2].iter().all(|p| p.distance(edge).abs() < 1e-14));
        // Nearest: what is left is perpendicular to the line.
        let line = planes[0].normal.cross(planes[1].normal);
        assert!((edge - Vec3::ONE).dot(line).abs() < 1e-14);
        assert_eq!(edge_of(&planes[0], &planes[0], Vec3::ONE), None);
        assert_eq!(corner_of(&[planes[0], planes[1], planes[0]], Vec3::ONE), None);
    }

    #[test]
    fn places_beyond_an_edge_are_brought_back() {
        let top = plane([-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let convex = plane([0.0, 0.0, -1.0], [1.0, 0.0, 0.0]);
        let concave = plane([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        assert_eq!((top.bend(&convex), convex.bend(&top)), (1.0, 1.0));
        let kept_off = |x: f64, other: &Plane| top.kept_off(Vec3::new(x, 2.0, 0.0), other, 0.1);
        assert_eq!(kept_off(-0.3, &convex), Vec3::new(-0.3, 2.0, 0.0));
        assert_eq!(kept_off(0.0, &convex), Vec3::new(-0.05, 2.0, 0.0));
        assert!(kept_off(0.3, &convex).abs_diff_eq(Vec3::new(-0.02, 2.0, 0.0), 1e-15));
        // The floor next to a wall.
        let floor = plane([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(floor.bend(&concave), -1.0);
        let brought_back = floor.kept_off(Vec3::new(-0.3, 2.0, 0.0), &concave, 0.1);
        assert!(brought_back.abs_diff_eq(Vec3::new(0.02, 2.0, 0.0), 1e-15));
        let below = plane([0.0, 0.0, -0.2], [0.0, 0.0, -1.0]);
        assert_eq!(top.kept_off(Vec3::ONE, &below, 0.1), Vec3::ONE);
    }
}
