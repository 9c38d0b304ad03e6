//! The gradient of the winding number against closed forms and finite differences, and the fast one against the exact.
mod common;

use common::*;
use fast_winding::data::{Lattice, Shape, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::winding::{
    Accuracy, FieldConfig, Order, WindingField, edge_gradient, winding, winding_gradient,
    winding_gradient_of_cloud, winding_gradient_of_soup,
};
use std::f64::consts::{PI, TAU};

/// Central differences of the exact winding number, and a bound of their error: what halving the step changes is three
/// times the truncation error that is left, and `w` is rounded. None where a step crosses the surface.
fn differences(shape: &Shape, q: Vec3, step: f64) -> Option<(Vec3, f64)> {
    let slope = |h: f64| Vec3::AXES.map(|axis| winding(shape, q + h * axis) - winding(shape, q - h * axis));
    let (wide, narrow) = (slope(step), slope(step / 2.0));
    if wide.iter().chain(&narrow).any(|jump| jump.abs() > 0.3) {
        return None;
    }
    let wide = Vec3::from_array(wide) / (2.0 * step);
    let narrow = Vec3::from_array(narrow) / step;
    let rounding = 1e-15 * (shape.len() as f64).sqrt() / step;
    Some((narrow, (wide - narrow).length() + rounding))
}

fn assert_slope_of_w(shape: &Shape, seed: u64) {
    let mut compared = 0;
    for q in scattered(shape.bounds().padded(0.3), 150, seed) {
        if let Some((expected, tolerance)) = differences(shape, q, 1e-4) {
            let value = winding_gradient(shape, q);
            assert!(
                (value - expected).length() <= tolerance,
                "{value} instead of {expected} ± {tolerance} at {q}"
            );
            compared += 1;
        }
    }
    assert!(compared > 130, "{compared}");
}

#[test]
fn gradient_of_damaged_soups_is_the_slope_of_their_winding_number() {
    for seed in 0..6 {
        let parts = [damaged(&torus(1.0, 0.4, 24, 12), seed), damaged(&sphere(5), seed + 100), cube(0.5)];
        assert_slope_of_w(&joined(&parts).into(), seed);
    }
}

#[test]
fn gradient_of_clouds_is_the_slope_of_their_winding_number() {
    for seed in 0..3 {
        let soup = damaged(&torus(1.0, 0.4, 30, 14), seed);
        assert_slope_of_w(&barycentre_cloud(&soup, 1).into(), seed + 10);
    }
}

#[test]
fn gradient_on_the_axis_of_a_square_and_a_disk() {
    let corner = |x: f64, y: f64| Vec3::new(x, y, 0.0);
    let square = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let square = TriangleSoup::new(square, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let rim = |sides: u32| {
        (0..sides).map(move |i| {
            let (y, x) = (TAU * f64::from(i) / f64::from(sides)).sin_cos();
            Vec3::new(x, y, 0.0)
        })
    };
    let disk = |sides: u32| {
        let positions: Vec<Vec3> = std::iter::once(Vec3::ZERO).chain(rim(sides)).collect();
        TriangleSoup::new(positions, (0..sides).map(|i| [0, i + 1, (i + 1) % sides + 1]).collect()).unwrap()
    };
    for z in [-0.01, -0.3, 0.0, 1.0, 4.0, 50.0] {
        let q = Vec3::new(0.0, 0.0, z);
        let of_square = 8.0 / ((1.0 + z * z) * (2.0 + z * z).sqrt() * 4.0 * PI);
        let value = winding_gradient_of_soup(&square, q);
        assert!((value - of_square * Vec3::Z).length() < 1e-14, "{value} instead of {of_square} at {z}");
        // A polygon of a thousand sides differs from the disk by a part in 10⁵ at most.
        let of_disk = 0.5 / (1.0 + z * z).powf(1.5);
        // In the disk's plane the spokes that meet at its middle are singular, and contribute 0.
        let value = winding_gradient_of_soup(&disk(1000), q);
        assert!((value - of_disk * Vec3::Z).length() < 1e-5 * of_disk, "{value} instead of {of_disk} at {z}");
    }
}

#[test]
fn gradient_depends_on_the_boundary_only() {
    // Two surfaces with the same rim: an open box and its missing face.
    let whole = cube(1.0);
    let lid = without(&whole, |t| t < 10);
    let open = without(&whole, |t| t >= 10);
    for q in scattered(Aabb { min: Vec3::splat(-2.0), max: Vec3::splat(2.0) }, 200, 4) {
        let [of_open, of_lid] = [&open, &lid].map(|soup| winding_gradient_of_soup(soup, q));
        assert!((of_open + of_lid).length() < 1e-13, "{of_open} and {of_lid}");
    }
}

#[test]
fn gradient_of_a_closed_mesh_is_zero_off_its_surface() {
    for soup in [torus(1.0, 0.4, 60, 24), sphere(16), joined(&[cube(1.0), cube(0.4)])] {
        let field = WindingField::new(soup.clone(), FieldConfig::default());
        for q in scattered(soup.bounds().padded(0.5), 200, 8) {
            let edges =
                (0..soup.len()).map(|t| soup.corners(t)).flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]);
            let largest = edges.map(|(a, b)| edge_gradient(q, a, b).length()).fold(0.0, f64::max);
            for value in [winding_gradient_of_soup(&soup, q), field.gradient(q, Accuracy::EXACT)] {
                assert!(value.length() < 1e-12 * largest, "{value} beside {largest}");
            }
        }
    }
}

