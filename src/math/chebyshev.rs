//! Polynomial interpolation at Chebyshev points, in barycentric form, and how far it can be from an analytic function.
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, LN_2};

/// Interpolation nodes on one axis.
#[derive(Clone, Debug)]
pub struct Nodes {
    pub points: Vec<f64>,
    weights: Vec<f64>,
}

impl Nodes {
    /// The `count` Chebyshev points of the first kind of an interval.
    pub fn chebyshev(center: f64, half: f64, count: usize) -> Nodes {
        let (mut cosine, mut sine) = cosine_and_sine(FRAC_PI_2 / count as f64);
        let turn = (cosine * cosine - sine * sine, 2.0 * sine * cosine);
        let (mut points, mut weights, mut sign) = (Vec::new(), Vec::new(), 1.0);
        for _ in 0..count {
            points.push(center + half * cosine);
            weights.push(sign * sine);
            (cosine, sine) = (cosine * turn.0 - sine * turn.1, sine * turn.0 + cosine * turn.1);
            sign = -sign;
        }
        Nodes { points, weights }
    }

    /// Points of which values are asked for at these points alone.
    pub fn exact(points: &[f64]) -> Nodes {
        Nodes { points: points.to_vec(), weights: vec![1.0; points.len()] }
    }

    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// What to multiply the values at the nodes with for those at `targets`: a row for each target.
    pub fn matrix(&self, targets: &[f64]) -> Vec<f64> {
        let mut matrix = Vec::with_capacity(targets.len() * self.count());
        for t in targets {
            if let Some(same) = self.points.iter().position(|p| p == t) {
                matrix.extend((0..self.count()).map(|k| if k == same { 1.0 } else { 0.0 }));
                continue;
            }
            let first = matrix.len();
            matrix.extend(self.points.iter().zip(&self.weights).map(|(p, w)| w / (t - p)));
            let sum: f64 = matrix[first..].iter().sum();
            matrix[first..].iter_mut().for_each(|m| *m /= sum);
        }
        matrix
    }
}

/// Cosine and sine of an angle up to a right one, by their series: less to download than a library's.
fn cosine_and_sine(angle: f64) -> (f64, f64) {
    let square = angle * angle;
    let (mut cosine, mut sine) = (1.0, 1.0);
    for k in (1..=12).rev() {
        let double = 2.0 * f64::from(k);
        cosine = 1.0 - square * cosine / (double * (double - 1.0));
        sine = 1.0 - square * sine / (double * (double + 1.0));
    }
    (cosine, angle * sine)
}

/// Bound of the Lebesgue constant of `count` Chebyshev points: how much interpolation may enlarge values. 1 + 2/π ln(n + 1)
/// (Rivlin 1974), with the logarithm to the base 2 rounded up.
pub fn lebesgue(count: usize) -> f64 {
    FRAC_2_PI * LN_2 * f64::from(usize::BITS - count.leading_zeros()) + 1.0
}

/// The ellipse with foci ±1 up to which to continue a function whose nearest singularity lies on the one with semi-major
/// axis `singular`, to bound its interpolation at `count` points: its semi-major axis, and for a function below 1 there
/// the largest error, 4ρ¹⁻ⁿ / (ρ − 1) (Trefethen, *Approximation Theory and Approximation Practice*, theorem 8.2).
pub fn bernstein(singular: f64, count: usize) -> (f64, f64) {
    let rho_of_singular = singular + (singular * singular - 1.0).sqrt();
    let degree = count as f64 - 1.0;
    let rho = rho_of_singular * degree / (degree + 2.0);
    if rho <= 1.0 {
        return (1.0, f64::INFINITY);
    }
    (0.5 * (rho + 1.0 / rho), 4.0 * rho.powi(-(count as i32 - 1)) / (rho - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_reproduced_and_constants_bounded() {
        for count in [1, 2, 5, 16] {
            let nodes = Nodes::chebyshev(3.0, 2.0, count);
            let polynomial =
                |x: f64| (1..count as i32).map(|k| (x - 2.5).powi(k) / f64::from(k)).sum::<f64>();
            let targets: Vec<f64> = (0..41).map(|k| 1.0 + 0.1 * f64::from(k)).collect();
            let matrix = nodes.matrix(&targets);
            for (row, t) in matrix.chunks(count).zip(&targets) {
                let value: f64 = row.iter().zip(&nodes.points).map(|(m, p)| m * polynomial(*p)).sum();
                assert!((value - polynomial(*t)).abs() < 1e-11 * (1.0 + polynomial(*t).abs()));
                assert!(row.iter().map(|m| m.abs()).sum::<f64>() <= lebesgue(count));
            }
        }
        let exact = Nodes::exact(&[0.0, 1.0, 5.0]);
        assert_eq!(exact.matrix(&[5.0, 0.0]), [0.0, 0.0, 1.0, 1.0, 0.0, 0.0]);
    }

    #[test]
    fn nodes_are_where_the_cosine_puts_them() {
        for count in [1, 2, 3, 9, 16] {
            for (k, point) in Nodes::chebyshev(0.0, 1.0, count).points.iter().enumerate() {
                let angle = std::f64::consts::PI * (k as f64 + 0.5) / count as f64;
                assert!((point - angle.cos()).abs() < 1e-15 * (1.0 + count as f64));
            }
        }
    }

    #[test]
    fn the_error_bound_holds_for_a_pole() {
        // 1 / (z − a): at most 1 / (a − semi-major axis) on an ellipse that leaves it out.
        for count in [2, 4, 8, 16] {
            for pole in [1.1, 1.5, 3.0, 10.0] {
                let nodes = Nodes::chebyshev(0.0, 1.0, count);
                let (axis, error) = bernstein(pole, count);
                let bound = error / (pole - axis);
                let targets: Vec<f64> = (0..101).map(|k| -1.0 + 0.02 * f64::from(k)).collect();
                for (row, t) in nodes.matrix(&targets).chunks(count).zip(&targets) {
                    let value: f64 = row.iter().zip(&nodes.points).map(|(m, p)| m / (p - pole)).sum();
                    assert!((value - 1.0 / (t - pole)).abs() <= bound + 1e-14);
                }
            }
        }
    }
}
