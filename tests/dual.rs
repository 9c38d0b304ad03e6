//! The dual-tree evaluator against direct sums.
mod common;

use common::*;
use fast_winding::data::{Lattice, OrientedCloud, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::treecode::{
    DualAccuracy, DualTree, LatticeTargets, Outcome, PointTargets, Sources, Targets,
};
use fast_winding::winding::{winding_of_cloud, winding_of_soup};
use std::sync::Arc;

const LEAF: usize = 8;
const PRESETS: [(DualAccuracy, f64); 4] = [
    (DualAccuracy::FAST, 3e-2),
    (DualAccuracy::DEFAULT, 1e-2),
    (DualAccuracy::FINE, 3e-3),
    (DualAccuracy::FINER, 3e-4),
];

/// Values and bounds at all targets.
fn evaluate<S: Sources, T: Targets>(
    tree: &DualTree<S>,
    targets: &T,
    count: usize,
    accuracy: DualAccuracy,
) -> Vec<(f64, f64)> {
    let mut results = vec![(f64::INFINITY, 0.0); count];
    let store = |indices: &[usize], outcome: Outcome<'_>| match outcome {
        Outcome::Values { values, bound } => {
            indices.iter().zip(values).for_each(|(i, v)| results[*i] = (*v, bound));
        }
        Outcome::Within { .. } => panic!("nothing was decided"),
    };
    tree.evaluate(targets, &accuracy, &Silent, |_, _, _| false, store).unwrap();
    results
}

fn check<S: Sources + Send>(sources: S, exact: impl Fn(Vec3) -> f64, bounds: Aabb, tolerance_scale: f64) {
    let tree = DualTree::build(Arc::new(sources), LEAF);
    for (preset, (accuracy, tolerance)) in PRESETS.into_iter().enumerate() {
        let tolerance = tolerance * tolerance_scale;
        for shape in [[11, 9, 13], [21, 22, 1]] {
            let lattice = Lattice::with_counts(bounds, shape).unwrap();
            let results = evaluate(&tree, &LatticeTargets::new(&lattice), lattice.len(), accuracy);
            for (index, (value, bound)) in results.into_iter().enumerate() {
                let expected = exact(lattice.point(lattice.sample(index)));
                let error = (value - expected).abs();
                assert!(error <= tolerance, "preset {preset}: {value} instead of {expected}");
                assert!(error <= bound, "preset {preset}: error {error}, bound {bound}");
            }
        }
        let points = scattered(bounds.padded(0.2 * bounds.diagonal()), 1500, 7);
        for (q, (value, bound)) in points.iter().zip(evaluate(&tree, &PointTargets::new(&points), 1500, accuracy)) {
            let error = (value - exact(*q)).abs();
            assert!(error <= tolerance, "preset {preset}: {value}, error {error}");
            assert!(error <= bound, "preset {preset}: error {error}, bound {bound}");
        }
    }
}

fn check_soup(soup: &TriangleSoup) {
    check(soup.clone(), |q| winding_of_soup(soup, q), soup.bounds().padded(0.1), 1.0);
}

fn check_cloud(cloud: &OrientedCloud, tolerance_scale: f64) {
    check(cloud.clone(), |q| winding_of_cloud(cloud, q), cloud.bounds().padded(0.1), tolerance_scale);
}

fn broken_torus() -> TriangleSoup {
    without(&torus(1.0, 0.4, 60, 24), |i| i % 7 == 3)
}

#[test]
fn broken_soups_are_right_to_the_preset_and_within_the_bound() {
    check_soup(&broken_torus());
    check_soup(&cube(1.0));
    check_soup(&joined(&[broken_torus(), sphere(6), flipped(&cube(0.3)), sphere(6)]));
}

#[test]
fn clouds_are_right_to_the_preset_and_within_the_bound() {
    check_cloud(&sphere_cloud(3000), 2.0);
    check_cloud(&barycentre_cloud(&broken_torus(), 3), 4.0);
}
