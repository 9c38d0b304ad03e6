//! Exact orientation tests with a symbolic tie-break.
//!
//! Queries are looked at from q' = q + (ε³, ε, ε²) with an infinitely small ε > 0 (Edelsbrunner & Mücke 1990): no such
//! point lies on a line of the yz plane or on a plane of space that rational points span, so every test answers *left*
//! or *right*, and a ray along x meets each surface in its inside only. The signs of unperturbed tests are exact by
//! adaptive precision (Shewchuk 1997, crate `robust`).
use super::{Vec2, Vec3};
use robust::{Coord, Coord3D};

/// Unit roundoff of `f64`.
const ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// Of the cross product in the yz plane computed from coordinates: Shewchuk's (3 + 16u)u.
const ORIENT_2D_BOUND: f64 = (3.0 + 16.0 * ROUNDOFF) * ROUNDOFF;
/// Of the determinant of three differences: Shewchuk's (7 + 56u)u.
const ORIENT_3D_BOUND: f64 = (7.0 + 56.0 * ROUNDOFF) * ROUNDOFF;

/// A sign: −1, 0 or 1.
pub type Sign = i32;

fn sign(x: f64) -> Sign {
    i32::from(x > 0.0) - i32::from(x < 0.0)
}

/// The exact sign of ((b − a) × (c − a)).x: 1 if a, b, c turn counter-clockwise in the yz plane, seen from +x.
#[inline]
pub fn orient_yz(a: Vec3, b: Vec3, c: Vec3) -> Sign {
    orient_in_plane([a.y, a.z], [b.y, b.z], [c.y, c.z])
}

/// The exact sign of (b − a) × (c − a): 1 if a, b, c turn counter-clockwise.
#[inline]
pub fn orient(a: Vec2, b: Vec2, c: Vec2) -> Sign {
    orient_in_plane(a.to_array(), b.to_array(), c.to_array())
}

