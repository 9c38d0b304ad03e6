//! Triangles as sources: solid angles near, dipole moments far (Barill et al. 2018, section 3.3).
use crate::bvh::WIDTH;
use crate::data::TriangleSoup;
use crate::math::{Vec3, area_vector};
use crate::treecode::{Kernel, Lanes, Quadrature};
use std::f64::consts::TAU;
use wide::{f64x4, i64x4};

impl Kernel for TriangleSoup {
    type Block = [Lanes; 3];
    type Sum = AngleProduct;

    fn len(&self) -> usize {
        self.triangles().len()
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        TriangleSoup::corners(self, index)
    }

    fn quadrature(&self, index: usize) -> Quadrature {
        let [a, b, c] = TriangleSoup::corners(self, index);
        let area_vector = area_vector([a, b, c]);
        let points = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
        Quadrature { points, area_vector, area: area_vector.length() }
    }

    /// A lane without a triangle holds three equal corners: it has no normal and adds nothing.
    fn block(&self, members: [Option<usize>; WIDTH]) -> [Lanes; 3] {
        let corners = members.map(|m| m.map_or([Vec3::ZERO; 3], |i| TriangleSoup::corners(self, i)));
        [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| f64x4::from(corners.map(|c| c[corner][axis]))))
    }

    fn sum() -> AngleProduct {
        AngleProduct::ONE
    }

    #[inline(always)]
    fn add(sum: &mut AngleProduct, corners: &[Lanes; 3], q: &Lanes) {
        let (denominator, numerator, _) = angle(corners, q);
        sum.multiply(denominator, numerator);
    }

    fn total(sum: AngleProduct) -> f64 {
        sum.turns()
    }

    #[inline(always)]
    fn add_gradient(sum: &mut Lanes, corners: &[Lanes; 3], q: &Lanes) {
        let relative = corners.each_ref().map(|c| minus(c, q));
        let lengths = relative.each_ref().map(|r| dot(r, r).sqrt());
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let along = minus(&corners[j], &corners[i]);
            add_edge(sum, [&relative[i], &relative[j]], [lengths[i], lengths[j]], &along);
        }
    }
}

/// [`super::edge_gradient`] of four edges, times 4π, given their ends relative to the query.
#[inline(always)]
fn add_edge(sum: &mut Lanes, [a, b]: [&Lanes; 2], [la, lb]: [f64x4; 2], along: &Lanes) {
    let one = f64x4::ONE;
    let is_a_nearer = la.simd_le(lb);
    let near = [0, 1, 2].map(|i| is_a_nearer.bitselect(a[i], b[i]));
    let inverse = one / (la * lb);
    let sine = cross(&near, along).map(|c| c * inverse);
    let sine_squared = dot(&sine, &sine);
    let cosine = dot(a, b) * inverse;
    let weight = cosine.simd_ge(f64x4::ZERO).bitselect(one / (one + cosine), (one - cosine) / sine_squared);
    // Comparisons with NaN, at an end of the edge, fail too.
    let is_aside = sine_squared.simd_gt(f64x4::ZERO);
    let weight = weight * (la + lb) * inverse;
    for i in 0..3 {
        sum[i] += is_aside & (weight * sine[i]);
    }
}

/// Denominator and numerator of the tangent of half the solid angles of four triangles, and a size to which the rounding
/// error of the numerator is relative.
#[inline(always)]
pub(super) fn angle([a, b, c]: &[Lanes; 3], q: &Lanes) -> (f64x4, f64x4, f64x4) {
    // The normal from edges, not from corners relative to the query: that stays accurate far away.
    let (u, v) = (minus(b, a), minus(c, a));
    let normal = cross(&u, &v);
    let (a, b, c) = (minus(a, q), minus(b, q), minus(c, q));
    let numerator = dot(&a, &normal);
    let (la, lb, lc) = (dot(&a, &a).sqrt(), dot(&b, &b).sqrt(), dot(&c, &c).sqrt());
    let denominator = la * lb * lc + dot(&a, &b) * lc + dot(&b, &c) * la + dot(&c, &a) * lb;
    (denominator, numerator, la * dot(&u, &u).sqrt() * dot(&v, &v).sqrt())
}

