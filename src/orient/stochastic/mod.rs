//! Stochastic globally consistent normal orientation, the sGCNO of *Leaps and Bounds* (appendix F).
mod losses;
mod parameters;
mod samples;

use crate::data::{Monitor, PointCloud};
use crate::estimate::{AreaMethod, EstimateConfig, EstimateError, areas, spacings};
use crate::math::{Aabb, Vec3};
use crate::treecode::{Clustered, Mutual};
use losses::slopes;
use parameters::{Parameters, Triple};
use samples::{Deck, Random, Samples};
use std::f64::consts::PI;
use std::sync::Arc;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    pub zero_or_one: f64,
    pub mean: f64,
    pub variance: f64,
    pub alignment: f64,
    pub surface: f64,
    pub area: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StochasticConfig {
    pub iterations: usize,
    pub batch: usize,
    pub coarse: usize,
    pub fine: usize,
    pub rate: f64,
    pub last_rate: f64,
    pub weights: Weights,
    pub seed: u64,
}

impl Default for StochasticConfig {
    fn default() -> Self {
        let weights =
            Weights { zero_or_one: 1.0, mean: 1.0, variance: 1.0, alignment: 1.0, surface: 1.0, area: 1.0 };
        StochasticConfig {
            iterations: 600,
            batch: 500,
            coarse: 2,
            fine: 8,
            rate: 0.1,
            last_rate: 0.01,
            weights,
            seed: 1,
        }
    }
}

const OPENING: f64 = 2.0;
const WIDTH: f64 = 1e-6;

pub fn stochastic_area_vectors(
    points: &[Vec3],
    config: &StochasticConfig,
    monitor: &dyn Monitor,
) -> Result<Vec<Vec3>, EstimateError> {
    let bounds = Aabb::around(points.iter().copied());
    let extent = bounds.size().max_element();
    let scale = if extent > 0.0 { 2.0 / extent } else { 1.0 };
    let scaled: Vec<Vec3> = points.iter().map(|p| (*p - bounds.center()) * scale).collect();
    let quiet = |_: f64, stage: &str| monitor.report(0.0, stage).is_ok();
    let widths = spacings(&scaled, 4, &quiet)?;
    let (cloud, _) = PointCloud::cleaned(scaled.clone(), None, None)?;
    let estimates = areas(&cloud, AreaMethod::NearestNeighbour, &EstimateConfig { neighbours: 4 }, &quiet)?;
    let mut random = Random(config.seed);
    let mut parameters = Parameters::random(estimates, &mut random);
    let mut deck = Deck::new(points.len());
    let clustered = Arc::new(Clustered::new(&scaled));
    for iteration in 0..config.iterations {
        let t = iteration as f64 / config.iterations as f64;
        monitor.report(t, "normals")?;
        let numbers = deck.deal(config.batch, &mut random);
        let samples = Samples::around(numbers, &scaled, &widths, config, &mut random);
        let (loss, slopes) = step(&parameters, &clustered, &samples, config);
        if iteration % 50 == 0 && std::env::var("TRACE").is_ok() {
            eprintln!("{iteration} {loss:?} {}", parameters.excess());
        }
        let rate = config.rate * (config.last_rate / config.rate).powf(t);
        parameters.descend(&slopes, rate);
    }
    monitor.report(1.0, "normals")?;
    Ok(parameters.area_vectors().iter().map(|v| *v / (scale * scale)).collect())
}

fn step(
    parameters: &Parameters,
    points: &Arc<Clustered>,
    samples: &Samples,
    config: &StochasticConfig,
) -> (f64, Vec<Triple>) {
    let vectors = parameters.area_vectors();
    let places = Arc::new(Clustered::new(&samples.places));
    let down = Mutual::between(points, &places, OPENING);
    let winding: Vec<f64> = down.bounded_potentials(&vectors, WIDTH).iter().map(|w| w / (4.0 * PI)).collect();
    let gradients = down.gradients(&vectors, WIDTH, true);
    let normals: Vec<Vec3> = samples.points.iter().map(|i| parameters.normal(*i as usize)).collect();
    let slopes = slopes(samples, &winding, &gradients[..samples.all_fine()], &normals, &config.weights);
    let up = Mutual::between(&places, points, OPENING);
    let fields = up.bounded_fields(&vectors, &slopes.winding, WIDTH);
    let excess = parameters.excess();
    let mut pulls: Vec<Triple> = (0..vectors.len())
        .map(|i| {
            // Fields are of sources q at targets p: Σ c (p − q)/|p − q|³
            let along = fields[i] / (4.0 * PI);
            let normal = parameters.normal(i);
            let along_area = along.dot(normal) + config.weights.area * excess.signum();
            parameters.pulled(i, parameters.area(i) * along, along_area)
        })
        .collect();
    for (i, along) in samples.points.iter().zip(&slopes.normals) {
        let add = parameters.pulled(*i as usize, *along, 0.0);
        (0..3).for_each(|k| pulls[*i as usize][k] += add[k]);
    }
    (slopes.loss + config.weights.area * excess.abs(), pulls)
}
