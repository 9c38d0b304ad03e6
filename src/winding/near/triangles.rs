//! Solid angles of triangles near a block of queries, four queries at a time.
use super::angles::Angles;
use crate::data::TriangleSoup;
use crate::math::{Vec3, area_vector};
use crate::treecode::{GROUPS, Lanes, QueryBlock, Sources};
use wide::{f32x4, f64x4};

/// Queries in a group.
const WIDTH: usize = 4;

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

/// Adds the solid angles of a triangle to the sums of those groups of queries whose bit is set in `wanted`: in 32-bit floats
/// where that is safe, and otherwise, or when `sides` decides, in 64-bit ones.
#[inline(always)]
pub fn add_triangle<D: Sides>(
    corners: [Vec3; 3],
    sides: &D,
    queries: &QueryBlock,
    wanted: u32,
    sums: &mut [Angles; GROUPS],
) {
    let triangle = Triangle32::new(&corners, queries);
    let mut rest = wanted;
    while rest != 0 {
        let group = rest.trailing_zeros() as usize;
        rest &= rest - 1;
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

impl Sources for TriangleSoup {
    type Sum = Angles;
    const POINTS: bool = false;
    const ROUNDING: f64 = TRIANGLE_ROUNDING;

    #[inline]
    fn len(&self) -> usize {
        self.triangles().len()
    }

    #[inline]
    fn corners(&self, index: usize) -> [Vec3; 3] {
        TriangleSoup::corners(self, index)
    }

    #[inline]
    fn area_vector(&self, index: usize) -> Vec3 {
        area_vector(TriangleSoup::corners(self, index))
    }

    #[inline]
    fn zero() -> Angles {
        Angles::ZERO
    }

    fn add(&self, members: &[u32], queries: &QueryBlock, wanted: u32, sums: &mut [Angles; GROUPS]) {
        for &i in members {
            let corners = TriangleSoup::corners(self, i as usize);
            add_triangle(corners, &AsComputed, queries, wanted, sums);
        }
    }

    fn total(sum: &Angles) -> [f64; 4] {
        sum.turns()
    }
}
