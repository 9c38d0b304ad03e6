//! Clouds and loose soups at many points at once, against direct sums.
mod common;

use common::*;
use fast_winding::data::{Lattice, OrientedCloud, Shape, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::winding::{Accuracy, FieldConfig, WindingField, winding};
use rayon::prelude::*;

/// Every triangle with corners of its own, moved by up to `share` of the diagonal along each axis.
fn apart(soup: &TriangleSoup, share: f64) -> TriangleSoup {
    let mut random = random(5);
    let reach = share * soup.bounds().diagonal();
    let moved = |t: usize| {
        let shift = reach * (2.0 * Vec3::new(random(), random(), random()) - Vec3::ONE);
        soup.corners(t).map(|c| c + shift)
    };
    soup_of(&(0..soup.len()).map(moved).collect::<Vec<_>>())
}

fn soup_of(triangles: &[[Vec3; 3]]) -> TriangleSoup {
    let indices = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(triangles.concat(), indices).unwrap()
}

fn field(shape: impl Into<Shape>) -> WindingField {
    WindingField::new(shape, FieldConfig::default())
}

/// Indices that take in all rows and columns.
fn some(count: usize, of: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by((count / of).max(1) | 1)
}

/// Values and inside tests of a field at a lattice and at scattered points, against the direct sum at about `checked` of each.
fn check(shape: impl Into<Shape>, counts: [usize; 3], checked: usize, tolerances: &[f64]) {
    let field = field(shape);
    let lattice = Lattice::with_counts(field.bounds().padded(1e-3), counts).unwrap();
    let on_lattice: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
    let points = scattered(field.bounds().padded(0.05 * field.bounds().diagonal()), 3000, 7);
    let exact = |points: &[Vec3]| -> Vec<(usize, f64)> {
        let chosen: Vec<usize> = some(points.len(), checked).collect();
        chosen.into_par_iter().map(|i| (i, winding(field.shape(), points[i]))).collect()
    };
    let (of_lattice, of_points) = (exact(&on_lattice), exact(&points));
    for &tolerance in tolerances {
        let accuracy = Accuracy::Tolerance(tolerance);
        let grid = field.evaluate_lattice(&lattice, accuracy, &Silent).unwrap();
        let values = field.evaluate(&points, accuracy, &Silent).unwrap();
        for (expected, values) in [(&of_lattice, &grid.values), (&of_points, &values)] {
            for (index, w) in expected {
                let error = (values[*index] - w).abs();
                assert!(error <= tolerance, "tolerance {tolerance}: error {error} at {index}, w {w}");
            }
        }
    }
    let bits = field.classify_lattice(&lattice, 0.5, &Silent).unwrap();
    let inside = field.contains(&points, &Silent).unwrap();
    let is_clear = |w: f64| (w - 0.5).abs() > 1e-9;
    for (i, w) in of_lattice.into_iter().filter(|(_, w)| is_clear(*w)) {
        assert_eq!(bits[i / 8] >> (i % 8) & 1 == 1, w >= 0.5, "sample {i}: {w}");
    }
    for (i, w) in of_points.into_iter().filter(|(_, w)| is_clear(*w)) {
        assert_eq!(inside[i], w >= 0.5, "point {i}: {w}");
    }
}

const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];

#[test]
fn a_loose_soup_is_right_to_the_tolerance() {
    check(apart(&torus(1.0, 0.4, 120, 48), 1e-3), [21, 24, 17], 3000, &TOLERANCES);
}

#[test]
fn a_scan_taken_apart_is_right_to_the_tolerance() {
    check(apart(&bunny(), 1.0 / 300.0), [48; 3], 700, &[1e-2, 3e-3, 1e-3]);
}

#[test]
fn clouds_are_right_to_the_tolerance() {
    check(barycentre_cloud(&torus(1.0, 0.4, 120, 48), 1), [21, 24, 17], 3000, &TOLERANCES);
    check(barycentre_cloud(&bunny(), 2), [48; 3], 3000, &[1e-2, 3e-3, 1e-3]);
}

#[test]
fn loose_and_closed_and_capped_components_together_are_right() {
    let loose = apart(&torus(1.0, 0.4, 60, 24), 1e-3);
    let capped = without(&sphere(12), |t| t < 40);
    let moved = |soup: &TriangleSoup, by: Vec3| {
        let positions = soup.positions().iter().map(|p| *p + by).collect();
        TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
    };
    let soup = joined(&[loose, moved(&capped, Vec3::new(1.0, 0.3, 0.2)), cube(0.4)]);
    let report = field(soup.clone()).report().clone();
    assert!(report.capped_components == 1 && report.loose_components > 1000, "{report:?}");
    check(soup, [25, 23, 19], 3000, &TOLERANCES);
}

#[test]
fn flat_lattices_and_single_rows_are_right() {
    let soup = apart(&torus(1.0, 0.4, 60, 24), 1e-3);
    let cloud = barycentre_cloud(&torus(1.0, 0.4, 60, 24), 1);
    for counts in [[40, 30, 1], [1, 40, 30], [300, 1, 1], [1, 1, 1]] {
        check(soup.clone(), counts, 400, &[1e-3]);
        check(cloud.clone(), counts, 400, &[1e-3]);
    }
}

