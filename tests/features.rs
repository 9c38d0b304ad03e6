//! Voxels, layers and surfaces against closed forms and against each other.
mod common;

use common::*;
use fast_winding::data::{Cancelled, Lattice, Layer, Shape, Silent, SurfaceMesh, TriangleSoup, signed_area};
use fast_winding::estimate::{self, EstimateConfig};
use fast_winding::math::{Aabb, Vec2, Vec3};
use fast_winding::slice::{LayerPlan, SampleAt, SliceConfig, SliceError, heat_map, slice};
use fast_winding::solid::{VoxelConfig, VoxelError, VoxelMethod, voxelize};
use fast_winding::surface::{SurfaceConfig, extract};
use fast_winding::winding::{Accuracy, FieldConfig, FieldError, WindingField};
use fast_winding::{OrientedCloud, PointCloud};
use std::collections::{HashMap, HashSet};
use std::f64::consts::{PI, TAU};

fn field(shape: impl Into<Shape>) -> WindingField {
    WindingField::new(shape, FieldConfig::default())
}

fn layers_of(field: &WindingField, count: usize) -> Vec<Layer> {
    let plan = LayerPlan { layer_height: field.bounds().size().z / count as f64, ..LayerPlan::default() };
    slice(field, &plan, &SliceConfig::default(), &Silent).unwrap()
}

/// The single layer at `z`.
fn layer_at(field: &WindingField, z: f64) -> Layer {
    slice(field, &LayerPlan::at(z), &SliceConfig::default(), &Silent).unwrap().remove(0)
}

fn perimeter(ring: &[Vec2]) -> f64 {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b)).sum()
}

/// Asserts that a mesh is closed, manifold and consistently oriented, and returns V − E + F.
fn euler_number(mesh: &SurfaceMesh) -> i64 {
    let directed: HashSet<(u32, u32)> =
        mesh.triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).collect();
    assert_eq!(directed.len(), 3 * mesh.triangles.len(), "an edge is used twice in one direction");
    assert!(directed.iter().all(|&(a, b)| directed.contains(&(b, a))), "an edge has one triangle only");
    let mut fans: HashMap<u32, Vec<(u32, u32)>> = HashMap::new();
    for t in &mesh.triangles {
        (0..3).for_each(|k| fans.entry(t[k]).or_default().push((t[(k + 1) % 3], t[(k + 2) % 3])));
    }
    for (vertex, fan) in &fans {
        let next: HashMap<u32, u32> = fan.iter().copied().collect();
        let (mut at, mut steps) = (fan[0].0, 0);
        while steps == 0 || at != fan[0].0 {
            (at, steps) = (next[&at], steps + 1);
        }
        assert_eq!(steps, fan.len(), "vertex {vertex} joins two fans");
    }
    fans.len() as i64 - directed.len() as i64 / 2 + mesh.triangles.len() as i64
}

#[test]
fn voxels_of_the_fast_field_equal_those_of_the_exact_one() {
    let open = without(&torus(1.0, 0.4, 60, 24), |t| t % 9 == 0);
    for shape in [Shape::from(open.clone()), Shape::from(barycentre_cloud(&open, 1))] {
        let field = field(shape);
        let lattice = Lattice::with_resolution(field.bounds(), 30).unwrap();
        let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
        let exact = field.evaluate_lattice(&lattice, Accuracy::EXACT, &Silent).unwrap();
        let expected: Vec<u8> = exact.values.iter().map(|w| u8::from(*w >= 0.5)).collect();
        assert_eq!(voxels.to_bytes().unwrap(), expected);
        assert_eq!(voxels.count(), expected.iter().filter(|v| **v == 1).count());
    }
}

#[test]
fn voxel_volume_approaches_the_solids() {
    let field = field(sphere(24));
    let lattice = Lattice::with_resolution(field.bounds(), 64).unwrap();
    let volume = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap().volume();
    assert!((volume / (4.0 / 3.0 * PI) - 1.0).abs() < 0.01, "{volume}");
}

