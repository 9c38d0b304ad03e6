//! Multipole moments of charged triangles and clusters of them, to the octupole.
//!
//! φ = Σ Hₙ(R)/|R|²ⁿ⁺¹: H₀ = q, H₁ = p·R, H₂ = ½ Q:RR, H₃ = ⅙ O:RRR, Q and O symmetric and without trace.
use crate::math::Vec3;

/// The pairs of axes of a symmetric matrix, and triples of a symmetric tensor.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
const TRIPLES: [[usize; 3]; 10] = [
    [0, 0, 0],
    [1, 1, 1],
    [2, 2, 2],
    [0, 0, 1],
    [0, 0, 2],
    [0, 1, 1],
    [1, 1, 2],
    [0, 2, 2],
    [1, 2, 2],
    [0, 1, 2],
];

/// Places of the coefficients of a series: charge, dipole, quadrupole by [`PAIRS`], octupole by [`TRIPLES`].
pub const COEFFICIENTS: usize = 20;
pub type Series = [f32; COEFFICIENTS];

/// Σ q, Σ q y, Σ q y yᵀ and Σ q y y y of charges at y relative to a centre.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moments {
    pub charge: f64,
    pub first: Vec3,
    pub second: [f64; 6],
    pub third: [f64; 10],
}

#[cfg(test)]
fn pair(i: usize, j: usize) -> usize {
    let wanted = [i.min(j), i.max(j)];
    PAIRS.iter().position(|p| *p == wanted).expect("both are axes")
}

fn triple(i: usize, j: usize, k: usize) -> usize {
    let mut wanted = [i, j, k];
    wanted.sort_unstable();
    TRIPLES.iter().position(|t| *t == wanted).expect("all are axes")
}

impl Moments {
    /// Of a charge of 1, even on a triangle, about its barycentre: with corners v, Σ v vᵀ / 12 and Σ v v v / 30.
    pub fn of_triangle(corners: [Vec3; 3], barycentre: Vec3) -> Moments {
        let corners = corners.map(|corner| corner - barycentre);
        let sum = |f: &dyn Fn(Vec3) -> f64| corners.iter().map(|v| f(*v)).sum::<f64>();
        Moments {
            charge: 1.0,
            first: Vec3::ZERO,
            second: PAIRS.map(|[i, j]| sum(&|v| v[i] * v[j]) / 12.0),
            third: TRIPLES.map(|[i, j, k]| sum(&|v| v[i] * v[j] * v[k]) / 30.0),
        }
    }

    /// Adds `times` other moments, whose centre is `d` from this one.
    pub fn add(&mut self, other: &Moments, times: f64, d: Vec3) {
        let (q, p) = (times * other.charge, times * other.first);
        let second = other.second.map(|x| times * x);
        self.charge += q;
        self.first += p + q * d;
        for (sum, (pair, [i, j])) in self.second.iter_mut().zip(second.iter().zip(PAIRS)) {
            *sum += pair + p[i] * d[j] + p[j] * d[i] + q * d[i] * d[j];
        }
        for (n, [i, j, k]) in TRIPLES.into_iter().enumerate() {
            self.third[n] += times * other.third[n]
                + second[SECOND_OF[n][0]] * d[i]
                + second[SECOND_OF[n][1]] * d[j]
                + second[SECOND_OF[n][2]] * d[k]
                + p[i] * d[j] * d[k]
                + p[j] * d[i] * d[k]
                + p[k] * d[i] * d[j]
                + q * d[i] * d[j] * d[k];
        }
    }

    /// The coefficients of q, p, Q and O.
    pub fn series(&self) -> Series {
        let mut series = [0.0; COEFFICIENTS];
        let single = |x: f64| x as f32;
        series[0] = single(self.charge);
        (0..3).for_each(|i| series[1 + i] = single(self.first[i]));
        let trace: f64 = self.second[..3].iter().sum();
        for (n, x) in self.second.iter().enumerate() {
            series[4 + n] = single(3.0 * x - if n < 3 { trace } else { 0.0 });
        }
        let traces = [0, 1, 2].map(|i| (0..3).map(|j| self.third[triple(i, j, j)]).sum::<f64>());
        for (n, [i, j, k]) in TRIPLES.into_iter().enumerate() {
            let both = |a: usize, b: usize, t: f64| if a == b { t } else { 0.0 };
            let trace = both(j, k, traces[i]) + both(i, k, traces[j]) + both(i, j, traces[k]);
            series[10 + n] = single(15.0 * self.third[n] - 3.0 * trace);
        }
        series
    }
}

/// Of each triple i, j, k the places of the pairs jk, ik, ij.
const SECOND_OF: [[usize; 3]; 10] = [
    [0, 0, 0],
    [1, 1, 1],
    [2, 2, 2],
    [3, 3, 0],
    [4, 4, 0],
    [1, 3, 3],
    [5, 5, 1],
    [2, 4, 4],
    [2, 5, 5],
    [5, 4, 3],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::charge::Rule;

    #[test]
    fn places_of_pairs_are_right() {
        for (n, [i, j, k]) in TRIPLES.into_iter().enumerate() {
            assert_eq!(SECOND_OF[n], [pair(j, k), pair(i, k), pair(i, j)]);
        }
    }

    #[test]
    fn a_displaced_triangle_has_the_moments_of_its_quadrature() {
        let corners = [Vec3::new(0.3, 0.1, -0.4), Vec3::new(1.2, -0.3, 0.5), Vec3::new(0.1, 0.8, 0.9)];
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let center = Vec3::new(-0.2, 0.4, 0.1);
        let mut moments = Moments::default();
        moments.add(&Moments::of_triangle(corners, middle), 2.5, middle - center);
        let sum = |f: &dyn Fn(Vec3) -> f64| {
            Rule::Six.points(corners).map(|(w, p)| 2.5 * w * f(p - center)).sum::<f64>()
        };
        assert!((moments.charge - 2.5).abs() < 1e-15);
        (0..3).for_each(|i| assert!((moments.first[i] - sum(&|y| y[i])).abs() < 1e-14));
        for (n, [i, j]) in PAIRS.into_iter().enumerate() {
            assert!((moments.second[n] - sum(&|y| y[i] * y[j])).abs() < 1e-14);
        }
        for (n, [i, j, k]) in TRIPLES.into_iter().enumerate() {
            assert!((moments.third[n] - sum(&|y| y[i] * y[j] * y[k])).abs() < 1e-14, "{n}");
        }
    }
}