#[test]
fn degenerate_soups_and_clouds_are_right() {
    let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
    // Not in its plane, where a side of it counts.
    check(soup_of(&[triangle]), [9, 9, 2], 100, &[1e-3]);
    check(soup_of(&[triangle, [Vec3::ONE; 3], [Vec3::ZERO, Vec3::Z, 2.0 * Vec3::Z]]), [9; 3], 800, &[1e-3]);
    let one = OrientedCloud::new(vec![Vec3::ONE], vec![Vec3::Z], vec![0.1]).unwrap();
    let points = scattered(Aabb { min: Vec3::ZERO, max: Vec3::splat(2.0) }, 2000, 3);
    let values = field(one.clone()).evaluate(&points, Accuracy::default(), &Silent).unwrap();
    let shape = Shape::from(one);
    points.iter().zip(values).for_each(|(q, w)| assert!((w - winding(&shape, *q)).abs() < 1e-5));
}

#[test]
fn many_disjoint_triangles_are_right() {
    let mut random = random(9);
    let mut vector = || Vec3::new(random(), random(), random());
    let triangles: Vec<[Vec3; 3]> = (0..100_000)
        .map(|_| {
            let (at, size) = (vector(), 0.01 * vector());
            [at, at + size.x * vector(), at + size.y * vector()]
        })
        .collect();
    check(soup_of(&triangles), [32; 3], 150, &[1e-3]);
}

#[test]
fn the_field_far_from_the_origin_is_right() {
    let moved = |soup: &TriangleSoup, scale: f64, by: f64| {
        let positions = soup.positions().iter().map(|p| scale * *p + Vec3::splat(by)).collect();
        TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
    };
    let soup = apart(&torus(1.0, 0.4, 60, 24), 1e-3);
    check(moved(&soup, 1.0, 1e6), [15, 16, 17], 700, &[1e-3]);
    check(moved(&soup, 1e9, -3e9), [15, 16, 17], 700, &[1e-3]);
    check(barycentre_cloud(&moved(&soup, 1.0, 1e6), 1), [15, 16, 17], 700, &[1e-3]);
}

#[test]
fn queries_that_are_not_finite_give_nan_and_are_outside() {
    let soup = apart(&sphere(12), 1e-4);
    for shape in [Shape::from(barycentre_cloud(&soup, 1)), Shape::from(soup)] {
        let field = field(shape);
        let mut points = scattered(Aabb { min: Vec3::splat(-0.2), max: Vec3::splat(0.2) }, 2000, 3);
        (points[7].x, points[1900].z) = (f64::NAN, f64::INFINITY);
        let values = field.evaluate(&points, Accuracy::default(), &Silent).unwrap();
        let inside = field.contains(&points, &Silent).unwrap();
        for i in 0..points.len() {
            let is_finite = i != 7 && i != 1900;
            assert_eq!((values[i].is_nan(), inside[i]), (!is_finite, is_finite), "point {i}");
        }
    }
}

#[test]
fn points_of_the_surface_have_principal_values_and_are_inside() {
    // A cube of loose triangles and another far away, so that the points are many.
    let cube = cube(1.0);
    let soup = soup_of(&(0..12).map(|t| cube.corners(t)).collect::<Vec<_>>());
    let loose = joined(&[soup, apart(&sphere(4), 0.05)]);
    let field = field(loose.clone());
    let mut points = scattered(field.bounds(), 2000, 3);
    points[0] = Vec3::new(1.0, 0.2, 0.3);
    let values = field.evaluate(&points, Accuracy::default(), &Silent).unwrap();
    assert!((values[0] - winding(&Shape::from(loose), points[0])).abs() < 1e-12);
    assert!(field.contains(&points, &Silent).unwrap()[0]);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let soup = apart(&torus(1.0, 0.4, 60, 24), 1e-3);
    for shape in [Shape::from(barycentre_cloud(&soup, 1)), Shape::from(soup)] {
        let bits = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let field = field(shape.clone());
                let lattice = Lattice::with_resolution(field.bounds(), 40).unwrap();
                let points = scattered(field.bounds(), 5000, 11);
                let grid = field.evaluate_lattice(&lattice, Accuracy::default(), &Silent).unwrap();
                let values = field.evaluate(&points, Accuracy::default(), &Silent).unwrap();
                let inside = field.classify_lattice(&lattice, 0.5, &Silent).unwrap();
                let at_points = field.contains(&points, &Silent).unwrap();
                let values: Vec<u64> = grid.values.into_iter().chain(values).map(f64::to_bits).collect();
                (values, inside, at_points)
            })
        };
        let one = bits(1);
        assert!(one == bits(2) && one == bits(8));
    }
}

#[test]
fn tall_lattices_are_classified_part_by_part() {
    // More samples than are held at once.
    let soup = apart(&torus(1.0, 0.4, 24, 12), 1e-3);
    let field = field(soup);
    let bounds = field.bounds();
    let tall = Lattice::with_counts(bounds, [160, 160, 100]).unwrap();
    let bits = field.classify_lattice(&tall, 0.5, &Silent).unwrap();
    for i in (0..tall.len()).step_by(9973) {
        let w = winding(field.shape(), tall.point(tall.sample(i)));
        assert_eq!(bits[i / 8] >> (i % 8) & 1 == 1, w >= 0.5, "sample {i}: {w}");
    }
}
