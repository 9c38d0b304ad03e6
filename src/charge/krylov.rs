//! Charges by GMRES: Saad & Schultz 1986, preconditioned from the right, so that residuals are those of the system itself.
use super::influence::Influence;
use super::robin_hood::deviation;
use super::system::System;
use crate::data::{Cancelled, Monitor, map_tasks};

/// Elements that are solved for together by the preconditioner: neighbours on the curve.
const CLUSTER: usize = 64;
/// Vectors that are kept.
const RESTART: usize = 80;
/// Steps after which the solver gives up; systems that have a solution take some tens.
const MOST_STEPS: usize = 400;
/// How much less the rms deviation has to be than the largest, at first.
const RMS_SHARE: f64 = 0.25;
/// A new direction smaller than this share of what it was made of is rounding, or would take charges of both signs that are larger than
/// all others by as much, as those of triangles that cross each other in nearly one plane: there is none left.
const SPENT: f64 = 1e-10;
/// A cluster's own potentials count as larger by this share: copies of a triangle would make its matrix singular.
const SHIFT: f64 = 1e-3;

/// Charges of elements, and the steps taken.
pub struct Solution {
    pub charges: Vec<f64>,
    pub steps: usize,
}

/// Charges that give the `wanted` potentials, of size 1, at the barycentres, but for `tolerance`.
pub fn solve(
    system: &dyn System,
    influence: &Influence,
    wanted: &[f64],
    tolerance: f64,
    monitor: &dyn Monitor,
) -> Result<Solution, Cancelled> {
    let len = influence.elements.len();
    let inverse = Clusters::new(influence);
    let mut charges = vec![0.0; len];
    // Where nothing is won, as of triangles whose potentials depend on each other, the charge is spread evenly.
    let spread: Vec<f64> = wanted.iter().zip(&influence.elements.areas).map(|(w, area)| w * area).collect();
    let (mut best, mut kept) = (1.0, spread);
    let mut steps = 0;
    let mut goal = RMS_SHARE * tolerance;
    loop {
        let (residual, deviation) = if steps == 0 {
            (wanted.to_vec(), 1.0)
        } else {
            let potentials = system.potentials(&charges);
            let signed: Vec<f64> = potentials.iter().zip(wanted).map(|(p, w)| p * w).collect();
            (potentials.iter().zip(wanted).map(|(p, w)| w - p).collect(), deviation(&signed).0)
        };
        let is_stuck = steps > 0 && deviation > 0.5 * best;
        if deviation < best {
            (best, kept) = (deviation, charges.clone());
        }
        if deviation <= tolerance || steps >= MOST_STEPS || is_stuck || deviation.is_nan() {
            return Ok(Solution { charges: kept, steps });
        }
        let norm = norm(&residual) / (len as f64).sqrt();
        let report = |rms: f64| {
            // Digits won, of those wanted.
            let done = libm::log(rms.max(goal)) / libm::log(goal.min(0.5));
            monitor.report(done.clamp(0.0, 1.0), "charges")
        };
        let (change, taken) = cycle(system, &inverse, residual, goal / norm, &|share| report(share * norm))?;
        if taken == 0 {
            return Ok(Solution { charges: kept, steps });
        }
        charges.iter_mut().zip(change).for_each(|(charge, change)| *charge += change);
        steps += taken;
        goal *= RMS_SHARE;
    }
}

fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// One cycle: what reduces `residual` to `share` of its norm, or as far as it gets, and the steps taken.
fn cycle(
    system: &dyn System,
    inverse: &Clusters,
    residual: Vec<f64>,
    share: f64,
    report: &dyn Fn(f64) -> Result<(), Cancelled>,
) -> Result<(Vec<f64>, usize), Cancelled> {
    let start = norm(&residual);
    let mut basis = vec![residual.iter().map(|r| r / start).collect::<Vec<f64>>()];
    // The columns of the triangular matrix, and the rotations that made it.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<(f64, f64)> = Vec::new();
    let mut right = vec![1f64];
    // There are no more directions than elements.
    while columns.len() < RESTART.min(residual.len()) && right[columns.len()].abs() > share {
        report(right[columns.len()].abs())?;
        let k = columns.len();
        let mut next = system.potentials(&inverse.apply(&basis[k]));
        let least = SPENT * norm(&next);
        let mut column = Vec::with_capacity(k + 2);
        for vector in &basis {
            let along = dot(&next, vector);
            next.iter_mut().zip(vector).for_each(|(n, v)| *n -= along * v);
            column.push(along);
        }
        let length = norm(&next);
        column.push(length);
        for (i, (cos, sin)) in rotations.iter().enumerate() {
            (column[i], column[i + 1]) =
                (cos * column[i] + sin * column[i + 1], cos * column[i + 1] - sin * column[i]);
        }
        let size = column[k].hypot(column[k + 1]);
        if size <= least || !size.is_finite() {
            break;
        }
        let (cos, sin) = (column[k] / size, column[k + 1] / size);
        column[k] = size;
        column.truncate(k + 1);
        rotations.push((cos, sin));
        right.push(-sin * right[k]);
        right[k] *= cos;
        columns.push(column);
        if length <= least {
            break;
        }
        basis.push(next.into_iter().map(|n| n / length).collect());
    }
    let steps = columns.len();
    let mut weights = right[..steps].to_vec();
    for k in (0..steps).rev() {
        weights[k] /= columns[k][k];
        let weight = weights[k];
        (0..k).for_each(|i| weights[i] -= columns[k][i] * weight);
    }
    let mut sum = vec![0.0; residual.len()];
    for (weight, vector) in weights.iter().zip(&basis) {
        sum.iter_mut().zip(vector).for_each(|(s, v)| *s += start * weight * v);
    }
    Ok((inverse.apply(&sum), steps))
}

/// The inverses of the systems of clusters alone.
struct Clusters {
    len: usize,
    inverses: Vec<Vec<f64>>,
}

impl Clusters {
    fn new(influence: &Influence) -> Clusters {
        let len = influence.elements.len();
        let inverses = map_tasks(len.div_ceil(CLUSTER), |k| {
            let first = k * CLUSTER;
            let size = CLUSTER.min(len - first);
            let entry = |i: usize, j: usize| {
                let own = if i == j { 1.0 + SHIFT } else { 1.0 };
                own * influence.entry(first + i, first + j)
            };
            let rows: Vec<f64> = (0..size * size).map(|n| entry(n / size, n % size)).collect();
            inverted(rows, size)
        });
        Clusters { len, inverses }
    }

    fn apply(&self, values: &[f64]) -> Vec<f64> {
        let tasks = map_tasks(self.inverses.len(), |k| {
            let own = &values[k * CLUSTER..self.len.min((k + 1) * CLUSTER)];
            self.inverses[k].chunks(own.len()).map(|row| dot(row, own)).collect::<Vec<f64>>()
        });
        tasks.concat()
    }
}

/// The inverse of a matrix, in rows, by Gauss–Jordan elimination with pivots from the column.
fn inverted(mut rows: Vec<f64>, size: usize) -> Vec<f64> {
    let mut inverse = vec![0.0; size * size];
    (0..size).for_each(|i| inverse[i * size + i] = 1.0);
    for k in 0..size {
        let pivot = (k..size)
            .fold(k, |best, i| if rows[i * size + k].abs() > rows[best * size + k].abs() { i } else { best });
        let scale = rows[pivot * size + k];
        for matrix in [&mut rows, &mut inverse] {
            for j in 0..size {
                matrix.swap(k * size + j, pivot * size + j);
                matrix[k * size + j] /= scale;
            }
        }
        let factors: Vec<f64> = (0..size).map(|i| if i == k { 0.0 } else { rows[i * size + k] }).collect();
        for matrix in [&mut rows, &mut inverse] {
            let own = matrix[k * size..(k + 1) * size].to_vec();
            for (row, factor) in matrix.chunks_mut(size).zip(&factors).filter(|(_, factor)| **factor != 0.0) {
                row.iter_mut().zip(&own).for_each(|(r, o)| *r -= factor * o);
            }
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverses_are_inverses() {
        let size = 13;
        let rows: Vec<f64> = (0..size * size).map(|n| (1.7 * (n * n) as f64).sin()).collect();
        let inverse = inverted(rows.clone(), size);
        for i in 0..size {
            for j in 0..size {
                let product: f64 = (0..size).map(|k| rows[i * size + k] * inverse[k * size + j]).sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-10, "{i} {j}: {product}");
            }
        }
    }
}
