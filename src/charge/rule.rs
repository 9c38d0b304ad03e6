//! Symmetric Gauss rules on triangles, none of which has a point at the barycentre: Dunavant 1985, *High degree efficient
//! symmetrical Gaussian quadrature rules for the triangle*.
use crate::math::Vec3;

/// Which polynomials a rule integrates exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Degree 2, with 3 points.
    Two,
    /// Degree 4, with 6 points.
    Four,
    /// Degree 6, with 12 points: that of the paper.
    Six,
}

/// An orbit of points: the weight of each, and their barycentric coordinates in any order.
type Orbit = (f64, [f64; 3]);

const TWO: [Orbit; 1] = [(1.0 / 3.0, pair(1.0 / 6.0))];
const FOUR: [Orbit; 2] = [
    (0.223_381_589_678_011_46, pair(0.445_948_490_915_964_9)),
    (0.109_951_743_655_321_87, pair(0.091_576_213_509_770_74)),
];
const SIX: [Orbit; 3] = [
    (0.116_786_275_726_379_37, pair(0.249_286_745_170_910_42)),
    (0.050_844_906_370_206_82, pair(0.063_089_014_491_502_23)),
    (0.082_851_075_618_373_57, [0.053_145_049_844_816_947, 0.310_352_451_033_784_4, 0.636_502_499_121_398_7]),
];

/// Two equal coordinates.
const fn pair(a: f64) -> [f64; 3] {
    [a, a, 1.0 - 2.0 * a]
}

impl Rule {
    fn orbits(self) -> &'static [Orbit] {
        match self {
            Rule::Two => &TWO,
            Rule::Four => &FOUR,
            Rule::Six => &SIX,
        }
    }

    /// Number of points.
    pub fn count(self) -> usize {
        match self {
            Rule::Two => 3,
            Rule::Four => 6,
            Rule::Six => 12,
        }
    }

    /// Weights, whose sum is 1, and points on the triangle.
    pub fn points(self, [a, b, c]: [Vec3; 3]) -> impl Iterator<Item = (f64, Vec3)> {
        self.orbits().iter().flat_map(move |(weight, [u, v, w])| {
            let all = [[u, v, w], [v, w, u], [w, u, v], [v, u, w], [u, w, v], [w, v, u]];
            let distinct = if u == v { 3 } else { 6 };
            all.into_iter().take(distinct).map(move |[u, v, w]| (*weight, *u * a + *v * b + *w * c))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of xᵐ yⁿ over the triangle (0,0), (1,0), (0,1): 2 m! n! / (m + n + 2)!.
    fn mean(m: i32, n: i32) -> f64 {
        let factorial = |k: i32| (1..=k).map(f64::from).product::<f64>();
        2.0 * factorial(m) * factorial(n) / factorial(m + n + 2)
    }

    #[test]
    fn rules_integrate_polynomials_of_their_degree_and_avoid_the_barycentre() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        for (rule, degree) in [(Rule::Two, 2), (Rule::Four, 4), (Rule::Six, 6)] {
            assert_eq!(rule.points(corners).count(), rule.count());
            let sum = |m: i32, n: i32| -> f64 {
                rule.points(corners).map(|(w, p)| w * p.x.powi(m) * p.y.powi(n)).sum()
            };
            for m in 0..=degree {
                for n in 0..=degree - m {
                    assert!((sum(m, n) - mean(m, n)).abs() < 1e-15, "{rule:?}: x^{m} y^{n}");
                }
            }
            let next = (0..=degree + 1).map(|m| (sum(m, degree + 1 - m) - mean(m, degree + 1 - m)).abs());
            assert!(next.fold(0.0, f64::max) > 1e-6, "{rule:?} is of a higher degree");
            let middle = Vec3::new(1.0, 1.0, 0.0) / 3.0;
            assert!(rule.points(corners).all(|(_, p)| p.distance(middle) > 0.1));
        }
    }
}
