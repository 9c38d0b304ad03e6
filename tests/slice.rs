//! Contours beside the field they come from, sampled in their planes, and beside sections known by other means.
mod common;

use common::*;
use fast_winding::data::{Layer, Polygon, Shape, Silent, TriangleSoup, signed_area};
use fast_winding::math::{Aabb, Mat3, Vec2, Vec3, distance_to_triangle};
use fast_winding::polygon::{Fill, enclosed, surrounds};
use fast_winding::slice::{LayerPlan, SliceConfig, SliceMode, SliceReport, slice, slice_each};
use fast_winding::winding::WindingField;

fn field(shape: impl Into<Shape>) -> WindingField {
    WindingField::new(shape, Default::default())
}

fn turned(soup: &TriangleSoup) -> TriangleSoup {
    let turn = Mat3::from_rotation_z(0.7) * Mat3::from_rotation_x(0.5) * Mat3::from_rotation_y(0.3);
    let positions = soup.positions().iter().map(|p| turn * *p).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
}

fn stack(field: &WindingField, count: usize, config: &SliceConfig) -> (Vec<Layer>, SliceReport) {
    let height = field.bounds().size().z / count as f64;
    let plan = LayerPlan { layer_height: height, ..LayerPlan::default() };
    let mut layers = Vec::new();
    let report = slice_each(field, &plan, config, &Silent, &mut |_, layer| layers.push(layer)).unwrap();
    (layers, report)
}

fn at(field: &WindingField, z: f64) -> Layer {
    slice(field, &LayerPlan::at(z), &SliceConfig::default(), &Silent).unwrap().remove(0)
}

fn rings(layer: &Layer) -> impl Iterator<Item = &Vec<Vec2>> {
    layer.polygons.iter().flat_map(|p| std::iter::once(&p.outer).chain(&p.holes))
}

fn within(layer: &Layer, p: Vec2) -> bool {
    let inside = |polygon: &Polygon| {
        surrounds(&polygon.outer, p) && !polygon.holes.iter().any(|hole| surrounds(hole, p))
    };
    layer.polygons.iter().any(inside)
}

