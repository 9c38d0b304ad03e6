//! Drains: cylinders that are taken out of a wall.
use crate::math::Vec3;

/// A cylinder with flat ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    pub start: Vec3,
    /// Unit, from one end to the other.
    pub direction: Vec3,
    pub length: f64,
    pub radius: f64,
}

impl Cylinder {
    /// How far a place is outside of the side and of the nearer end, and the normals there: away from the axis, and from the ends.
    fn sides(&self, q: Vec3) -> [(f64, Vec3); 2] {
        let offset = q - self.start;
        let along = offset.dot(self.direction);
        let across = offset - along * self.direction;
        let end = if along > 0.5 * self.length {
            (along - self.length, self.direction)
        } else {
            (-along, -self.direction)
        };
        [(across.length() - self.radius, across.normalize_or_zero()), end]
    }

    /// Positive outside.
    pub fn distance(&self, q: Vec3) -> f64 {
        let [(side, _), (end, _)] = self.sides(q);
        if side > 0.0 && end > 0.0 { side.hypot(end) } else { side.max(end) }
    }

    /// Into the cylinder: outward of what it is taken from.
    pub fn normal(&self, q: Vec3) -> Vec3 {
        let [side, end] = self.sides(q);
        -if side.0 >= end.0 { side.1 } else { end.1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_to_the_side_the_ends_and_their_rims() {
        let drain = Cylinder { start: Vec3::ZERO, direction: Vec3::Z, length: 10.0, radius: 2.0 };
        let cases = [
            ([1.0, 0.0, 5.0], -1.0),
            ([0.0, 0.5, 0.25], -0.25),
            ([0.0, 5.0, 5.0], 3.0),
            ([0.0, 1.0, 14.0], 4.0),
            ([5.0, 0.0, -4.0], 5.0),
        ];
        for (q, expected) in cases {
            assert_eq!(drain.distance(Vec3::from_array(q)), expected);
        }
        assert_eq!(drain.normal(Vec3::new(3.0, 0.0, 5.0)), -Vec3::X);
        assert_eq!(drain.normal(Vec3::new(0.0, 0.1, 12.0)), -Vec3::Z);
    }
}
