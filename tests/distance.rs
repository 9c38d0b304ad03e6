//! Signed distances: as geometry gives them, as a look at all triangles does, with the right sign where shapes are open.
mod common;

use common::*;
use fast_winding::data::{Lattice, Monitor, Shape, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Feature, Vec3, area_vector, distance_to_triangle};
use fast_winding::solid::{DistanceConfig, DistanceError, DistanceSign, SignedDistance};
use fast_winding::winding::{Accuracy, FieldConfig, FieldError, WindingField};

fn field(shape: impl Into<Shape>) -> WindingField {
    WindingField::new(shape, FieldConfig::default())
}

fn distances(field: &WindingField, points: &[Vec3]) -> Vec<f64> {
    SignedDistance::new(field).distances(points, &DistanceConfig::default(), &Silent).unwrap()
}

fn around(half: f64, count: usize, seed: u64) -> Vec<Vec3> {
    scattered(Aabb { min: Vec3::splat(-half), max: Vec3::splat(half) }, count, seed)
}

#[test]
fn a_box_is_as_far_as_its_formula_says() {
    let bounds = Aabb { min: Vec3::new(-1.0, -0.5, -0.3), max: Vec3::new(1.0, 0.7, 0.4) };
    let points = around(2.0, 5000, 1);
    for (p, found) in points.iter().zip(distances(&field(cuboid(bounds)), &points)) {
        let q = (*p - bounds.center()).abs() - 0.5 * bounds.size();
        let expected = q.max(Vec3::ZERO).length() + q.max_element().min(0.0);
        assert!((found - expected).abs() < 1e-14, "{p}: {found}, not {expected}");
    }
}

#[test]
fn round_shapes_are_as_far_as_theirs_but_for_facets() {
    let points = around(1.6, 3000, 2);
    let off = |soup: TriangleSoup, truth: &dyn Fn(Vec3) -> f64| {
        let found = distances(&field(soup), &points);
        points.iter().zip(found).map(|(p, d)| (d - truth(*p)).abs()).fold(0.0, f64::max)
    };
    // Chords of an arc of an angle a lie within its sagitta, a² / 8 of the radius; those of triangles have two.
    let sphere_error = off(sphere(24), &|p| p.length() - 1.0);
    assert!(sphere_error < 2.0 * (1.6f64 / 24.0).powi(2) / 4.0, "{sphere_error}");
    let ring = |p: Vec3| (p.truncate().length() - 1.0).hypot(p.z) - 0.35;
    let torus_error = off(torus(1.0, 0.35, 120, 60), &ring);
    assert!(
        torus_error < 1.35 * (6.29f64 / 120.0).powi(2) / 8.0 + 0.35 * (6.29f64 / 60.0).powi(2) / 8.0,
        "{torus_error}"
    );
}

#[test]
fn damaged_shapes_are_as_far_as_their_nearest_triangle() {
    let soup = damaged(&torus(1.0, 0.4, 40, 20), 7);
    let field = field(soup.clone());
    let distance = SignedDistance::new(&field);
    let points = around(1.5, 400, 3);
    let inside = field.contains(&points, &Silent).unwrap();
    let closest = distance.closest(&points, &Silent).unwrap();
    let found = distance.distances(&points, &DistanceConfig::default(), &Silent).unwrap();
    for (i, p) in points.iter().enumerate() {
        let all = (0..soup.len()).map(|t| distance_to_triangle(*p, soup.corners(t)));
        let expected = all.fold(f64::INFINITY, f64::min);
        assert!((found[i].abs() - expected).abs() < 1e-14);
        assert_eq!(found[i] < 0.0, inside[i]);
        assert_eq!((closest[i].signed, found[i]), (found[i], distance.at(*p)));
        let near = closest[i].closest;
        let corners = soup.corners(near.element as usize);
        let weighed: Vec3 = corners.iter().zip(near.barycentric).map(|(c, w)| w * *c).sum();
        assert!(weighed.distance(near.point) < 1e-14);
        let is_zero = |k: u8| near.barycentric[k as usize] == 0.0;
        assert!(match near.feature {
            Feature::Face => !(is_zero(0) || is_zero(1) || is_zero(2)),
            Feature::Edge(k) => is_zero((k + 2) % 3) && !is_zero(k),
            Feature::Vertex(k) => near.barycentric[k as usize] == 1.0,
        });
        // One step along the gradient is one farther.
        let step = 1e-6 * closest[i].gradient;
        assert!((distance.at(*p + step) - found[i] - 1e-6).abs() < 1e-9 || expected < 1e-5);
    }
}

