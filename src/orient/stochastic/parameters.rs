//! Normals in spherical coordinates and areas: what Adam (Kingma and Ba 2015) moves.
use crate::math::{Random, Vec3};
use std::f64::consts::TAU;

/// Least and most of an area, in its estimate (*Leaps and Bounds*, appendix F.2).
const RANGE: (f64, f64) = (0.25, 1000.0);
/// How much of the mean slope, and of its mean square, is kept from step to step.
const MEMORY: (f64, f64) = (0.9, 0.99);

/// Polar angle, azimuth, and the logarithm of the area over its estimate; or slopes along these.
pub type Triple = [f64; 3];

pub struct Parameters {
    pub values: Vec<Triple>,
    estimates: Vec<f64>,
    means: Vec<Triple>,
    squares: Vec<Triple>,
    steps: usize,
}

impl Parameters {
    /// Normals at random, each direction as likely as any other, and the areas `estimates`.
    pub fn random(estimates: Vec<f64>, random: &mut Random) -> Parameters {
        let mut triple = || [libm::acos(2.0 * random.above_zero() - 1.0), TAU * random.above_zero(), 0.0];
        let values: Vec<Triple> = estimates.iter().map(|_| triple()).collect();
        let zeros = vec![[0.0; 3]; estimates.len()];
        Parameters { values, estimates, means: zeros.clone(), squares: zeros, steps: 0 }
    }

    pub fn normal(&self, point: usize) -> Vec3 {
        let [polar, azimuth, _] = self.values[point];
        let sin = libm::sin(polar);
        Vec3::new(sin * libm::cos(azimuth), sin * libm::sin(azimuth), libm::cos(polar))
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

    /// Slopes along a point's parameters, from those along its normal and its area.
    pub fn slopes(&self, point: usize, along_normal: Vec3, along_area: f64) -> Triple {
        let [polar, azimuth, _] = self.values[point];
        let (sin, cos) = (libm::sin(polar), libm::cos(polar));
        let (sine, cosine) = (libm::sin(azimuth), libm::cos(azimuth));
        let southward = Vec3::new(cos * cosine, cos * sine, -sin);
        let eastward = Vec3::new(-sin * sine, sin * cosine, 0.0);
        [southward.dot(along_normal), eastward.dot(along_normal), self.area(point) * along_area]
    }

    /// A step downhill, of about `rate` along each parameter.
    pub fn descend(&mut self, slopes: &[Triple], rate: f64) {
        self.steps += 1;
        // As the memory is empty at first.
        let full = |memory: f64| 1.0 - libm::pow(memory, self.steps as f64);
        let (full_mean, full_square) = (full(MEMORY.0), full(MEMORY.1));
        let (least, most) = (libm::log(RANGE.0), libm::log(RANGE.1));
        let memories = self.means.iter_mut().zip(&mut self.squares);
        for ((value, slope), (mean, square)) in self.values.iter_mut().zip(slopes).zip(memories) {
            for k in 0..3 {
                mean[k] += (1.0 - MEMORY.0) * (slope[k] - mean[k]);
                square[k] += (1.0 - MEMORY.1) * (slope[k] * slope[k] - square[k]);
                let size = (square[k] / full_square).sqrt();
                if size > 0.0 {
                    value[k] -= rate * (mean[k] / full_mean) / size;
                }
            }
            value[2] = value[2].clamp(least, most);
        }
    }
}