#[test]
fn continuation_finds_the_same_voxels() {
    let bunny = bunny();
    let cloud = barycentre_cloud(&bunny, 4);
    for shape in [Shape::from(bunny), Shape::from(cloud)] {
        let field = field(shape);
        let lattice = Lattice::with_resolution(field.bounds(), 48).unwrap();
        let with =
            |method| voxelize(&field, &lattice, &VoxelConfig { method, threshold: 0.5 }, &Silent).unwrap();
        assert_eq!(with(VoxelMethod::Continuation), with(VoxelMethod::Lattice));
    }
}

#[test]
fn threshold_picks_out_the_overlap() {
    let other = cuboid(Aabb { min: Vec3::ZERO, max: Vec3::splat(2.0) });
    let field = field(joined(&[cube(1.0), other]));
    let lattice = Lattice::with_spacing(field.bounds(), 0.1).unwrap();
    let count = |threshold| {
        let config = VoxelConfig { threshold, method: VoxelMethod::Lattice };
        voxelize(&field, &lattice, &config, &Silent).unwrap().count()
    };
    assert_eq!((count(0.5), count(1.5), count(2.5)), (8000 + 8000 - 1000, 1000, 0));
    let bad = VoxelConfig { threshold: f64::NAN, ..VoxelConfig::default() };
    assert!(matches!(voxelize(&field, &lattice, &bad, &Silent), Err(VoxelError::BadThreshold(_))));
}

#[test]
fn voxel_surface_is_closed_without_duplicates() {
    let field = field(torus(1.0, 0.4, 60, 24));
    let lattice = Lattice::with_resolution(field.bounds(), 20).unwrap();
    let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
    let mesh = voxels.surface().unwrap();
    let places: HashSet<[u64; 3]> = mesh.positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    assert_eq!(places.len(), mesh.positions.len());
    let faces: HashSet<Vec<u32>> = (mesh.triangles.iter())
        .map(|t| {
            let mut corners = t.to_vec();
            corners.sort();
            corners
        })
        .collect();
    assert_eq!(faces.len(), mesh.triangles.len());
    let mut balance: HashMap<(u32, u32), i32> = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            *balance.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
        }
    }
    assert!(balance.values().all(|b| *b == 0));
    assert!((mesh.volume() - voxels.volume()).abs() < 1e-9);
}

#[test]
fn layers_of_a_sphere_have_its_areas_and_perimeters() {
    let field = field(sphere(64));
    let layers = layers_of(&field, 20);
    assert_eq!(layers.len(), 20);
    for layer in &layers {
        let squared_radius = 1.0 - layer.z_sample * layer.z_sample;
        assert_eq!(layer.polygons.len(), 1);
        // The inscribed polyhedron of 64² · 8 triangles is 1e-3 smaller.
        assert!((layer.area() / (PI * squared_radius) - 1.0).abs() < 4e-3, "{}", layer.area());
        let length = perimeter(&layer.polygons[0].outer);
        assert!((length / (TAU * squared_radius.sqrt()) - 1.0).abs() < 4e-3, "{length}");
    }
}

#[test]
fn rings_of_a_torus_nest() {
    let field = field(torus(1.0, 0.4, 200, 80));
    let layer = layer_at(&field, 0.013);
    assert_eq!((layer.polygons.len(), layer.polygons[0].holes.len()), (1, 1));
    let r = (0.16f64 - 0.013 * 0.013).sqrt();
    let expected = PI * ((1.0 + r) * (1.0 + r) - (1.0 - r) * (1.0 - r));
    assert!((layer.area() / expected - 1.0).abs() < 3e-3, "{} instead of {expected}", layer.area());
    assert!(signed_area(&layer.polygons[0].outer) > 0.0 && signed_area(&layer.polygons[0].holes[0]) < 0.0);
}

#[test]
fn a_box_with_a_missing_face_still_slices_to_a_square() {
    let open = without(&cube(1.0), |t| t < 2); // the face at x = −1
    let layer = layer_at(&field(open), 0.1);
    assert_eq!((layer.polygons.len(), layer.polygons[0].holes.len()), (1, 0));
    let outer = &layer.polygons[0].outer;
    let bounds = outer.iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |b, p| (b.0.min(*p), b.1.max(*p)));
    // Three sides are where the surface is; the fourth bulges through the plane of the missing face, where the square
    // takes up half of all directions only at the face itself.
    let cell = 2.0 / 256.0;
    assert!(
        (bounds.1.x - 1.0).abs() < cell && (bounds.1.y - 1.0).abs() < cell && (bounds.0.y + 1.0).abs() < cell
    );
    assert!((bounds.0.x + 1.0).abs() < 0.01, "the field is 1/2 on the missing face: {}", bounds.0.x);
    assert!((layer.area() - 4.0).abs() < 0.02, "{}", layer.area());
}

