//! The plain field of a cluster seen from afar, and how far it is from the truth.
//!
//! As complex numbers n·r / |r|² is the real part of n / r, so the plain field is that of f(q) = Σ m / (p − q), and its
//! gradient is the conjugate of f'. About a centre c, with a = p − c and z = q − c, each term is a geometric series:
//! m / (a − z) = −Σ m aᵏ / zᵏ⁺¹. What K terms of it leave is m (a / z)ᴷ / (a − z), so with S = Σ |m| and all |a| ≤ ρ < |z|
//!
//! - f lacks at most S (ρ/|z|)ᴷ / g, where g = |z| − ρ is the gap between query and cluster;
//! - f' lacks at most S (ρ/|z|)ᴷ (K/|z| + 1/g) / g.
//!
//! Bounding a point takes at most π²|x|³/3 from its value and π²x²|∇x| from its gradient, as y − arctan y ≤ y³/3 and
//! 1 − 1/(1 + y²) ≤ y². With |x| ≤ |m|/g and |∇x| ≤ |m|/g² a cluster of plain points is off by π² Σ|m|³ / 3g³ and
//! π² Σ|m|³ / g⁴.
use super::dipole::Dipole;
use crate::math::Vec2;
use std::f64::consts::PI;

/// Terms kept of each expansion. With 16 a query at a tolerance of 1e-6 takes 13 % more terms along curves and 46 % more where
/// points fill the plane; with 32 it takes 3 and 14 % fewer, for a third more memory. At 1e-3 curves do not tell.
const TERMS: usize = 24;

/// What is summed: w, or its gradient.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    Value,
    Gradient,
}

/// Multipole moments of some points.
#[derive(Clone, Default)]
pub struct Cluster {
    pub centre: Vec2,
    /// Largest distance of a point from the centre: ρ.
    pub radius: f64,
    /// Σ |m|.
    pub strength: f64,
    /// Σ |m|³.
    cubes: f64,
    /// Σ m (a/ρ)ᵏ: scaled, so that no unit of length overflows.
    moments: [Vec2; TERMS],
}

impl Cluster {
    pub fn of(dipoles: &[Dipole]) -> Cluster {
        let low = dipoles.iter().fold(Vec2::INFINITY, |low, d| low.min(d.point));
        let high = dipoles.iter().fold(Vec2::NEG_INFINITY, |high, d| high.max(d.point));
        let centre = low + 0.5 * (high - low);
        let radius = dipoles.iter().fold(0.0, |radius: f64, d| radius.max(d.point.distance(centre)));
        let mut cluster = Cluster { centre, radius, ..Cluster::default() };
        for dipole in dipoles {
            let strength = dipole.moment.length();
            cluster.strength += strength;
            cluster.cubes += strength.powi(3);
            let offset = if radius > 0.0 { (dipole.point - centre) / radius } else { Vec2::ZERO };
            let mut part = dipole.moment;
            for moment in &mut cluster.moments {
                *moment += part;
                part = part.rotate(offset); // the product of complex numbers
            }
        }
        cluster
    }

    /// The fewest terms whose error at a distance from the centre is at most `share`; none where no number of them is
    /// enough, as between the points. `is_bounded`: beside the bounded field.
    pub fn terms(&self, distance: f64, share: f64, quantity: Quantity, is_bounded: bool) -> Option<usize> {
        let gap = distance - self.radius;
        if gap.is_nan() || gap <= 0.0 {
            return None;
        }
        let unbounded = if is_bounded { PI * PI * self.cubes / gap.powi(3) } else { 0.0 };
        let share = match quantity {
            Quantity::Value => share - unbounded / 3.0,
            Quantity::Gradient => share - unbounded / gap,
        };
        let mut series = self.strength / gap;
        (0..=TERMS).find(|&terms| {
            let error = match quantity {
                Quantity::Value => series,
                Quantity::Gradient => series * (terms as f64 / distance + 1.0 / gap),
            };
            series *= self.radius / distance;
            error <= share
        })
    }

    /// The plain field at the centre plus `z`, by the first `terms`.
    pub fn value(&self, z: Vec2, terms: usize) -> f64 {
        let inverse = reciprocal(z);
        let step = self.radius * inverse;
        let add = |sum: Vec2, moment: &Vec2| sum.rotate(step) + *moment;
        let sum = self.moments[..terms].iter().rev().fold(Vec2::ZERO, add);
        -inverse.rotate(sum).x
    }