#[inline]
fn orient_in_plane(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Sign {
    let left = (a[0] - c[0]) * (b[1] - c[1]);
    let right = (a[1] - c[1]) * (b[0] - c[0]);
    let determinant = left - right;
    if determinant.abs() > ORIENT_2D_BOUND * (left.abs() + right.abs()) {
        return sign(determinant);
    }
    orient_adaptively(a, b, c)
}

#[cold]
#[inline(never)]
fn orient_adaptively(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Sign {
    let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    sign(robust::orient2d(coord(a), coord(b), coord(c)))
}

/// The exact signs of the components of the normal (b − a) × (c − a); all 0 if and only if the triangle has no area.
pub fn normal_signs([a, b, c]: [Vec3; 3]) -> [Sign; 3] {
    [
        orient_in_plane([a.y, a.z], [b.y, b.z], [c.y, c.z]),
        orient_in_plane([a.z, a.x], [b.z, b.x], [c.z, c.x]),
        orient_in_plane([a.x, a.y], [b.x, b.y], [c.x, c.y]),
    ]
}

/// On which side of the line from `from` to `to` the point q' lies, in the yz plane: 1 for left, −1 for right; 0 if and
/// only if the line has no length there.
#[inline]
pub fn side_of_edge(q: Vec3, from: Vec3, to: Vec3) -> Sign {
    match orient_yz(from, to, q) {
        // The derivative of the cross product along y, then along z.
        0 if from.z != to.z => sign(from.z - to.z),
        0 => sign(to.y - from.y),
        side => side,
    }
}

/// The exact sign of n·(q − a), n the normal (b − a) × (c − a): 1 if q lies on the side to which the normal points.
#[inline]
pub fn side_of_plane(q: Vec3, [a, b, c]: [Vec3; 3]) -> Sign {
    let (u, v, w) = (a - q, b - q, c - q);
    let (vxwy, wxvy) = (v.x * w.y, w.x * v.y);
    let (wxuy, uxwy) = (w.x * u.y, u.x * w.y);
    let (uxvy, vxuy) = (u.x * v.y, v.x * u.y);
    let determinant = u.z * (vxwy - wxvy) + v.z * (wxuy - uxwy) + w.z * (uxvy - vxuy);
    let permanent = (vxwy.abs() + wxvy.abs()) * u.z.abs()
        + (wxuy.abs() + uxwy.abs()) * v.z.abs()
        + (uxvy.abs() + vxuy.abs()) * w.z.abs();
    if determinant.abs() > ORIENT_3D_BOUND * permanent {
        return -sign(determinant);
    }
    side_adaptively(q, [a, b, c])
}

#[cold]
#[inline(never)]
fn side_adaptively(q: Vec3, [a, b, c]: [Vec3; 3]) -> Sign {
    let coord = |p: Vec3| Coord3D { x: p.x, y: p.y, z: p.z };
    -sign(robust::orient3d(coord(a), coord(b), coord(c), coord(q)))
}

/// [`side_of_plane`] for q': 0 if and only if the triangle has no area.
#[inline]
pub fn perturbed_side_of_plane(q: Vec3, triangle: [Vec3; 3]) -> Sign {
    match side_of_plane(q, triangle) {
        0 => tie_break(triangle),
        side => side,
    }
}

/// To which side of the plane of a triangle q' has moved from a q in that plane.
pub fn tie_break(triangle: [Vec3; 3]) -> Sign {
    let [x, y, z] = normal_signs(triangle);
    [y, z, x].into_iter().find(|s| *s != 0).unwrap_or(0)
}

/// Whether the projection of a triangle to the yz plane holds that of q': never on its rim. A triangle whose projection
/// has no area holds nothing.
#[inline]
pub fn covers(q: Vec3, [a, b, c]: [Vec3; 3]) -> bool {
    let first = side_of_edge(q, a, b);
    first != 0 && first == side_of_edge(q, b, c) && first == side_of_edge(q, c, a)
}

/// Whether q itself lies on a segment, its ends included.
pub fn touches_segment(q: Vec3, [a, b]: [Vec3; 2]) -> bool {
    let is_within = a.min(b).cmple(q).all() && q.cmple(a.max(b)).all();
    is_within && normal_signs([a, b, q]) == [0; 3]
}

/// Whether q itself lies on a triangle, its rim included; of one without area, on one of its edges.
pub fn touches(q: Vec3, [a, b, c]: [Vec3; 3]) -> bool {
    if side_of_plane(q, [a, b, c]) != 0 {
        return false;
    }
    // In the plane, any projection of the triangle that has an area decides.
    let normal = normal_signs([a, b, c]);
    let Some(axis) = (0..3).find(|axis| normal[*axis] != 0) else {
        return touches_segment(q, [a, b]) || touches_segment(q, [b, c]) || touches_segment(q, [c, a]);
    };
    let flat = |p: Vec3| [p[(axis + 1) % 3], p[(axis + 2) % 3]];
    let on_inner_side = |s: Vec3, t: Vec3| orient_in_plane(flat(s), flat(t), flat(q)) * normal[axis] >= 0;
    on_inner_side(a, b) && on_inner_side(b, c) && on_inner_side(c, a)
}

/// How the ray from q' along −x meets a triangle: the sign with which it crosses, 0 if it does not, and whether q itself
/// lies on the triangle.
#[inline]
pub fn meet(q: Vec3, corners: [Vec3; 3]) -> (Sign, bool) {
    let [a, b, c] = corners;
    let sides = [orient_yz(a, b, q), orient_yz(b, c, q), orient_yz(c, a, q)];
    if sides.contains(&1) && sides.contains(&-1) {
        return (0, false); // beside the projection
    }
    let (low, high) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
    let is_covered = if sides.contains(&0) { covers(q, corners) } else { true };
    let facing = match sides {
        _ if !is_covered => 0,
        [0, ..] => orient_yz(a, b, c),
        [side, ..] => side,
    };
    if q.x < low {
        return (0, false);
    }
    if q.x > high {
        return (-facing, false);
    }
    let side = side_of_plane(q, corners);
    let is_before = facing != 0 && facing == if side == 0 { tie_break(corners) } else { side };
    let touches = side == 0 && (!sides.contains(&0) || touches(q, corners));
    (if is_before { -facing } else { 0 }, touches)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn the_normal_points_to_the_positive_side() {
        assert_eq!(side_of_plane(Vec3::Z, FLAT), 1);
        assert_eq!(side_of_plane(-1e-300 * Vec3::Z, FLAT), -1);
        assert_eq!(side_of_plane(Vec3::new(5.0, -7.0, 0.0), FLAT), 0);
        assert_eq!(normal_signs(FLAT), [0, 0, 1]);
        assert_eq!(perturbed_side_of_plane(Vec3::X, FLAT), 1);
        assert_eq!(normal_signs([Vec3::ZERO, Vec3::X, Vec3::Y + Vec3::Z]), [0, -1, 1]);
    }

    #[test]
    fn a_point_on_an_edge_or_a_vertex_is_covered_once_by_a_fan() {
        let around = [(1.0, 0.0), (0.3, 2.0), (-1.0, 0.4), (-1.0, -1.0), (0.0, -2.0)];
        let rim = around.map(|(y, z)| Vec3::new(y * z, y, z));
        for q in [Vec3::ZERO, 0.5 * rim[0], 0.25 * rim[3], 0.5 * rim[4]] {
            let count = (0..5).filter(|&k| covers(q, [Vec3::ZERO, rim[k], rim[(k + 1) % 5]])).count();
            assert_eq!(count, 1, "{q}");
        }
    }

    #[test]
    fn a_rounding_error_off_the_plane_is_seen() {
        let (a, b) = (Vec3::new(0.1, 0.1, 0.1), Vec3::new(0.7, 0.7, 0.7));
        let third = 0.3f64;
        let on = Vec3::splat(third);
        let off = Vec3::new(third, third, f64::from_bits(third.to_bits() + 1));
        let triangle = [a, b, Vec3::new(1.0, 1.0, 0.0)];
        assert_eq!(side_of_plane(on, triangle), 0);
        assert_eq!(side_of_edge(off, a, b), orient_yz(a, b, off));
        assert_ne!(orient_yz(a, b, off), 0);
    }

    #[test]
    fn a_ray_meets_what_the_single_predicates_say() {
        let mut state = 1u64;
        let mut point = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            Vec3::from_array([0, 1, 2].map(|k| f64::from((state >> (20 + 8 * k)) as u32 % 4)))
        };
        for _ in 0..100_000 {
            let (triangle, q) = ([point(), point(), point()], point());
            let facing = orient_yz(triangle[0], triangle[1], triangle[2]);
            let is_crossed = covers(q, triangle) && perturbed_side_of_plane(q, triangle) == facing;
            let crossing = if is_crossed { -facing } else { 0 };
            assert_eq!(meet(q, triangle), (crossing, touches(q, triangle)), "{q} {triangle:?}");
        }
    }

    #[test]
    fn a_triangle_touches_its_rim_and_nothing_beyond() {
        for q in [Vec3::ZERO, Vec3::X, 0.5 * (Vec3::X + Vec3::Y), Vec3::new(0.2, 0.2, 0.0)] {
            assert!(touches(q, FLAT), "{q}");
        }
        for q in [Vec3::new(0.6, 0.6, 0.0), Vec3::new(-1e-300, 0.0, 0.0), Vec3::new(0.2, 0.2, 1e-300)] {
            assert!(!touches(q, FLAT), "{q}");
        }
        let upright = [Vec3::ZERO, Vec3::X, Vec3::Z];
        assert!(touches(Vec3::new(0.5, 0.0, 0.5), upright));
        let flat = [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X];
        assert!(touches(Vec3::ZERO, flat) && touches(1.5 * Vec3::X, flat));
        assert!(!touches(3.0 * Vec3::X, flat) && !touches(Vec3::X + 1e-9 * Vec3::Y, flat));
    }
}
