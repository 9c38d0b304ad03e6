//! Points on the surface: the principal value, and what the regions around them hold.
//!
//! Close to a point q of the surface the triangles that it lies on look like sectors of planes with their apex in q. Seen
//! from q + δ with an infinitely small δ, a sector between the directions u and v spans the spherical triangle
//! (−δ, u, v). So w(q + δ) = (principal value) + Σ (those solid angles) / 4π: constant over each region between sectors.
use crate::math::{Sign, Vec3, normal, normal_signs, tie_break};
use std::f64::consts::{PI, TAU};

/// Directions closer to a plane than this count as in it.
const FLAT: f64 = 1e-12;
/// What rounding may take from a winding number of exactly the threshold.
const ROUNDING: f64 = 1e-12;

/// What a triangle looks like from close to a point on it.
enum Sight {
    Plane,
    /// The unit vector in the plane, away from the edge.
    HalfPlane(Vec3),
    /// Unit directions of the two sides, in the triangle's turn.
    Corner(Vec3, Vec3),
}

/// A triangle at a point on it.
struct Fan {
    normal: Vec3,
    sight: Sight,
    /// Pairs of unit directions to the triangle's corners that span it, for each side on which the point does not lie.
    sectors: Vec<[Vec3; 2]>,
}

impl Fan {
    fn new(q: Vec3, corners: [Vec3; 3]) -> Fan {
        let normal = normal(corners);
        let is_beside = |k: &usize| normal_signs([corners[*k], corners[(*k + 1) % 3], q]) != [0; 3];
        let sides: Vec<usize> = (0..3).filter(is_beside).collect();
        let rim = corners.map(|p| (p - q).normalize_or_zero());
        let sight = match sides[..] {
            [side] => Sight::Corner(rim[side], rim[(side + 1) % 3]),
            [first, second] => {
                let edge = 3 - first - second;
                let along = corners[(edge + 1) % 3] - corners[edge];
                Sight::HalfPlane(normal.cross(along).normalize_or_zero())
            }
            _ => Sight::Plane,
        };
        Fan { normal, sight, sectors: sides.into_iter().map(|k| [rim[k], rim[(k + 1) % 3]]).collect() }
    }

    /// Solid angle seen from q + δ, δ along `direction` and, infinitely less, along the perpendicular `then`; `side` is the
    /// side of the plane on which δ counts as lying when both lie in it.
    fn solid_angle(&self, direction: Vec3, then: Vec3, side: Sign) -> f64 {
        let height = direction.dot(self.normal);
        let is_above = if height.abs() > FLAT { height > 0.0 } else { side > 0 };
        let signed = |size: f64| if is_above { -size.abs() } else { size.abs() };
        match self.sight {
            Sight::Plane => signed(TAU),
            Sight::HalfPlane(inward) => {
                let across = direction.dot(inward);
                // δ along the edge: what follows it counts.
                let (height, across) = if height.abs().max(across.abs()) > FLAT {
                    (height, across)
                } else {
                    (then.dot(self.normal), then.dot(inward))
                };
                2.0 * libm::atan2(signed(height), -across)
            }
            Sight::Corner(u, v) => {
                // With −δ opposite to one end of the sector the spherical triangle is a lune, seen along its axis.
                for (axis, other) in [(u, v), (v, u)] {
                    if direction.distance_squared(axis) < FLAT {
                        let across = other - other.dot(axis) * axis;
                        return 2.0 * libm::atan2(signed(then.dot(axis.cross(across))), -then.dot(across));
                    }
                }
                let denominator = 1.0 - direction.dot(u) + u.dot(v) - direction.dot(v);
                2.0 * libm::atan2(signed(height * u.cross(v).length()), denominator)
            }
        }
    }
}

/// What the triangles that q lies on add to w at q' (see [`crate::math`]): w there less this is the principal value at q.
pub fn share_of_touching(q: Vec3, touching: &[[Vec3; 3]]) -> f64 {
    let one = |corners: &[Vec3; 3]| {
        Fan::new(q, *corners).solid_angle(Vec3::Y, Vec3::Z, tie_break(*corners)) / (4.0 * PI)
    };
    touching.iter().filter(has_area).map(one).sum()
}

/// Triangles without area have no sides: w is the same on them as beside them.
fn has_area(corners: &&[Vec3; 3]) -> bool {
    normal_signs(**corners) != [0; 3]
}

