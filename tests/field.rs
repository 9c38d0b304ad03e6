//! The winding field against closed forms, and the fast field against the exact one.
mod common;

use common::*;
use fast_winding::data::{Lattice, Shape, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3, distance_to_triangle};
use fast_winding::winding::{
    Accuracy, FieldConfig, Order, WindingField, winding, winding_gradient, winding_of_cloud, winding_of_soup,
};
use std::f64::consts::{PI, TAU};

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}, tolerance {tolerance}");
}

#[test]
fn closed_shapes_are_one_inside_and_zero_outside() {
    for q in scattered(Aabb { min: Vec3::splat(-1.6), max: Vec3::splat(1.6) }, 300, 1) {
        let in_cube = q.abs().max_element() < 1.0;
        assert_close(winding_of_soup(&cube(1.0), q), f64::from(u8::from(in_cube)), 1e-13);
        let from_circle = Vec3::new(q.truncate().length() - 1.0, 0.0, q.z).length();
        if (from_circle - 0.4).abs() > 0.02 {
            let expected = f64::from(u8::from(from_circle < 0.4));
            assert_close(winding_of_soup(&torus(1.0, 0.4, 60, 24), q), expected, 1e-13);
        }
        if (q.length() - 1.0).abs() > 0.02 {
            assert_close(winding_of_soup(&sphere(20), q), f64::from(u8::from(q.length() < 1.0)), 1e-12);
        }
    }
}

#[test]
fn overlaps_count_twice_and_flipped_shapes_minus_one() {
    let inner = cuboid(Aabb { min: Vec3::splat(-0.5), max: Vec3::splat(0.5) });
    let shifted = cuboid(Aabb { min: Vec3::ZERO, max: Vec3::splat(2.0) });
    let q = Vec3::new(0.3, 0.2, 0.1);
    assert_close(winding_of_soup(&joined(&[cube(1.0), inner]), q), 2.0, 1e-14);
    let overlapping = joined(&[cube(1.0), shifted]);
    assert_close(winding_of_soup(&overlapping, q), 2.0, 1e-14);
    assert_close(winding_of_soup(&overlapping, -q), 1.0, 1e-14);
    assert_close(winding_of_soup(&overlapping, 1.5 * Vec3::ONE), 1.0, 1e-14);
    assert_close(winding_of_soup(&flipped(&cube(1.0)), q), -1.0, 1e-14);
}

#[test]
fn principal_values_on_a_cube() {
    // On a face, an edge and a vertex half, a quarter and an eighth of all directions are inside.
    let places = [
        (Vec3::new(1.0, 0.2, 0.3), 0.5),
        (Vec3::new(1.0, 0.3, 0.3), 0.5), // on the diagonal of the face
        (Vec3::new(1.0, 1.0, 0.3), 0.25),
        (Vec3::new(1.0, 1.0, 1.0), 0.125),
    ];
    let field = WindingField::new(cube(1.0), FieldConfig::default());
    for (q, expected) in places {
        assert_close(winding_of_soup(&cube(1.0), q), expected, 1e-15);
        assert_close(field.at(q, Accuracy::EXACT), expected, 1e-15);
        assert_close(field.at(q, Accuracy::default()), expected, 1e-6);
    }
}

