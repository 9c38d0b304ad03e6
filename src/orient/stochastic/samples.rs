//! Places around some of the points, drawn anew for each step.
use super::StochasticConfig;
use super::problem::Problem;
use crate::math::{Random, Vec3};
use std::f64::consts::TAU;

/// The standard deviation of coarse samples along each axis, where the cloud fills [−1, 1]³.
const COARSE: f64 = 0.3;

/// Three normally distributed numbers (Box and Muller).
fn normal(random: &mut Random) -> Vec3 {
    let mut pair = || {
        let (radius, angle) = ((-2.0 * libm::log(random.above_zero())).sqrt(), TAU * random.above_zero());
        (radius * libm::cos(angle), radius * libm::sin(angle))
    };
    let ((x, y), (z, _)) = (pair(), pair());
    Vec3::new(x, y, z)
}

/// All points again and again in random order, some at a time.
pub struct Deck {
    order: Vec<u32>,
    dealt: usize,
}

impl Deck {
    pub fn new(count: usize) -> Deck {
        Deck { order: (0..count as u32).collect(), dealt: count }
    }

    /// The next `count` points, or all if there are fewer.
    pub fn deal(&mut self, count: usize, random: &mut Random) -> &[u32] {
        let count = count.min(self.order.len());
        if self.dealt + count > self.order.len() {
            for last in (1..self.order.len()).rev() {
                self.order.swap(last, random.below(last + 1));
            }
            self.dealt = 0;
        }
        self.dealt += count;
        &self.order[self.dealt - count..self.dealt]
    }
}

/// The samples of one step: fine ones of the first point, of the second …, then coarse ones likewise, then the points
/// themselves.
pub struct Samples {
    /// The points that samples are around.
    pub numbers: Vec<u32>,
    /// Fine samples of each.
    pub fine: usize,
    coarse: usize,
    pub places: Vec<Vec3>,
}

impl Samples {
    pub fn around(
        numbers: &[u32],
        problem: &Problem,
        config: &StochasticConfig,
        random: &mut Random,
    ) -> Samples {
        let (fine, coarse) = (config.fine.max(2), config.coarse.max(1));
        let point = |i: &u32| problem.points[*i as usize];
        let mut places = Vec::with_capacity(numbers.len() * (fine + coarse + 1));
        for i in numbers {
            let spacing = problem.spacings[*i as usize];
            places.extend((0..fine).map(|_| point(i) + spacing * normal(random)));
        }
        for i in numbers {
            places.extend((0..coarse).map(|_| point(i) + COARSE * normal(random)));
        }
        places.extend(numbers.iter().map(point));
        Samples { numbers: numbers.to_vec(), fine, coarse, places }
    }

    /// Number of fine samples.
    pub fn all_fine(&self) -> usize {
        self.numbers.len() * self.fine
    }

    /// Number of coarse samples.
    pub fn all_coarse(&self) -> usize {
        self.numbers.len() * self.coarse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_mean_0_and_variance_1() {
        let mut random = Random::new(3);
        let drawn: Vec<Vec3> = (0..20_000).map(|_| normal(&mut random)).collect();
        let mean = drawn.iter().sum::<Vec3>() / 20_000.0;
        let variance = drawn.iter().map(|v| *v * *v).sum::<Vec3>() / 20_000.0;
        // Four standard deviations of these: 1/√20,000 and √2 times that.
        assert!(mean.abs().max_element() < 0.028, "{mean}");
        assert!((variance - 1.0).abs().max_element() < 0.04, "{variance}");
    }

    #[test]
    fn every_point_has_its_turn() {
        let (mut deck, mut random) = (Deck::new(10), Random::new(1));
        for _ in 0..5 {
            let mut dealt = [deck.deal(5, &mut random).to_vec(), deck.deal(5, &mut random).to_vec()].concat();
            dealt.sort_unstable();
            assert_eq!(dealt, (0..10).collect::<Vec<u32>>());
        }
        assert_eq!(deck.deal(50, &mut random).len(), 10);
        assert!(Deck::new(0).deal(3, &mut random).is_empty());
    }
}
