//! Where the fraction of a capped soup can be left out of a classification.
//!
//! The winding number of the caps is smooth away from them: an element of area dA at distance r changes it by at most
//! 2 dA / 4πr³ per length. Over a box whose interval of fractions holds no tie, w ≥ threshold is a question to the integer
//! part alone. That is a proof, not an estimate; what stays in doubt is summed exactly.
use crate::math::{Vec3, area_vector, barycentre, distance_to_triangle, normal_signs};
use std::f64::consts::PI;

/// Rounding of an exactly summed fraction, with a margin.
const ROUNDING: f64 = 1e-11;

/// Caps with balls around them.
#[derive(Clone, Debug, Default)]
pub struct CapBalls {
    balls: Vec<Ball>,
}

#[derive(Clone, Debug)]
struct Ball {
    center: Vec3,
    radius: f64,
    area: f64,
    cap: [Vec3; 3],
}

/// Caps nearer than this many of their radii are measured themselves: the balls of long ones reach far beyond them.
const NEAR: f64 = 3.0;

impl CapBalls {
    pub fn new(caps: &[[Vec3; 3]]) -> CapBalls {
        let ball = |cap: &[Vec3; 3]| {
            let center = barycentre(*cap);
            let radius = cap.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
            Ball { center, radius, area: area_vector(*cap).length(), cap: *cap }
        };
        // Those without area, as T-junctions have, contribute nothing anywhere.
        let has_area = |cap: &&[Vec3; 3]| normal_signs(**cap) != [0; 3];
        CapBalls { balls: caps.iter().filter(has_area).map(ball).collect() }
    }

    /// How much the winding number of the caps differs, at most, between `center` and a point within `radius` of it;
    /// infinite if a cap may reach that far.
    pub fn variation(&self, center: Vec3, radius: f64) -> f64 {
        let mut sum = 0.0;
        for ball in &self.balls {
            let to_center = ball.center.distance(center);
            let mut distance = to_center - ball.radius - radius;
            if to_center < NEAR * ball.radius + radius {
                distance = distance_to_triangle(center, ball.cap) * (1.0 - 1e-9) - radius;
            }
            if distance <= 1e-9 * radius {
                return f64::INFINITY;
            }
            sum += ball.area / (distance * distance * distance);
        }
        sum * radius / (2.0 * PI)
    }

    /// The least integer part for which w reaches `threshold` everywhere within `radius` of `center`, where the fraction is
    /// `fraction`; none if it is not the same everywhere.
    pub fn least_crossings(&self, center: Vec3, radius: f64, fraction: f64, threshold: f64) -> Option<i32> {
        let slack = self.variation(center, radius) + ROUNDING;
        let least = |fraction: f64| (threshold - fraction).ceil();
        let (low, high) = (least(fraction + slack), least(fraction - slack));
        (low == high && low.abs() < 1e9).then_some(low as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::solid_angle;

    #[test]
    fn the_bound_holds_around_a_triangle() {
        let cap = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let balls = CapBalls::new(&[cap]);
        let w = |q: Vec3| solid_angle(q, cap) / (4.0 * PI);
        for k in 0..2000 {
            let t = f64::from(k);
            let center = 3.0 * Vec3::new((1.3 * t).sin(), (2.1 * t).cos(), (0.7 * t).sin());
            let radius = 0.5 * (1.1 * t).sin().abs();
            let bound = balls.variation(center, radius);
            let toward = -center.normalize_or_zero() * radius;
            let aside = Vec3::new((3.0 * t).sin(), (5.0 * t).cos(), (4.0 * t).sin()).normalize() * radius;
            for offset in [toward, aside, -aside] {
                assert!((w(center + offset) - w(center)).abs() <= bound + 1e-15);
            }
        }
        assert!(balls.variation(Vec3::ZERO, 0.1).is_infinite());
    }
}
