//! Normals in spherical coordinates and areas, as what Adam (Kingma and Ba 2015) moves.
use super::samples::Random;
use crate::math::Vec3;
use std::f64::consts::TAU;

/// How many times its estimate an area may be (appendix F.2).
const RANGE: (f64, f64) = (0.25, 1000.0);
/// Adam's memory of slopes and of their squares.
const MEMORY: (f64, f64) = (0.9, 0.99);

/// Polar angle, azimuth, and logarithm of the area over its estimate.
pub type Triple = [f64; 3];

pub struct Parameters {
    pub values: Vec<Triple>,
    estimates: Vec<f64>,
    slopes: Vec<Triple>,
    squares: Vec<Triple>,
    steps: i32,
}

fn normal_of([polar, azimuth, _]: Triple) -> Vec3 {
    let (sin, cos) = (libm::sin(polar), libm::cos(polar));
    Vec3::new(sin * libm::cos(azimuth), sin * libm::sin(azimuth), cos)
}

impl Parameters {
    /// Evenly distributed normals, and the areas `estimates`.
    pub fn random(estimates: Vec<f64>, random: &mut Random) -> Parameters {
        let mut triple = || [libm::acos(2.0 * random.unit() - 1.0), TAU * random.unit(), 0.0];
        let values: Vec<Triple> = estimates.iter().map(|_| triple()).collect();
        let zeros = vec![[0.0; 3]; estimates.len()];
        Parameters { values, estimates, slopes: zeros.clone(), squares: zeros, steps: 0 }
    }

    pub fn normal(&self, point: usize) -> Vec3 {
        normal_of(self.values[point])
    }

    pub fn area(&self, point: usize) -> f64 {
        self.estimates[point] * libm::exp(self.values[point][2])
    }

    pub fn area_vectors(&self) -> Vec<Vec3> {
        (0..self.values.len()).map(|i| self.area(i) * self.normal(i)).collect()
    }

    /// By how much all areas together exceed the sum of their estimates.
    pub fn excess(&self) -> f64 {
        (0..self.values.len()).map(|i| self.area(i) - self.estimates[i]).sum()
    }

    /// The slope of a loss along a point's parameters, from those along its normal and its area.
    pub fn pulled(&self, point: usize, along_normal: Vec3, along_area: f64) -> Triple {
        let [polar, azimuth, _] = self.values[point];
        let (sin, cos) = (libm::sin(polar), libm::cos(polar));
        let (sine, cosine) = (libm::sin(azimuth), libm::cos(azimuth));
        let southward = Vec3::new(cos * cosine, cos * sine, -sin);
        let eastward = Vec3::new(-sin * sine, sin * cosine, 0.0);
        [southward.dot(along_normal), eastward.dot(along_normal), self.area(point) * along_area]
    }

    /// A step of Adam downhill, of length about `rate`.
    pub fn descend(&mut self, slopes: &[Triple], rate: f64) {
        self.steps += 1;
        let (first, second) = (1.0 - MEMORY.0.powi(self.steps), 1.0 - MEMORY.1.powi(self.steps));
        let memories = self.slopes.iter_mut().zip(&mut self.squares);
        for ((value, slope), (mean, square)) in self.values.iter_mut().zip(slopes).zip(memories) {
            for k in 0..3 {
                mean[k] += (1.0 - MEMORY.0) * (slope[k] - mean[k]);
                square[k] += (1.0 - MEMORY.1) * (slope[k] * slope[k] - square[k]);
                let size = (square[k] / second).sqrt();
                if size > 0.0 {
                    value[k] -= rate * (mean[k] / first) / size;
                }
            }
            value[2] = value[2].clamp(libm::log(RANGE.0), libm::log(RANGE.1));
        }
    }
}