/// Openings are closed by triangles that are not there: on edges between two of these, and beside them by less than rounding
/// tells, the field is smooth, too.
#[test]
fn inside_of_an_opening_the_field_is_the_sum_between_any_two_corners() {
    let box_ = cube(1.5);
    let apart = |soup: TriangleSoup, k: usize| moved(&soup, Vec3::new(30.0, 4.0 * k as f64, 0.0));
    // More openings, that a tree is asked for; and more loose triangles, that one is for many points.
    let boxes: Vec<TriangleSoup> = (0..10).map(|k| apart(without(&box_, |t| t == k), k)).collect();
    let loose: Vec<TriangleSoup> = (0..700).map(|k| apart(without(&box_, |t| t != k % 12), k)).collect();
    // Corners in one plane, and others that make triangles at angles.
    for dropped in [vec![0], vec![0, 1], vec![0, 2], vec![3, 8], vec![0, 1, 5, 6], vec![2, 5, 7, 9, 11]] {
        let soup = without(&box_, |t| dropped.contains(&t));
        let queries = between_corners(&soup);
        for company in [&[][..], &boxes, &loose] {
            let shape = Shape::from(joined(&[std::slice::from_ref(&soup), company].concat()));
            let field = WindingField::new(shape.clone(), FieldConfig { leaf_size: 1, ..Default::default() });
            let together = field.evaluate(&queries, Accuracy::default(), &Silent).unwrap();
            let inside = field.contains(&queries, &Silent).unwrap();
            for ((q, found), is_inside) in queries.iter().zip(together).zip(inside) {
                let expected = winding(&shape, *q);
                let singly = field.at(*q, Accuracy::default());
                for w in [singly, found, field.at(*q, Accuracy::EXACT)] {
                    assert!((w - expected).abs() < 1e-3, "{dropped:?} {q}: {w} instead of {expected}");
                }
                if (expected - 0.5).abs() > 1e-9 {
                    assert_eq!(is_inside, expected > 0.5, "{dropped:?} {q}: {expected}");
                    assert_eq!(field.contains_point(*q), expected > 0.5, "{dropped:?} {q}: {expected}");
                }
                let gradient = winding_gradient(&shape, *q);
                for g in [Accuracy::default(), Accuracy::EXACT].map(|accuracy| field.gradient(*q, accuracy)) {
                    assert!((g - gradient).length() < 1e-2, "{dropped:?} {q}: {g} instead of {gradient}");
                }
            }
        }
    }
}

