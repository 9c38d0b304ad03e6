//! Normals of clouds that have none.
mod common;

use common::*;
use fast_winding::data::{Cancelled, PointCloud, Silent, TriangleSoup, WarningKind};
use fast_winding::estimate::EstimateError;
use fast_winding::math::Vec3;
use fast_winding::metrics::{SurfaceSamples, angle_rmse, good_points, sample_surface};
use fast_winding::orient::{
    Bounded, ConsistencyConfig, OrientMethod, Widths, consistent_area_vectors, orient,
};

fn samples(soup: &TriangleSoup, count: usize) -> SurfaceSamples {
    sample_surface(soup, count, 3).unwrap()
}

fn cloud(points: &[Vec3]) -> PointCloud {
    PointCloud::cleaned(points.to_vec(), None, None).unwrap().0
}

/// Share of good points, and root mean square angle.
fn quality(samples: &SurfaceSamples, config: ConsistencyConfig) -> (f64, f64) {
    let found = consistent_area_vectors(&samples.points, &config, &Silent).unwrap();
    (good_points(&found, &samples.normals).unwrap(), angle_rmse(&found, &samples.normals).unwrap())
}

#[test]
fn clean_samples_are_turned_outward() {
    let hollow = joined(&[sphere(20), flipped(&scaled(&sphere(20), 0.6))]);
    for (name, soup, worst) in [
        ("ball", sphere(20), 5.0),
        ("torus", torus(1.0, 0.3, 90, 30), 6.0),
        ("hollow ball", hollow, 6.0),
        ("bunny", bunny(), 14.0),
    ] {
        let samples = samples(&soup, 3000);
        let (good, angle) = quality(&samples, ConsistencyConfig::default());
        assert!(good >= 0.99 && angle < worst, "{name}: {good} good, {angle}°");
    }
}

fn scaled(soup: &TriangleSoup, factor: f64) -> TriangleSoup {
    let positions = soup.positions().iter().map(|p| factor * *p).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
}

/// As tables 5 and 7 of *Leaps and Bounds* have it.
#[test]
fn bounded_gradients_are_no_worse_on_clean_samples_and_better_on_noisy_ones() {
    let clean = samples(&bunny(), 6000);
    let mut noisy = clean.clone();
    let (size, mut random) = (bunny().bounds().size().max_element(), random(17));
    let mut normal = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
    noisy.points.iter_mut().for_each(|p| *p += 0.005 * size * Vec3::new(normal(), normal(), normal()));
    let at = |samples: &SurfaceSamples, bounded: Bounded| {
        quality(samples, ConsistencyConfig { bounded, widths: Some(Widths::ALL[0]), ..Default::default() })
    };
    let (plain, bounded) = (at(&clean, Bounded::Nothing), at(&clean, Bounded::Gradients));
    assert!(bounded.0 >= plain.0 && bounded.1 < plain.1, "clean: {plain:?}, bounded {bounded:?}");
    let (plain, bounded) = (at(&noisy, Bounded::Nothing), at(&noisy, Bounded::Gradients));
    assert!(bounded.0 > plain.0 + 0.03 && bounded.1 < plain.1 - 5.0, "noisy: {plain:?}, bounded {bounded:?}");
    // With the field bounded too, narrow widths do with fewer points.
    let everything = at(&clean, Bounded::Everything);
    assert!(everything.0 >= 0.99 && everything.1 < at(&clean, Bounded::Nothing).1, "{everything:?}");
    // The widths chosen for the noise are better than both.
    let chosen = quality(&noisy, ConsistencyConfig::default());
    assert!(chosen.0 > 0.99 && chosen.1 < bounded.1 - 5.0, "chosen {chosen:?}");
}

