//! Solid angles of triangles near a block of queries, four queries at a time.
use super::angles::Angles;
use crate::bvh::WIDTH;
use crate::data::BLOCK;
use crate::math::{Vec3, area_vector, perturbed_side_of_plane};
use crate::treecode::{GROUPS, Kernel, Lanes, NearLeaf, QueryBlock, SourceKind, Sources};
use crate::winding::triangles::Triangles;
use wide::{f32x4, f64x4};

/// Who decides on which side of a triangle a query lies where rounding leaves it open.
pub trait Sides {
    /// False where nobody does: then no time is spent on finding out where it is open.
    const DECIDES: bool;

    /// Numerators (a − q)·n with the right signs, n = (b − a) × (c − a), given computed ones; the bits of `open` tell the
    /// lanes in which the sign is not certain. A lane that stays 0 counts as in the plane and contributes nothing.
    fn decide(&self, corners: &[Vec3; 3], queries: &Lanes, numerators: f64x4, open: u32) -> f64x4;
}

/// Computed signs are taken as they are.
pub struct AsComputed;

impl Sides for AsComputed {
    const DECIDES: bool = false;

    fn decide(&self, _: &[Vec3; 3], _: &Lanes, numerators: f64x4, _: u32) -> f64x4 {
        numerators
    }
}

/// Rounding error of (a − q)·n relative to the same sum of absolute values: (7 + 56ε) ε, ε = 2⁻⁵³ (Shewchuk 1997,
/// orient3d), with what the bound's own computation may lose.
const NUMERATOR_ERROR: f64 = 8.0 * (f64::EPSILON / 2.0);

/// Adds the solid angles of a triangle of `leaf` to the sums of the groups of queries that this acts on: in 32-bit floats
/// where that is safe, and otherwise, or when `sides` decides, in 64-bit ones.
#[inline(always)]
pub fn add_triangle<D: Sides>(
    corners: [Vec3; 3],
    sides: &D,
    queries: &QueryBlock,
    leaf: &NearLeaf,
    sums: &mut [Angles; GROUPS],
) {
    let triangle = Triangle32::new(&corners, queries);
    for group in leaf.groups() {
        let quick = if D::DECIDES { None } else { triangle.half_angles(&queries.offsets[group]) };
        let (numerators, denominators) =
            quick.unwrap_or_else(|| precise_half_angles(&corners, sides, &queries.positions[group]));
        sums[group].add(denominators, numerators);
    }
}

#[cold]
#[inline(never)]
fn precise_half_angles<D: Sides>(corners: &[Vec3; 3], sides: &D, q: &Lanes) -> (f32x4, f32x4) {
    let (mut numerators, denominators, bound) = Triangle::new(corners).half_angles::<D>(q);
    if D::DECIDES {
        let open = numerators.abs().simd_le(bound).to_bitmask();
        if open != 0 {
            numerators = sides.decide(corners, q, numerators, open);
        }
    }
    let [numerators, denominators] = [numerators, denominators].map(|v| v.to_array());
    let narrowed: [(f32, f32); WIDTH] = std::array::from_fn(|k| narrowed(numerators[k], denominators[k]));
    (f32x4::from(narrowed.map(|n| n.0)), f32x4::from(narrowed.map(|n| n.1)))
}

/// Numerator and denominator scaled to about 1, in 32-bit floats that keep the numerator's sign. With a numerator of 0 the
/// query is in the triangle's plane: an angle of 0.
fn narrowed(numerator: f64, denominator: f64) -> (f32, f32) {
    let size = numerator.abs().max(denominator.abs());
    if numerator == 0.0 {
        return (0.0, 1.0);
    }
    let scaled = (numerator / size) as f32;
    (scaled.abs().max(SMALLEST_NUMERATOR).copysign(scaled), (denominator / size) as f32)
}

/// Far from vanishing when the product of angles is scaled.
const SMALLEST_NUMERATOR: f32 = 1e-30;

/// A triangle near a block of queries, relative to its centre, in all lanes.
///
/// With ε = 2⁻²⁴ and L a bound of the lengths of corners and queries, corners relative to a query a, b, c are known to about
/// εL, and numerator and denominator to a few ε L (|a||b| + |b||c| + |c||a|), which is up to ε L (|a| + |b| + |c|)² with a third
/// of the factor.
struct Triangle32 {
    corners: [[f32x4; 3]; 3],
    normal: [f32x4; 3],
    /// L times the constants below.
    least: f32x4,
    least_numerator: f32x4,
    slack: f32x4,
}

/// What numerator and denominator together must exceed for an angle to be good to 2e-5: a third of 8 ε / 2e-5.
const LEAST: f32 = 0.008;
/// What a numerator must exceed for its sign to be certain, which matters where the denominator is negative: a third of 8 ε.
const LEAST_NUMERATOR: f32 = 1.7e-7;
/// How much larger than computed |a| + |b| + |c| may be: 8 ε.
const SLACK: f32 = 5e-7;
/// The error of a winding number by that angle: 2e-5 / 2π.
const TRIANGLE_ROUNDING: f64 = 3.2e-6;

