//! Solid angles of triangles near a block of queries: in 32-bit floats where that is safe, and otherwise in 64-bit ones.
use super::LANES;
use super::angles::Angles;
use crate::math::{Floats, Vec3};
use crate::treecode::{GROUPS, Lanes, Octet, QueryBlock, QueryGroup, groups_of, parts, relative};
use crate::winding::closure::crossings_of_caps;
use crate::winding::curtain::factors_of;
use crate::winding::half_angle::{HalfAngle, LEAST_OF_CAP, Triangle};
use crate::winding::triangles::point_of;
use wide::f64x4;

/// Who decides on which side of a triangle a query lies where rounding leaves it open.
pub trait Sides {
    /// Numerators (a − q)·n with the right signs, n = (b − a) × (c − a), given computed ones; the bits of `open` tell the
    /// lanes in which the sign is not certain. A lane that stays 0 counts as in the plane and contributes nothing.
    fn decide(&self, corners: &[Vec3; 3], queries: &Lanes, numerators: f64x4, open: u32) -> f64x4;
}

/// Adds the winding numbers of a cap to the sums of some groups of queries: by its solid angle, and where rounding leaves that open
/// by its edges and its crossing.
#[cold]
#[inline(never)]
pub fn add_cap(cap: &[Vec3; 3], queries: &QueryBlock, groups: u32, sums: &mut [Angles; GROUPS]) {
    let triangle = Triangle::new(*cap);
    for group in groups_of(groups) {
        for (half, q) in queries.positions[2 * group..][..2].iter().enumerate() {
            let angle = triangle.half_angle(*q);
            let certain = angle.is_certain(LEAST_OF_CAP);
            let [numerators, denominators] = [angle.numerator, angle.denominator].map(|v| v.to_array());
            let one = |k: usize| {
                if certain >> k & 1 == 1 { narrowed(numerators[k], denominators[k]) } else { (0.0, 1.0) }
            };
            sums[group].add_each(LANES * half, [0, 1, 2, 3].map(one));
            for k in (0..LANES).filter(|k| certain >> k & 1 == 0) {
                let q = point_of(q, k);
                if !q.is_finite() {
                    continue;
                }
                let factors = factors_of(cap, q).map(|[real, imaginary]| narrowed(imaginary, real));
                let crossings = crossings_of_caps(&[*cap], q);
                sums[group].add_at(LANES * half + k, &factors, -crossings as f32);
            }
        }
    }
}