fn minus(a: &Lanes, b: &Lanes) -> Lanes {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: &Lanes, b: &Lanes) -> f64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Lanes, b: &Lanes) -> Lanes {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A sum of half solid angles, kept as the product of complex numbers with those arguments, and the number of times
/// the product went around: one arctangent for a whole query instead of one for each triangle.
pub struct AngleProduct {
    real: f64x4,
    imaginary: f64x4,
    wraps: f64x4,
}

impl AngleProduct {
    pub(super) const ONE: AngleProduct =
        AngleProduct { real: f64x4::ONE, imaginary: f64x4::ZERO, wraps: f64x4::ZERO };

    /// Multiplies by `real + i·imaginary`, four factors at once. A factor without an imaginary part counts as 1: its
    /// triangle holds the query in its plane.
    #[inline(always)]
    pub(super) fn multiply(&mut self, real: f64x4, imaginary: f64x4) {
        let flat = imaginary.simd_eq(f64x4::ZERO);
        let real = flat.bitselect(f64x4::ONE, real);
        let new_real = self.real * real - self.imaginary * imaginary;
        let new_imaginary = self.real * imaginary + self.imaginary * real;
        let zero = f64x4::ZERO;
        let was_upper = self.imaginary.simd_ge(zero);
        let is_upper = new_imaginary.simd_ge(zero);
        // Upper half-plane turned by a positive angle into the lower one: past π, and its mirror.
        let up = !flat & was_upper & imaginary.simd_ge(zero) & !is_upper;
        let down = !was_upper & imaginary.simd_lt(zero) & is_upper;
        self.wraps += (up & f64x4::ONE) - (down & f64x4::ONE);
        let scale = reciprocal_power_of_two(new_real.abs() + new_imaginary.abs());
        self.real = new_real * scale;
        self.imaginary = new_imaginary * scale;
    }

    /// The winding number: the sum of half solid angles over 2π.
    pub(super) fn turns(self) -> f64 {
        let [real, imaginary, wraps] = [self.real, self.imaginary, self.wraps].map(|v| v.to_array());
        let mut sum = AngleProduct1 { real: real[0], imaginary: imaginary[0], wraps: wraps[0] };
        for k in 1..WIDTH {
            sum.multiply(AngleProduct1 { real: real[k], imaginary: imaginary[k], wraps: wraps[k] });
        }
        // −0 would turn an angle of π into −π.
        libm::atan2(sum.imaginary + 0.0, sum.real) / TAU + sum.wraps
    }
}

/// One lane of an [`AngleProduct`].
struct AngleProduct1 {
    real: f64,
    imaginary: f64,
    wraps: f64,
}

impl AngleProduct1 {
    fn multiply(&mut self, other: AngleProduct1) {
        let real = self.real * other.real - self.imaginary * other.imaginary;
        let imaginary = self.real * other.imaginary + self.imaginary * other.real;
        let (was, with, is) = (self.imaginary >= 0.0, other.imaginary >= 0.0, imaginary >= 0.0);
        self.wraps += other.wraps;
        if was && with && !is {
            self.wraps += 1.0;
        }
        if !was && !with && is {
            self.wraps -= 1.0;
        }
        self.real = real;
        self.imaginary = imaginary;
    }
}

/// 2⁻ᵉ for a positive normal number with exponent e: it keeps products from overflowing and rounds nothing.
#[inline(always)]
fn reciprocal_power_of_two(x: f64x4) -> f64x4 {
    const EXPONENT: i64 = 0x7ff0_0000_0000_0000;
    const TWICE_BIAS: i64 = 0x7fe0_0000_0000_0000;
    let bits: i64x4 = wide::bytemuck::cast(x);
    wide::bytemuck::cast(i64x4::splat(TWICE_BIAS) - (bits & i64x4::splat(EXPONENT)))
}