impl Triangle32 {
    #[inline(always)]
    fn new([a, b, c]: &[Vec3; 3], queries: &QueryBlock) -> Triangle32 {
        let relative = |v: &Vec3| queries.scale * (*v - queries.center);
        let (a, b, c) = (relative(a), relative(b), relative(c));
        let largest = a.length_squared().max(b.length_squared()).max(c.length_squared()).sqrt();
        let length = largest as f32 + queries.reach;
        let splat = |v: Vec3| [f32x4::splat(v.x as f32), f32x4::splat(v.y as f32), f32x4::splat(v.z as f32)];
        Triangle32 {
            corners: [splat(a), splat(b), splat(c)],
            normal: splat((b - a).cross(c - a)),
            least: f32x4::splat(LEAST * length),
            least_numerator: f32x4::splat(LEAST_NUMERATOR * length),
            slack: f32x4::splat(SLACK * length),
        }
    }

    /// As [`Triangle::half_angles`]; none where a lane might be wrong.
    #[inline(always)]
    fn half_angles(&self, q: &[f32x4; 3]) -> Option<(f32x4, f32x4)> {
        let minus = |c: &[f32x4; 3]| [c[0] - q[0], c[1] - q[1], c[2] - q[2]];
        let [a, b, c] = [minus(&self.corners[0]), minus(&self.corners[1]), minus(&self.corners[2])];
        let dot = |a: &[f32x4; 3], b: &[f32x4; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let numerator = dot(&a, &self.normal);
        let (la, lb, lc) = (dot(&a, &a).sqrt(), dot(&b, &b).sqrt(), dot(&c, &c).sqrt());
        let ab = la * lb;
        let denominator = (ab + dot(&a, &b)) * lc + (dot(&b, &c) * la + dot(&c, &a) * lb);
        let lengths = la + lb + lc + self.slack;
        let square = lengths * lengths;
        let size = numerator.abs();
        let is_large = (size + denominator.abs()).simd_gt(self.least * square);
        let has_sign = size.simd_gt(self.least_numerator * square) | denominator.simd_gt(f32x4::ZERO);
        (is_large & has_sign).all().then_some((numerator, denominator))
    }
}

/// A triangle in all lanes.
struct Triangle {
    corners: [Lanes; 3],
    normal: Lanes,
    /// Sums of absolute values of the products in the normal.
    normal_magnitude: Lanes,
}

impl Triangle {
    #[inline(always)]
    fn new([a, b, c]: &[Vec3; 3]) -> Triangle {
        let splat = |v: Vec3| v.to_array().map(f64x4::splat);
        // The normal from edges, not from corners relative to the query: that stays accurate far away.
        let (u, v) = (*b - *a, *c - *a);
        let (m, n) = (u.abs(), v.abs());
        let magnitude = Vec3::new(m.y * n.z + m.z * n.y, m.z * n.x + m.x * n.z, m.x * n.y + m.y * n.x);
        Triangle {
            corners: [splat(*a), splat(*b), splat(*c)],
            normal: splat(u.cross(v)),
            normal_magnitude: splat(NUMERATOR_ERROR * magnitude),
        }
    }

    /// Tangents of the half solid angles as numerators and denominators (van Oosterom & Strackee 1983), and bounds of the
    /// numerators' errors if they are asked for.
    #[inline(always)]
    fn half_angles<D: Sides>(&self, q: &Lanes) -> (f64x4, f64x4, f64x4) {
        let minus = |c: &Lanes| [c[0] - q[0], c[1] - q[1], c[2] - q[2]];
        let [a, b, c] = [minus(&self.corners[0]), minus(&self.corners[1]), minus(&self.corners[2])];
        let numerator = dot(&a, &self.normal);
        let (la, lb, lc) = (dot(&a, &a).sqrt(), dot(&b, &b).sqrt(), dot(&c, &c).sqrt());
        let denominator = (la * lb + dot(&a, &b)) * lc + (dot(&b, &c) * la + dot(&c, &a) * lb);
        let bound = if D::DECIDES {
            dot(&[a[0].abs(), a[1].abs(), a[2].abs()], &self.normal_magnitude)
        } else {
            f64x4::ZERO
        };
        (numerator, denominator, bound)
    }
}

#[inline(always)]
fn dot(a: &Lanes, b: &Lanes) -> f64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Caps are decided as their crossings are, so that the two jump at the same place.
struct AsCrossings;

impl Sides for AsCrossings {
    const DECIDES: bool = true;

