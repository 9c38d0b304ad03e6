//! Multipole moments of orders 0 to 3, in f64: of sources, and of clusters of clusters.
//!
//! w(q) = (1/4π) Σ A_γ ∂^γ(1/|R|), R = q − c, where Σ A_γ ∂^γ is the mean of (n·∂) exp(−y·∂) over the sources, y their
//! place relative to c, and n their area vectors (Barill et al. 2018, eqs. 13 to 21, as a generating function). All
//! products are taken modulo ∂x² + ∂y² + ∂z² = 0.
use super::harmonic::{add_product, place};
use crate::math::Vec3;
use wide::f64x4;

/// Highest order: "order p" sums degrees 1 to p + 1.
pub const MAX_ORDER: usize = 3;
/// Coefficients of degrees 1 to 4.
pub const COEFFICIENTS: usize = place(MAX_ORDER + 2, 0, 0) - 1;

/// A_γ of a cluster about its centre: degree n at places n² − 1 to n² + 2n − 1, as in [`super::harmonic`].
#[derive(Clone, Copy)]
pub struct Moments {
    pub coefficients: [f64; COEFFICIENTS],
}

/// Nodes of a rule with four points that is exact for polynomials of degree 3 over a triangle, in barycentric
/// coordinates: the barycentre, and for each corner 3/5 of it with 1/5 of the others (Strang & Fix 1973).
const RULE_WEIGHTS: [f64; 4] = [-27.0 / 48.0, 25.0 / 48.0, 25.0 / 48.0, 25.0 / 48.0];

/// Degrees 0 to 3 of exp(−y·∂).
type Exponential = [f64; place(MAX_ORDER + 1, 0, 0)];

impl Moments {
    pub const ZERO: Moments = Moments { coefficients: [0.0; COEFFICIENTS] };

    /// Adds a dipole at `y`, relative to the centre.
    #[inline]
    pub fn add_point(&mut self, y: Vec3, area_vector: Vec3) {
        let exponential = exponential([-y.x, -y.y, -y.z], 1.0, [0.5, 1.0 / 3.0], 0.0);
        self.add_dipole_times(&exponential, area_vector);
    }

    /// Adds a triangle, its corners relative to the centre.
    #[inline]
    pub fn add_triangle(&mut self, [a, b, c]: [Vec3; 3], area_vector: Vec3) {
        let sum = 0.2 * (a + b + c);
        let nodes = [sum / 0.6, sum + 0.4 * a, sum + 0.4 * b, sum + 0.4 * c];
        let minus = [0, 1, 2].map(|axis| f64x4::from(nodes.map(|p| -p[axis])));
        let thirds = [0.5, 1.0 / 3.0].map(f64x4::splat);
        let at_nodes = exponential(minus, f64x4::from(RULE_WEIGHTS), thirds, f64x4::ZERO);
        let mut mean = at_nodes.map(f64x4::reduce_add);
        mean[0] = 1.0;
        self.add_dipole_times(&mean, area_vector);
    }

    #[inline(always)]
    fn add_dipole_times(&mut self, exponential: &Exponential, area_vector: Vec3) {
        let n = area_vector.to_array();
        add_product::<f64, 0>(&exponential[0..1], n, &mut self.coefficients[0..3]);
        add_product::<f64, 1>(&exponential[1..4], n, &mut self.coefficients[3..8]);
        add_product::<f64, 2>(&exponential[4..9], n, &mut self.coefficients[8..15]);
        add_product::<f64, 3>(&exponential[9..16], n, &mut self.coefficients[15..24]);
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

/// `weight` · exp(f), f a linear form, up to degree 3.
#[inline(always)]
fn exponential<T: super::harmonic::Number>(
    form: [T; 3],
    weight: T,
    [half, third]: [T; 2],
    zero: T,
) -> [T; 16] {
    let mut result = [zero; 16];
    result[0] = weight;
    let (head, rest) = result.split_at_mut(1);
    add_product::<T, 0>(head, form, &mut rest[0..3]);
    let (first, rest) = rest.split_at_mut(3);
    add_product::<T, 1>(first, form.map(|f| f * half), &mut rest[0..5]);
    let (second, third_degree) = rest.split_at_mut(5);
    add_product::<T, 2>(second, form.map(|f| f * third), third_degree);
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

    #[test]
    fn a_triangle_equals_its_four_quarters() {
        let [a, b, c] = TRIANGLE;
        let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
        let mut whole = Moments::ZERO;
        whole.add_triangle(TRIANGLE, area_vector(TRIANGLE));
        let mut parts = Moments::ZERO;
        for quarter in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
            parts.add_triangle(quarter, area_vector(quarter));
        }
        assert_equal(&whole, &parts);
    }

    #[test]
    fn a_moved_cluster_has_the_moments_of_its_sources() {
        let (old, new) = (Vec3::new(0.1, 0.2, -0.1), Vec3::new(-0.3, 0.4, 0.5));
        let about = |center: Vec3| {
            let mut moments = Moments::ZERO;
            moments.add_triangle(TRIANGLE.map(|v| v - center), area_vector(TRIANGLE));
            moments.add_point(TRIANGLE[1] - center, Vec3::new(1.0, 2.0, 3.0));
            moments
        };
        let mut moved = Moments::ZERO;
        moved.add_cluster(&about(old), old - new);
        assert_equal(&moved, &about(new));
    }
}
