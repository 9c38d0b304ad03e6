//! Surfaces of clouds and soups: closed, manifold, near the truth, trimmed, at levels that suit open scans.
mod common;

use common::*;
use fast_winding::data::{LatticeError, OrientedCloud, Silent, SurfaceMesh, TriangleSoup};
use fast_winding::levelset::TraceError;
use fast_winding::math::{Aabb, Vec3};
use fast_winding::metrics::NearestPoints;
use fast_winding::surface::{SurfaceConfig, SurfaceError, extract, suggested_level};
use fast_winding::winding::{FieldConfig, WindingField};
use std::f64::consts::PI;

fn field(shape: impl Into<fast_winding::data::Shape>) -> WindingField {
    WindingField::new(shape, FieldConfig::default())
}

fn surface_of(cloud: OrientedCloud, config: &SurfaceConfig) -> SurfaceMesh {
    extract(&field(cloud), config, &Silent).unwrap()
}

/// The part of a cloud for which `kept` holds.
fn part(cloud: &OrientedCloud, kept: impl Fn(Vec3) -> bool) -> OrientedCloud {
    let chosen: Vec<usize> = (0..cloud.len()).filter(|&i| kept(cloud.points()[i])).collect();
    OrientedCloud::new(
        chosen.iter().map(|&i| cloud.points()[i]).collect(),
        chosen.iter().map(|&i| cloud.normals()[i]).collect(),
        chosen.iter().map(|&i| cloud.areas()[i]).collect(),
    )
    .unwrap()
}

fn joined(a: &OrientedCloud, b: &OrientedCloud) -> OrientedCloud {
    OrientedCloud::new(
        [a.points(), b.points()].concat(),
        [a.normals(), b.normals()].concat(),
        [a.areas(), b.areas()].concat(),
    )
    .unwrap()
}

/// A sphere cloud of that radius around a centre.
fn ball(count: usize, radius: f64, center: Vec3) -> OrientedCloud {
    let unit = sphere_cloud(count);
    OrientedCloud::new(
        unit.points().iter().map(|p| center + radius * *p).collect(),
        unit.normals().to_vec(),
        unit.areas().iter().map(|a| radius * radius * a).collect(),
    )
    .unwrap()
}

#[test]
fn without_any_option_a_clouds_surface_is_as_fine_as_the_cloud() {
    let mesh = surface_of(sphere_cloud(5000), &SurfaceConfig::default());
    assert_eq!(topology(&mesh), (2, 0));
    // Three edges of the grid are crossed for two squares of a cell's edge, more or less: cells are 0.7 of the spacing.
    let expected = 1.5 * 5000.0 / (0.7 * 0.7);
    assert!((mesh.positions.len() as f64 / expected - 1.0).abs() < 0.15, "{}", mesh.positions.len());
    // The spacing is 0.05: the mean error is a hundredth of it, the largest next to points a tenth.
    let errors = mesh.positions.iter().map(|p| (p.length() - 1.0).abs());
    assert!(errors.clone().sum::<f64>() / (mesh.positions.len() as f64) < 5e-4);
    assert!(errors.fold(0.0, f64::max) < 5e-3);
    assert!((mesh.volume() / (4.0 / 3.0 * PI) - 1.0).abs() < 2e-3);
    assert!(mesh.positions.iter().zip(&mesh.normals).all(|(p, n)| p.dot(*n) > 0.9));
}

#[test]
fn the_bunnys_surface_is_manifold_and_near_its_points() {
    let cloud = barycentre_cloud(&bunny(), 2);
    let mesh = surface_of(cloud.clone(), &SurfaceConfig::default());
    assert_eq!(topology(&mesh).1, 0);
    let spacing = (cloud.areas().iter().sum::<f64>() / cloud.len() as f64).sqrt();
    let to_surface = NearestPoints::new(&mesh.positions).of(cloud.points());
    let farthest = to_surface.iter().map(|near| near.1).fold(0.0, f64::max);
    assert!(farthest < 2.0 * spacing, "{farthest} for a spacing of {spacing}");
}

#[test]
fn threads_change_no_bit() {
    let cloud = barycentre_cloud(&torus(1.0, 0.4, 90, 36), 1);
    let soup = without(&torus(1.0, 0.4, 30, 12), |t| t % 9 == 0);
    let coarse = SurfaceConfig { resolution: Some(16), ..SurfaceConfig::default() };
    let (cloud, soup) = (field(cloud), field(soup));
    let config = SurfaceConfig { trim: Some(3.0), smoothing: Some(1.0), ..SurfaceConfig::default() };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let of_cloud = extract(&cloud, &SurfaceConfig::default(), &Silent).unwrap();
            let trimmed = extract(&cloud, &config, &Silent).unwrap();
            (of_cloud, trimmed, extract(&soup, &coarse, &Silent).unwrap())
        })
    };
    assert_eq!(on(1), on(2));
}

