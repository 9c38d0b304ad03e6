//! The dual-tree evaluator against direct sums.
mod common;

use common::*;
use fast_winding::data::{Lattice, OrientedCloud, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::treecode::{DualAccuracy, DualTree, LatticeTargets, PointTargets, Proof, Sources, Targets};
use fast_winding::winding::{Dipoles, Triangles, winding_of_cloud, winding_of_soup};
use std::sync::Arc;

const LEAF: usize = 8;
/// A strength for fields with poles, of which only the bound can be checked.
const ANY: f64 = f64::INFINITY;
/// With the largest errors to expect of small models, whose leaves are large: ten times those of the bunny.
const PRESETS: [(DualAccuracy, f64); 4] = [
    (DualAccuracy::FAST, 3e-2),
    (DualAccuracy::DEFAULT, 1e-2),
    (DualAccuracy::FINE, 3e-3),
    (DualAccuracy::FINER, 1e-3),
];

/// Values and bounds at all targets.
fn evaluate(tree: &DualTree, targets: &dyn Targets, count: usize, accuracy: DualAccuracy) -> Vec<(f64, f64)> {
    let mut results = vec![(f64::INFINITY, 0.0); count];
    let mut store = |indices: &[usize], values: &[f64], bound: f64| {
        indices.iter().zip(values).for_each(|(i, v)| results[*i] = (*v, bound));
    };
    tree.evaluate(targets, &accuracy, &Silent, Proof::Bounds, &mut store).unwrap();
    results
}

fn check(sources: Arc<dyn Sources>, exact: impl Fn(Vec3) -> f64, bounds: Aabb, strength: f64) {
    let tree = DualTree::build(sources, LEAF);
    for (preset, (accuracy, tolerance)) in PRESETS.into_iter().enumerate() {
        let tolerance = tolerance * strength;
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
        for (q, (value, bound)) in
            points.iter().zip(evaluate(&tree, &PointTargets::new(&points), 1500, accuracy))
        {
            let error = (value - exact(*q)).abs();
            assert!(error <= tolerance, "preset {preset}: {value}, error {error}");
            assert!(error <= bound, "preset {preset}: error {error}, bound {bound}");
        }
    }
}

fn dipoles(cloud: &OrientedCloud) -> Arc<Dipoles> {
    Arc::new(Dipoles::new(Arc::new(cloud.clone()), false))
}

fn of(soup: &TriangleSoup) -> Arc<Triangles> {
    Arc::new(Triangles::new(Arc::new(soup.clone())))
}

/// `strength`: how many times stronger the field may be than that of a closed surface.
fn check_soup(soup: &TriangleSoup, strength: f64) {
    check(of(soup), |q| winding_of_soup(soup, q), soup.bounds().padded(0.1), strength);
}

fn check_cloud(cloud: &OrientedCloud, strength: f64) {
    check(dipoles(cloud), |q| winding_of_cloud(cloud, q), cloud.bounds().padded(0.1), strength);
}

fn broken_torus() -> TriangleSoup {
    without(&torus(1.0, 0.4, 60, 24), |i| i % 7 == 3)
}

#[test]
fn broken_soups_are_right_to_the_preset_and_within_the_bound() {
    check_soup(&broken_torus(), 1.0);
    check_soup(&cube(1.0), 1.0);
    check_soup(&joined(&[broken_torus(), sphere(6), flipped(&cube(0.3)), sphere(6)]), 1.0);
}

#[test]
fn clouds_are_right_to_the_preset_and_within_the_bound() {
    check_cloud(&sphere_cloud(3000), 4.0);
    // Few points, each with a strong field around it.
    check_cloud(&barycentre_cloud(&broken_torus(), 3), 10.0);
}

fn soup_of(triangles: &[[Vec3; 3]]) -> TriangleSoup {
    let indices = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(triangles.concat(), indices).unwrap()
}

#[test]
fn degenerate_soups_are_right() {
    let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let flat = [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X];
    let dot = [Vec3::ONE; 3];
    check_soup(&soup_of(&[triangle]), 1.0);
    check_soup(&soup_of(&[triangle; 300]), 300.0);
    check_soup(&soup_of(&[flat, dot, triangle, flat, dot, dot]), 1.0);
    check_soup(&soup_of(&[flat; 20]), 1.0);
    check_soup(&joined(&[broken_torus(), broken_torus(), soup_of(&[flat, dot])]), 2.0);
    // Far from the origin, and of very different sizes.
    let moved = |soup: &TriangleSoup, scale: f64, by: Vec3| {
        let positions = soup.positions().iter().map(|p| scale * *p + by).collect();
        TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
    };
    check_soup(&moved(&broken_torus(), 1e-9, Vec3::ZERO), 1.0);
    check_soup(&moved(&broken_torus(), 1e9, Vec3::ZERO), 1.0);
    check_soup(&joined(&[broken_torus(), moved(&broken_torus(), 1e-6, Vec3::splat(0.2))]), 1.0);
}

#[test]
fn nothing_has_no_field() {
    let tree = DualTree::build(of(&TriangleSoup::default()), LEAF);
    let points = [Vec3::ZERO, Vec3::ONE];
    assert_eq!(evaluate(&tree, &PointTargets::new(&points), 2, DualAccuracy::DEFAULT)[1].0, 0.0);
    let full = DualTree::build(of(&cube(1.0)), LEAF);
    full.evaluate(&PointTargets::new(&[]), &DualAccuracy::DEFAULT, &Silent, Proof::Bounds, &mut |_, _, _| {
        panic!("there are no queries")
    })
    .unwrap();
}

#[test]
fn equal_points_and_queries_on_points_are_right() {
    let cloud = |points: Vec<Vec3>| {
        let count = points.len();
        OrientedCloud::new(points, vec![Vec3::Z; count], vec![0.001; count]).unwrap()
    };
    check_cloud(&cloud(vec![Vec3::ONE; 5000]), ANY);
    check_cloud(&cloud(vec![Vec3::ONE]), ANY);
    let sphere = sphere_cloud(2000);
    let tree = DualTree::build(dipoles(&sphere), LEAF);
    let results = evaluate(&tree, &PointTargets::new(sphere.points()), 2000, DualAccuracy::FINER);
    for (q, (value, bound)) in sphere.points().iter().zip(results) {
        let error = (value - winding_of_cloud(&sphere, *q)).abs();
        assert!(error <= bound.min(1e-2), "{value}, error {error}, bound {bound}");
    }
}

#[test]
fn principal_values_on_the_surface_are_kept() {
    let places = [
        (Vec3::new(1.0, 0.2, 0.3), 0.5),
        (Vec3::new(1.0, 0.3, 0.3), 0.5),
        (Vec3::new(1.0, 1.0, 0.3), 0.25),
        (Vec3::new(1.0, 1.0, 1.0), 0.125),
    ];
    let points = places.map(|p| p.0);
    let results = evaluate(
        &DualTree::build(of(&cube(1.0)), LEAF),
        &PointTargets::new(&points),
        4,
        DualAccuracy::DEFAULT,
    );
    for ((_, expected), (value, _)) in places.into_iter().zip(results) {
        assert!((value - expected).abs() < 1e-5, "{value} instead of {expected}");
    }
}

#[test]
fn queries_next_to_the_surface_are_on_the_right_side() {
    let soup = sphere(12);
    let tree = DualTree::build(of(&soup), LEAF);
    for offset in [1e-3, 1e-6, 1e-9] {
        let points: Vec<Vec3> = (0..soup.len())
            .flat_map(|t| {
                let [a, b, c] = soup.corners(t);
                let (middle, near_corner) = ((a + b + c) / 3.0, 0.998 * a + 0.001 * (b + c));
                let normal = (b - a).cross(c - a).normalize();
                [middle, near_corner]
                    .into_iter()
                    .flat_map(move |p| [p - offset * normal, p + offset * normal])
            })
            .collect();
        let results = evaluate(&tree, &PointTargets::new(&points), points.len(), DualAccuracy::DEFAULT);
        for (i, (value, bound)) in results.into_iter().enumerate() {
            let error = (value - winding_of_soup(&soup, points[i])).abs();
            assert!(error <= bound.min(1e-2), "offset {offset}: {value}, error {error}, bound {bound}");
        }
    }
}

#[test]
fn queries_that_are_not_finite_give_nan_and_distant_ones_nothing() {
    let mut points = scattered(cube(1.0).bounds(), 200, 3);
    points[7].y = f64::NAN;
    points[90].z = f64::NEG_INFINITY;
    points[91] = Vec3::splat(1e30);
    points[92] = Vec3::splat(-1e200);
    let results = evaluate(
        &DualTree::build(of(&cube(1.0)), LEAF),
        &PointTargets::new(&points),
        200,
        DualAccuracy::DEFAULT,
    );
    for (i, (value, _)) in results.into_iter().enumerate() {
        match i {
            7 | 90 => assert!(value.is_nan()),
            91 | 92 => assert_eq!(value, 0.0),
            _ => assert!((value - 1.0).abs() < 1e-3, "{value}"),
        }
    }
}

#[test]
fn bits_are_equal_for_any_number_of_threads() {
    let soup = broken_torus();
    let lattice = Lattice::with_resolution(soup.bounds(), 40).unwrap();
    let points = scattered(soup.bounds(), 10_000, 5);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let tree = DualTree::build(of(&soup), LEAF);
            let on_lattice =
                evaluate(&tree, &LatticeTargets::new(&lattice), lattice.len(), DualAccuracy::DEFAULT);
            let at_points = evaluate(&tree, &PointTargets::new(&points), points.len(), DualAccuracy::DEFAULT);
            [on_lattice, at_points]
                .concat()
                .into_iter()
                .map(|(v, b)| (v.to_bits(), b.to_bits()))
                .collect::<Vec<_>>()
        })
    };
    let one = run(1);
    assert!(one == run(2) && one == run(8));
}

