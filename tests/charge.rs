//! Charges of soups and lines of their field, against closed forms.
#[path = "charge/lines.rs"]
mod lines;

use fast_winding::TriangleSoup;
use fast_winding::charge::*;
use fast_winding::data::Silent;
use fast_winding::math::{Vec3, area_vector};
use std::f64::consts::PI;
use std::sync::Arc;

/// An octahedron cut up `times` times, its vertices on the unit sphere.
fn sphere(times: usize) -> TriangleSoup {
    let tips = [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y];
    let mut faces: Vec<[Vec3; 3]> = (0..4)
        .flat_map(|k| {
            let (a, b) = (tips[k], tips[(k + 1) % 4]);
            [[a, b, Vec3::Z], [b, a, Vec3::NEG_Z]]
        })
        .collect();
    for _ in 0..times {
        faces = faces
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [a.midpoint(b), b.midpoint(c), c.midpoint(a)].map(Vec3::normalize);
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    loose(&faces)
}

/// Triangles that share no vertices.
fn loose(faces: &[[Vec3; 3]]) -> TriangleSoup {
    let triangles = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(faces.concat(), triangles).unwrap()
}

fn faces(soup: &TriangleSoup) -> Vec<[Vec3; 3]> {
    (0..soup.len()).map(|t| soup.corners(t)).collect()
}

fn scaled(soup: &TriangleSoup, axes: Vec3, shift: Vec3) -> TriangleSoup {
    loose(&faces(soup).into_iter().map(|corners| corners.map(|p| axes * p + shift)).collect::<Vec<_>>())
}

/// A square of side 2 about the origin in the plane z = 0, of 2 n² triangles that face up.
fn plate(n: usize) -> TriangleSoup {
    let at =
        |i: usize, j: usize| Vec3::new(i as f64, j as f64, 0.0) * (2.0 / n as f64) - Vec3::new(1.0, 1.0, 0.0);
    let cells = (0..n * n).flat_map(|k| {
        let (i, j) = (k / n, k % n);
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    loose(&cells.collect::<Vec<_>>())
}

fn solve(soup: TriangleSoup, config: &ChargeConfig) -> ElectricField {
    ElectricField::solve(Arc::new(soup), config, &Silent).unwrap()
}

fn as_is() -> ChargeConfig {
    ChargeConfig { refinement: None, tolerance: 1e-10, ..Default::default() }
}

fn middle(corners: [Vec3; 3]) -> Vec3 {
    corners.iter().sum::<Vec3>() / 3.0
}

/// Charge per area of each triangle.
fn densities(field: &ElectricField) -> Vec<f64> {
    let soup = field.soup();
    (0..soup.len()).map(|t| field.charges()[t] / area_vector(soup.corners(t)).length()).collect()
}

#[test]
fn a_sphere_is_charged_evenly_and_has_the_potential_of_a_point() {
    let field = solve(sphere(4), &as_is());
    // The polyhedron lies up to 3e-3 within the sphere.
    assert!((field.report().potential - 1.0).abs() < 5e-3, "{:?}", field.report());
    for density in densities(&field) {
        assert!((density * 4.0 * PI - 1.0).abs() < 0.03, "{density}");
    }
    for k in 0..50 {
        let t = f64::from(k);
        let direction = Vec3::new(t.sin(), (1.7 * t).cos(), (0.6 * t).sin()).normalize();
        let at = (1.05 + 0.1 * t) * direction;
        let (potential, force) = (field.potential(&[at])[0], field.field(&[at])[0]);
        assert!((potential * at.length() - 1.0).abs() < 3e-3, "{potential} at {at}");
        assert!((force * at.length_squared()).distance(direction) < 2e-2, "{force} at {at}");
        // Within, there is no field.
        let inner = (0.017 * t) * direction;
        assert!((field.potential(&[inner])[0] - field.report().potential).abs() < 3e-3);
        assert!(field.field(&[inner])[0].length() < 2e-2, "{inner}");
    }
}

/// σ = Q / (4π abc √(x²/a⁴ + y²/b⁴ + z²/c⁴)).
#[test]
fn an_ellipsoid_has_the_charges_of_the_closed_form() {
    let axes = Vec3::new(1.0, 0.7, 1.6);
    let field = solve(scaled(&sphere(4), axes, Vec3::new(5.0, -3.0, 2.0)), &as_is());
    let soup = field.soup();
    let errors: Vec<f64> = densities(&field)
        .into_iter()
        .enumerate()
        .map(|(t, density)| {
            let on = ((middle(soup.corners(t)) - Vec3::new(5.0, -3.0, 2.0)) / axes).normalize();
            let expected = 1.0 / (4.0 * PI * axes.element_product() * (on / axes).length());
            density / expected - 1.0
        })
        .collect();
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    assert!(rms < 0.015, "{rms}");
    assert!(
        errors.iter().all(|e| e.abs() < 0.06),
        "{:?}",
        errors.iter().map(|e| e.abs()).fold(0.0, f64::max)
    );
}

/// 0.3667875 of its side (Read 1997). The density is singular along the edges, so errors halve with the triangles' size, and
/// the extrapolation from two sizes is much nearer than either.
#[test]
fn a_square_has_its_capacitance() {
    let potential = |n: usize| solve(plate(n), &as_is()).report().potential;
    let expected = 1.0 / (2.0 * 0.366_787_5);
    let (coarse, fine) = (potential(12) / expected - 1.0, potential(24) / expected - 1.0);
    assert!((coarse / fine - 2.0).abs() < 0.1 && (2.0 * fine - coarse).abs() < 1e-3, "{coarse} {fine}");
}

#[test]
fn both_solvers_give_the_same_charges_and_the_potential_is_the_same_at_all_barycentres() {
    let soup = scaled(&sphere(3), Vec3::new(1.0, 0.5, 0.8), Vec3::ZERO);
    for integration in [Integration::Exact, Integration::Quadrature] {
        let [one, other] = [Solver::Krylov, Solver::RobinHood]
            .map(|solver| solve(soup.clone(), &ChargeConfig { solver, integration, ..as_is() }));
        assert!(one.report().deviation < 1e-10 && other.report().deviation < 1e-10);
        for (a, b) in one.charges().iter().zip(other.charges()) {
            assert!((a - b).abs() < 1e-7 * a.abs(), "{integration:?}: {a} {b}");
        }
        if integration == Integration::Exact {
            let potential = one.report().potential;
            for t in 0..soup.len() {
                // Rules of quadrature for what is not near are good to 1e-5.
                let at = one.direct(middle(soup.corners(t))).0;
                assert!((at / potential - 1.0).abs() < 1e-5, "{t}: {at}, {potential}");
            }
        }
    }
}

#[test]
fn the_tree_solves_what_the_matrix_does() {
    // 8,192 triangles, and 2,048 of the same shape.
    let (large, small) = (solve(sphere(5), &as_is()), solve(sphere(4), &as_is()));
    assert_eq!(large.report().elements, 8192);
    // 10⁻¹⁰ is less than what the tree is wrong by, which the report says; 10⁻⁴ is not.
    assert!(!large.report().reached && large.report().deviation < 1e-4 && small.report().reached);
    assert!(solve(sphere(5), &ChargeConfig { tolerance: 1e-4, ..as_is() }).report().reached);
    let hasty = ChargeConfig { solver: Solver::RobinHood, most_steps: 5, ..as_is() };
    let unfinished = solve(scaled(&sphere(2), Vec3::new(1.0, 0.5, 0.8), Vec3::ZERO), &hasty);
    assert!(!unfinished.report().reached && unfinished.report().deviation > 1e-10);
    let soup = large.soup();
    for t in (0..soup.len()).step_by(97) {
        let at = large.direct(middle(soup.corners(t))).0;
        assert!((at / large.report().potential - 1.0).abs() < 1e-4, "{t}: {at}");
    }
    // Errors are of second order: a fourth.
    let errors = [&large, &small].map(|field| (field.report().potential - 1.0).abs());
    assert!(errors[0] < 0.4 * errors[1], "{errors:?}");
}

#[test]
fn charge_is_conserved_and_has_the_sign_asked_for() {
    for (total, solver) in [(1.0, Solver::RobinHood), (-2.5, Solver::Krylov), (1e-9, Solver::Krylov)] {
        let field = solve(sphere(3), &ChargeConfig { total, solver, ..as_is() });
        let sum: f64 = field.charges().iter().sum();
        assert!((sum / total - 1.0).abs() < 1e-13, "{sum}");
        assert!(field.charges().iter().all(|q| q.signum() == total.signum()));
        let far = 500.0 * Vec3::new(0.6, 0.0, 0.8);
        assert!(
            field.field(&[far])[0].distance(total * far / far.length().powi(3))
                < 1e-4 * (total / 250_000.0).abs()
        );
    }
}

/// Moments of large and of small charges are none in 32-bit floats.
#[test]
fn the_field_is_in_proportion_to_the_charge() {
    let points: Vec<Vec3> = (0..50).map(|k| 0.06 * f64::from(k) * Vec3::new(1.0, 0.3, -0.7)).collect();
    let of = |total: f64| {
        let field = solve(sphere(3), &ChargeConfig { total, ..as_is() });
        (field.potential(&points), field.field(&points))
    };
    let (potentials, fields) = of(1.0);
    for total in [1e60, -1e-60] {
        let (found, directions) = of(total);
        let pairs = potentials.iter().zip(found);
        pairs.for_each(|(one, all)| assert!((all / total - one).abs() <= 1e-14 * one.abs(), "{one} {all}"));
        let pairs = fields.iter().zip(directions);
        pairs.for_each(|(one, all)| assert!((all / total).distance(*one) <= 1e-14 * one.length()));
    }
}

#[test]
fn the_field_by_the_tree_is_that_of_all_triangles() {
    let field = solve(scaled(&sphere(4), Vec3::new(30.0, 8.0, 3.0), Vec3::new(1e3, 0.0, -40.0)), &as_is());
    let point = |k: usize| {
        let t = k as f64;
        let on = Vec3::new(t.sin(), (1.7 * t).cos(), (0.6 * t).sin()).normalize();
        (1.0 + 0.02 * (k % 40) as f64 + 1e-4) * on * Vec3::new(30.0, 8.0, 3.0) + Vec3::new(1e3, 0.0, -40.0)
    };
    let points: Vec<Vec3> = (0..800).map(point).collect();
    let (potentials, fields) = (field.potential(&points), field.field(&points));
    let mut errors: Vec<f64> = Vec::new();
    for (k, q) in points.iter().enumerate() {
        let (potential, force) = field.direct(*q);
        assert!((potentials[k] / potential - 1.0).abs() < 1e-3, "{q}: {}, {potential}", potentials[k]);
        errors.push(fields[k].distance(force) / force.length());
    }
    errors.sort_by(f64::total_cmp);
    assert!(errors[400] < 1e-3 && errors[799] < 2e-2, "{} {}", errors[400], errors[799]);
}

#[test]
fn points_that_are_not_finite_have_no_field() {
    let field = solve(sphere(1), &as_is());
    let values = field.potential(&[Vec3::NAN, 2.0 * Vec3::X, Vec3::INFINITY]);
    assert!(values[0].is_nan() && values[1].is_finite() && values[2].is_nan());
    assert!(field.field(&[]).is_empty() && field.field(&[Vec3::NAN])[0].is_nan());
}

fn lines_of(field: &ElectricField, starts: &[Vec3], normals: &[Vec3], config: &LineConfig) -> FieldLines {
    trace(field, starts, normals, config, &Silent).unwrap()
}

#[test]
fn one_triangle_two_parts_and_flat_triangles_are_charged() {
    let one = solve(loose(&[[Vec3::ZERO, Vec3::X, Vec3::Y]]), &ChargeConfig::default());
    assert!(one.report().elements >= 1500 && (one.charges()[0] - 1.0).abs() < 1e-12);
    let (up, down) =
        (one.field(&[Vec3::new(0.3, 0.3, 0.01)])[0], one.field(&[Vec3::new(0.3, 0.3, -0.01)])[0]);
    assert!(up.z > 0.0 && (up.z + down.z).abs() < 1e-3 * up.z);

    // Two equal spheres far apart share the charge; each lowers the other's share little.
    let ball = sphere(2);
    let mut two = faces(&scaled(&ball, Vec3::ONE, Vec3::new(20.0, 0.0, 0.0)));
    two.extend(faces(&ball));
    two.push([Vec3::ZERO, Vec3::X, 3.0 * Vec3::X]);
    two.push([Vec3::ONE; 3]);
    let field = solve(loose(&two), &as_is());
    assert_eq!((field.report().flat, &field.charges()[256..]), (2, &[0.0, 0.0][..]));
    let first: f64 = field.charges()[..128].iter().sum();
    assert!((first - 0.5).abs() < 1e-6, "{first}");
    assert!((field.report().potential / (0.5 + 0.5 / 20.0) - 1.0).abs() < 0.05);
}

#[test]
fn copies_of_a_triangle_share_its_charge() {
    let mut twice = faces(&sphere(2));
    let once = solve(loose(&twice), &as_is());
    twice.extend(twice.clone());
    for solver in [Solver::Krylov, Solver::RobinHood] {
        let field = solve(loose(&twice), &ChargeConfig { solver, ..as_is() });
        assert!(field.report().deviation < 1e-10, "{:?}", field.report());
        for t in 0..128 {
            let sum = field.charges()[t] + field.charges()[128 + t];
            assert!((sum - once.charges()[t]).abs() < 1e-9, "{t}: {sum}");
        }
    }
}

/// The system of two copies has one direction only: what a solver goes on with after that is rounding.
#[test]
fn copies_are_charged_however_small_the_tolerance() {
    let triangle = [Vec3::X, Vec3::new(3.0, 1.0, 3.0), Vec3::ZERO];
    let field = solve(loose(&[triangle; 2]), &ChargeConfig { tolerance: 2e-16, ..as_is() });
    let sum: f64 = field.charges().iter().sum();
    assert!((sum - 1.0).abs() < 1e-12 && field.report().deviation < 1e-12, "{sum}, {:?}", field.report());
}

#[test]
fn bad_input_is_named() {
    let flat = loose(&[[Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]]);
    let solve = |soup: TriangleSoup, config: ChargeConfig| {
        ElectricField::solve(Arc::new(soup), &config, &Silent).err().map(|error| error.to_string())
    };
    let message = solve(flat, as_is()).unwrap();
    assert_eq!(message, "none of the 1 triangles of the soup has an area");
    let message = solve(sphere(0), ChargeConfig { tolerance: f64::NAN, ..as_is() }).unwrap();
    assert_eq!(message, "tolerance is NaN: it has to be greater than 0 and less than 1");
    let cancelled =
        ElectricField::solve(Arc::new(sphere(3)), &as_is(), &|fraction: f64, _: &str| fraction < 0.3);
    assert!(matches!(cancelled, Err(ChargeError::Cancelled(_))));
    let field = self::solve(sphere(0), &as_is());
    let lines = |starts: &[Vec3], normals: &[Vec3], config: LineConfig| {
        trace(&field, starts, normals, &config, &Silent)
    };
    let config = LineConfig::default();
    assert_eq!(lines(&[Vec3::X], &[], config), Err(LineError::Lengths { starts: 1, directions: 0 }));
    assert_eq!(lines(&[Vec3::X, Vec3::NAN], &[Vec3::X; 2], config), Err(LineError::NonFinite(1)));
    let bad = LineConfig { step: Some(-1.0), ..config };
    assert_eq!(lines(&[Vec3::X], &[Vec3::X], bad), Err(LineError::BadLength { name: "step", value: -1.0 }));
    assert!(lines(&[], &[], config).unwrap().is_empty());
    let still = lines(&[Vec3::X], &[Vec3::ZERO], config).unwrap();
    assert!(still.line(0).iter().all(|p| *p == Vec3::X));
}

#[test]
fn threads_do_not_change_a_bit() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let field = solve(sphere(5), &ChargeConfig { tolerance: 1e-5, ..as_is() });
            let starts: Vec<Vec3> = (0..300).map(|t| field.soup().corners(t)[0]).collect();
            let config = LineConfig { steps: 10, ..Default::default() };
            (field.charges().to_vec(), lines_of(&field, &starts, &starts, &config))
        })
    };
    assert_eq!(run(1), run(2));
}
