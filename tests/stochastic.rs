//! Normals by stochastic globally consistent normal orientation.
mod common;

use common::*;
use fast_winding::data::{Cancelled, PointCloud, Silent, TriangleSoup, WarningKind};
use fast_winding::estimate::EstimateError;
use fast_winding::math::Vec3;
use fast_winding::metrics::{angle_rmse, good_points, sample_surface};
use fast_winding::orient::{
    Bounded, ConsistencyConfig, OrientMethod, StochasticConfig, Widths, consistent_area_vectors, orient,
    stochastic_area_vectors,
};

/// Half the steps.
fn short() -> StochasticConfig {
    StochasticConfig { iterations: 300, ..Default::default() }
}

fn found(points: &[Vec3], config: &StochasticConfig) -> Vec<Vec3> {
    stochastic_area_vectors(points, config, &Silent).unwrap()
}

fn cloud(points: &[Vec3]) -> PointCloud {
    PointCloud::cleaned(points.to_vec(), None, None).unwrap().0
}

#[test]
fn clean_samples_are_turned_outward() {
    let inner = sphere(20);
    let inner = flipped(
        &TriangleSoup::new(inner.positions().iter().map(|p| 0.5 * *p).collect(), inner.triangles().to_vec())
            .unwrap(),
    );
    for (name, soup, worst) in [
        ("ball", sphere(20), 10.0),
        ("torus", torus(1.0, 0.3, 90, 30), 10.0),
        ("hollow ball", joined(&[sphere(20), inner]), 10.0),
        ("bunny", bunny(), 16.0),
    ] {
        let samples = sample_surface(&soup, 2000, 3).unwrap();
        let vectors = found(&samples.points, &short());
        let good = good_points(&vectors, &samples.normals).unwrap();
        let angle = angle_rmse(&vectors, &samples.normals).unwrap();
        println!("{name}: {good}, {angle}");
        assert!(good >= 0.99 && angle < worst, "{name}: {good} good, {angle}°");
    }
}

#[test]
fn noisy_samples_are_better_than_by_narrow_consistency() {
    let mut samples = sample_surface(&bunny(), 2000, 5).unwrap();
    let (size, mut random) = (bunny().bounds().size().max_element(), random(17));
    let mut normal = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
    samples.points.iter_mut().for_each(|p| *p += 0.005 * size * Vec3::new(normal(), normal(), normal()));
    let narrow =
        ConsistencyConfig { bounded: Bounded::Gradients, widths: Some(Widths::ALL[0]), ..Default::default() };
    let consistent = consistent_area_vectors(&samples.points, &narrow, &Silent).unwrap();
    let angles =
        [found(&samples.points, &short()), consistent].map(|v| angle_rmse(&v, &samples.normals).unwrap());
    assert!(angles[0] < angles[1] - 5.0, "{angles:?}");
}

#[test]
fn oriented_clouds_have_areas_and_a_warning() {
    let samples = sample_surface(&torus(3.0, 1.0, 60, 30), 1500, 3).unwrap();
    let area = 4.0 * std::f64::consts::PI.powi(2) * 3.0;
    let method = OrientMethod::Stochastic(short());
    let (oriented, warnings) = orient(&cloud(&samples.points), &method, &Silent).unwrap();
    let total: f64 = oriented.areas().iter().sum();
    assert!((total / area - 1.0).abs() < 0.05, "{total} instead of {area}");
    assert!(good_points(oriented.normals(), &samples.normals).unwrap() > 0.99);
    assert_eq!(
        warnings.iter().map(|w| (w.kind, w.count)).collect::<Vec<_>>(),
        [(WarningKind::EstimatedNormals, 1500)]
    );
    // Its own areas, lengths of the vectors, are in the square of the cloud's unit.
    let total: f64 = found(&samples.points, &short()).iter().map(|v| v.length()).sum();
    assert!((total / area - 1.0).abs() < 0.2, "{total} instead of {area}");
}

#[test]
fn the_seed_decides_and_not_the_number_of_threads() {
    let samples = sample_surface(&torus(1.0, 0.4, 40, 20), 2500, 3).unwrap();
    let run = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let config = StochasticConfig { iterations: 30, seed, ..Default::default() };
        pool.install(|| found(&samples.points, &config))
    };
    let one = run(1, 1);
    assert!(one == run(2, 1) && one == run(8, 1));
    assert!(one != run(2, 2));
}

