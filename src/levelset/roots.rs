//! Where a smooth function vanishes on many edges, all of which are asked for together.
use super::cubes::{Edge, TraceError};
use crate::data::Monitor;
use crate::math::Vec3;

/// Values beyond this tell no more than their sign: the field of points grows without bounds next to them.
const MOST: f64 = 0.5;
/// A place serves where the function is as small as this. With 0.02 surfaces of knots are a third farther from the truth.
const CLOSE: f64 = 5e-3;
/// Times that the function is asked for. On the dragon's 35,000 points the mean distance of the surface from the truth, which is
/// 0.0185 % of the diagonal at last, is 0.0382, 0.0228, 0.0196, 0.0188 and 0.0186 % after none to four; a fifth takes 5 % off that on
/// smooth models.
const ROUNDS: usize = 5;
/// Guesses keep this share of the interval away from its ends.
const MARGIN: f64 = 0.05;

/// An edge whose root is being looked for: the ends of an interval on it, values there.
struct Bracket {
    edge: usize,
    ends: [f64; 2],
    values: [f64; 2],
    /// The end that was moved last, if any.
    moved: Option<usize>,
}

/// Values of the function at some points.
pub type Values<'a> = dyn Fn(&[Vec3], &dyn Monitor) -> Result<Vec<f64>, TraceError> + 'a;

/// For each edge a place between 0 and 1 where a function is near 0 that has different signs at its ends: by false position in the
/// Illinois variant (Dowell & Jarratt 1971).
///
/// # Errors
/// As `values`.
pub fn find_roots(edges: &[Edge], values: &Values, monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
    let start = |(edge, e): (usize, &Edge)| Bracket {
        edge,
        ends: [0.0, 1.0],
        values: e.ends.map(|value| f64::from(value).clamp(-MOST, MOST)),
        moved: None,
    };
    let mut open: Vec<Bracket> = edges.iter().enumerate().map(start).collect();
    let mut roots: Vec<f64> = open.iter().map(Bracket::guess).collect();
    for round in 0..ROUNDS {
        let points: Vec<Vec3> = open.iter().map(|b| edges[b.edge].at(roots[b.edge])).collect();
        let of_round = |part: f64, _: &str| {
            monitor.report((round as f64 + part) / ROUNDS as f64, "surface vertices").is_ok()
        };
        let mut found = values(&points, &of_round)?.into_iter();
        open.retain_mut(|bracket| {
            let value = found.next().unwrap_or(0.0).clamp(-MOST, MOST);
            if value.abs() < CLOSE {
                return false;
            }
            bracket.narrow(roots[bracket.edge], value);
            roots[bracket.edge] = bracket.guess();
            true
        });
    }
    Ok(roots)
}

impl Bracket {
    /// Where the line through both ends vanishes.
    fn guess(&self) -> f64 {
        let [a, b] = self.values;
        let share = if a == b { 0.5 } else { (a / (a - b)).clamp(MARGIN, 1.0 - MARGIN) };
        self.ends[0] + share * (self.ends[1] - self.ends[0])
    }

    fn narrow(&mut self, at: f64, value: f64) {
        let end = usize::from(value.is_sign_positive() != self.values[0].is_sign_positive());
        (self.ends[end], self.values[end]) = (at, value);
        if self.moved == Some(end) {
            // The other end stays where it is too long unless its value counts for less.
            self.values[1 - end] *= 0.5;
        }
        self.moved = Some(end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    #[test]
    fn roots_of_a_steep_step_are_found() {
        let steps: Vec<f64> = (1..200).map(|k| f64::from(k) / 200.0).collect();
        // As across a cloud's surface: all of the change lies in a fifth of the edge.
        let step = |p: Vec3| 0.5 * ((p.x - p.y) / 0.1).tanh();
        let edge = |y: &f64| {
            let start = Vec3::new(0.0, *y, 0.0);
            Edge { start, along: Vec3::X, ends: [step(start) as f32, step(start + Vec3::X) as f32] }
        };
        let edges: Vec<Edge> = steps.iter().map(edge).collect();
        let values = |points: &[Vec3], _: &dyn Monitor| Ok(points.iter().map(|p| step(*p)).collect());
        let roots = find_roots(&edges, &values, &Silent).unwrap();
        let errors = roots.iter().zip(&steps).map(|(root, step)| (root - step).abs());
        assert!(errors.clone().all(|e| e < 0.05) && errors.sum::<f64>() < 199.0 * 5e-3);
    }
}