    /// The gradient of [`Cluster::value`]'s field: f' = Σ (k + 1) m aᵏ / zᵏ⁺², conjugate.
    pub fn gradient(&self, z: Vec2, terms: usize) -> Vec2 {
        let inverse = reciprocal(z);
        let step = self.radius * inverse;
        let add = |sum: Vec2, (k, moment): (usize, &Vec2)| sum.rotate(step) + (k as f64 + 1.0) * *moment;
        let sum = self.moments[..terms].iter().enumerate().rev().fold(Vec2::ZERO, add);
        conjugate(inverse.rotate(inverse.rotate(sum)))
    }
}

fn conjugate(z: Vec2) -> Vec2 {
    Vec2::new(z.x, -z.y)
}

fn reciprocal(z: Vec2) -> Vec2 {
    conjugate(z) / z.length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points all at the end of the radius but one, which face the query: nearly the worst case.
    fn facing() -> Vec<Dipole> {
        let at = |x: f64, y: f64| Dipole { point: Vec2::new(x, y), moment: Vec2::new(0.1, 0.0) };
        vec![at(1.0, 0.0), at(1.0, 0.0), at(-1.0, 0.0)]
    }

    #[test]
    fn the_error_of_terms_is_below_its_bound_and_near_it() {
        let (dipoles, cluster) = (facing(), Cluster::of(&facing()));
        assert_eq!((cluster.centre, cluster.radius), (Vec2::ZERO, 1.0));
        let mut nearest = [0.0_f64; 2];
        for (distance, share) in [(1.5, 1e-2), (2.0, 1e-3), (3.0, 1e-5), (9.0, 1e-7)] {
            for turn in 0..50 {
                let z = Vec2::from_angle(0.1257 * f64::from(turn)) * distance;
                let terms = cluster.terms(distance, share, Quantity::Value, false).unwrap();
                let exact: f64 = dipoles.iter().map(|d| d.value(z, false)).sum();
                let error = (cluster.value(z, terms) - exact).abs();
                assert!(error <= share, "{error} of {share} with {terms} terms");
                nearest[0] = nearest[0].max(error / share);
                let terms = cluster.terms(distance, share, Quantity::Gradient, false).unwrap();
                let exact: Vec2 = dipoles.iter().map(|d| d.gradient(z, false)).sum();
                let error = (cluster.gradient(z, terms) - exact).length();
                assert!(error <= share, "{error} of {share} with {terms} terms of the gradient");
                nearest[1] = nearest[1].max(error / share);
            }
        }
        assert!(nearest.iter().all(|n| *n > 0.3), "the bounds are loose: {nearest:?}");
    }

    #[test]
    fn what_bounding_takes_is_part_of_the_error() {
        // A point alone: its series is exact after a term, so what is left is the bounding.
        let point = Dipole { point: Vec2::ZERO, moment: Vec2::new(0.3, 0.0) };
        let cluster = Cluster::of(&[point]);
        for (quantity, scale) in [(Quantity::Value, 3.0), (Quantity::Gradient, 1.0)] {
            for distance in [1.0, 2.0, 10.0] {
                let z = Vec2::new(-distance, 0.0);
                let taken = match quantity {
                    Quantity::Value => (point.value(z, false) - point.value(z, true)).abs(),
                    Quantity::Gradient => (point.gradient(z, false) - point.gradient(z, true)).length(),
                };
                let power = if quantity == Quantity::Value { 3 } else { 4 };
                let bound = PI * PI * 0.3_f64.powi(3) / (scale * distance.powi(power));
                assert!(taken <= bound && taken > 0.4 * bound, "{taken} of {bound} at {distance}");
                assert_eq!(cluster.terms(distance, 1.001 * bound, quantity, true), Some(1));
                assert_eq!(cluster.terms(distance, 0.999 * bound, quantity, true), None);
            }
        }
    }

    #[test]
    fn inside_its_circle_and_without_tolerance_a_cluster_is_opened() {
        let cluster = Cluster::of(&facing());
        for (distance, share) in
            [(0.0, 1e9), (1.0, 1e9), (5.0, 0.0), (5.0, -1.0), (5.0, f64::NAN), (f64::NAN, 1.0)]
        {
            assert_eq!(cluster.terms(distance, share, Quantity::Value, false), None);
        }
    }
}