fn distance_to_contour(layer: &Layer, p: Vec2) -> f64 {
    let to_side = |(a, b): (&Vec2, &Vec2)| {
        let along = *b - *a;
        let share = ((p - *a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        p.distance(*a + share * along)
    };
    let sides = rings(layer).flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    sides.map(to_side).fold(f64::INFINITY, f64::min)
}

/// Points in the planes of layers are inside their polygons if and only if they are inside the field.
fn assert_layers_are_the_fields(field: &WindingField, layers: &[Layer], what: &str) {
    let bounds = field.bounds();
    let margin = 0.2 * bounds.size();
    let around = Aabb { min: bounds.min - margin, max: bounds.max + margin };
    for (k, layer) in layers.iter().enumerate() {
        let points: Vec<Vec3> =
            scattered(around, 600, 7 + k as u64).iter().map(|p| p.with_z(layer.z_sample)).collect();
        let inside = field.contains(&points, &Silent).unwrap();
        for (p, inside) in points.iter().zip(inside) {
            let p = p.truncate();
            if within(layer, p) != inside {
                let distance = distance_to_contour(layer, p);
                assert!(
                    distance < 1e-4 * bounds.size().max_element(),
                    "{what}: {p} at {} is {inside}, {distance} from the contour",
                    layer.z_sample
                );
            }
        }
        assert_simple(layer, what);
    }
}

fn assert_simple(layer: &Layer, what: &str) {
    for polygon in &layer.polygons {
        assert!(signed_area(&polygon.outer) > 0.0, "{what}: outlines run counter-clockwise");
        for hole in &polygon.holes {
            assert!(signed_area(hole) < 0.0 && surrounds(&polygon.outer, hole[0]), "{what}: holes");
        }
    }
    let side = |p: Vec2, q: Vec2, r: Vec2| (q - p).perp_dot(r - p);
    let segments: Vec<(Vec2, Vec2)> = rings(layer)
        .flat_map(|ring| ring.iter().copied().zip(ring.iter().copied().cycle().skip(1)))
        .collect();
    for (i, &(a, b)) in segments.iter().enumerate() {
        for &(c, d) in &segments[..i] {
            let cross = side(a, b, c) * side(a, b, d) < -1e-24 && side(c, d, a) * side(c, d, b) < -1e-24;
            assert!(!cross, "{what}: {a} {b} crosses {c} {d} at {}", layer.z_sample);
        }
    }
}

fn assert_on_surface(soup: &TriangleSoup, layer: &Layer) {
    let size = soup.bounds().size().max_element();
    for p in rings(layer).flatten() {
        let p = p.extend(layer.z_sample);
        let distance = |t: usize| distance_to_triangle(p, soup.corners(t));
        let nearest = (0..soup.len()).map(distance).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9 * size, "{p} is {nearest} off the surface");
    }
}

#[test]
fn sections_of_closed_soups_are_exact() {
    let shapes = [
        ("turned cube", turned(&cube(1.0))),
        ("turned torus", turned(&torus(1.0, 0.4, 40, 20))),
        ("cubes that overlap", joined(&[turned(&cube(1.0)), cube(0.9)])),
        ("a hollow", joined(&[cube(1.0), flipped(&turned(&cube(0.4)))])),
        ("twice the same", joined(&[turned(&cube(1.0)), turned(&cube(1.0))])),
        ("inside out", flipped(&turned(&cube(1.0)))),
    ];
    for (what, soup) in shapes {
        let field = field(soup.clone());
        let (layers, _) = stack(&field, 9, &SliceConfig::default());
        assert_layers_are_the_fields(&field, &layers, what);
        layers.iter().for_each(|layer| assert_on_surface(&soup, layer));
        assert_eq!(layers.iter().any(|layer| layer.area() > 0.1), what != "inside out");
    }
}

#[test]
fn corners_of_a_cube_stay_sharp() {
    let soup = cube(1.0);
    let turn = Mat3::from_rotation_z(0.3);
    let positions = soup.positions().iter().map(|p| turn * *p).collect();
    let layer = at(&field(TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()), 0.25);
    for corner in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        let corner = (turn * Vec3::new(corner.0, corner.1, 0.25)).truncate();
        let nearest =
            layer.polygons[0].outer.iter().map(|p| p.distance(corner)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-12, "{nearest}");
    }
    assert!((layer.area() - 4.0).abs() < 1e-12);
}

#[test]
fn contours_of_open_soups_are_the_fields() {
    let tube = without(&cube(1.0), |t| t / 2 == 4 || t / 2 == 5);
    let shapes = [
        ("a turned box without a face", turned(&without(&cube(1.0), |t| t < 2))),
        ("a turned box without a triangle", turned(&without(&cube(1.0), |t| t == 3))),
        ("a turned tube", turned(&tube)),
        ("a torus with holes", turned(&without(&torus(1.0, 0.4, 40, 20), |t| t % 100 < 7))),
        ("half a sphere", turned(&without(&sphere(12), |t| t % 2000 < 500))),
        ("a damaged torus", damaged(&turned(&torus(1.0, 0.4, 30, 14)), 3)),
        ("an open box through a closed one", joined(&[turned(&without(&cube(0.8), |t| t < 2)), cube(0.5)])),
    ];
    for (what, soup) in shapes {
        let field = field(soup);
        let (layers, report) = stack(&field, 15, &SliceConfig::default());
        assert_eq!(report, SliceReport { layers: 15, approximated: 0 }, "{what}");
        assert_layers_are_the_fields(&field, &layers, what);
    }
}

#[test]
fn the_bunny_with_its_holes_is_cut_as_its_field() {
    let field = field(bunny());
    let (layers, report) = stack(&field, 40, &SliceConfig::default());
    assert_eq!(report, SliceReport { layers: 40, approximated: 0 });
    assert_layers_are_the_fields(&field, &layers, "bunny");
}

