//! The loss and its slopes beside the definitions, in 64 bits.
use super::parameters::{Parameters, Triple};
use super::problem::Problem;
use super::samples::{Deck, Samples};
use super::{LossWeights, StochasticConfig};
use crate::data::Silent;
use crate::math::{Random, Vec3};
use std::f64::consts::PI;

/// A ball's points, from which normals point anywhere.
fn setting(opening: f64) -> (Problem, Vec<f64>, Parameters, Samples, StochasticConfig) {
    let mut random = Random::new(4);
    let point = |i: usize| {
        let z = 1.0 - 2.0 * (i as f64 + 0.5) / 60.0;
        let (r, a) = ((1.0 - z * z).sqrt(), 2.4 * i as f64);
        Vec3::new(r * a.cos(), 0.7 * r * a.sin(), z)
    };
    let (mut problem, areas) = Problem::new((0..60).map(point).collect(), &Silent).unwrap();
    problem.opening = opening;
    let mut parameters = Parameters::random(areas.clone(), &mut random);
    // So that the bound matters, and areas are not what they were.
    parameters.values.iter_mut().for_each(|[_, _, area]| *area = 0.3 + random.above_zero());
    let weights =
        LossWeights { zero_or_one: 0.7, mean: 1.3, variance: 0.9, alignment: 0.4, surface: 1.1, area: 0.2 };
    let config = StochasticConfig { fine: 5, coarse: 3, weights, ..Default::default() };
    let numbers = Deck::new(60).deal(20, &mut random).to_vec();
    let samples = Samples::around(&numbers, &problem, &config, &mut random);
    (problem, areas, parameters, samples, config)
}

fn normal([polar, azimuth, _]: Triple) -> Vec3 {
    Vec3::new(polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos())
}

/// The bounded winding number (eqs. 12 and 41).
fn winding(problem: &Problem, areas: &[f64], values: &[Triple], q: Vec3) -> f64 {
    let of_point = |i: usize| {
        let offset = problem.points[i] - q;
        let distance = offset.length();
        let vector = areas[i] * values[i][2].exp() * normal(values[i]);
        let plain = offset.dot(vector) / (4.0 * PI * distance.powi(3));
        let bounded = 0.5 * (1.0 - 1.0 / (4.0 * plain.abs() + 1.0).sqrt());
        if distance > 0.0 { bounded.copysign(plain) } else { 0.0 }
    };
    (0..values.len()).map(of_point).sum()
}

fn well(x: f64, a: f64, c: f64) -> f64 {
    a / 4.0 * x.powi(4) - (a / 3.0 + a * c / 3.0) * x.powi(3) + 0.5 * a * c * x * x
}

/// Mean directions outward at the fine samples of each point, of slopes by differences (eq. 69).
fn outward(problem: &Problem, areas: &[f64], values: &[Triple], samples: &Samples) -> Vec<Vec3> {
    let slope = |q: Vec3| {
        let at = |q: Vec3| winding(problem, areas, values, q);
        let along = |axis: Vec3| (at(q + 1e-6 * axis) - at(q - 1e-6 * axis)) / 2e-6;
        Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z)).normalize()
    };
    let fine = samples.places[..samples.all_fine()].chunks(samples.fine);
    fine.map(|own| -own.iter().map(|q| slope(*q)).sum::<Vec3>() / samples.fine as f64).collect()
}

/// The loss by eqs. 62 to 70, the directions `outward` given.
fn loss(
    problem: &Problem,
    areas: &[f64],
    values: &[Triple],
    (samples, outward): (&Samples, &[Vec3]),
    weights: &LossWeights,
) -> f64 {
    let count = samples.numbers.len() as f64;
    let w: Vec<f64> = samples.places.iter().map(|q| winding(problem, areas, values, *q)).collect();
    let (fine, rest) = w.split_at(samples.all_fine());
    let (coarse, at_points) = rest.split_at(samples.all_coarse());
    let wells = coarse.iter().map(|w| well(*w, 8.0, 0.41)).sum::<f64>()
        + fine.iter().map(|w| well(*w, 8.0, 0.5)).sum::<f64>();
    let (mut means, mut variances) = (0.0, 0.0);
    for own in fine.chunks(samples.fine) {
        let m = own.len() as f64;
        let mean = own.iter().sum::<f64>() / m;
        means += (mean - 0.5).powi(2);
        let variance = own.iter().map(|w| (w - mean).powi(2)).sum::<f64>() / (m - 1.0);
        variances += (variance - m / (4.0 * (m - 1.0))).abs();
    }
    let own = |i: &u32| normal(values[*i as usize]);
    let alignment: f64 = samples.numbers.iter().zip(outward).map(|(i, o)| 1.0 - o.dot(own(i))).sum();
    let surface: f64 = at_points.iter().map(|w| (w - 0.5).abs()).sum();
    let excess: f64 = areas.iter().zip(values).map(|(a, v)| a * v[2].exp() - a).sum();
    (0.5 * weights.zero_or_one * wells
        + weights.mean * means
        + weights.variance * variances
        + weights.alignment * alignment
        + weights.surface * surface)
        / count
        + weights.area * excess.abs()
}

#[test]
fn slopes_are_those_of_the_loss() {
    // All points singly, in 32 bits; then clusters as a whole.
    for (opening, most) in [(1e9, 2e-4), (2.0, 5e-2)] {
        let (problem, areas, parameters, samples, config) = setting(opening);
        let outward = outward(&problem, &areas, &parameters.values, &samples);
        let at = |values: &[Triple]| loss(&problem, &areas, values, (&samples, &outward), &config.weights);
        let (found, slopes) = problem.slopes(&parameters, &samples, &config.weights);
        let expected = at(&parameters.values);
        assert!((found - expected).abs() < most * expected, "{found} instead of {expected}");
        let (mut error, mut size) = (0.0, [0.0; 3]);
        for i in 0..slopes.len() {
            for k in 0..3 {
                let mut values = parameters.values.clone();
                let mut moved = |by: f64| {
                    values[i][k] = parameters.values[i][k] + by;
                    at(&values)
                };
                let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                error += (slope - slopes[i][k]).powi(2);
                size[k] += slope * slope;
            }
        }
        println!("opening {opening}: {error}, {size:?}");
        assert!(size.iter().all(|s| *s > 1e-8), "{size:?}");
        assert!(error < most * most * size.iter().sum::<f64>(), "{error} of {size:?}");
    }
}

#[test]
fn areas_stay_within_their_range() {
    let (_, areas, mut parameters, ..) = setting(2.0);
    for (slope, factor) in [(1.0, 0.25), (-1.0, 1000.0)] {
        (0..200).for_each(|_| parameters.descend(&[[0.0, 0.0, slope]; 60], 0.1));
        let found = parameters.area(7) / areas[7];
        assert!((found / factor - 1.0).abs() < 1e-12, "{found}");
    }
}