#[test]
fn a_small_piece_far_from_the_large_one_is_found_and_can_be_dropped() {
    let two = joined(&ball(4000, 1.0, Vec3::ZERO), &ball(300, 0.2, Vec3::new(3.0, 0.0, 0.0)));
    let keep = |share: f64| {
        let config = SurfaceConfig { min_component: Some(share), ..SurfaceConfig::default() };
        let mesh = surface_of(two.clone(), &config);
        let near = mesh.positions.iter().filter(|p| p.x < 2.0).count();
        (topology(&mesh).0, near == mesh.positions.len())
    };
    // Its area is a 25th of the large one's.
    assert_eq!((keep(0.0), keep(0.03)), ((4, false), (4, false)));
    assert_eq!((keep(0.05), keep(1.0)), ((2, true), (2, true)));
}

#[test]
fn pieces_of_soups_are_dropped_too() {
    let small = cuboid(Aabb { min: Vec3::splat(5.0), max: Vec3::splat(5.5) });
    let soup = both(&cube(1.0), &small);
    let config = SurfaceConfig { min_component: Some(0.5), ..SurfaceConfig::default() };
    let all = extract(&field(soup.clone()), &SurfaceConfig::default(), &Silent).unwrap();
    let large = extract(&field(soup), &config, &Silent).unwrap();
    assert_eq!((topology(&all), topology(&large)), ((4, 0), (2, 0)));
}

fn both(a: &TriangleSoup, b: &TriangleSoup) -> TriangleSoup {
    let first = a.positions().len() as u32;
    let moved = b.triangles().iter().map(|t| t.map(|v| v + first));
    let triangles = a.triangles().iter().copied().chain(moved).collect();
    TriangleSoup::new([a.positions(), b.positions()].concat(), triangles).unwrap()
}

#[test]
fn at_a_level_above_one_only_what_lies_in_two_bodies_is_left_of_a_soup() {
    let inner = Aabb { min: Vec3::splat(-0.4), max: Vec3::splat(0.3) };
    let nested = field(both(&cube(1.0), &cuboid(inner)));
    let volume = |level: f64| {
        let config = SurfaceConfig { level: Some(level), resolution: Some(50), ..SurfaceConfig::default() };
        let mesh = extract(&nested, &config, &Silent).unwrap();
        assert_eq!(topology(&mesh), (2, 0));
        mesh.volume()
    };
    // Cells cut the corners of a cube.
    assert!((volume(0.5) / 8.0 - 1.0).abs() < 0.01);
    assert!((volume(1.5) / 0.7f64.powi(3) - 1.0).abs() < 0.03);
}

#[test]
fn levels_suggested_for_closed_shapes_are_a_half() {
    let level = |shape: fast_winding::data::Shape| suggested_level(&field(shape), &Silent).unwrap();
    assert!((level(sphere_cloud(5000).into()) - 0.5).abs() < 0.01);
    assert!((level(torus(1.0, 0.4, 60, 24).into()) - 0.5).abs() < 1e-9);
    // Two spheres, one within the other: the principal values are 1/2 and 3/2, most of the area is outside.
    let nested = joined(&ball(4000, 1.0, Vec3::ZERO), &ball(1000, 0.5, Vec3::ZERO));
    assert!((level(nested.into()) - 0.5).abs() < 0.01);
}

#[test]
fn two_points_that_nearly_coincide_do_not_move_the_level() {
    let sphere = sphere_cloud(3000);
    let near = part(&sphere, |p| p.z > 0.3);
    let shifted: Vec<Vec3> = near.points().iter().map(|p| 1.000001 * *p).collect();
    let doubled = joined(
        &sphere,
        &OrientedCloud::new(shifted, near.normals().to_vec(), near.areas().to_vec()).unwrap(),
    );
    let values: Vec<f64> = suggested_level(&field(doubled), &Silent).into_iter().collect();
    assert!(values[0] > 0.3 && values[0] < 1.0, "{values:?}");
}