#[test]
fn planes_through_vertices_edges_and_faces_are_half_open() {
    let tower = joined(&[
        cuboid(Aabb { min: Vec3::new(-2.0, -2.0, 0.0), max: Vec3::new(2.0, 2.0, 1.0) }),
        cuboid(Aabb { min: Vec3::new(-1.0, -1.0, 1.0), max: Vec3::new(1.0, 1.0, 2.0) }),
    ]);
    let tower = field(tower);
    let areas: Vec<f64> = [-0.5, 0.0, 0.5, 1.0, 1.5, 2.0].map(|z| at(&tower, z).area()).to_vec();
    assert_eq!(areas, [0.0, 16.0, 16.0, 4.0, 4.0, 0.0], "what lies just above counts");
    // An octahedron through its waist, where four edges lie in the plane.
    let tips = [Vec3::X, Vec3::Y, -Vec3::X, -Vec3::Y, Vec3::Z, -Vec3::Z].to_vec();
    let faces = (0..4).flat_map(|k| [[k, (k + 1) % 4, 4], [(k + 1) % 4, k, 5]]).collect();
    let waist = at(&field(TriangleSoup::new(tips, faces).unwrap()), 0.0);
    assert!((waist.area() - 2.0).abs() < 1e-12 && waist.polygons[0].outer.len() == 4);
    // An open box, cut through its missing lid and just below.
    let open = field(without(&cube(1.0), |t| t / 2 == 5));
    let lid = open.bounds().max.z;
    assert!(at(&open, lid).area() == 0.0 || at(&open, -lid).area() > 3.9);
}

/// The winding number of rings in their plane, about a point.
fn planar_winding(rings: &[Vec<Vec2>], p: Vec2) -> f64 {
    let turn = |(a, b): (&Vec2, &Vec2)| (*a - p).perp_dot(*b - p).atan2((*a - p).dot(*b - p));
    let sides = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    sides.map(turn).sum::<f64>() / std::f64::consts::TAU
}

#[test]
fn the_section_of_an_open_box_tells_less_than_its_field() {
    // Cut just below its missing lid, the section of the box is a square: in the plane its winding number is 1 within (Barill et al.
    // 2018, section 5). That of the field is only a little above 1/2 there, and below it just above the lid, where there is no section.
    let lid = without(&cube(1.0), |t| cube(1.0).corners(t).iter().all(|p| p.z == 1.0));
    let field = field(lid);
    let z = 0.99;
    let layer = at(&field, z);
    let square: Vec<Vec<Vec2>> = rings(&layer).cloned().collect();
    let p = Vec2::new(0.2, -0.1);
    assert!((planar_winding(&square, p) - 1.0).abs() < 1e-9);
    let w = field.at(p.extend(z), fast_winding::winding::Accuracy::EXACT);
    assert!((0.5..0.6).contains(&w), "{w}");
    // A threshold of 0.6 would be empty for the field and whole for the section.
    assert!(!field.exceeds(p.extend(z), 0.6, &mut Default::default()));
}

#[test]
fn modes_differ_where_solids_overlap() {
    let two = joined(&[
        cuboid(Aabb { min: Vec3::ZERO, max: Vec3::new(2.0, 2.0, 1.0) }),
        cuboid(Aabb { min: Vec3::new(1.0, 1.0, 0.0), max: Vec3::new(3.0, 3.0, 1.0) }),
        cuboid(Aabb { min: Vec3::new(10.0, 0.0, 0.0), max: Vec3::new(11.0, 1.0, 1.0) }),
    ]);
    let area = |soup: &TriangleSoup, mode: SliceMode| {
        let config = SliceConfig { mode, ..SliceConfig::default() };
        slice(&field(soup.clone()), &LayerPlan::at(0.31), &config, &Silent).unwrap()[0].area()
    };
    assert_eq!(
        [SliceMode::Winding, SliceMode::EvenOdd, SliceMode::Largest].map(|m| area(&two, m)),
        [8.0, 7.0, 7.0]
    );
    // The same without the face of the third that looks at nothing: its contour is closed by the level curve.
    let open = without(&two, |t| t == two.len() - 1);
    let found = [SliceMode::Winding, SliceMode::EvenOdd].map(|m| area(&open, m));
    assert!((found[0] - 8.0).abs() < 0.15 && (found[0] - found[1] - 1.0).abs() < 1e-6, "{found:?}");
}