#[test]
fn a_monitor_can_stop_the_evaluation() {
    let tree = DualTree::build(of(&cube(1.0)), LEAF);
    let lattice = Lattice::with_resolution(cube(1.0).bounds(), 120).unwrap();
    let monitor = |fraction: f64, _: &str| fraction < 0.3;
    let result = tree.evaluate(
        &LatticeTargets::new(&lattice),
        &DualAccuracy::DEFAULT,
        &monitor,
        Proof::Bounds,
        &mut |_, _, _| {},
    );
    assert!(result.is_err());
}

#[test]
fn memory_stays_below_a_hundred_bytes_for_a_source() {
    let soup = torus(1.0, 0.4, 200, 100);
    let tree = DualTree::build(of(&soup), LEAF);
    assert!(tree.bytes() < 100 * soup.len(), "{}", tree.bytes() as f64 / soup.len() as f64);
}

#[test]
fn tolerances_are_kept_on_a_scan() {
    let bunny = bunny();
    let cloud = barycentre_cloud(&bunny, 2);
    let points = scattered(bunny.bounds(), 300, 11);
    let of_soup: Vec<f64> = points.iter().map(|q| winding_of_soup(&bunny, *q)).collect();
    let of_cloud: Vec<f64> = points.iter().map(|q| winding_of_cloud(&cloud, *q)).collect();
    let (soup_tree, cloud_tree) = (DualTree::build(of(&bunny), LEAF), DualTree::build(dipoles(&cloud), LEAF));
    let targets = PointTargets::new(&points);
    for tolerance in [1e-2f64, 1e-3, 1e-4, 1e-5] {
        let keeps = |results: Vec<(f64, f64)>, expected: &[f64]| {
            for ((value, bound), expected) in results.into_iter().zip(expected) {
                let error = (value - expected).abs();
                assert!(error <= tolerance.min(bound), "tolerance {tolerance}: error {error}, bound {bound}");
            }
        };
        let accuracy = DualAccuracy::within(tolerance).unwrap();
        keeps(evaluate(&soup_tree, &targets, 300, accuracy), &of_soup);
        keeps(evaluate(&cloud_tree, &targets, 300, accuracy), &of_cloud);
    }
    assert_eq!(DualAccuracy::within(1e-7), None);
}