#[test]
fn at_the_suggested_level_the_surface_of_half_a_sphere_passes_through_its_points() {
    // Seen from the points of the upper half, the opening takes up part of the solid angle: w is 1/2 less that.
    let half = part(&sphere_cloud(8000), |p| p.z > 0.0);
    let level = suggested_level(&field(half.clone()), &Silent).unwrap();
    assert!((0.1..0.4).contains(&level), "{level}");
    let distance = |level: Option<f64>| {
        let config = SurfaceConfig { level, trim: Some(3.0), ..SurfaceConfig::default() };
        let mesh = surface_of(half.clone(), &config);
        let errors = mesh.positions.iter().filter(|p| p.z > 0.2).map(|p| (p.length() - 1.0).abs());
        errors.clone().sum::<f64>() / errors.count() as f64
    };
    let (suggested, plain) = (distance(None), distance(Some(0.5)));
    assert!(suggested < 0.5 * plain, "{suggested} at {level}, {plain} at 1/2");
}

#[test]
fn a_trimmed_surface_is_open_and_keeps_to_its_points() {
    let half = part(&sphere_cloud(8000), |p| p.z > 0.0);
    let spacing = (4.0 * PI / 8000.0f64).sqrt();
    let config = SurfaceConfig { level: None, trim: Some(2.0), ..SurfaceConfig::default() };
    let mesh = surface_of(half.clone(), &config);
    // A disk has V − E + F = 1: one piece with one rim, about as long as the equator.
    let (euler, open) = topology(&mesh);
    assert_eq!(euler, 1);
    assert!(open > 0);
    let near = NearestPoints::new(half.points()).of(&mesh.positions);
    assert!(near.iter().all(|(_, distance)| *distance <= 2.1 * spacing));
    let closed = surface_of(half, &SurfaceConfig { trim: None, ..config });
    assert_eq!(topology(&closed), (2, 0));
    assert!(closed.triangles.len() > mesh.triangles.len());
}

#[test]
fn a_flat_scan_has_a_trimmed_surface() {
    // w is 0 on it, and the level set of 0 is the whole plane.
    let points: Vec<Vec3> = (0..900).map(|i| Vec3::new((i % 30) as f64, (i / 30) as f64, 0.0)).collect();
    let flat = OrientedCloud::new(points, vec![Vec3::Z; 900], vec![1.0; 900]).unwrap();
    let config = SurfaceConfig { level: None, trim: Some(1.5), ..SurfaceConfig::default() };
    let mesh = surface_of(flat.clone(), &config);
    assert_eq!(topology(&mesh).0, 1);
    assert!(mesh.positions.iter().all(|p| p.z.abs() < 0.05), "it is where the points are");
    let area = 0.5 * mesh.triangles.iter().map(|t| double_area(&mesh, t)).sum::<f64>();
    assert!((29.0 * 29.0..33.0 * 33.0).contains(&area), "{area}");
    let untrimmed = SurfaceConfig { trim: None, level: Some(0.0), ..config };
    assert_eq!(extract(&field(flat), &untrimmed, &Silent), Err(SurfaceError::BadLevel(0.0)));
}

fn double_area(mesh: &SurfaceMesh, t: &[u32; 3]) -> f64 {
    let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
    (b - a).cross(c - a).length()
}

#[test]
fn a_piece_that_passes_no_points_cell_is_found() {
    // At a level near 1 the surface lies within the points, by about as much as they are apart.
    let config = SurfaceConfig { level: Some(0.98), spacing: Some(0.02), ..SurfaceConfig::default() };
    let mesh = surface_of(sphere_cloud(1500), &config);
    let (least, most) = mesh
        .positions
        .iter()
        .fold((f64::MAX, 0.0f64), |(low, high), p| (low.min(p.length()), high.max(p.length())));
    assert!(mesh.positions.len() > 10_000 && most < 1.0 + 0.09 && least > 0.8, "{least} to {most}");
}

/// A sphere cloud whose points are moved along their normals by up to `noise` either way.
fn noisy_sphere(count: usize, noise: f64) -> OrientedCloud {
    let sphere = sphere_cloud(count);
    let mut next = random(3);
    let moved = sphere.points().iter().map(|p| (1.0 + noise * (2.0 * next() - 1.0)) * *p).collect();
    OrientedCloud::new(moved, sphere.normals().to_vec(), sphere.areas().to_vec()).unwrap()
}

