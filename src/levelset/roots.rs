//! Where a smooth function vanishes on many edges, all of which are asked for together.
use super::cubes::{Edge, TraceError};
use crate::math::Vec3;

/// Values beyond this tell no more than their sign: a field of points grows without bounds next to them.
const MOST: f64 = 0.5;

/// An edge whose root is being looked for: ends of the interval, values there.
struct Bracket {
    edge: usize,
    ends: [f64; 2],
    values: [f64; 2],
    /// The end that was replaced last.
    replaced: usize,
}

fn env(n: &str, d: f64) -> f64 { std::env::var(n).ok().and_then(|s| s.parse().ok()).unwrap_or(d) }

/// For each edge a place between 0 and 1 where a function is near 0 that has different signs at the ends, by the Illinois
/// variant of the false position (Dowell & Jarratt 1971).
///
/// # Errors
/// If `values` fails.
pub fn find_roots(
    edges: &[Edge],
    values: &dyn Fn(&[Vec3]) -> Result<Vec<f64>, TraceError>,
) -> Result<Vec<f64>, TraceError> {
    let rounds = env("ROUNDS", 4.0) as usize;
    let close = env("CLOSE", 2e-2);
    let start = |(edge, e): (usize, &Edge)| Bracket {
        edge,
        ends: [0.0, 1.0],
        values: e.ends.map(|v| f64::from(v).clamp(-MOST, MOST)),
        replaced: 2,
    };
    let mut open: Vec<Bracket> = edges.iter().enumerate().map(start).collect();
    let mut roots: Vec<f64> = open.iter().map(Bracket::guess).collect();
    for _ in 0..rounds {
        if open.is_empty() { break; }
        let points: Vec<Vec3> = open.iter().map(|b| edges[b.edge].at(roots[b.edge])).collect();
        let found = values(&points)?;
        let mut found = found.into_iter();
        open.retain_mut(|bracket| {
            let value = found.next().expect("a value for each").clamp(-MOST, MOST);
            if value.abs() < close {
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
    fn guess(&self) -> f64 {
        let [a, b] = self.values;
        let share = (a / (a - b)).clamp(0.05, 0.95);
        self.ends[0] + share * (self.ends[1] - self.ends[0])
    }

    fn narrow(&mut self, at: f64, value: f64) {
        let end = usize::from(value.is_sign_positive() != self.values[0].is_sign_positive());
        (self.ends[end], self.values[end]) = (at, value);
        if self.replaced == end {
            self.values[1 - end] *= 0.5;
        }
        self.replaced = end;
    }
}