#[test]
fn a_monitor_hears_of_it_and_can_stop_it() {
    let samples = sample_surface(&sphere(12), 500, 3).unwrap();
    let heard = std::cell::RefCell::new(Vec::new());
    let monitor = |fraction: f64, stage: &str| {
        heard.borrow_mut().push(fraction);
        stage != "normals" || fraction < 0.3
    };
    let method = OrientMethod::Stochastic(short());
    let stopped = orient(&cloud(&samples.points), &method, &monitor);
    assert_eq!(stopped.unwrap_err(), EstimateError::Cancelled(Cancelled));
    let heard = heard.into_inner();
    assert!(heard.len() > 50 && heard.is_sorted(), "{heard:?}");
}

#[test]
fn poor_clouds_are_errors_or_warnings() {
    let method = OrientMethod::Stochastic(StochasticConfig { iterations: 30, ..Default::default() });
    let oriented = |points: &[Vec3]| orient(&cloud(points), &method, &Silent);
    assert_eq!(oriented(&[]).unwrap_err(), EstimateError::Empty);
    let flat: Vec<Vec3> = (0..100).map(|i| Vec3::new(f64::from(i % 10), f64::from(i / 10), 0.0)).collect();
    for points in [&flat[..1], &flat[..3], &flat[..], &[Vec3::ONE; 9]] {
        let (oriented, warnings) = oriented(points).unwrap();
        assert_eq!(oriented.len(), points.len());
        let is_told = warnings.iter().any(|w| w.kind == WarningKind::FlatCloud);
        assert!(is_told, "{} points: {warnings:?}", points.len());
    }
    // Asked for directly, all in one place is an error, and flat ones get vectors of some kind.
    let direct = |points: &[Vec3]| {
        stochastic_area_vectors(points, &StochasticConfig { iterations: 30, ..Default::default() }, &Silent)
    };
    assert_eq!(direct(&[]), Err(EstimateError::Empty));
    assert_eq!(direct(&[Vec3::ONE; 9]), Err(EstimateError::OnePlace { points: 9 }));
    for points in [&flat[..2], &flat[..]] {
        let vectors = direct(points).unwrap();
        assert!(vectors.iter().all(|v| v.is_finite() && v.length() > 0.0), "{vectors:?}");
    }
    // Points far from all others.
    let mut odd = sample_surface(&sphere(12), 500, 3).unwrap().points;
    odd.extend([Vec3::splat(50.0), Vec3::splat(50.0) + Vec3::X, Vec3::splat(-1e6)]);
    assert_eq!(oriented(&odd).unwrap().0.len(), 503);
}

#[test]
fn every_point_twice_is_as_good_as_once() {
    let samples = sample_surface(&sphere(12), 800, 3).unwrap();
    let twice: Vec<Vec3> = samples.points.iter().flat_map(|p| [*p, *p]).collect();
    let truth: Vec<Vec3> = samples.normals.iter().flat_map(|n| [*n, *n]).collect();
    let vectors = found(&twice, &short());
    assert!(good_points(&vectors, &truth).unwrap() > 0.99);
    // The areas of copies add up to those of places.
    let [once, twice] =
        [found(&samples.points, &short()), vectors].map(|v| v.iter().map(|v| v.length()).sum::<f64>());
    assert!((twice / once - 1.0).abs() < 0.1, "{twice} and {once}");
}

/// A step has no natural length where the cloud has none: place and scale are taken out first.
#[test]
fn place_and_scale_do_not_matter() {
    let samples = sample_surface(&torus(1.0, 0.4, 40, 20), 500, 3).unwrap();
    let config = StochasticConfig { iterations: 10, ..Default::default() };
    let moved: Vec<Vec3> =
        samples.points.iter().map(|p| 1024.0 * *p + Vec3::new(8192.0, -4096.0, 0.0)).collect();
    for (a, b) in found(&samples.points, &config).iter().zip(found(&moved, &config)) {
        assert!((*a - b / 1048576.0).length() < 1e-3 * a.length(), "{a} and {b}");
    }
}