/// Sets numerators and denominators of some lanes of a group.
#[cold]
#[inline(never)]
fn set_precisely<D: Sides>(
    corners: &[Vec3; 3],
    sides: &D,
    queries: &QueryBlock,
    group: usize,
    lanes: u32,
    [to_numerators, to_denominators]: [&mut Octet; 2],
) {
    let triangle = Triangle::new(*corners);
    for (half, q) in queries.positions[2 * group..][..2].iter().enumerate() {
        let lanes = lanes >> (LANES * half) & 0xf;
        if lanes == 0 {
            continue;
        }
        let HalfAngle { numerator: mut numerators, denominator, error, .. } = triangle.half_angle(*q);
        let open = numerators.abs().simd_le(error).to_bitmask();
        if open != 0 {
            numerators = sides.decide(corners, q, numerators, open);
        }
        let [numerators, denominators] = [numerators, denominator].map(|v| v.to_array());
        for k in (0..LANES).filter(|k| lanes >> k & 1 == 1) {
            let place = LANES * half + k;
            (to_numerators.0[place], to_denominators.0[place]) = narrowed(numerators[k], denominators[k]);
        }
    }
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

/// A triangle near a block of queries, relative to its centre.
///
/// With ε = 2⁻²⁴ and L a bound of the lengths of corners and queries, corners relative to a query a, b, c are known to about
/// εL, and numerator and denominator to a few ε L (|a||b| + |b||c| + |c||a|), which is up to ε L (|a| + |b| + |c|)² with a third
/// of the factor.
#[derive(Clone, Copy, Default)]
pub struct NearTriangle {
    corners: [[f32; 3]; 3],
    normal: [f32; 3],
    /// L.
    length: f32,
}

/// What numerator and denominator together must exceed for an angle to be good to 2e-5: a third of 8 ε / 2e-5.
const LEAST: f32 = 0.008;
/// What a numerator must exceed for its sign to be certain, which matters where the denominator is negative: a third of 8 ε.
const LEAST_NUMERATOR: f32 = 1.7e-7;
/// How much larger than computed |a| + |b| + |c| may be: 8 ε.
const SLACK: f32 = 5e-7;
/// The error of a winding number by that angle: 2e-5 / 2π.
pub const TRIANGLE_ROUNDING: f64 = 3.2e-6;

impl NearTriangle {
    /// Of corners relative to the block's centre, and their normal.
    #[inline(always)]
    pub fn new(corners: [[f32; 3]; 3], normal: [f32; 3], reach: f32) -> NearTriangle {
        let [a, b, c] = corners;
        let square = |[x, y, z]: [f32; 3]| x * x + y * y + z * z;
        let largest = larger(larger(square(a), square(b)), square(c)).sqrt();
        NearTriangle { corners, normal, length: largest + reach }
    }

    /// The square of the largest distance of a corner from a place.
    #[inline(always)]
    pub fn largest_square(&self, place: [f32; 3]) -> f32 {
        let [a, b, c] = self.corners;
        let square = |[x, y, z]: [f32; 3]| {
            let (x, y, z) = (x - place[0], y - place[1], z - place[2]);
            x * x + y * y + z * z
        };
        larger(larger(square(a), square(b)), square(c))
    }

    /// Adds the solid angles at a group of queries; `corners` gives the triangle as it is.
    #[inline(always)]
    pub fn add<F: Floats<Number = f32>, D: Sides>(
        &self,
        corners: impl Fn() -> [Vec3; 3],
        sides: &D,
        queries: &QueryBlock,
        group: usize,
        sums: &mut Angles,
    ) {
        for part in parts::<F>() {
            let (mut numerator, mut denominator, safe) = self.half_angles::<F>(&queries.offsets[group], part);
            let all = (1 << F::COUNT) - 1;
            if safe != all {
                let mut both = [Octet::ZERO; 2];
                both[0].put(part, numerator);
                both[1].put(part, denominator);
                let [numerators, denominators] = &mut both;
                let lanes = (!safe & all) << part;
                set_precisely(&corners(), sides, queries, group, lanes, [numerators, denominators]);
                (numerator, denominator) = (both[0].get(part), both[1].get(part));
            }
            sums.add(part, denominator, numerator);
        }
    }

    /// As [`Triangle::half_angle`], and the lanes in which they are right.
    #[inline(always)]
    fn half_angles<F: Floats<Number = f32>>(&self, q: &QueryGroup, part: usize) -> (F, F, u32) {
        // All with opposite signs, and so is the normal.
        let [a, b, c] = &self.corners;
        let a = relative::<F>(q, part, *a);
        let b = relative::<F>(q, part, *b);
        let c = relative::<F>(q, part, *c);
        let [x, y, z] = self.normal;
        let numerator = product(&a, &[F::splat(-x), F::splat(-y), F::splat(-z)]);
        let (la, lb, lc) = (product(&a, &a).sqrt(), product(&b, &b).sqrt(), product(&c, &c).sqrt());
        let ab = la * lb;
        let denominator = (ab + product(&a, &b)) * lc + (product(&b, &c) * la + product(&c, &a) * lb);
        let lengths = la + lb + lc + F::splat(SLACK * self.length);
        let square = lengths * lengths;
        let size = numerator.abs();
        let is_large = (size + denominator.abs()).greater(F::splat(LEAST * self.length) * square);
        let has_sign = size.greater(F::splat(LEAST_NUMERATOR * self.length) * square)
            | denominator.greater(F::splat(0.0));
        (numerator, denominator, is_large & has_sign)
    }
}

#[inline(always)]
fn product<F: Floats<Number = f32>>(a: &[F; 3], b: &[F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The larger one of two numbers.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::solid_angle;
    use crate::winding::near::single;
    use std::f64::consts::PI;
    use wide::f32x4;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::new(1.0, 0.1, 0.3), Vec3::new(0.2, 1.0, -0.2)];

    fn block(points: [Vec3; 4]) -> QueryBlock {
        let lanes = |axis: usize| f64x4::from(points.map(|p| p[axis]));
        let offsets = |axis: usize| Octet(std::array::from_fn(|k| points[k % 4][axis] as f32));
        QueryBlock {
            positions: [[lanes(0), lanes(1), lanes(2)]; 2 * GROUPS],
            center: Vec3::ZERO,
            offsets: [[offsets(0), offsets(1), offsets(2)]; GROUPS],
            scale: 1.0,
            reach: points.iter().fold(0.0, |reach, p| p.length().max(reach)) as f32,
            groups: 1,
            middles: [Octet::ZERO; 3],
            halves: [Octet::ZERO; 3],
        }
    }

    fn first_four(sums: &Angles) -> [f64; 4] {
        let turns = sums.turns();
        assert_eq!(turns[..4], turns[4..]);
        std::array::from_fn(|k| turns[k])
    }

    #[test]
    fn one_triangle_has_its_solid_angle_from_near_and_far() {
        let [a, b, c] = TRIANGLE;
        let (normal, middle, edge) = ((b - a).cross(c - a), (a + b + c) / 3.0, 0.3 * a + 0.7 * b);
        for distance in [3.0, 0.1, 1e-4, 1e-8, -1e-8, -0.01] {
            let points = [middle, edge, a + 1e-9 * b, edge + distance * c].map(|p| p + distance * normal);
            let queries = block(points);
            let mut sums = [Angles::ZERO; GROUPS];
            NearTriangle::new(TRIANGLE.map(single), single(normal), queries.reach).add::<f32x4, _>(
                || TRIANGLE,
                &AsComputed,
                &queries,
                0,
                &mut sums[0],
            );
            add_cap(&TRIANGLE, &queries, 2, &mut sums);
            let found = points.into_iter().zip(first_four(&sums[0]).into_iter().zip(first_four(&sums[1])));
            for (q, (w, precise)) in found {
                let expected = solid_angle(q, TRIANGLE) / (4.0 * PI);
                assert!((w - expected).abs() < TRIANGLE_ROUNDING, "{distance}: {w} instead of {expected}");
                assert!((precise - expected).abs() < 1e-6, "{distance}: {precise} instead of {expected}");
            }
        }
    }

    /// Computed signs are taken as they are.
    struct AsComputed;

    impl Sides for AsComputed {
        fn decide(&self, _: &[Vec3; 3], _: &Lanes, numerators: f64x4, _: u32) -> f64x4 {
            numerators
        }
    }

    /// Puts every query in doubt on the side of a sign.
    struct Given(f64);

    impl Sides for Given {
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
            let mut sum = Angles::ZERO;
            let queries = block(points);
            let triangle = NearTriangle::new(TRIANGLE.map(single), single(normal), queries.reach);
            triangle.add::<f32x4, _>(|| TRIANGLE, &Given(sign * 1e-300), &queries, 0, &mut sum);
            let [inside, in_front, outside, behind] = first_four(&sum);
            assert!((inside - 0.5 * sign).abs() < 1e-6, "{inside}");
            assert!(outside.abs() < 1e-6, "{outside}");
            assert!(in_front < -0.49 && behind > 0.49, "{in_front} {behind}");
        }
    }
}
