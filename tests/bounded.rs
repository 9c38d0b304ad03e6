//! The field of bounded points: as exact as asked for, wherever it is asked.
mod common;

use common::*;
use fast_winding::data::{Lattice, OrientedCloud, Silent};
use fast_winding::math::Vec3;
use fast_winding::winding::{
    Accuracy, FieldConfig, WindingField, bounded_gradient_of_cloud, bounded_winding_of_cloud,
    winding_of_cloud,
};
use rayon::prelude::*;

fn bounded_field(cloud: &OrientedCloud) -> WindingField {
    WindingField::new(cloud.clone(), FieldConfig { bounded: true, ..FieldConfig::default() })
}

/// Evenly and unevenly sampled clouds, one of them with ten times the areas.
fn clouds() -> Vec<(&'static str, OrientedCloud)> {
    let strong = {
        let cloud = barycentre_cloud(&torus(1.0, 0.4, 60, 30), 3);
        let areas = cloud.areas().iter().map(|a| 10.0 * a).collect();
        OrientedCloud::new(cloud.points().to_vec(), cloud.normals().to_vec(), areas).unwrap()
    };
    vec![("sphere", sphere_cloud(8000)), ("bunny", barycentre_cloud(&bunny(), 4)), ("strong", strong)]
}

fn largest_error(cloud: &OrientedCloud, points: &[Vec3], values: &[f64]) -> f64 {
    let error = |(q, w): (&Vec3, &f64)| (w - bounded_winding_of_cloud(cloud, *q)).abs();
    points.par_iter().zip(values).map(error).reduce(|| 0.0, f64::max)
}

#[test]
fn values_are_within_their_tolerance_on_lattices_and_at_scattered_points() {
    for (name, cloud) in clouds() {
        let field = bounded_field(&cloud);
        let bounds = cloud.bounds();
        let lattice = Lattice::with_resolution(bounds.padded(0.1 * bounds.diagonal()), 14).unwrap();
        let nodes: Vec<Vec3> = {
            let [nx, ny, _] = lattice.counts;
            (0..lattice.len()).map(|i| lattice.point([i % nx, i / nx % ny, i / (nx * ny)])).collect()
        };
        let mut near = scattered(bounds, 300, 5);
        near.extend(cloud.points().iter().step_by(cloud.len() / 300).map(|p| *p + 1e-6 * bounds.size()));
        for tolerance in [1e-2, 1e-3, 1e-4, 0.0] {
            let accuracy = Accuracy::Tolerance(tolerance);
            let most = f64::max(tolerance, 1e-12);
            let on_lattice = field.evaluate_lattice(&lattice, accuracy, &Silent).unwrap().values;
            let few = field.evaluate(&near, accuracy, &Silent).unwrap();
            let (many, again) = (2000 / near.len() + 1, near.len());
            let repeated: Vec<Vec3> = (0..many).flat_map(|_| near.iter().copied()).collect();
            let at_many = field.evaluate(&repeated, accuracy, &Silent).unwrap();
            let errors = [
                largest_error(&cloud, &nodes, &on_lattice),
                largest_error(&cloud, &near, &few),
                largest_error(&cloud, &near, &at_many[..again]),
            ];
            println!("{name} at {tolerance}: {errors:?}");
            assert!(errors.iter().all(|e| *e <= most), "{name} at {tolerance}: {errors:?}");
        }
    }
}

#[test]
fn next_to_a_point_the_field_stays_bounded() {
    let cloud = sphere_cloud(3000);
    let field = bounded_field(&cloud);
    for (p, n) in cloud.points().iter().zip(cloud.normals()).step_by(37) {
        for depth in [1e-2, 1e-5, 1e-9] {
            let q = *p - depth * *n;
            assert!(winding_of_cloud(&cloud, q) > 1.5 || depth > 1e-3, "the plain field is not bounded");
            let w = field.at(q, Accuracy::default());
            assert!((0.5..1.5).contains(&w), "{w} at a depth of {depth}");
        }
    }
    assert!(field.report().method.contains("bounded"));
}

#[test]
fn gradients_are_those_of_the_definition() {
    let cloud = barycentre_cloud(&torus(1.0, 0.4, 60, 30), 2);
    let field = bounded_field(&cloud);
    let points = scattered(cloud.bounds().padded(0.2), 500, 9);
    let found = field.gradients(&points, Accuracy::Tolerance(1e-4), &Silent).unwrap();
    let exact = field.gradients(&points, Accuracy::EXACT, &Silent).unwrap();
    for ((q, found), exact) in points.iter().zip(found).zip(exact) {
        let expected = bounded_gradient_of_cloud(&cloud, *q);
        assert!(
            (found - expected).length() < 2e-3 * (1.0 + expected.length()),
            "{found} for {expected} at {q}"
        );
        assert!(
            (exact - expected).length() < 1e-11 * (1.0 + expected.length()),
            "{exact} for {expected} at {q}"
        );
    }
}
