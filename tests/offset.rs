//! Offset surfaces and hollow shapes: closed, manifold, at their distance, with the volumes that geometry gives them.
mod common;

use common::*;
use fast_winding::data::{LatticeError, OrientedCloud, Silent, SurfaceMesh, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::solid::{DistanceConfig, SignedDistance};
use fast_winding::surface::{
    Drain, HollowConfig, OffsetConfig, OffsetError, SurfaceConfig, SurfaceError, hollow, offset,
};
use fast_winding::winding::{FieldConfig, WindingField};
use std::f64::consts::PI;

fn field(shape: impl Into<fast_winding::data::Shape>) -> WindingField {
    WindingField::new(shape, FieldConfig::default())
}

fn offset_of(field: &WindingField, distance: f64, spacing: f64, sharp: Option<f64>) -> SurfaceMesh {
    offset(field, &OffsetConfig { distance, spacing: Some(spacing), sharp, resolution: None }, &Silent)
        .unwrap()
}

/// Largest difference of the signed distance at the vertices from `expected`.
fn largest_error(field: &WindingField, mesh: &SurfaceMesh, expected: f64) -> f64 {
    let found =
        SignedDistance::new(field).distances(&mesh.positions, &DistanceConfig::default(), &Silent).unwrap();
    found.iter().map(|d| (d - expected).abs()).fold(0.0, f64::max)
}

/// What chords of cells of that size cut off a surface with at least that radius of curvature.
fn sagitta(spacing: f64, radius: f64) -> f64 {
    3.0 * spacing * spacing / (8.0 * radius)
}

#[test]
fn a_cube_grows_as_steiner_says() {
    let cube = field(cube(1.0));
    let (d, spacing) = (0.5, 0.05);
    let mesh = offset_of(&cube, d, spacing, None);
    assert_eq!(topology(&mesh), (2, 0));
    assert!(largest_error(&cube, &mesh, d) < 1e-5 * spacing + 1e-9);
    // Volume, area times d, mean width, ball.
    let steiner = 8.0 + 24.0 * d + 24.0 * PI / 4.0 * d * d + 4.0 / 3.0 * PI * d.powi(3);
    let round = 24.0 * PI / 2.0 * d + 4.0 * PI * d * d;
    let lost = steiner - mesh.volume();
    assert!(lost > 0.0 && lost < round * sagitta(spacing, d), "{lost}");
    assert!(mesh.positions.iter().zip(&mesh.normals).all(|(p, n)| p.dot(*n) > 0.0));
}

#[test]
fn a_cube_shrinks_to_a_cube_with_its_edges() {
    let cube = field(cube(1.0));
    let (d, spacing) = (-0.31f64, 0.07);
    let volume = 8.0 * (1.0 + d).powi(3);
    let rough = offset_of(&cube, d, spacing, None);
    assert_eq!(topology(&rough), (2, 0));
    assert!(largest_error(&cube, &rough, d) < 1e-5 * spacing + 1e-9);
    let sharp = offset_of(&cube, d, spacing, Some(SurfaceConfig::SHARP));
    assert_eq!(topology(&sharp), (2, 0));
    assert!(largest_error(&cube, &sharp, d) < 1e-3 * spacing);
    let (lost, left) = (volume - rough.volume(), (volume - sharp.volume()).abs());
    assert!(lost > 1e-3 * volume && left < 1e-4 * volume, "{lost} {left} of {volume}");
    let corner = Vec3::splat(1.0 + d);
    assert!(sharp.positions.iter().any(|p| p.distance(corner) < 1e-3 * spacing));
}

#[test]
fn a_sphere_stays_one_either_way() {
    let sphere = field(sphere(24));
    let spacing = 0.06;
    for d in [-0.4, 0.0, 0.5] {
        let mesh = offset_of(&sphere, d, spacing, None);
        assert_eq!(topology(&mesh), (2, 0));
        assert!(largest_error(&sphere, &mesh, d) < 1e-5 * spacing + 1e-9);
        // The sphere's own facets cut off a little.
        let (radius, facet) = (1.0 + d, 0.003);
        let low = 4.0 / 3.0 * PI * (radius - facet - sagitta(spacing, radius)).powi(3);
        let high = 4.0 / 3.0 * PI * radius.powi(3);
        assert!((low..=high).contains(&mesh.volume()), "{d}: {} of {high}", mesh.volume());
    }
}

#[test]
fn offsets_strictly_contain_what_they_are_made_of() {
    let spacing = 0.05;
    let cloud = sphere_cloud(300);
    let noisy: Vec<Vec3> =
        cloud.points().iter().zip(scattered(cube(0.1).bounds(), 300, 3)).map(|(p, s)| *p + s).collect();
    let noisy = OrientedCloud::new(noisy, cloud.normals().to_vec(), cloud.areas().to_vec()).unwrap();
    let open = without(&torus(1.0, 0.4, 60, 30), |t| t % 7 == 0);
    for shape in [field(cloud), field(noisy), field(open)] {
        // Points are 0.2 apart.
        let d = 0.3;
        let mesh = offset_of(&shape, d, spacing, None);
        assert_eq!(topology(&mesh).1, 0);
        let grown = field(TriangleSoup::from(mesh));
        let around = SignedDistance::new(&grown);
        let held: Vec<Vec3> = match shape.shape() {
            fast_winding::data::Shape::Soup(soup) => soup.positions().to_vec(),
            fast_winding::data::Shape::Cloud(cloud) => cloud.points().to_vec(),
        };
        let depths = around.distances(&held, &DistanceConfig::default(), &Silent).unwrap();
        let shallowest = depths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!(shallowest < -(d - 2.0 * sagitta(spacing, d)), "{shallowest}");
    }
}

#[test]
fn open_and_flipped_shapes_have_closed_offsets() {
    let damaged = field(damaged(&sphere(16), 5));
    for d in [-0.2, 0.1] {
        let mesh = offset_of(&damaged, d, 0.05, None);
        assert_eq!(topology(&mesh).1, 0, "{d}");
        assert!(
            (mesh.volume() / (4.0 / 3.0 * PI * (1.0 + d).powi(3)) - 1.0).abs() < 0.1,
            "{d}: {}",
            mesh.volume()
        );
    }
}

#[test]
fn parts_far_apart_are_all_found() {
    let ball = |center: Vec3| {
        let ball = sphere(6);
        let moved = ball.positions().iter().map(|p| 0.1 * *p + center).collect();
        TriangleSoup::new(moved, ball.triangles().to_vec()).unwrap()
    };
    let centers = [[0.0; 3], [9.0, 1.0, 0.0], [3.0, -7.0, 2.0], [4.0, 4.0, 6.0]];
    let all = field(joined(&centers.map(|c| ball(Vec3::from_array(c)))));
    for (d, spacing) in [(0.2, 0.1), (-0.03, 0.02)] {
        assert_eq!(topology(&offset_of(&all, d, spacing, None)), (2 * centers.len() as i64, 0));
    }
}

#[test]
fn a_hollow_cube_has_the_volume_of_its_walls() {
    let (cube, spacing) = (field(cube(1.0)), 0.06);
    let config =
        HollowConfig { thickness: 0.3, spacing: Some(spacing), sharp: Some(35.0), ..HollowConfig::default() };
    let mesh = hollow(&cube, &config, &Silent).unwrap();
    // Two shells.
    assert_eq!(topology(&mesh), (4, 0));
    let walls = 8.0 - 8.0 * 0.7f64.powi(3);
    assert!((mesh.volume() - walls).abs() < 1e-3 * walls, "{}", mesh.volume());
    // A drain through the top joins them.
    let drain = Drain { at: Vec3::new(0.1, 0.0, 1.5), direction: Vec3::NEG_Z, radius: 0.2 };
    let drained = hollow(&cube, &HollowConfig { drains: vec![drain], ..config.clone() }, &Silent).unwrap();
    assert_eq!(topology(&drained), (2, 0));
    let taken = mesh.volume() - drained.volume();
    assert!((taken / (PI * 0.04 * 0.3) - 1.0).abs() < 0.1, "{taken}");
    // From within the wall, and askew; two make a handle.
    let askew = Drain { at: Vec3::new(-0.9, 0.0, 0.0), direction: Vec3::new(2.0, 0.3, 0.0), radius: 0.15 };
    let both = hollow(&cube, &HollowConfig { drains: vec![drain, askew], ..config }, &Silent).unwrap();
    assert_eq!(topology(&both), (0, 0));
}

#[test]
fn open_soups_get_walls_where_they_are_open() {
    let capless = field(without(&cube(1.0), |t| t == 3));
    let config = HollowConfig { thickness: 0.25, spacing: Some(0.06), ..HollowConfig::default() };
    let mesh = hollow(&capless, &config, &Silent).unwrap();
    assert_eq!(topology(&mesh), (4, 0));
    assert!(field(TriangleSoup::from(mesh)).contains_point(Vec3::new(0.9, 0.0, 0.0)));
}

#[test]
fn impossible_requests_are_refused() {
    let (ball, empty) = (field(sphere(8)), field(TriangleSoup::default()));
    let config = OffsetConfig { distance: -1.5, ..OffsetConfig::default() };
    let refusal = |field: &WindingField, config: OffsetConfig| offset(field, &config, &Silent).unwrap_err();
    assert_eq!(refusal(&ball, config), OffsetError::NothingLeft(-1.5));
    assert_eq!(refusal(&empty, config), OffsetError::from(LatticeError::EmptyBounds));
    let far = OffsetConfig { distance: f64::INFINITY, ..config };
    assert_eq!(refusal(&ball, far), OffsetError::BadDistance(f64::INFINITY));
    assert_eq!(
        refusal(&ball, OffsetConfig { resolution: Some(0), ..config }),
        LatticeError::BadResolution(0.0).into()
    );
    assert_eq!(
        refusal(&ball, OffsetConfig { spacing: Some(-1.0), ..config }),
        LatticeError::BadSpacing(-1.0).into()
    );
    assert_eq!(
        refusal(&ball, OffsetConfig { sharp: Some(5.0), ..config }),
        SurfaceError::BadSharp(5.0).into()
    );
    let fine = OffsetConfig { distance: 0.1, spacing: Some(1e-6), ..config };
    assert!(matches!(
        refusal(&ball, fine),
        OffsetError::Surface(SurfaceError::Lattice(LatticeError::TooMany(_)))
    ));
    let cancelled = offset(&ball, &OffsetConfig { distance: 0.1, ..config }, &|_: f64, _: &str| false);
    assert!(cancelled.is_err());

    let drain = Drain { at: Vec3::new(0.0, 0.0, 2.0), direction: Vec3::NEG_Z, radius: 0.2 };
    let config = HollowConfig { thickness: 0.2, ..HollowConfig::default() };
    let with = |drain: Drain| HollowConfig { drains: vec![drain], ..config.clone() };
    let refusal = |config: HollowConfig| hollow(&ball, &config, &Silent).unwrap_err();
    assert_eq!(refusal(HollowConfig { thickness: 0.0, ..config.clone() }), OffsetError::BadThickness(0.0));
    assert_eq!(refusal(HollowConfig { thickness: 1.1, ..config.clone() }), OffsetError::NoCavity(1.1));
    let thin = OffsetError::ThinWall { thickness: 0.2, spacing: 0.15 };
    assert_eq!(refusal(HollowConfig { spacing: Some(0.15), ..config.clone() }), thin);
    assert_eq!(refusal(with(Drain { at: Vec3::new(5.0, 0.0, 0.0), ..drain })), OffsetError::DrainMisses(0));
    assert_eq!(refusal(with(Drain { direction: Vec3::Z, ..drain })), OffsetError::DrainMisses(0));
    assert_eq!(refusal(with(Drain { direction: Vec3::ZERO, ..drain })), OffsetError::BadDrain(0));
    assert!(matches!(
        refusal(with(Drain { radius: 0.01, ..drain })),
        OffsetError::SmallDrain { drain: 0, .. }
    ));
}

#[test]
fn any_number_of_threads_makes_the_same_surface() {
    let bounds = Aabb { min: Vec3::ZERO, max: Vec3::new(1.0, 2.0, 0.5) };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| offset_of(&field(cuboid(bounds)), 0.2, 0.07, Some(35.0)))
    };
    assert_eq!(with(1), with(3));
}