#[test]
fn signs_are_right_where_shapes_are_open_flipped_or_overlap() {
    let moved = |x: f64| {
        let sphere = sphere(20);
        TriangleSoup::new(
            sphere.positions().iter().map(|p| *p + x * Vec3::X).collect(),
            sphere.triangles().to_vec(),
        )
        .unwrap()
    };
    let ball = sphere(20);
    let low = |t: usize| ball.corners(t).iter().all(|p| p.z < -0.75);
    let few_flipped = |t: &[u32; 3], i: usize| if i.is_multiple_of(40) { [t[0], t[2], t[1]] } else { *t };
    let flips = ball.triangles().iter().enumerate().map(|(i, t)| few_flipped(t, i)).collect();
    let flipped = TriangleSoup::new(ball.positions().to_vec(), flips).unwrap();
    let of_ball = |p: Vec3| p.length() - 1.0;
    let of_two = |p: Vec3| (p - 0.4 * Vec3::X).length().min((p + 0.4 * Vec3::X).length()) - 1.0;
    let cases: [(TriangleSoup, &dyn Fn(Vec3) -> f64); 3] =
        [(without(&ball, low), &of_ball), (flipped, &of_ball), (joined(&[moved(-0.4), moved(0.4)]), &of_two)];
    for (soup, truth) in cases {
        let points: Vec<Vec3> = around(1.5, 2000, 4).into_iter().filter(|p| truth(*p).abs() > 0.1).collect();
        let found = distances(&field(soup), &points);
        // Below the opening's rim the field decides where the shape ends.
        let wrong = points.iter().zip(found).filter(|(p, d)| p.z > -0.7 && (*d < 0.0) != (truth(**p) < 0.0));
        assert_eq!(wrong.count(), 0);
    }
}

#[test]
fn on_the_surface_the_distance_is_zero_and_the_gradient_its_normal() {
    let soup = cube(1.0);
    let field = field(soup.clone());
    let on_faces: Vec<Vec3> =
        (0..12).map(|t| soup.corners(t).iter().sum::<Vec3>() / 4.0 + 0.25 * soup.corners(t)[0]).collect();
    let found = SignedDistance::new(&field).closest(&on_faces, &Silent).unwrap();
    for (t, near) in found.iter().enumerate() {
        assert_eq!((near.signed, near.signed.is_sign_positive()), (0.0, true));
        assert_eq!(near.gradient, area_vector(soup.corners(t)).normalize());
        assert_eq!((near.closest.element, near.closest.feature), (t as u32, Feature::Face));
    }
}

#[test]
fn bands_and_signs_are_as_asked_for() {
    let field = field(damaged(&sphere(10), 3));
    let distance = SignedDistance::new(&field);
    let points = around(1.5, 1000, 5);
    let with = |sign, band| distance.distances(&points, &DistanceConfig { sign, band }, &Silent).unwrap();
    let hard = with(DistanceSign::Hard, None);
    let length = |d: &f64| d.abs();
    assert_eq!(with(DistanceSign::None, None), hard.iter().map(length).collect::<Vec<_>>());
    let clamped: Vec<f64> = hard.iter().map(|d| d.clamp(-0.2, 0.2)).collect();
    assert_eq!(with(DistanceSign::Hard, Some(0.2)), clamped);
    let winding = field.evaluate(&points, Accuracy::EXACT, &Silent).unwrap();
    for ((smooth, hard), w) in with(DistanceSign::Smooth, None).iter().zip(&hard).zip(winding) {
        assert!((smooth - (1.0 - 2.0 * w) * hard.abs()).abs() < 3e-3 * hard.abs());
    }
}

