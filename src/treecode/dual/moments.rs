//! Multipole moments of orders 0 to 3, in f64: of sources, and of clusters of clusters.
//!
//! w(q) = (1/4π) Σ A_γ ∂^γ(1/|R|), R = q − c, where Σ A_γ ∂^γ is the mean of (n·∂) exp(−y·∂) over the sources, y their
//! place relative to c, and n their area vectors (Barill et al. 2018, eqs. 13 to 21, as a generating function). All
//! products are taken modulo ∂x² + ∂y² + ∂z² = 0.
use super::SourceKind;
use super::harmonic::{add_product, place};
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};

/// Highest order: "order p" sums degrees 1 to p + 1.
pub const MAX_ORDER: usize = 3;
/// Coefficients of degrees 1 to 4.
pub const COEFFICIENTS: usize = place(MAX_ORDER + 2, 0, 0) - 1;

/// A_γ of a cluster about its centre: degree n at places n² − 1 to n² + 2n − 1, as in [`super::harmonic`].
#[derive(Clone, Copy)]
pub struct Moments {
    pub coefficients: [f64; COEFFICIENTS],
}

/// A source of a cluster.
pub struct Member {
    pub corners: [Vec3; 3],
    pub area_vector: Vec3,
}

/// Weights of a rule with four nodes that is exact for polynomials of degree 3 over a triangle: the barycentre, and for each
/// corner 3/5 of it with 1/5 of the others (Strang & Fix 1973).
const MIDDLE_WEIGHT: f64 = -27.0 / 48.0;
const CORNER_WEIGHT: f64 = 25.0 / 48.0;

/// Sources that are taken together.
const LANES: usize = 4;

/// Degrees 0 to 3 of exp(−y·∂).
type Exponential<T> = [T; place(MAX_ORDER + 1, 0, 0)];

impl Moments {
    pub const ZERO: Moments = Moments { coefficients: [0.0; COEFFICIENTS] };

    /// Those of sources about a centre.
    pub fn of(members: &[Member], kind: SourceKind, center: Vec3) -> Moments {
        let mut moments = Moments::ZERO;
        in_widest_registers(Sum { members, kind, center, moments: &mut moments });
        moments
    }

    /// Adds a cluster whose centre lies at `d` from this one (M2M): the product with exp(−d·∂).
    pub fn add_cluster(&mut self, part: &Moments, d: Vec3) {
        let form = [-d.x, -d.y, -d.z];
        let a = &part.coefficients;
        let mut first = [0.0; 5]; // the form times degree 1
        add_product::<f64, 1>(&a[0..3], form, &mut first);
        let mut second: [f64; 7] = std::array::from_fn(|i| a[8 + i]);
        let mut third: [f64; 9] = std::array::from_fn(|i| a[15 + i]);
        let half: [f64; 5] = std::array::from_fn(|i| a[3 + i] + first[i] / 2.0);
        let sixth: [f64; 5] = std::array::from_fn(|i| 0.5 * (a[3 + i] + first[i] / 3.0));
        let mut inner: [f64; 7] = std::array::from_fn(|i| a[8 + i]);
        add_product::<f64, 2>(&sixth, form, &mut inner);
        add_product::<f64, 2>(&half, form, &mut second);
        add_product::<f64, 3>(&inner, form, &mut third);
        let moved =
            (a[0..3].iter().copied()).chain((0..5).map(|i| a[3 + i] + first[i])).chain(second).chain(third);
        self.coefficients.iter_mut().zip(moved).for_each(|(sum, term)| *sum += term);
    }
}

/// The work of [`Moments::of`].
struct Sum<'a> {
    members: &'a [Member],
    kind: SourceKind,
    center: Vec3,
    moments: &'a mut Moments,
}

impl Work for Sum<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.sum::<R::Doubles>();
    }
}