#[test]
fn oriented_clouds_have_areas_and_a_warning() {
    let samples = samples(&torus(3.0, 1.0, 60, 30), 3000);
    let area = 4.0 * std::f64::consts::PI.powi(2) * 3.0;
    for method in [OrientMethod::default(), OrientMethod::Propagation] {
        let (oriented, warnings) = orient(&cloud(&samples.points), &method, &Silent).unwrap();
        let total: f64 = oriented.areas().iter().sum();
        assert!((total / area - 1.0).abs() < 0.03, "{method:?}: {total} instead of {area}");
        assert_eq!(
            warnings.iter().map(|w| (w.kind, w.count)).collect::<Vec<_>>(),
            [(WarningKind::EstimatedNormals, 3000)]
        );
    }
    // Their own areas, lengths of the vectors, are near the truth too.
    let vectors = consistent_area_vectors(&samples.points, &ConsistencyConfig::default(), &Silent).unwrap();
    let total: f64 = vectors.iter().map(|v| v.length()).sum();
    assert!((total / area - 1.0).abs() < 0.15, "{total} instead of {area}");
    // Normals and areas that are there stay.
    let normals = vec![Vec3::X; 3000];
    let given =
        PointCloud::cleaned(samples.points.clone(), Some(normals.clone()), Some(vec![2.0; 3000])).unwrap().0;
    let (kept, warnings) = orient(&given, &OrientMethod::default(), &Silent).unwrap();
    assert_eq!((kept.normals(), kept.areas(), warnings.len()), (&normals[..], &vec![2.0; 3000][..], 0));
    let with_areas = PointCloud::cleaned(samples.points, None, Some(vec![2.0; 3000])).unwrap().0;
    let (kept, _) = orient(&with_areas, &OrientMethod::default(), &Silent).unwrap();
    assert_eq!(kept.areas(), vec![2.0; 3000]);
}

#[test]
fn place_and_scale_do_not_matter() {
    let samples = samples(&torus(1.0, 0.4, 40, 20), 1500);
    let found = consistent_area_vectors(&samples.points, &ConsistencyConfig::default(), &Silent).unwrap();
    let moved: Vec<Vec3> =
        samples.points.iter().map(|p| 1024.0 * *p + Vec3::new(8192.0, -4096.0, 0.0)).collect();
    let again = consistent_area_vectors(&moved, &ConsistencyConfig::default(), &Silent).unwrap();
    for (a, b) in found.iter().zip(&again) {
        assert!((*a - *b / 1048576.0).length() < 1e-3 * a.length(), "{a} and {b}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let samples = samples(&torus(1.0, 0.4, 40, 20), 2500);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            consistent_area_vectors(&samples.points, &ConsistencyConfig::default(), &Silent).unwrap()
        })
    };
    let one = run(1);
    assert!(one == run(2) && one == run(8));
}

#[test]
fn poor_clouds_are_errors_or_warnings() {
    let oriented = |points: &[Vec3]| orient(&cloud(points), &OrientMethod::default(), &Silent);
    assert_eq!(oriented(&[]).unwrap_err(), EstimateError::Empty);
    let flat: Vec<Vec3> = (0..100).map(|i| Vec3::new(f64::from(i % 10), f64::from(i / 10), 0.0)).collect();
    for points in [&flat[..1], &flat[..3], &flat[..]] {
        let (found, warnings) = oriented(points).unwrap();
        assert_eq!(found.len(), points.len());
        assert!(
            warnings.iter().any(|w| w.kind == WarningKind::FlatCloud),
            "{} points: {warnings:?}",
            points.len()
        );
    }
    // Every point twice.
    let samples = samples(&sphere(12), 1500);
    let twice: Vec<Vec3> = samples.points.iter().flat_map(|p| [*p, *p]).collect();
    let truth: Vec<Vec3> = samples.normals.iter().flat_map(|n| [*n, *n]).collect();
    let (found, _) = oriented(&twice).unwrap();
    assert_eq!(good_points(found.normals(), &truth), Ok(1.0));
    // A corner of three points far from a ball of others.
    let mut odd = samples.points;
    odd.extend([Vec3::splat(50.0), Vec3::splat(50.0) + Vec3::X, Vec3::splat(-1e6)]);
    assert_eq!(oriented(&odd).unwrap().0.len(), 1503);
}

#[test]
fn a_monitor_can_stop_it() {
    let samples = samples(&sphere(12), 1000);
    let monitor = |fraction: f64, stage: &str| stage != "normals" || fraction < 0.3;
    assert_eq!(
        orient(&cloud(&samples.points), &OrientMethod::default(), &monitor).unwrap_err(),
        EstimateError::Cancelled(Cancelled)
    );
}
