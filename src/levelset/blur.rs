//! Gaussian smoothing of a function that is known on nodes.

/// Nodes to either side that take part: as many as a brick has along an edge.
const REACH: usize = 4;
const TAPS: usize = 2 * REACH + 1;
/// Nodes along an edge of a brick, and of a brick with those that take part.
const SIDE: usize = 4;
const WIDE: usize = SIDE + 2 * REACH;

/// Weights along an axis: those of a normal distribution times a parabola that takes away their second moment. Where a surface is
/// curved, smoothing with the distribution alone would move it towards its centre of curvature, by half the variance times the sum
/// of the principal curvatures; this leaves it in place but for fourth powers of the width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blur([f32; TAPS]);

impl Blur {
    /// The largest standard deviation, in cells, that the weights have room for.
    pub const WIDEST: f64 = 1.5;

    /// Of a normal distribution with this standard deviation in cells, above 0.
    pub fn new(deviation: f64) -> Blur {
        let place = |tap: usize| tap as f64 - REACH as f64;
        let weight = |tap: usize| libm::exp(-0.5 * (place(tap) / deviation) * (place(tap) / deviation));
        let moment = |power: i32| (0..TAPS).map(|tap| weight(tap) * place(tap).powi(power)).sum::<f64>();
        let [zeroth, second, fourth] = [moment(0), moment(2), moment(4)];
        // So narrow that only the middle counts, there is nothing to take away.
        let per_square = if fourth > 0.0 { second / fourth } else { 0.0 };
        let total = zeroth - per_square * second;
        let tap = |tap: usize| weight(tap) * (1.0 - per_square * place(tap) * place(tap)) / total;
        Blur(std::array::from_fn(|k| tap(k) as f32))
    }

    /// The smoothed values of a brick, from those of the 27 bricks around and including it, x fastest. NaN where one of them that
    /// takes part is.
    pub(super) fn of(&self, around: &[&[f32]; 27]) -> [f32; SIDE * SIDE * SIDE] {
        // Each pass smooths along the fastest axis and makes it the slowest: after three, all are done and in their order again.
        let mut values: Vec<f32> = (0..WIDE * WIDE * WIDE)
            .map(|node| {
                let at = [node % WIDE, node / WIDE % WIDE, node / (WIDE * WIDE)];
                let [x, y, z] = at.map(|c| c % SIDE);
                let brick = at.map(|c| c / SIDE);
                around[brick[0] + 3 * brick[1] + 9 * brick[2]][x + SIDE * y + SIDE * SIDE * z]
            })
            .collect();
        for _ in 0..3 {
            let rows = values.len() / WIDE;
            let mut smooth = vec![0.0; SIDE * rows];
            for (row, line) in values.chunks_exact(WIDE).enumerate() {
                for place in 0..SIDE {
                    let taps = line[place..place + TAPS].iter().zip(&self.0);
                    smooth[place * rows + row] = taps.map(|(value, weight)| value * weight).sum();
                }
            }
            values = smooth;
        }
        std::array::from_fn(|node| values[node])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn smoothed(deviation: f64, function: impl Fn([f32; 3]) -> f32) -> [f32; 64] {
        let bricks: Vec<Vec<f32>> = (0..27usize)
            .map(|brick| {
                let at = |node: usize, power: u32| {
                    let [brick, node] = [brick / 3usize.pow(power) % 3, node / 4usize.pow(power) % 4];
                    (4 * brick + node) as f32 - 4.0
                };
                (0..64).map(|node| function([0, 1, 2].map(|axis| at(node, axis)))).collect()
            })
            .collect();
        Blur::new(deviation).of(&std::array::from_fn(|k| &bricks[k][..]))
    }

    #[test]
    fn quadratic_functions_are_kept() {
        for deviation in [1e-3, 0.3, 0.9, Blur::WIDEST] {
            let function =
                |[x, y, z]: [f32; 3]| 1.0 + x - 2.0 * y + 3.0 * z + x * x - 2.0 * y * z + 3.0 * z * z;
            for (node, value) in smoothed(deviation, function).into_iter().enumerate() {
                let at = [node % 4, node / 4 % 4, node / 16].map(|c| c as f32);
                assert!((value - function(at)).abs() < 1e-3, "{value} at {at:?}");
            }
        }
    }

    #[test]
    fn what_alternates_between_nodes_is_taken_away() {
        let alternating = |[x, y, z]: [f32; 3]| if (x + y + z) as i32 % 2 == 0 { 1.0 } else { -1.0 };
        assert!(smoothed(1.2, alternating).iter().all(|value| value.abs() < 1e-3));
        assert!(smoothed(0.1, alternating).iter().all(|value| value.abs() == 1.0));
    }

    #[test]
    fn a_value_that_is_missing_is_missing_around() {
        let values = smoothed(1.0, |[x, ..]| if x == 6.0 { f32::NAN } else { 1.0 });
        let missing = values.map(f32::is_nan);
        assert!((0..64).all(|node| missing[node] == (node % 4 >= 2)), "{values:?}");
    }
}
