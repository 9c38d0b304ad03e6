use super::LossWeights;
use super::losses::{Found, losses};
use super::parameters::{Parameters, Triple};
use super::samples::Samples;
use crate::data::Monitor;
use crate::estimate::{EstimateError, Spacings, spacings};
use crate::math::Vec3;
use crate::treecode::{Clustered, Mutual};
use std::f64::consts::PI;
use std::sync::Arc;

/// A cluster acts as a whole beyond so many of its radii.
const OPENING: f64 = 2.0;
/// What is nearer does not act, so that the winding number is defined at the points themselves.
const WIDTH: f64 = 1e-6;
/// So many nearest neighbours tell how far fine samples spread, and areas.
const NEIGHBOURS: usize = 4;

/// What stays the same from step to step.
pub struct Problem {
    pub points: Vec<Vec3>,
    /// Mean distances to the nearest neighbours.
    pub spacings: Vec<f64>,
    clustered: Arc<Clustered>,
    pub opening: f64,
}

impl Problem {
    /// For points in [−1, 1]³; with their areas.
    pub fn new(points: Vec<Vec3>, monitor: &dyn Monitor) -> Result<(Problem, Vec<f64>), EstimateError> {
        let at_start = |_: f64, stage: &str| monitor.report(0.0, stage).is_ok();
        let Spacings { means, areas } = spacings(&points, NEIGHBOURS, &at_start)?;
        if areas.iter().all(|a| *a == 0.0) {
            return Err(EstimateError::OnePlace { points: points.len() });
        }
        let clustered = Arc::new(Clustered::new(&points));
        Ok((Problem { points, spacings: means, clustered, opening: OPENING }, areas))
    }

    /// The loss at some samples, and its slopes along the parameters of all points.
    pub fn slopes(
        &self,
        parameters: &Parameters,
        samples: &Samples,
        weights: &LossWeights,
    ) -> (f64, Vec<Triple>) {
        let vectors = parameters.area_vectors();
        let places = Arc::new(Clustered::new(&samples.places));
        let down = Mutual::between(&self.clustered, &places, self.opening);
        // Potentials are 4πw.
        let potentials = down.bounded_potentials(&vectors, WIDTH);
        let found = Found {
            winding: potentials.iter().map(|p| p / (4.0 * PI)).collect(),
            gradients: down.gradients(&vectors, WIDTH, true),
            normals: samples.numbers.iter().map(|i| parameters.normal(*i as usize)).collect(),
        };
        let losses = losses(samples, &found, weights);
        let up = Mutual::between(&places, &self.clustered, self.opening);
        let mut along: Vec<Vec3> = up.bounded_fields(&vectors, &losses.along_winding, WIDTH);
        let excess = parameters.excess();
        let of_areas = weights.area * excess.signum();
        along.iter_mut().for_each(|a| *a /= 4.0 * PI);
        let mut slopes: Vec<Triple> = (0..along.len())
            .map(|i| {
                let along_area = along[i].dot(parameters.normal(i)) + of_areas;
                parameters.slopes(i, parameters.area(i) * along[i], along_area)
            })
            .collect();
        for (i, along_normal) in samples.numbers.iter().zip(&losses.along_normals) {
            let own = parameters.slopes(*i as usize, *along_normal, 0.0);
            slopes[*i as usize].iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
        (losses.sum + weights.area * excess.abs(), slopes)
    }
}
