//! What a charge on one element gives at the barycentre of another: the entries of the linear system (eqs. 3 and 5).
use super::elements::Elements;
use super::panel::potential_and_field;
use super::rule::Rule;
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};

/// How potentials on the surface are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Integration {
    /// In closed form where a triangle is near, its own barycentre included; by rules of lower and lower degree farther away.
    #[default]
    Exact,
    /// By the rule of degree 6 everywhere, as in the paper: a triangle's own potential is 9 % low then.
    Quadrature,
}

/// Rules from the farthest on, and where they begin to do, in longest edges of the triangle from its barycentre: errors are some
/// 10⁻⁶ of the potential there, and of alternating sign.
const BANDS: [(f64, Rule); 3] = [(12.0, Rule::Two), (4.0, Rule::Four), (2.0, Rule::Six)];

/// Barycentres that are taken together.
const LANES: usize = 16;

/// The potentials of single elements at the barycentres of others.
pub struct Influence<'a> {
    pub elements: &'a Elements,
    pub integration: Integration,
}

impl Influence<'_> {
    /// The rule that does at all distances from `distance` on; none where it takes the closed form.
    fn rule(&self, source: usize, distance: f64) -> Option<Rule> {
        let ratio = distance / self.elements.sizes[source];
        match self.integration {
            Integration::Quadrature => Some(Rule::Six),
            Integration::Exact => BANDS.into_iter().find(|(from, _)| ratio > *from).map(|(_, rule)| rule),
        }
    }

    /// The potential at the barycentre of `target` of a charge of 1 on `source`.
    pub fn entry(&self, target: usize, source: usize) -> f64 {
        let Elements { centers, corners, areas, .. } = self.elements;
        let x = centers[target];
        match self.rule(source, x.distance(centers[source])) {
            Some(rule) => rule.points(corners[source]).map(|(weight, y)| weight / x.distance(y)).sum(),
            None => potential_and_field(x, corners[source]).0 / areas[source],
        }
    }

    /// The entries of one source and the targets from `first` on.
    pub fn fill(&self, places: &Places, source: usize, first: usize, column: &mut [f64]) {
        let center = self.elements.centers[source];
        for start in (first..first + column.len()).step_by(LANES) {
            let end = (start + LANES).min(first + column.len());
            let some = &mut column[start - first..end - first];
            let ball = places.balls[start / LANES];
            match self.rule(source, center.distance(ball.0) - ball.1) {
                Some(rule) if start % LANES == 0 => {
                    let axes = [0, 1, 2].map(|k| &places.axes[k][start..start + LANES]);
                    let mut sums = [0.0; LANES];
                    for (weight, y) in rule.points(self.elements.corners[source]) {
                        in_widest_registers(Point { weight, y: y.to_array(), axes, sums: &mut sums });
                    }
                    some.copy_from_slice(&sums[..end - start]);
                }
                _ => {
                    some.iter_mut().zip(start..).for_each(|(slot, target)| *slot = self.entry(target, source))
                }
            }
        }
    }
}

/// The barycentres of all elements, by axis, and balls around each [`LANES`] of them.
pub struct Places {
    axes: [Vec<f64>; 3],
    balls: Vec<(Vec3, f64)>,
}

impl Places {
    pub fn of(elements: &Elements) -> Places {
        let padded = elements.len().next_multiple_of(LANES);
        let at = |i: usize| elements.centers[i.min(elements.len() - 1)];
        let ball = |centers: &[Vec3]| {
            let middle = centers.iter().sum::<Vec3>() / centers.len() as f64;
            (middle, centers.iter().map(|c| c.distance(middle)).fold(0.0, f64::max))
        };
        Places {
            axes: [0, 1, 2].map(|axis| (0..padded).map(|i| at(i)[axis]).collect()),
            balls: elements.centers.chunks(LANES).map(ball).collect(),
        }
    }
}

/// A point charge at many places.
struct Point<'a> {
    weight: f64,
    y: [f64; 3],
    axes: [&'a [f64]; 3],
    sums: &'a mut [f64; LANES],
}

impl Work for Point<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.add::<R::Doubles>();
    }
}

impl Point<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f64>>(self) {
        let weight = F::splat(self.weight);
        for start in (0..LANES).step_by(F::COUNT) {
            let offset = |k: usize| F::load(&self.axes[k][start..]) - F::splat(self.y[k]);
            let (x, y, z) = (offset(0), offset(1), offset(2));
            let sum = F::load(&self.sums[start..]) + weight / (x * x + y * y + z * z).sqrt();
            sum.store(&mut self.sums[start..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::TriangleSoup;

    #[test]
    fn columns_hold_the_entries_and_these_are_near_the_closed_form() {
        let point = |i: usize| {
            let t = i as f64;
            Vec3::new((1.3 * t).sin(), (2.1 * t).cos(), (0.7 * t).sin())
        };
        let positions: Vec<Vec3> =
            (0..67).flat_map(|i| [0, 1, 2].map(|k| point(i) + 0.2 * point(100 + 3 * i + k))).collect();
        let soup =
            TriangleSoup::new(positions, (0..67).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).unwrap();
        let elements = Elements::new(&soup, None);
        let places = Places::of(&elements);
        let (mut column, mut part) = (vec![0.0; 67], vec![0.0; 35]);
        for integration in [Integration::Exact, Integration::Quadrature] {
            let influence = Influence { elements: &elements, integration };
            for source in 0..67 {
                influence.fill(&places, source, 0, &mut column);
                influence.fill(&places, source, 32, &mut part);
                for target in 0..67 {
                    let entry = influence.entry(target, source);
                    let exact = potential_and_field(elements.centers[target], elements.corners[source]).0
                        / elements.areas[source];
                    // One rule for all is no closed form where a barycentre is next to one of its points.
                    let distance = elements.centers[target].distance(elements.centers[source]);
                    if integration == Integration::Exact || distance > 2.0 * elements.sizes[source] {
                        assert!((entry / exact - 1.0).abs() < 1e-4, "{source} at {target}: {entry}, {exact}");
                    }
                    // A block of places may take a better rule than one alone.
                    assert!((column[target] / entry - 1.0).abs() < 1e-4);
                    assert!(target < 32 || part[target - 32] == column[target]);
                }
            }
        }
    }
}