/// Whether two segments cross in a point inside both.
fn cross(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> bool {
    let side = |p: Vec2, q: Vec2, r: Vec2| (q - p).perp_dot(r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[test]
fn every_layer_of_the_bunny_is_simple() {
    let layers = layers_of(&field(bunny()), 40);
    let volume: f64 = layers.iter().map(|l| l.area() * (l.z_top - l.z_bottom)).sum();
    for layer in &layers {
        assert!(!layer.polygons.is_empty(), "the bunny has no gap at {}", layer.z_sample);
        let rings = layer.polygons.iter().flat_map(|p| std::iter::once(&p.outer).chain(&p.holes));
        let segments: Vec<(Vec2, Vec2)> =
            rings.flat_map(|ring| ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))).collect();
        for (i, &(a, b)) in segments.iter().enumerate() {
            assert!(segments[..i].iter().all(|&(c, d)| !cross(a, b, c, d)), "layer at {}", layer.z_sample);
        }
    }
    let bunny = field(bunny());
    let lattice = Lattice::with_resolution(bunny.bounds(), 64).unwrap();
    let voxels = voxelize(&bunny, &lattice, &VoxelConfig::default(), &Silent).unwrap().volume();
    assert!((volume / voxels - 1.0).abs() < 5e-3, "layers {volume}, voxels {voxels}");
}

#[test]
fn layers_are_sampled_where_asked_and_empty_ones_kept() {
    let gap =
        joined(&[cube(1.0), cuboid(Aabb { min: Vec3::new(-1.0, -1.0, 2.0), max: Vec3::new(1.0, 1.0, 3.0) })]);
    let field = field(gap);
    let plan = |sample_at| LayerPlan { layer_height: 0.5, sample_at, ..LayerPlan::default() };
    let areas = |sample_at| -> Vec<bool> {
        slice(&field, &plan(sample_at), &SliceConfig::default(), &Silent)
            .unwrap()
            .iter()
            .map(|l| l.area() > 3.0)
            .collect()
    };
    assert_eq!(areas(SampleAt::Middle), [true, true, true, true, false, false, true, true]);
    let bad = LayerPlan { layer_height: -1.0, ..LayerPlan::default() };
    assert!(matches!(slice(&field, &bad, &SliceConfig::default(), &Silent), Err(SliceError::Plan(_))));
}

#[test]
fn heat_map_shows_the_field_on_its_plane() {
    let field = field(cube(1.0));
    let map = heat_map(&field, 0.25, 48, &Silent).unwrap();
    assert_eq!(map.lattice.counts, [48, 48, 1]);
    for (index, w) in map.values.iter().enumerate() {
        let p = map.lattice.point(map.lattice.sample(index));
        assert_eq!(p.z, 0.25);
        let inside = p.abs().max_element() < 1.0;
        assert!((w - f64::from(u8::from(inside))).abs() < 1e-3, "{w} at {p}");
    }
}

fn surface(shape: impl Into<Shape>, resolution: usize) -> SurfaceMesh {
    extract(
        &field(shape),
        &SurfaceConfig { resolution: Some(resolution), ..SurfaceConfig::default() },
        &Silent,
    )
    .unwrap()
}

fn assert_volume(mesh: &SurfaceMesh, expected: f64) {
    assert!((mesh.volume() / expected - 1.0).abs() < 0.01, "{} instead of {expected}", mesh.volume());
}

#[test]
fn surface_of_a_sphere_cloud_is_a_sphere() {
    let mesh = surface(sphere_cloud(5000), 40);
    assert_eq!(euler_number(&mesh), 2);
    assert_volume(&mesh, 4.0 / 3.0 * PI);
}

#[test]
fn surface_of_a_torus_cloud_has_a_handle() {
    let mesh = surface(barycentre_cloud(&torus(1.0, 0.4, 160, 64), 1), 48);
    assert_eq!(euler_number(&mesh), 0);
    assert_volume(&mesh, 2.0 * PI * PI * 0.16);
}

#[test]
fn surface_of_an_open_torus_is_closed() {
    let mesh = surface(without(&torus(1.0, 0.4, 100, 40), |t| t % 400 < 6), 48);
    assert_eq!(euler_number(&mesh), 0);
    assert_volume(&mesh, 2.0 * PI * PI * 0.16);
}

#[test]
fn surface_of_the_bunnys_points_is_closed_and_has_its_volume() {
    // The bunny's points without areas or normals, as a scanner gives them.
    let bunny = bunny();
    let points = barycentre_cloud(&bunny, 2).points().to_vec();
    let (raw, _) = PointCloud::cleaned(points, None, None).unwrap();
    let (cloud, warnings) = estimate::orient(&raw, &EstimateConfig::default(), &Silent).unwrap();
    assert_eq!(warnings.len(), 1);
    let mesh = surface(cloud, 64);
    // One body without handles: the holes in the base are closed.
    assert_eq!(euler_number(&mesh), 2);
    let field = field(bunny);
    let lattice = Lattice::with_resolution(field.bounds(), 100).unwrap();
    let expected = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap().volume();
    assert_volume(&mesh, expected);
    assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-9));
}