/// Points between the corners of a soup, at some distance from it: many to the last bit on the line, others next to it.
fn between_corners(soup: &TriangleSoup) -> Vec<Vec3> {
    let corners = soup.positions();
    let pairs = (0..corners.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let on_edges: Vec<Vec3> = pairs
        .flat_map(|(i, j)| [0.25, 0.3, 0.5, 0.75].map(|share| corners[i].lerp(corners[j], share)))
        .filter(|q| (0..soup.len()).all(|t| distance_to_triangle(*q, soup.corners(t)) > 1e-3))
        .collect();
    assert!(on_edges.len() > 10, "{}", on_edges.len());
    let offsets = [0.0, 1e-17, 1e-16, 3e-16, 1e-15, 1e-13, 1e-9, 1e-6, 1e-4];
    let beside = |q: &Vec3| offsets.map(|off| *q + off * Vec3::new(1.0, -0.6, 0.3));
    on_edges.iter().flat_map(beside).collect()
}

fn moved(soup: &TriangleSoup, by: Vec3) -> TriangleSoup {
    let positions = soup.positions().iter().map(|p| *p + by).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
}

/// Two damaged cuboids and a flat part, of which three closing triangles meet in a diagonal of one.
#[test]
fn on_a_diagonal_of_closing_triangles_the_field_is_the_sum() {
    let part = |first: u32, triangles: &[[u32; 3]]| triangles.iter().map(|t| t.map(|v| first + v)).collect();
    let flat: Vec<[u32; 3]> = part(
        0,
        &[
            [0, 4, 6],
            [0, 6, 2],
            [1, 3, 7],
            [3, 7, 1],
            [1, 7, 5],
            [7, 5, 1],
            [0, 1, 5],
            [0, 5, 4],
            [5, 4, 0],
            [2, 6, 7],
            [6, 7, 2],
            [2, 7, 3],
            [7, 3, 2],
            [0, 3, 1],
            [4, 5, 7],
            [4, 7, 6],
        ],
    );
    let needle: Vec<[u32; 3]> = part(8, &[[0, 2, 1], [1, 3, 2], [2, 0, 3]]);
    let cuboid: Vec<[u32; 3]> = part(
        12,
        &[
            [0, 4, 6],
            [4, 6, 0],
            [0, 2, 6],
            [1, 7, 5],
            [0, 5, 1],
            [0, 5, 4],
            [2, 3, 7],
            [0, 3, 1],
            [4, 5, 7],
            [4, 6, 7],
        ],
    );
    let corners = |low: Vec3, high: Vec3| {
        let side = move |k: usize, bit: usize| if k >> bit & 1 == 1 { high[bit] } else { low[bit] };
        (0..8).map(move |k| Vec3::new(side(k, 0), side(k, 1), side(k, 2)))
    };
    let mut positions: Vec<Vec3> = corners(Vec3::new(0.7, 0.7, 2.7), Vec3::splat(2.7)).collect();
    positions
        .extend([[1.7, 0.7, 1.7], [2.7, 1.7, 3.7], [2.7, 1.7, 1.7], [2.7, 1.7, 3.7]].map(Vec3::from_array));
    positions.extend(corners(Vec3::splat(0.7), Vec3::splat(3.7)));
    let shape = Shape::from(TriangleSoup::new(positions, [flat, needle, cuboid].concat()).unwrap());
    let field = WindingField::new(shape.clone(), FieldConfig { leaf_size: 3, ..Default::default() });
    let queries: Vec<Vec3> = (1..40).map(|k| Vec3::splat(0.7 + 0.075 * f64::from(k))).collect();
    let queries = [vec![Vec3::splat(1.449_735_915_968_074_5)], queries].concat();
    let together = field.evaluate(&queries, Accuracy::default(), &Silent).unwrap();
    for (q, found) in queries.into_iter().zip(together) {
        let expected = winding(&shape, q);
        let singly = field.at(q, Accuracy::default());
        assert!((singly - expected).abs() < 1e-3, "{q}: {singly} instead of {expected}");
        assert!((found - expected).abs() < 1e-3, "{q}: {found} instead of {expected}, among others");
    }
}

#[test]
fn triangles_without_area_leave_the_field_as_it_is() {
    let part = without(&cube(1.5), |t| t < 3);
    let flat = TriangleSoup::new(vec![Vec3::ZERO, Vec3::splat(0.5), Vec3::ONE], vec![[0, 1, 2]]).unwrap();
    for soup in [flat.clone(), joined(&[part.clone(), flat.clone()]), joined(&[flat, part])] {
        let shape = Shape::from(soup);
        let field = WindingField::new(shape.clone(), FieldConfig::default());
        for t in [-0.25, 0.0, 0.25, 0.5, 0.7, 1.0, 1.2] {
            let q = Vec3::splat(t);
            let expected = winding(&shape, q);
            for accuracy in [Accuracy::EXACT, Accuracy::default()] {
                assert!((field.at(q, accuracy) - expected).abs() < 1e-3, "{q}: {expected}");
            }
            assert_eq!(field.contains_point(q), expected >= 0.5, "{q}: {expected}");
        }
    }
}

#[test]
fn a_square_and_a_disk_on_their_axes() {
    let square = |half: f64| {
        let corner = |x: f64, y: f64| Vec3::new(half * x, half * y, 0.0);
        let corners = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        TriangleSoup::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap()
    };
    let disk = |sides: u32| {
        let rim = (0..sides).map(|i| {
            let (y, x) = (TAU * f64::from(i) / f64::from(sides)).sin_cos();
            Vec3::new(x, y, 0.0)
        });
        let positions: Vec<Vec3> = std::iter::once(Vec3::ZERO).chain(rim).collect();
        TriangleSoup::new(positions, (0..sides).map(|i| [0, i + 1, (i + 1) % sides + 1]).collect()).unwrap()
    };
    for d in [0.01, 0.3, 1.0, 4.0, 50.0] {
        let q = Vec3::new(0.0, 0.0, -d);
        let square_angle = 4.0 * (4.0 / (d * (8.0 + d * d).sqrt())).atan();
        assert_close(winding_of_soup(&square(2.0), q), square_angle / (4.0 * PI), 1e-14);
        // A polygon of n sides covers 2π²/(3n²) less of the disk: 6e-6 for a thousand.
        let disk_angle = TAU * (1.0 - d / (1.0 + d * d).sqrt());
        assert_close(winding_of_soup(&disk(1000), q), disk_angle / (4.0 * PI), 6.6e-6);
        assert_close(winding_of_soup(&disk(1000), -q), -disk_angle / (4.0 * PI), 6.6e-6);
    }
}

#[test]
fn cloud_on_a_sphere_converges_as_it_is_refined() {
    let queries =
        [(Vec3::new(0.3, 0.2, 0.1), 1.0), (Vec3::new(0.0, -0.7, 0.2), 1.0), (Vec3::new(0.9, 0.9, 0.4), 0.0)];
    for (q, expected) in queries {
        let error = |count: usize| (winding_of_cloud(&sphere_cloud(count), q) - expected).abs();
        let errors = [error(250), error(1000), error(4000), error(16000)];
        assert!(errors[3] < 1e-4, "{errors:?}");
        assert!(errors[3] < 0.2 * errors[0] || errors[0] < 1e-9, "{errors:?}");
    }
}

#[test]
fn queries_that_are_not_finite_give_nan_and_spoil_nothing() {
    let field = WindingField::new(cube(1.0), FieldConfig::default());
    let queries = [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::X * 0.5];
    for accuracy in [Accuracy::EXACT, Accuracy::default()] {
        let values = field.evaluate(&queries, accuracy, &Silent).unwrap();
        assert_close(values[0], 1.0, 1e-6);
        assert!(values[1].is_nan() && values[2].is_nan());
        assert_close(values[3], 1.0, 1e-6);
    }
    assert_eq!(field.contains(&queries, &Silent).unwrap(), [true, false, false, true]);
}

#[test]
fn empty_and_degenerate_shapes_have_a_field() {
    let point = vec![Vec3::ONE; 3];
    for soup in [TriangleSoup::default(), TriangleSoup::new(point, vec![[0, 1, 2]]).unwrap()] {
        let field = WindingField::new(soup, FieldConfig::default());
        for q in [Vec3::ZERO, Vec3::ONE] {
            assert_eq!(field.at(q, Accuracy::default()), 0.0);
            assert_eq!(field.at(q, Accuracy::EXACT), 0.0);
        }
    }
}

#[test]
fn the_field_does_not_depend_on_scale_or_place() {
    for (scale, offset) in [(1e-6, 0.0), (1.0, 1e6), (1e9, 0.0)] {
        let place = |p: Vec3| scale * p + Vec3::splat(offset);
        let soup = torus(1.0, 0.4, 40, 16);
        let moved = TriangleSoup::new(
            soup.positions().iter().map(|p| place(*p)).collect(),
            soup.triangles().to_vec(),
        );
        let field = WindingField::new(moved.unwrap(), FieldConfig::default());
        for q in scattered(soup.bounds(), 200, 5) {
            let expected = winding_of_soup(&soup, q).round();
            assert_close(field.at(place(q), Accuracy::default()), expected, 1e-3);
        }
    }
}

/// RMS and largest difference.
fn errors(values: &[f64], exact: &[f64]) -> (f64, f64) {
    let differences = values.iter().zip(exact).map(|(a, b)| (a - b).abs());
    let squares: f64 = differences.clone().map(|d| d * d).sum();
    ((squares / values.len() as f64).sqrt(), differences.fold(0.0, f64::max))
}

fn lattice_points(bounds: Aabb, resolution: usize) -> Vec<Vec3> {
    let lattice = Lattice::with_resolution(bounds, resolution).unwrap();
    (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect()
}

#[test]
fn error_falls_with_order_and_with_beta() {
    let soup = torus(1.0, 0.4, 160, 64);
    let shapes = [Shape::from(barycentre_cloud(&soup, 1)), Shape::from(without(&soup, |t| t % 7 == 0))];
    for shape in shapes {
        let field = WindingField::new(shape.clone(), FieldConfig::default());
        let points = lattice_points(shape.bounds(), 16);
        let exact: Vec<f64> = points.iter().map(|q| winding(&shape, *q)).collect();
        let rms = |order: Order, beta: f64| {
            let values = field.evaluate(&points, Accuracy::Explicit { order, beta }, &Silent).unwrap();
            errors(&values, &exact).0
        };
        let orders = [Order::Zero, Order::One, Order::Two];
        let betas = [1.5, 2.0, 3.0, 4.5];
        let table = orders.map(|order| betas.map(|beta| rms(order, beta)));
        for k in 0..betas.len() {
            assert!(table[1][k] < table[0][k] && table[2][k] < table[1][k], "{table:?}");
        }
        for row in table {
            assert!(row.windows(2).all(|pair| pair[1] < pair[0]), "{table:?}");
        }
        assert!(table[2][1] < 2e-3, "{table:?}");
    }
}

#[test]
fn defaults_meet_the_papers_error_on_the_bunny() {
    // Fig. 10's lattice of 50³ over the bounds; every 11th sample is compared, which takes in all rows and columns.
    let bunny = bunny();
    let cloud = barycentre_cloud(&bunny, 2);
    for (shape, limit) in [(Shape::from(bunny), 1e-3), (Shape::from(cloud), 1e-2)] {
        let field = WindingField::new(shape.clone(), FieldConfig::default());
        let points: Vec<Vec3> = lattice_points(shape.bounds(), 50).into_iter().step_by(11).collect();
        let exact = field.evaluate(&points, Accuracy::EXACT, &Silent).unwrap();
        let oracle: Vec<f64> = points.iter().step_by(97).map(|q| winding(&shape, *q)).collect();
        let sampled: Vec<f64> = exact.iter().step_by(97).copied().collect();
        assert!(errors(&sampled, &oracle).1 < 1e-12, "{:?}", errors(&sampled, &oracle));
        let of_paper = field.evaluate(&points, Accuracy::of_paper(&shape), &Silent).unwrap();
        let (rms, max) = errors(&of_paper, &exact);
        assert!(rms <= limit, "rms {rms}, max {max}");
        for tolerance in [1e-2, 1e-3, 1e-4] {
            let values = field.evaluate(&points, Accuracy::Tolerance(tolerance), &Silent).unwrap();
            let (_, max) = errors(&values, &exact);
            assert!(max <= tolerance, "largest error {max} for a tolerance of {tolerance}");
        }
        let inside = field.contains(&points, &Silent).unwrap();
        let wrong =
            inside.iter().zip(&exact).filter(|(i, w)| **i != (**w >= 0.5) && (**w - 0.5).abs() > 1e-9);
        assert_eq!(wrong.count(), 0);
    }
}

#[test]
fn a_lattice_has_the_values_of_its_points() {
    let soup = without(&torus(1.0, 0.4, 100, 40), |t| t % 5 == 0);
    for shape in [Shape::from(barycentre_cloud(&soup, 1)), Shape::from(soup)] {
        let field = WindingField::new(shape, FieldConfig::default());
        let lattice = Lattice::with_resolution(field.bounds(), 21).unwrap();
        for order in [Order::Zero, Order::One, Order::Two] {
            let accuracy = Accuracy::Explicit { order, beta: 2.0 };
            let grid = field.evaluate_lattice(&lattice, accuracy, &Silent).unwrap();
            let singly = field.evaluate(&lattice_points(field.bounds(), 21), accuracy, &Silent).unwrap();
            // The same clusters, summed in another order of 32-bit floats.
            assert!(errors(&grid.values, &singly).1 < 2e-6, "{:?}", errors(&grid.values, &singly));
        }
    }
}

#[test]
fn product_of_angles_equals_the_sum_of_arctangents_next_to_the_surface() {
    let soup = without(&torus(1.0, 0.4, 60, 24), |t| t % 13 == 0);
    let field = WindingField::new(soup.clone(), FieldConfig::default());
    let mut next = random(3);
    for t in 0..soup.len() {
        let [a, b, c] = soup.corners(t);
        let on_it = a + 0.9 * next() * (b - a) + 0.1 * next() * (c - a);
        let offset = 10f64.powf(-12.0 * next()) * Vec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
        let q = on_it + offset;
        assert_close(field.at(q, Accuracy::EXACT), winding_of_soup(&soup, q), 1e-12);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let soup = without(&torus(1.0, 0.4, 100, 40), |t| t % 5 == 0);
    let points = lattice_points(soup.bounds(), 24);
    let bits = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let field = WindingField::new(soup.clone(), FieldConfig::default());
            let singly = field.evaluate(&points, Accuracy::default(), &Silent).unwrap();
            let lattice = Lattice::with_resolution(field.bounds(), 24).unwrap();
            let grid = field.evaluate_lattice(&lattice, Accuracy::default(), &Silent).unwrap();
            singly.into_iter().chain(grid.values).map(f64::to_bits).collect::<Vec<u64>>()
        })
    };
    let one = bits(1);
    assert_eq!(one, bits(2));
    assert_eq!(one, bits(8));
}
