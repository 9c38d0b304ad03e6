//! Minimisation by L-BFGS (Nocedal and Wright 2006, algorithms 7.4 and 7.5).
use std::collections::VecDeque;

/// Steps that the curvature is known from.
const MEMORY: usize = 10;
/// What a step must win of what the slope promises, and how much of the slope may be left (Wolfe's conditions).
const WOLFE: (f64, f64) = (1e-4, 0.9);
/// Most values for one step.
const TRIALS: usize = 20;

/// A value and its slope at a place.
type Function<'a> = &'a dyn Fn(&[f64]) -> (f64, Vec<f64>);
/// A step and the change of slope along it.
type Step = (Vec<f64>, Vec<f64>);

/// Moves `x` to a minimum of `f` in at most `steps`; ends where no step wins.
pub fn minimise(x: &mut Vec<f64>, f: Function, steps: usize) {
    let (mut value, mut slope) = f(x);
    let mut known: VecDeque<Step> = VecDeque::new();
    for _ in 0..steps {
        let mut direction = newton(&known, &slope);
        if dot(&direction, &slope) >= 0.0 {
            known.clear();
            direction = newton(&known, &slope);
        }
        let first = if known.is_empty() { 1.0 / dot(&slope, &slope).sqrt() } else { 1.0 };
        let Some((next, next_value, next_slope)) = search(x, &direction, (value, &slope), first, f) else {
            break;
        };
        let moved: Vec<f64> = next.iter().zip(&*x).map(|(a, b)| a - b).collect();
        let change: Vec<f64> = next_slope.iter().zip(&slope).map(|(a, b)| a - b).collect();
        if dot(&moved, &change) > 0.0 {
            known.push_back((moved, change));
            known.drain(..known.len().saturating_sub(MEMORY));
        }
        (*x, value, slope) = (next, next_value, next_slope);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
}

/// The direction of Newton's method with the curvature known from steps and the changes of slope along them.
fn newton(known: &VecDeque<Step>, slope: &[f64]) -> Vec<f64> {
    let mut direction: Vec<f64> = slope.iter().map(|s| -s).collect();
    let mut factors = Vec::new();
    for (moved, change) in known.iter().rev() {
        let factor = dot(moved, &direction) / dot(moved, change);
        add(&mut direction, -factor, change);
        factors.push(factor);
    }
    if let Some((moved, change)) = known.back() {
        let scale = dot(moved, change) / dot(change, change);
        direction.iter_mut().for_each(|d| *d *= scale);
    }
    for ((moved, change), factor) in known.iter().zip(factors.iter().rev()) {
        let back = dot(change, &direction) / dot(moved, change);
        add(&mut direction, factor - back, moved);
    }
    direction
}

/// A step along `direction` that meets Wolfe's conditions, found by bisection; at worst one that wins at all.
fn search(
    x: &[f64],
    direction: &[f64],
    (value, slope): (f64, &[f64]),
    first: f64,
    f: Function,
) -> Option<(Vec<f64>, f64, Vec<f64>)> {
    let promised = dot(direction, slope);
    let (mut length, mut low, mut high) = (first, 0.0, f64::INFINITY);
    let mut best: Option<(Vec<f64>, f64, Vec<f64>)> = None;
    for _ in 0..TRIALS {
        let mut next = x.to_vec();
        add(&mut next, length, direction);
        let (next_value, next_slope) = f(&next);
        if next_value > value + WOLFE.0 * length * promised {
            high = length;
        } else {
            let is_steep = dot(direction, &next_slope) < WOLFE.1 * promised;
            best = Some((next, next_value, next_slope));
            if !is_steep {
                break;
            }
            low = length;
        }
        length = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * length };
    }
    best
}