#[test]
fn direct_gradient_of_the_field_equals_the_exact_one() {
    let soup = damaged(&torus(1.0, 0.4, 40, 16), 2);
    for shape in [Shape::from(barycentre_cloud(&soup, 1)), Shape::from(soup)] {
        let field = WindingField::new(shape.clone(), FieldConfig::default());
        let mut points = scattered(shape.bounds().padded(0.2), 100, 5);
        if let Shape::Soup(soup) = &shape {
            points.extend(&soup.positions()[..20]); // on corners, and on the edges that meet there
        }
        for (q, value) in points.iter().zip(field.gradients(&points, Accuracy::EXACT, &Silent).unwrap()) {
            let expected = winding_gradient(&shape, *q);
            assert!(
                (value - expected).length() < 1e-12 * (1.0 + expected.length()),
                "{value} instead of {expected}"
            );
        }
    }
}

#[test]
fn fast_gradient_converges_with_order_and_with_beta() {
    let soup = torus(1.0, 0.4, 160, 64);
    let shapes = [Shape::from(barycentre_cloud(&soup, 1)), Shape::from(without(&soup, |t| t % 7 == 0))];
    for shape in shapes {
        let field = WindingField::new(shape.clone(), FieldConfig::default());
        let lattice = Lattice::with_resolution(shape.bounds(), 14).unwrap();
        let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
        let exact = field.gradients(&points, Accuracy::EXACT, &Silent).unwrap();
        let rms = |order: Order, beta: f64| {
            let values = field.gradients(&points, Accuracy::Explicit { order, beta }, &Silent).unwrap();
            let squares = values.iter().zip(&exact).map(|(a, b)| (*a - *b).length_squared());
            (squares.sum::<f64>() / points.len() as f64).sqrt()
        };
        let betas = [1.5, 2.0, 3.0, 4.5];
        let table = [Order::Zero, Order::One, Order::Two].map(|order| betas.map(|beta| rms(order, beta)));
        for k in 0..betas.len() {
            // Order 1 adds little: about the centre of a flat cluster its moments are 0.
            assert!(table[1][k] < 1.05 * table[0][k] && table[2][k] < 0.7 * table[1][k], "{table:?}");
        }
        for row in table {
            assert!(row.windows(2).all(|pair| pair[1] < pair[0]), "{table:?}");
        }
        assert!(table[2][3] < 0.01 * table[0][0], "{table:?}");
    }
}