#[test]
fn smoothing_takes_noise_away_and_leaves_curved_surfaces_in_place() {
    // Points are 0.04 apart; noise is up to 0.03.
    let surface = |noise: f64, smoothing: Option<f64>| {
        let mesh =
            surface_of(noisy_sphere(8000, noise), &SurfaceConfig { smoothing, ..SurfaceConfig::default() });
        let radii: Vec<f64> = mesh.positions.iter().map(|p| p.length()).collect();
        let mean = radii.iter().sum::<f64>() / radii.len() as f64;
        let spread = radii.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / radii.len() as f64;
        let tilt = mesh.positions.iter().zip(&mesh.normals).map(|(p, n)| p.normalize().dot(*n)).sum::<f64>();
        (topology(&mesh), mean, spread.sqrt(), tilt / radii.len() as f64)
    };
    let (rough, smooth) = (surface(0.03, None), surface(0.03, Some(1.0)));
    assert_eq!(smooth.0, (2, 0));
    assert!(smooth.2 < 0.6 * rough.2, "{smooth:?} {rough:?}");
    assert!(1.0 - smooth.3 < 0.2 * (1.0 - rough.3), "{smooth:?} {rough:?}");
    // A Gaussian alone would move it by its variance, 0.0016.
    let clean = surface(0.0, Some(1.0));
    assert!((clean.1 - 1.0).abs() < 4e-4, "{clean:?}");
}

#[test]
fn smoothed_surfaces_are_trimmed_too() {
    let half = part(&noisy_sphere(8000, 0.01), |p| p.z > 0.0);
    let config = SurfaceConfig { trim: Some(2.0), smoothing: Some(1.0), ..SurfaceConfig::default() };
    let (euler, open) = topology(&surface_of(half, &config));
    assert_eq!(euler, 1);
    assert!(open > 50, "{open}");
}

#[test]
fn options_out_of_range_are_told_apart() {
    let cloud = field(sphere_cloud(200));
    let with = |config: SurfaceConfig| extract(&cloud, &config, &Silent).unwrap_err();
    let default = SurfaceConfig::default();
    assert_eq!(with(SurfaceConfig { level: Some(0.0), ..default }), SurfaceError::BadLevel(0.0));
    assert!(matches!(with(SurfaceConfig { level: Some(f64::NAN), ..default }), SurfaceError::BadLevel(_)));
    assert_eq!(with(SurfaceConfig { min_component: Some(1.5), ..default }), SurfaceError::BadShare(1.5));
    assert_eq!(with(SurfaceConfig { trim: Some(0.0), ..default }), SurfaceError::BadTrim(0.0));
    let lattice = |config| match with(config) {
        SurfaceError::Lattice(error) => error,
        error => panic!("{error}"),
    };
    assert_eq!(lattice(SurfaceConfig { spacing: Some(-1.0), ..default }), LatticeError::BadSpacing(-1.0));
    assert_eq!(lattice(SurfaceConfig { resolution: Some(0), ..default }), LatticeError::BadResolution(0.0));
    let too_many = lattice(SurfaceConfig { resolution: Some(100_000), ..default });
    assert!(matches!(too_many, LatticeError::TooMany(_)), "{too_many}");
    let soup = field(cube(1.0));
    let trimmed = SurfaceConfig { trim: Some(1.0), ..default };
    assert_eq!(extract(&soup, &trimmed, &Silent), Err(SurfaceError::OnlyOfClouds("trimmed")));
    let smooth = SurfaceConfig { smoothing: Some(1.0), ..default };
    assert_eq!(extract(&soup, &smooth, &Silent), Err(SurfaceError::OnlyOfClouds("smoothed")));
    assert_eq!(with(SurfaceConfig { smoothing: Some(-1.0), ..default }), SurfaceError::BadSmoothing(-1.0));
    let narrow = with(SurfaceConfig { spacing: Some(0.01), ..smooth });
    assert!(matches!(narrow, SurfaceError::SmallCells { spacing: 0.01, .. }), "{narrow}");
    let stop = |fraction: f64, stage: &str| !(stage == "surface vertices" && fraction > 0.0);
    let cancelled = SurfaceError::Trace(TraceError::Cancelled(fast_winding::data::Cancelled));
    assert_eq!(extract(&cloud, &default, &stop), Err(cancelled));
}

#[test]
fn points_in_one_place_or_on_a_line_have_some_surface_or_none() {
    for points in [vec![Vec3::ONE], vec![Vec3::ONE; 20], (0..40).map(|i| f64::from(i) * Vec3::X).collect()] {
        let count = points.len();
        let cloud = OrientedCloud::new(points, vec![Vec3::Z; count], vec![1.0; count]).unwrap();
        topology(&surface_of(cloud, &SurfaceConfig::default()));
    }
}