#[test]
fn contours_are_simplified_within_what_is_asked() {
    let field = field(turned(&torus(1.0, 0.4, 300, 150)));
    let fine = stack(&field, 7, &SliceConfig::default()).0;
    let coarse = stack(&field, 7, &SliceConfig { simplify: 0.01, ..SliceConfig::default() }).0;
    for (fine, coarse) in fine.iter().zip(&coarse) {
        let count = |layer: &Layer| rings(layer).map(Vec::len).sum::<usize>();
        assert!(3 * count(coarse) < count(fine), "{} of {}", count(coarse), count(fine));
        assert_eq!(rings(fine).count(), rings(coarse).count());
        assert!(rings(fine).flatten().all(|p| distance_to_contour(coarse, *p) < 0.01 + 1e-12));
        assert_simple(coarse, "simplified");
    }
    let bad = SliceConfig { simplify: f64::NAN, ..SliceConfig::default() };
    let error = slice(&field, &LayerPlan::at(0.0), &bad, &Silent).unwrap_err();
    assert!(error.to_string().contains("NaN"), "{error}");
}

#[test]
fn layers_do_not_depend_on_threads() {
    let soup = joined(&[turned(&without(&torus(1.0, 0.4, 40, 20), |t| t % 90 < 6)), turned(&cube(0.5))]);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| stack(&field(soup.clone()), 30, &SliceConfig::default()).0)
    };
    let one = with(1);
    assert!(one == with(3));
    // Blocks come from below; heights in any order keep their places.
    let heights: Vec<f64> = one.iter().rev().map(|layer| layer.z_sample).collect();
    let plan = LayerPlan { heights: Some(heights), ..LayerPlan::default() };
    let reversed = slice(&field(soup), &plan, &SliceConfig::default(), &Silent).unwrap();
    assert!(reversed.iter().rev().zip(&one).all(|(a, b)| a.polygons == b.polygons));
}

#[test]
fn what_overlaps_is_united_as_by_the_definition() {
    // Three turned cubes through each other: their union by the section's rings, and by the field.
    let soup = joined(&[turned(&cube(1.0)), cube(0.8), turned(&turned(&cube(0.9)))]);
    let field = field(soup);
    for layer in stack(&field, 11, &SliceConfig::default()).0 {
        let all: Vec<Vec<Vec2>> = rings(&layer).cloned().collect();
        let area: f64 = enclosed(&all, Fill::Positive).iter().map(Polygon::area).sum();
        assert!((area - layer.area()).abs() < 1e-12 * area.max(1.0), "rings do not overlap");
    }
}

#[test]
fn contours_of_clouds_are_round_on_coarse_cells() {
    let field = field(sphere_cloud(20_000));
    let config = SliceConfig { resolution: 12, ..SliceConfig::default() };
    let layer = slice(&field, &LayerPlan::at(0.31), &config, &Silent).unwrap().remove(0);
    let radius = (1.0 - 0.31f64 * 0.31).sqrt();
    let ring = &layer.polygons[0].outer;
    // Between two vertices a circle is s² / 8r off its chord.
    let off = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| radius - (0.5 * (*a + *b)).length());
    let worst = off.fold(0.0, |a: f64, b| a.max(b.abs()));
    assert!(worst < 0.004, "{worst}");
    assert!((layer.area() / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 4e-3);
    assert_simple(&layer, "cloud");
}
