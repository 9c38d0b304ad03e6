//! Whether triangles go through each other or lie on each other, exactly.
use super::{Sign, Vec3, normal_signs, side_of_plane};

/// Whether the insides of two triangles, without their rims, have a point in common.
///
/// So triangles meet that cross along a segment and such as overlap in one plane; those that share no more than a corner
/// or an edge do not, nor do those of which one ends on the other. A triangle without area has no inside. Exact whatever
/// the coordinates, unless their products leave the range of `f64`.
///
/// The planes and intervals of Guigue & Devillers 2003, *Fast and robust triangle–triangle overlap test using orientation
/// predicates*, with all inequalities strict.
pub fn triangles_meet(a: [Vec3; 3], b: [Vec3; 3]) -> bool {
    let of_a = sides(a, b);
    let Some(a_alone) = alone(of_a) else { return of_a == [0; 3] && meet_in_plane(a, b) };
    let of_b = sides(b, a);
    // None straddles a triangle without area.
    let Some(b_alone) = alone(of_b) else { return false };
    let turned = |[p, q, r]: [Vec3; 3], first: usize, is_above: bool| {
        let [p, q, r] = [[p, q, r], [q, r, p], [r, p, q]][first];
        if is_above { [p, q, r] } else { [p, r, q] }
    };
    // Each turns so that the lonely corner of the other is above it.
    let [p1, q1, r1] = turned(a, a_alone, of_b[b_alone] > 0);
    let [p2, q2, r2] = turned(b, b_alone, of_a[a_alone] > 0);
    // Each cuts an interval out of the line of both planes; neither ends where the other begins, or before.
    side(q2, [p1, q1, p2]) < 0 && side(r2, [p1, p2, r1]) < 0
}

/// On which sides of the plane of `b` the corners of `a` lie.
fn sides(a: [Vec3; 3], b: [Vec3; 3]) -> [Sign; 3] {
    a.map(|p| side(p, b))
}

/// [`side_of_plane`], sooner where q is a corner.
fn side(q: Vec3, triangle: [Vec3; 3]) -> Sign {
    if triangle.contains(&q) { 0 } else { side_of_plane(q, triangle) }
}

/// The corner that is alone on its side, of a triangle with corners on both sides of a plane.
fn alone(sides: [Sign; 3]) -> Option<usize> {
    let straddles = sides.contains(&1) && sides.contains(&-1);
    let is_alone = |k: &usize| sides[*k] != 0 && sides.iter().filter(|s| **s == sides[*k]).count() == 1;
    (0..3).find(is_alone).filter(|_| straddles)
}

/// The same for triangles in one plane: no edge of either has the other beyond it.
fn meet_in_plane(a: [Vec3; 3], b: [Vec3; 3]) -> bool {
    let (normal, other) = (normal_signs(a), normal_signs(b));
    let Some(axis) = (0..3).find(|axis| normal[*axis] != 0) else { return false };
    if other == [0; 3] {
        return false;
    }
    let turn = |p: Vec3, q: Vec3, r: Vec3| normal_signs([p, q, r])[axis];
    let is_separated = |one: [Vec3; 3], turns: Sign, other: [Vec3; 3]| {
        (0..3).any(|k| other.iter().all(|p| turn(one[k], one[(k + 1) % 3], *p) * turns <= 0))
    };
    !is_separated(a, normal[axis], b) && !is_separated(b, other[axis], a)
}

#[cfg(test)]
mod tests {
    use super::*;

    type Point = [i64; 3];