    fn decide(&self, corners: &[Vec3; 3], queries: &Lanes, numerators: f64x4, open: u32) -> f64x4 {
        let mut parts = numerators.to_array();
        for k in (0..WIDTH).filter(|k| open >> k & 1 == 1) {
            let q = Vec3::from_array([0, 1, 2].map(|axis| queries[axis].to_array()[k]));
            // Seen from the side to which the normal points the solid angle is negative.
            let side = -f64::from(perturbed_side_of_plane(q, *corners));
            parts[k] = side * parts[k].abs().max(f64::MIN_POSITIVE);
        }
        f64x4::from(parts)
    }
}

impl Sources for Triangles {
    fn len(&self) -> usize {
        Kernel::len(self)
    }

    fn kind(&self) -> SourceKind {
        SourceKind::Triangles
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        Kernel::corners(self, index)
    }

    fn area_vector(&self, index: usize) -> Vec3 {
        area_vector(Kernel::corners(self, index))
    }

    fn rounding(&self) -> f64 {
        TRIANGLE_ROUNDING
    }

    fn add(&self, near: &[NearLeaf], items: &[u32], queries: &QueryBlock, values: &mut [f64; BLOCK]) {
        let mut sums = [Angles::ZERO; GROUPS];
        let caps = self.caps();
        for leaf in near {
            for &i in leaf.members(items) {
                let corners = Kernel::corners(self, i as usize);
                if (i as usize) < caps {
                    add_triangle(corners, &AsCrossings, queries, leaf, &mut sums);
                } else {
                    add_triangle(corners, &AsComputed, queries, leaf, &mut sums);
                }
            }
        }
        for (values, sum) in values.chunks_mut(WIDTH).zip(sums) {
            values.iter_mut().zip(sum.turns()).for_each(|(value, turns)| *value += turns);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::solid_angle;
    use std::f64::consts::PI;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::new(1.0, 0.1, 0.3), Vec3::new(0.2, 1.0, -0.2)];

    fn block(points: [Vec3; 4]) -> QueryBlock {
        let lanes = |axis: usize| f64x4::from(points.map(|p| p[axis]));
        let offsets = |axis: usize| f32x4::from(points.map(|p| p[axis] as f32));
        QueryBlock {
            positions: [[lanes(0), lanes(1), lanes(2)]; GROUPS],
            center: Vec3::ZERO,
            offsets: [[offsets(0), offsets(1), offsets(2)]; GROUPS],
            scale: 1.0,
            reach: points.iter().fold(0.0, |reach, p| p.length().max(reach)) as f32,
            groups: 1,
        }
    }

    fn winding_numbers(sides: &impl Sides, points: [Vec3; 4]) -> [f64; 4] {
        let mut sums = [Angles::ZERO; GROUPS];
        let leaf = NearLeaf { first: 0, count: 1, wanted: 1 };
        add_triangle(TRIANGLE, sides, &block(points), &leaf, &mut sums);
        assert_eq!(sums[1].turns(), [0.0; 4]);
        sums[0].turns()
    }

    #[test]
    fn one_triangle_has_its_solid_angle_from_near_and_far() {
        let [a, b, c] = TRIANGLE;
        let (normal, middle, edge) = ((b - a).cross(c - a), (a + b + c) / 3.0, 0.3 * a + 0.7 * b);
        for distance in [3.0, 0.1, 1e-4, 1e-8, -1e-8, -0.01] {
            let points = [middle, edge, a + 1e-9 * b, edge + distance * c].map(|p| p + distance * normal);
            for (q, w) in points.into_iter().zip(winding_numbers(&AsComputed, points)) {
                let expected = solid_angle(q, TRIANGLE) / (4.0 * PI);
                assert!((w - expected).abs() < TRIANGLE_ROUNDING, "{distance}: {w} instead of {expected}");
            }
        }
    }

    /// Puts every query in doubt on the side of a sign.
    struct Given(f64);

    impl Sides for Given {
        const DECIDES: bool = true;

        fn decide(&self, corners: &[Vec3; 3], _: &Lanes, numerators: f64x4, open: u32) -> f64x4 {
            assert_eq!(*corners, TRIANGLE);
            let mut values = numerators.to_array();
            (0..4).filter(|k| open >> k & 1 == 1).for_each(|k| values[k] = self.0);
            f64x4::from(values)
        }
    }

    #[test]
    fn sides_decide_only_where_rounding_leaves_it_open() {
        let [a, b, c] = TRIANGLE;
        let (normal, middle) = ((b - a).cross(c - a), (a + b + c) / 3.0);
        let points =
            [middle, middle + 1e-3 * normal, a + 2.0 * (b - a) + 2.0 * (c - a), middle - 1e-3 * normal];
        for sign in [1.0, -1.0] {
            let [inside, in_front, outside, behind] = winding_numbers(&Given(sign * 1e-300), points);
            assert!((inside - 0.5 * sign).abs() < 1e-6, "{inside}");
            assert!(outside.abs() < 1e-6, "{outside}");
            assert!(in_front < -0.49 && behind > 0.49, "{in_front} {behind}");
        }
    }
}