#[test]
fn fast_gradient_is_the_slope_of_the_fast_winding_number() {
    // Far from everything one and the same set of clusters answers for both ends of a step.
    let field = WindingField::new(damaged(&torus(1.0, 0.4, 40, 16), 3), FieldConfig::default());
    let step = 0.05;
    for order in [Order::Zero, Order::One, Order::Two] {
        let accuracy = Accuracy::Explicit { order, beta: 1.5 };
        for q in scattered(Aabb { min: Vec3::splat(3.0), max: Vec3::splat(4.0) }, 50, 6) {
            let slope = Vec3::AXES.map(|axis| {
                (field.at(q + step * axis, accuracy) - field.at(q - step * axis, accuracy)) / (2.0 * step)
            });
            let (slope, value) = (Vec3::from_array(slope), field.gradient(q, accuracy));
            // Truncation: (step / distance)² of it; 32-bit floats: 1e-7 of w over the step.
            let tolerance = 1e-3 * value.length() + 1e-7 / step;
            assert!((value - slope).length() < tolerance, "{value} instead of {slope}");
        }
    }
}

#[test]
fn gradient_scales_with_the_inverse_of_length_and_ignores_place() {
    let soup = damaged(&torus(1.0, 0.4, 40, 16), 1);
    for (scale, offset) in [(1e-6, 0.0), (1.0, 1e5), (1e9, 0.0)] {
        let place = |p: Vec3| scale * p + Vec3::splat(offset);
        let positions = soup.positions().iter().map(|p| place(*p)).collect();
        let moved = TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap();
        let field = WindingField::new(moved, FieldConfig::default());
        for q in scattered(soup.bounds(), 100, 9) {
            let expected = winding_gradient_of_soup(&soup, q);
            for (accuracy, tolerance) in [(Accuracy::EXACT, 1e-8), (Accuracy::Tolerance(1e-4), 1e-2)] {
                let value = scale * field.gradient(place(q), accuracy);
                assert!(
                    (value - expected).length() < tolerance * (1.0 + expected.length()),
                    "{value} {expected}"
                );
            }
        }
    }
}

#[test]
fn queries_that_are_not_finite_give_nan_and_singular_ones_do_not() {
    let field = WindingField::new(cube(1.0), FieldConfig::default());
    for accuracy in [Accuracy::EXACT, Accuracy::default()] {
        let queries =
            [Vec3::NAN, Vec3::INFINITY, Vec3::ONE, Vec3::new(1.0, 0.3, 0.3), Vec3::new(1.0, 1.0, 0.2)];
        let gradients = field.gradients(&queries, accuracy, &Silent).unwrap();
        assert!(gradients[..2].iter().all(|g| g.is_nan()));
        assert!(gradients[2..].iter().all(|g| g.length() < 1e-5), "{gradients:?}");
    }
    let cloud = sphere_cloud(200);
    let at_a_point = winding_gradient_of_cloud(&cloud, cloud.points()[7]);
    assert!(at_a_point.is_finite());
    let field = WindingField::new(cloud.clone(), FieldConfig::default());
    let value = field.gradient(cloud.points()[7], Accuracy::EXACT);
    assert!((value - at_a_point).length() < 1e-12 * at_a_point.length());
    for empty in [TriangleSoup::default(), TriangleSoup::new(vec![Vec3::ONE; 3], vec![[0, 1, 2]]).unwrap()] {
        let field = WindingField::new(empty, FieldConfig::default());
        for q in [Vec3::ZERO, Vec3::ONE] {
            assert_eq!(field.gradient(q, Accuracy::EXACT), Vec3::ZERO);
            assert_eq!(field.gradient(q, Accuracy::default()), Vec3::ZERO);
        }
    }
}