    fn minus(a: Point, b: Point) -> Point {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    fn cross(a: Point, b: Point) -> Point {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    fn dot(a: Point, b: Point) -> i64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    fn normal([a, b, c]: [Point; 3]) -> Point {
        cross(minus(b, a), minus(c, a))
    }

    /// The open interval that the inside of `a` cuts out of a line along `d` in the plane of `b`, as fractions, if any.
    fn interval(a: [Point; 3], b: [Point; 3], d: Point) -> Option<[(i64, i64); 2]> {
        let n = normal(b);
        let height = a.map(|p| dot(n, minus(p, b[0])));
        if !(height.iter().any(|h| *h > 0) && height.iter().any(|h| *h < 0)) {
            return None;
        }
        let mut ends: Vec<(i64, i64)> =
            (0..3).filter(|k| height[*k] == 0).map(|k| (dot(d, a[k]), 1)).collect();
        for k in 0..3 {
            let (p, q, s, t) = (a[k], a[(k + 1) % 3], height[k], height[(k + 1) % 3]);
            if s * t < 0 {
                // The point (t p − s q) / (t − s).
                let (above, below) = (t * dot(d, p) - s * dot(d, q), t - s);
                ends.push(if below > 0 { (above, below) } else { (-above, -below) });
            }
        }
        ends.sort_by(|x, y| (x.0 * y.1).cmp(&(y.0 * x.1)));
        Some([ends[0], ends[1]])
    }

    /// Twice the area of what two triangles in one plane have in common, seen along an axis, by clipping.
    fn common_area(a: [Point; 3], b: [Point; 3], axis: usize) -> f64 {
        let flat = |p: Point| [(axis + 1) % 3, (axis + 2) % 3].map(|k| p[k] as f64);
        let turn = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let mut clip = b.map(flat);
        if turn(clip[0], clip[1], clip[2]) < 0.0 {
            clip.swap(1, 2);
        }
        let mut polygon = a.map(flat).to_vec();
        for k in 0..3 {
            let (p, q) = (clip[k], clip[(k + 1) % 3]);
            let mut kept = Vec::new();
            for (i, from) in polygon.iter().enumerate() {
                let to = polygon[(i + 1) % polygon.len()];
                let (s, t) = (turn(p, q, *from), turn(p, q, to));
                if s >= 0.0 {
                    kept.push(*from);
                }
                if s * t < 0.0 {
                    kept.push([0, 1].map(|x| from[x] + s / (s - t) * (to[x] - from[x])));
                }
            }
            polygon = kept;
        }
        (1..polygon.len().max(1))
            .map(|i| turn(polygon[0], polygon[i], polygon[(i + 1) % polygon.len()]))
            .sum()
    }

    fn oracle(a: [Point; 3], b: [Point; 3]) -> bool {
        let (m, n) = (normal(a), normal(b));
        if m == [0; 3] || n == [0; 3] {
            return false;
        }
        let d = cross(m, n);
        if d == [0; 3] {
            let axis = (0..3).find(|k| m[*k] != 0).unwrap();
            return dot(m, minus(b[0], a[0])) == 0 && common_area(a, b, axis).abs() > 1e-9;
        }
        let (Some([s, e]), Some([t, f])) = (interval(a, b, d), interval(b, a, d)) else { return false };
        let is_less = |x: (i64, i64), y: (i64, i64)| x.0 * y.1 < y.0 * x.1;
        is_less(s, f) && is_less(t, e)
    }

    #[test]
    fn triangles_on_a_small_grid_meet_where_fractions_say_so() {
        let mut state = 1u64;
        let mut met = [0; 2];
        for round in 0..400_000u64 {
            // Few places make all kinds of contact likely; a single layer, triangles in one plane.
            let (sizes, shift) =
                ([[4, 4, 4], [3, 3, 2], [5, 5, 1], [9, 9, 9]][(round % 4) as usize], [3, -4, 0]);
            let mut point = || {
                [0, 1, 2].map(|k| {
                    state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                    (state >> 40) as i64 % sizes[k] + shift[k]
                })
            };
            let (mut a, mut b) = ([point(), point(), point()], [point(), point(), point()]);
            if sizes[2] == 1 {
                // Out of the axes' planes.
                [&mut a, &mut b].into_iter().flatten().for_each(|p| p[2] = 2 * p[0] - 3 * p[1]);
            }
            let [x, y] = [a, b].map(|t| t.map(|p| Vec3::from_array(p.map(|c| c as f64))));
            let expected = oracle(a, b);
            met[usize::from(expected)] += 1;
            for (x, y) in [(x, y), (y, x), ([x[1], x[2], x[0]], [y[0], y[2], y[1]])] {
                assert_eq!(triangles_meet(x, y), expected, "{x:?} {y:?}");
            }
        }
        assert!(met[0] > 50_000 && met[1] > 50_000, "{met:?}");
    }

    #[test]
    fn neighbours_do_not_meet_unless_folded_onto_each_other() {
        let [o, x, y, z] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        assert!(!triangles_meet([o, x, y], [x, o, z])); // an edge
        assert!(!triangles_meet([o, x, y], [o, -x, z])); // a corner
        assert!(!triangles_meet([o, x, y], [x, y, x + y])); // an edge, in one plane
        assert!(triangles_meet([o, x, y], [o, x, x + 0.5 * y])); // folded over
        assert!(triangles_meet([o, x, y], [o, y, x])); // the same turned around
        assert!(triangles_meet([o, x, y], [o, x + y + z, x + y - z])); // out of a corner through the inside
        assert!(!triangles_meet([o, x, y], [0.25 * (x + y), x + z, y + z])); // a corner ends on it
        assert!(!triangles_meet([o, x, y], [0.1 * (x + y), 0.3 * (x + y), z])); // an edge lies on it
    }

    #[test]
    fn the_last_bit_decides() {
        let below = |z: f64| f64::from_bits(z.to_bits() - 1);
        let floor = [Vec3::new(0.1, 0.1, 0.3), Vec3::new(0.9, 0.2, 0.3), Vec3::new(0.3, 0.8, 0.3)];
        let above = |z: f64| [Vec3::new(0.4, 0.3, z), Vec3::new(0.5, 0.4, 1.0), Vec3::new(0.3, 0.5, 1.0)];
        assert!(!triangles_meet(floor, above(0.3)));
        assert!(triangles_meet(floor, above(below(0.3))));
    }
}