impl Sum<'_> {
    #[inline(always)]
    fn sum<F: Floats<Number = f64>>(self) {
        let mut sums = [F::splat(0.0); COEFFICIENTS];
        for four in self.members.chunks(LANES) {
            let mean = if self.kind == SourceKind::Points {
                exponential(self.corner::<F>(four, 0), 1.0)
            } else {
                self.mean_of_triangles::<F>(four)
            };
            let mut vectors = [[0.0; LANES]; 3];
            for (k, member) in four.iter().enumerate() {
                for (lanes, x) in vectors.iter_mut().zip(member.area_vector.to_array()) {
                    lanes[k] = x;
                }
            }
            let vector = [F::load(&vectors[0]), F::load(&vectors[1]), F::load(&vectors[2])];
            add_product::<F, 0>(&mean[0..1], vector, &mut sums[0..3]);
            add_product::<F, 1>(&mean[1..4], vector, &mut sums[3..8]);
            add_product::<F, 2>(&mean[4..9], vector, &mut sums[8..15]);
            add_product::<F, 3>(&mean[9..16], vector, &mut sums[15..24]);
        }
        for (coefficient, lanes) in self.moments.coefficients.iter_mut().zip(&sums) {
            let mut parts = [0.0; LANES];
            lanes.store(&mut parts);
            let [a, b, c, d] = parts;
            *coefficient = (a + b) + (c + d);
        }
    }

    /// The means of exp(−y·∂) over triangles.
    #[inline(always)]
    fn mean_of_triangles<F: Floats<Number = f64>>(&self, four: &[Member]) -> Exponential<F> {
        let mut middle = [F::splat(0.0); 3];
        let corners = [self.corner::<F>(four, 0), self.corner::<F>(four, 1), self.corner::<F>(four, 2)];
        for axis in 0..3 {
            let sum = corners[0][axis] + corners[1][axis] + corners[2][axis];
            middle[axis] = sum * F::splat(1.0 / 3.0);
        }
        let mut mean = exponential(middle, MIDDLE_WEIGHT);
        for corner in &corners {
            let mut node = middle;
            for axis in 0..3 {
                node[axis] = middle[axis] * F::splat(0.6) + corner[axis] * F::splat(0.4);
            }
            let at_node = exponential(node, CORNER_WEIGHT);
            for (sum, term) in mean.iter_mut().zip(&at_node) {
                *sum = *sum + *term;
            }
        }
        mean
    }

    /// Minus the positions of a corner of up to four sources, relative to the centre.
    #[inline(always)]
    fn corner<F: Floats<Number = f64>>(&self, four: &[Member], corner: usize) -> [F; 3] {
        let mut lanes = [[0.0; LANES]; 3];
        for (k, member) in four.iter().enumerate() {
            let position = self.center - member.corners[corner];
            for (lanes, x) in lanes.iter_mut().zip(position.to_array()) {
                lanes[k] = x;
            }
        }
        [F::load(&lanes[0]), F::load(&lanes[1]), F::load(&lanes[2])]
    }
}

/// `weight` · exp(f), f a linear form, up to degree 3.
#[inline(always)]
fn exponential<T: Floats<Number = f64>>(form: [T; 3], weight: f64) -> Exponential<T> {
    let mut result = [T::splat(0.0); place(MAX_ORDER + 1, 0, 0)];
    result[0] = T::splat(weight);
    let (half, third) = (T::splat(0.5), T::splat(1.0 / 3.0));
    let halves = [form[0] * half, form[1] * half, form[2] * half];
    let thirds = [form[0] * third, form[1] * third, form[2] * third];
    let (head, rest) = result.split_at_mut(1);
    add_product::<T, 0>(head, form, &mut rest[0..3]);
    let (first, rest) = rest.split_at_mut(3);
    add_product::<T, 1>(first, halves, &mut rest[0..5]);
    let (second, third_degree) = rest.split_at_mut(5);
    add_product::<T, 2>(second, thirds, third_degree);
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::area_vector;

    const TRIANGLE: [Vec3; 3] =
        [Vec3::new(0.1, 0.7, -0.3), Vec3::new(-0.5, 0.2, 0.4), Vec3::new(0.3, -0.6, 0.2)];

    fn assert_equal(a: &Moments, b: &Moments) {
        for (x, y) in a.coefficients.iter().zip(b.coefficients) {
            assert!((x - y).abs() < 1e-14, "{x} instead of {y}");
        }
    }

    fn of_triangles(triangles: &[[Vec3; 3]], center: Vec3) -> Moments {
        let member = |corners: &[Vec3; 3]| Member { corners: *corners, area_vector: area_vector(*corners) };
        let members: Vec<Member> = triangles.iter().map(member).collect();
        Moments::of(&members, SourceKind::Triangles, center)
    }

    #[test]
    fn a_triangle_equals_its_four_quarters() {
        let [a, b, c] = TRIANGLE;
        let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
        let whole = of_triangles(&[TRIANGLE], Vec3::ZERO);
        assert_equal(
            &whole,
            &of_triangles(&[[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]], Vec3::ZERO),
        );
        let with_more = of_triangles(&[[a, ab, c], TRIANGLE, [c, b, a], TRIANGLE, [ab, b, c]], Vec3::ZERO);
        assert_equal(&with_more, &of_triangles(&[TRIANGLE, TRIANGLE], Vec3::ZERO));
    }

    #[test]
    fn a_small_triangle_is_a_point() {
        let center = Vec3::new(0.1, 0.2, -0.1);
        let small = TRIANGLE.map(|v| TRIANGLE[1] + 1e-8 * v);
        let vector = area_vector(small);
        let point = Member { corners: [TRIANGLE[1]; 3], area_vector: 1e16 * vector };
        let of_points = Moments::of(&[point], SourceKind::Points, center);
        let of_triangle = of_triangles(&[small], center);
        for (x, y) in of_points.coefficients.iter().zip(of_triangle.coefficients) {
            assert!((x - 1e16 * y).abs() < 1e-6, "{x} instead of {y}");
        }
    }

    #[test]
    fn a_moved_cluster_has_the_moments_of_its_sources() {
        let (old, new) = (Vec3::new(0.1, 0.2, -0.1), Vec3::new(-0.3, 0.4, 0.5));
        let mut moved = Moments::ZERO;
        moved.add_cluster(&of_triangles(&[TRIANGLE], old), old - new);
        assert_equal(&moved, &of_triangles(&[TRIANGLE], new));
    }
}
