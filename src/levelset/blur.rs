//! Gaussian smoothing of a function that is known on nodes.

/// Nodes to either side that take part: as many as a brick has along an edge.
const REACH: usize = 4;
const TAPS: usize = 2 * REACH + 1;
/// Nodes along an edge of a brick, and of a brick with those that take part.
const SIDE: usize = 4;
const WIDE: usize = SIDE + 2 * REACH;

/// Weights along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blur([f32; TAPS]);

impl Blur {
    /// The largest standard deviation, in cells: weights at the end are then a thirtieth of that in the middle.
    pub const WIDEST: f64 = 1.5;

    /// A normal distribution with this standard deviation in cells.
    pub fn new(deviation: f64) -> Blur {
        let weight = |tap: usize| libm::exp(-0.5 * ((tap as f64 - REACH as f64) / deviation).powi(2));
        let total: f64 = (0..TAPS).map(weight).sum();
        Blur(std::array::from_fn(|tap| (weight(tap) / total) as f32))
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
    fn linear_functions_are_kept_and_squares_grow_by_the_variance() {
        let linear = |[x, y, z]: [f32; 3]| 1.0 + x - 2.0 * y + 3.0 * z;
        let values = smoothed(0.9, linear);
        for (node, value) in values.into_iter().enumerate() {
            let at = [node % 4, node / 4 % 4, node / 16].map(|c| c as f32);
            assert!((value - linear(at)).abs() < 1e-4, "{value} at {at:?}");
        }
        let squares = smoothed(0.9, |[x, y, z]| x * x + 2.0 * y * y - z * z);
        assert!((squares[0] - 2.0 * 0.81).abs() < 1e-3, "{}", squares[0]);
    }

    #[test]
    fn a_value_that_is_missing_is_missing_around() {
        let values = smoothed(1.0, |[x, ..]| if x == 6.0 { f32::NAN } else { 1.0 });
        let missing = values.map(f32::is_nan);
        assert!((0..64).all(|node| missing[node] == (node % 4 >= 2)), "{values:?}");
    }
}
