//! Near fields for blocks of queries: solid angles of triangles, four queries at a time.
use super::triangles::AngleProduct;
use crate::data::{OrientedCloud, TriangleSoup};
use crate::math::{Vec3, area_vector};
use crate::treecode::{GROUPS, Lanes, QueryBlock, Sources};
use std::f64::consts::PI;
use wide::f64x4;

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

/// Adds the solid angles of a triangle to the sums of those groups of queries whose bit is set in `wanted`.
#[inline(always)]
pub fn add_triangle<D: Sides>(
    corners: [Vec3; 3],
    sides: &D,
    queries: &QueryBlock,
    wanted: u32,
    sums: &mut [AngleProduct; GROUPS],
) {
    let triangle = Triangle::new(&corners);
    let mut rest = wanted;
    while rest != 0 {
        let group = rest.trailing_zeros() as usize;
        rest &= rest - 1;
        let q = &queries.positions[group];
        let (mut numerators, denominators, bound) = triangle.half_angles::<D>(q);
        if D::DECIDES {
            let open = numerators.abs().simd_le(bound).to_bitmask();
            if open != 0 {
                numerators = sides.decide(&corners, q, numerators, open);
            }
        }
        sums[group].multiply(denominators, numerators);
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
        let bound =
            if D::DECIDES { dot(&[a[0].abs(), a[1].abs(), a[2].abs()], &self.normal_magnitude) } else { f64x4::ZERO };
        (numerator, denominator, bound)
    }
}

#[inline(always)]
fn dot(a: &Lanes, b: &Lanes) -> f64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Sources for TriangleSoup {
    type Sum = AngleProduct;
    const POINTS: bool = false;

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
    fn zero() -> AngleProduct {
        AngleProduct::ONE
    }

    fn add(&self, members: &[u32], queries: &QueryBlock, wanted: u32, sums: &mut [AngleProduct; GROUPS]) {
        for &i in members {
            let corners = TriangleSoup::corners(self, i as usize);
            add_triangle(corners, &AsComputed, queries, wanted, sums);
        }
    }

    fn total(sum: &AngleProduct) -> [f64; 4] {
        sum.turns_of_lanes()
    }
}

impl Sources for OrientedCloud {
    type Sum = f64x4;
    const POINTS: bool = true;

    #[inline]
    fn len(&self) -> usize {
        self.points().len()
    }

    #[inline]
    fn corners(&self, index: usize) -> [Vec3; 3] {
        [self.points()[index]; 3]
    }

    #[inline]
    fn area_vector(&self, index: usize) -> Vec3 {
        self.areas()[index] * self.normals()[index]
    }

    #[inline]
    fn zero() -> f64x4 {
        f64x4::ZERO
    }

    /// A dipole at a query adds nothing.
    fn add(&self, members: &[u32], queries: &QueryBlock, wanted: u32, sums: &mut [f64x4; GROUPS]) {
        for &i in members {
            let point = self.points()[i as usize].to_array().map(f64x4::splat);
            let vector = Sources::area_vector(self, i as usize).to_array().map(f64x4::splat);
            let mut rest = wanted;
            while rest != 0 {
                let group = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let q = &queries.positions[group];
                let offset = [point[0] - q[0], point[1] - q[1], point[2] - q[2]];
                let square = dot(&offset, &offset);
                let field = dot(&offset, &vector) / (square * square.sqrt());
                sums[group] += square.simd_gt(f64x4::ZERO) & field;
            }
        }
    }

    fn total(sum: &f64x4) -> [f64; 4] {
        sum.to_array().map(|s| s / (4.0 * PI))
    }
}