#[test]
fn lattices_hold_what_single_points_have() {
    let soup = damaged(&torus(1.0, 0.4, 50, 25), 8);
    for shape in [Shape::from(soup), Shape::from(sphere_cloud(400))] {
        let field = field(shape);
        let distance = SignedDistance::new(&field);
        let bounds = field.bounds().padded(0.3);
        for counts in [[23, 18, 13], [9, 4, 1], [1, 1, 7]] {
            let lattice = Lattice::with_counts(bounds, counts).unwrap();
            let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
            for sign in [DistanceSign::Hard, DistanceSign::None] {
                for band in [None, Some(0.15)] {
                    let config = DistanceConfig { sign, band };
                    let grid = distance.lattice(&lattice, &config, &Silent).unwrap();
                    let singly = distance.distances(&points, &config, &Silent).unwrap();
                    assert_eq!(grid.values, singly.iter().map(|d| *d as f32).collect::<Vec<_>>());
                }
            }
        }
        let lattice = Lattice::with_counts(bounds, [11, 10, 9]).unwrap();
        let mut slabs = Vec::new();
        let mut store = |layers: std::ops::Range<usize>, values: &[f32]| {
            assert_eq!((layers.start, values.len()), (slabs.len() / 110, 110 * layers.len()));
            slabs.extend_from_slice(values);
        };
        distance.for_each_slab(&lattice, &DistanceConfig::default(), &Silent, &mut store).unwrap();
        assert_eq!(slabs, distance.lattice(&lattice, &DistanceConfig::default(), &Silent).unwrap().values);
    }
}

#[test]
fn any_number_of_threads_finds_the_same() {
    let field = field(damaged(&sphere(12), 3));
    let points = around(1.5, 3000, 6);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| SignedDistance::new(&field).closest(&points, &Silent).unwrap())
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn clouds_are_as_far_as_their_nearest_point() {
    let cloud = sphere_cloud(500);
    let points = around(1.5, 500, 7);
    let found = distances(&field(cloud.clone()), &points);
    for (p, d) in points.iter().zip(found) {
        let expected = cloud.points().iter().map(|c| c.distance(*p)).fold(f64::INFINITY, f64::min);
        assert!((d.abs() - expected).abs() < 1e-15);
        assert!((d < 0.0) == (p.length() < 1.0) || (p.length() - 1.0).abs() < 0.1);
    }
}

#[test]
fn bad_requests_have_their_errors_and_bad_points_nothing() {
    let ball = field(sphere(6));
    let distance = SignedDistance::new(&ball);
    let points = [Vec3::NAN, Vec3::ZERO, Vec3::INFINITY];
    for band in [None, Some(5.0)] {
        let config = DistanceConfig { band, ..DistanceConfig::default() };
        let found = distance.distances(&points, &config, &Silent).unwrap();
        assert!(found[0].is_nan() && found[2].is_nan() && found[1] < 0.0);
    }
    let closest = distance.closest(&points, &Silent).unwrap();
    assert!(closest[0].closest.distance.is_nan() && closest[0].gradient.is_nan() && closest[1].signed < 0.0);
    for band in [0.0, -1.0, f64::NAN] {
        let config = DistanceConfig { band: Some(band), ..DistanceConfig::default() };
        let refusal = distance.distances(&points, &config, &Silent).unwrap_err();
        assert!(matches!(refusal, DistanceError::BadBand(_)));
    }
    let empty = field(TriangleSoup::default());
    let of_empty = SignedDistance::new(&empty);
    assert_eq!(of_empty.closest(&points, &Silent), Err(DistanceError::EmptyShape));
    assert_eq!(of_empty.at(Vec3::ZERO), f64::INFINITY);
    let never: &dyn Monitor = &|_: f64, _: &str| false;
    let refusal = distance.distances(&points, &DistanceConfig::default(), never).unwrap_err();
    assert!(matches!(refusal, DistanceError::Field(FieldError::Cancelled(_))));
    let lattice = Lattice::with_counts(ball.bounds(), [8; 3]).unwrap();
    assert!(distance.lattice(&lattice, &DistanceConfig::default(), never).is_err());
}