#[test]
fn normals_of_a_raw_sphere_are_found_and_point_outward() {
    let truth = sphere_cloud(3000);
    let (raw, _) = PointCloud::cleaned(truth.points().to_vec(), None, None).unwrap();
    assert!(matches!(
        estimate::complete(&raw, &EstimateConfig::default(), &Silent),
        Err(estimate::EstimateError::MissingNormals { points: 3000 })
    ));
    let (cloud, _) = estimate::orient(&raw, &EstimateConfig::default(), &Silent).unwrap();
    assert!(cloud.points().iter().zip(cloud.normals()).all(|(p, n)| p.dot(*n) > 0.99));
    let total: f64 = cloud.areas().iter().sum();
    assert!((total / (4.0 * PI) - 1.0).abs() < 0.01, "{total}");
}

#[test]
fn awkward_clouds_are_completed() {
    let one = vec![Vec3::ONE];
    let equal = vec![Vec3::ONE; 30];
    let line: Vec<Vec3> = (0..30).map(|i| Vec3::X * f64::from(i)).collect();
    for points in [one, equal, line] {
        let (raw, _) = PointCloud::cleaned(points.clone(), None, None).unwrap();
        let (cloud, _) = estimate::orient(&raw, &EstimateConfig::default(), &Silent).unwrap();
        assert_eq!(cloud.len(), points.len());
        assert!(field(cloud).at(Vec3::new(0.3, 0.4, 0.5), Accuracy::default()).is_finite());
    }
    let none = OrientedCloud::default();
    assert!(extract(&field(none), &SurfaceConfig::default(), &Silent).is_err());
}

#[test]
fn every_long_job_stops_when_told_to() {
    let stop = |_: f64, _: &str| false;
    let soup: TriangleSoup = cube(1.0);
    let field = field(soup.clone());
    let lattice = Lattice::with_resolution(field.bounds(), 16).unwrap();
    let cancelled = FieldError::Cancelled(Cancelled);
    assert_eq!(field.evaluate(&[Vec3::ZERO], Accuracy::default(), &stop), Err(cancelled.clone()));
    assert_eq!(field.contains(&[Vec3::ZERO], &stop), Err(cancelled));
    assert!(voxelize(&field, &lattice, &VoxelConfig::default(), &stop).is_err());
    let continuation = VoxelConfig { method: VoxelMethod::Continuation, ..VoxelConfig::default() };
    assert!(voxelize(&field, &lattice, &continuation, &stop).is_err());
    assert!(slice(&field, &LayerPlan::default(), &SliceConfig::default(), &stop).is_err());
    assert!(heat_map(&field, 0.0, 8, &stop).is_err());
    assert!(extract(&field, &SurfaceConfig::default(), &stop).is_err());
    let (raw, _) = PointCloud::cleaned(soup.positions().to_vec(), None, None).unwrap();
    assert!(estimate::orient(&raw, &EstimateConfig::default(), &stop).is_err());
}