/// Whether a region that touches `q` has w ≥ `threshold`, given the principal value at `q` and the triangles it lies on.
pub fn touches_inside(q: Vec3, touching: &[[Vec3; 3]], principal: f64, threshold: f64) -> bool {
    let fans: Vec<Fan> = touching.iter().filter(has_area).map(|corners| Fan::new(q, *corners)).collect();
    if fans.is_empty() {
        return principal >= threshold - ROUNDING;
    }
    let value = |direction: Vec3, normal: Vec3| {
        let side = |fan: &Fan| if fan.normal.dot(normal) > 0.0 { 1 } else { -1 };
        let sum: f64 = fans.iter().map(|fan| fan.solid_angle(direction, normal, side(fan))).sum();
        principal + sum / (4.0 * PI)
    };
    fans.iter().any(|fan| {
        directions_within(fan, &fans).into_iter().any(|direction| {
            // Every region has a piece of a sector on its rim: both sides of every piece are asked.
            [fan.normal, -fan.normal].into_iter().any(|n| value(direction, n) >= threshold - ROUNDING)
        })
    })
}

/// One direction in each piece into which the planes of the other triangles cut the sectors of a fan.
fn directions_within(fan: &Fan, fans: &[Fan]) -> Vec<Vec3> {
    let Some([first, _]) = fan.sectors.first() else { return vec![] };
    let (x, y) = (*first, fan.normal.cross(*first));
    let angle = |d: Vec3| libm::atan2(d.dot(y), d.dot(x));
    let cuts: Vec<Vec3> = (fans.iter())
        .map(|other| fan.normal.cross(other.normal))
        .filter(|line| line.length() > FLAT)
        .flat_map(|line| [line.normalize(), -line.normalize()])
        .collect();
    let mut directions = Vec::new();
    for [u, v] in &fan.sectors {
        let turn = |d: &Vec3| {
            let turned = angle(*d) - angle(*u);
            if turned < 0.0 { turned + TAU } else { turned }
        };
        let mut rays = vec![(0.0, *u), (turn(v), *v)];
        for cut in cuts.iter().map(|c| (turn(c), *c)).filter(|cut| cut.0 < turn(v)) {
            rays.insert(rays.partition_point(|ray| ray.0 <= cut.0), cut);
        }
        let between = rays.windows(2).filter(|pair| pair[1].0 - pair[0].0 > FLAT);
        directions.extend(between.map(|pair| bisector(pair[0].1, pair[1].1, fan.normal)));
    }
    directions
}

/// The unit direction halfway from `u` to `v`, less than half a turn away about `axis`.
fn bisector(u: Vec3, v: Vec3, axis: Vec3) -> Vec3 {
    // Of wide angles both rays are turned by a right angle to the inside first: opposite ones would cancel.
    let sum = if u.dot(v) > 0.0 { u + v } else { axis.cross(u) + v.cross(axis) };
    sum.normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: [[Vec3; 3]; 2] =
        [[Vec3::ZERO, Vec3::X, Vec3::Y], [Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]];

    #[test]
    fn a_face_hides_half_of_all_directions_from_either_side() {
        for (q, touching) in [(Vec3::new(0.2, 0.3, 0.0), &FLOOR[..1]), (Vec3::new(0.5, 0.5, 0.0), &FLOOR[..])]
        {
            // q' lies above: the normal points to it.
            assert!((share_of_touching(q, touching) + 0.5).abs() < 1e-15, "{q}");
            let inside = |principal: f64| touches_inside(q, touching, principal, 0.5);
            assert!(inside(0.0) && inside(0.5) && inside(1.0));
            assert!(!inside(-0.5));
        }
    }

    #[test]
    fn opposite_faces_hide_nothing() {
        let pair = [FLOOR[0], [Vec3::ZERO, Vec3::Y, Vec3::X]];
        let q = Vec3::new(0.2, 0.3, 0.0);
        assert!(share_of_touching(q, &pair).abs() < 1e-15);
        assert!(touches_inside(q, &pair, 1.0, 0.5) && !touches_inside(q, &pair, 0.0, 0.5));
    }

    #[test]
    fn a_corner_of_a_cube_touches_its_inside() {
        let [o, x, y, z] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let corner = [[o, y, x], [o, x, z], [o, z, y]];
        assert!(touches_inside(o, &corner, 0.125, 0.5));
        assert!(!touches_inside(o, &corner, 0.125 - 1.0, 0.5));
        assert!(touches_inside(o, &corner.map(|[a, b, c]| [a, c, b]), 0.875, 0.5));
    }
}
