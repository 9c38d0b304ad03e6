//! Repaired meshes: closed manifolds by their indices, with the volumes that are known, and the triangles that were there.
mod common;

use common::*;
use fast_winding::check::{CheckConfig, check};
use fast_winding::data::{Silent, SurfaceMesh, TriangleSoup};
use fast_winding::math::{Aabb, Vec3, area_vector};
use fast_winding::repair::{
    ConserveConfig, Fallback, RemeshConfig, RepairError, RepairMethod, Repaired, conserve, remesh,
};
use fast_winding::winding::{FieldConfig, WindingField};

fn field(soup: &TriangleSoup) -> WindingField {
    WindingField::new(soup.clone(), FieldConfig::default())
}

/// Conserves without remeshing, and checks the topology of the result: gives it with its Euler number.
fn conserved(soup: &TriangleSoup) -> (Repaired, i64) {
    let config = ConserveConfig { fallback: None, ..ConserveConfig::default() };
    let made = conserve(&field(soup), &config, &Silent).unwrap();
    let mesh = SurfaceMesh::with_face_normals(made.soup.positions().to_vec(), made.soup.triangles().to_vec());
    let (euler, open) = topology(&mesh);
    assert_eq!(open, 0, "{:?}", made.report);
    assert!(made.report.closed && made.report.fallback.is_none());
    assert!((mesh.volume() - made.report.volume).abs() <= 1e-9 * mesh.volume().abs());
    (made, euler)
}

fn volume(soup: &TriangleSoup) -> f64 {
    SurfaceMesh::with_face_normals(soup.positions().to_vec(), soup.triangles().to_vec()).volume()
}

#[track_caller]
fn assert_near(value: f64, expected: f64, share: f64) {
    assert!((value / expected - 1.0).abs() <= share, "{value} instead of {expected}");
}

#[test]
fn a_closed_mesh_comes_back_bit_for_bit() {
    for soup in [torus(1.0, 0.4, 40, 16), cube(1.5), joined(&[cube(1.0), flipped(&cube(0.5))])] {
        let (made, _) = conserved(&soup);
        assert_eq!(made.soup, soup);
        assert!(made.sources.iter().copied().eq(0..soup.len() as u32));
        assert_eq!((made.report.kept, made.report.new), (soup.len(), 0));
        assert_near(made.report.agreement, 1.0, 1e-12);
    }
}

#[test]
fn loose_triangles_keep_their_corners_and_share_them() {
    let soup = sphere(12);
    let (made, euler) = conserved(&soup);
    assert_eq!((made.soup.len(), euler), (soup.len(), 2));
    assert!((0..soup.len()).all(|t| made.soup.corners(t) == soup.corners(t)));
}

#[test]
fn a_box_without_a_face_gets_it_back() {
    let soup = without(&cube(1.0), |t| t < 2);
    let (made, euler) = conserved(&soup);
    assert_eq!((made.soup.len(), euler, made.report.holes, made.report.new), (12, 2, 1, 2));
    assert_near(volume(&made.soup), 8.0, 1e-12);
    assert_near(made.report.cap_area, 4.0, 1e-12);
    assert!((0..10).all(|t| made.soup.corners(t) == soup.corners(t)));
}

#[test]
fn a_torus_keeps_its_hole_though_a_tenth_of_its_faces_is_gone() {
    let whole = torus(1.0, 0.4, 60, 24);
    let mut next = random(3);
    let lots: Vec<f64> = (0..whole.len()).map(|_| next()).collect();
    let soup = without(&whole, |t| lots[t] < 0.1);
    let (made, euler) = conserved(&soup);
    assert_eq!(euler, 0);
    assert_near(volume(&made.soup), volume(&whole), 2e-3);
    assert_eq!(made.report.kept, soup.len());
}

#[test]
fn a_hole_in_a_sphere_is_closed_along_the_level_set() {
    let whole = sphere(24);
    let soup = without(&whole, |t| whole.corners(t).iter().any(|p| p.z > 0.8));
    let (made, euler) = conserved(&soup);
    assert_eq!((euler, made.report.holes), (2, 1));
    let w = field(&soup);
    let rim = soup.positions().len();
    assert!(made.report.new > 50, "{:?}", made.report);
    let is_new = |p: &&Vec3| !soup.positions().contains(p);
    let within: Vec<&Vec3> = made.soup.positions().iter().filter(is_new).collect();
    assert!(within.len() > 20 && rim > 0);
    for p in within {
        let value = w.at(*p, fast_winding::winding::Accuracy::EXACT);
        assert!((value - 0.5).abs() < 0.01, "{value} at {p}");
    }
}

#[test]
fn duplicates_and_faces_without_area_are_counted_and_dropped() {
    let whole = torus(1.0, 0.4, 20, 12);
    let mut triangles = whole.triangles().to_vec();
    triangles.extend_from_slice(&whole.triangles()[..17]);
    triangles.extend([[5, 5, 9], [3, 4, 3]]);
    let soup = TriangleSoup::new(whole.positions().to_vec(), triangles).unwrap();
    let (made, _) = conserved(&soup);
    assert_eq!(made.soup, whole);
    assert_eq!((made.report.duplicates, made.report.degenerate), (17, 2));
}

#[test]
fn a_double_sided_shape_gets_one_side() {
    let whole = torus(1.0, 0.4, 20, 12);
    let both = joined(&[whole.clone(), flipped(&whole)]);
    let (made, euler) = conserved(&both);
    assert_eq!((made.soup.len(), euler), (whole.len(), 0));
    assert_near(volume(&made.soup), volume(&whole), 1e-12);
}

#[test]
fn an_inner_shell_of_the_same_orientation_is_dropped() {
    let soup = joined(&[cube(1.0), cube(0.5)]);
    let (made, euler) = conserved(&soup);
    assert_eq!((made.soup.len(), euler, made.report.internal), (12, 2, 12));
    assert_near(volume(&made.soup), 8.0, 1e-12);
}

#[test]
fn a_sheet_without_thickness_is_dropped() {
    let sheet = |z: f64| {
        let p = [(0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (0.0, 0.5)].map(|(x, y)| Vec3::new(x, y, z));
        TriangleSoup::new(p.to_vec(), vec![[0, 1, 2], [0, 2, 3]]).unwrap()
    };
    let (made, euler) = conserved(&joined(&[cube(1.0), sheet(0.25), sheet(3.0)]));
    assert_eq!((made.soup.len(), euler), (12, 2));
    assert_near(volume(&made.soup), 8.0, 1e-12);
}

#[test]
fn an_edge_with_a_vertex_of_others_on_it_is_stitched() {
    // The top of the box has a vertex amid one of its sides, a little off, that the side wall does not have.
    let whole = cube(1.0);
    let top = |t: usize| whole.corners(t).iter().all(|p| p.z == 1.0);
    let mut positions = whole.positions().to_vec();
    positions.push(Vec3::new(0.1, 1.0 - 1e-6, 1.0 + 1e-6));
    let mut triangles: Vec<[u32; 3]> = (0..12).filter(|t| !top(*t)).map(|t| whole.triangles()[t]).collect();
    let at = |x: f64, y: f64| (0..8).find(|v| positions[*v as usize] == Vec3::new(x, y, 1.0)).unwrap();
    let [a, b, c, d] = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    triangles.extend([[a, b, 8], [b, c, 8], [a, 8, d]]);
    let soup = TriangleSoup::new(positions, triangles).unwrap();
    let (made, euler) = conserved(&soup);
    assert_eq!((euler, made.report.split_edges, made.report.holes, made.soup.len()), (2, 1, 0, 14));
    assert_near(volume(&made.soup), 8.0, 1e-5);
}

#[test]
fn two_halves_that_nearly_touch_are_stitched() {
    let half = |low: f64, high: f64| {
        let bounds = Aabb { min: Vec3::new(low, 0.0, 0.0), max: Vec3::new(high, 1.0, 1.0) };
        let all = cuboid(bounds);
        without(&all, |t| all.corners(t).iter().all(|p| (p.x - 1.0).abs() < 0.1))
    };
    let (made, euler) = conserved(&joined(&[half(0.0, 1.0), half(1.0 + 1e-6, 2.0)]));
    assert_eq!((euler, made.report.stitched_vertices, made.report.holes), (2, 4, 0));
    assert_near(volume(&made.soup), 2.0, 1e-5);
}

#[test]
fn overlapping_boxes_become_their_union() {
    let at = |low: Vec3, high: Vec3| cuboid(Aabb { min: low, max: high });
    let shifted = Vec3::new(0.3, 0.45, 0.6);
    // Askew, with faces in one plane, and one with a window cut through by the other.
    let others = [
        (at(shifted, shifted + Vec3::ONE), 2.0 - 0.7 * 0.55 * 0.4),
        (at(Vec3::new(0.5, 0.0, 0.0), Vec3::new(1.5, 1.0, 1.0)), 1.5),
        (at(Vec3::new(0.5, 0.25, 0.25), Vec3::new(1.5, 0.75, 0.75)), 1.125),
        (at(Vec3::new(1.0, 0.25, 0.25), Vec3::new(2.0, 0.75, 1.25)), 1.5),
        (at(Vec3::new(1.0, 0.0, 0.0), Vec3::new(2.0, 1.0, 1.0)), 2.0),
    ];
    for (other, expected) in others {
        let (made, euler) = conserved(&joined(&[at(Vec3::ZERO, Vec3::ONE), other]));
        assert_near(volume(&made.soup), expected, 1e-12);
        assert_eq!(euler, 2, "{:?}", made.report);
    }
}

#[test]
fn an_open_box_that_another_runs_through_is_closed_and_united_with_it() {
    let outer = without(&cube(1.0), |t| t < 2);
    let bar = cuboid(Aabb { min: Vec3::new(-2.0, -0.5, -0.25), max: Vec3::new(2.0, 0.5, 0.25) });
    let (made, euler) = conserved(&joined(&[outer, bar]));
    assert_near(volume(&made.soup), 8.0 + 2.0 * 0.5, 1e-12);
    assert_eq!((euler, made.report.holes), (2, 1));
}

#[test]
fn turned_faces_are_turned_back_and_hollows_stay() {
    let solid = torus(1.0, 0.4, 40, 16);
    let hollow = joined(&[cube(1.0), flipped(&cube(0.5))]);
    for (whole, share) in [(&solid, 0.01), (&solid, 0.1), (&solid, 1.0), (&hollow, 0.1)] {
        let mut next = random(7);
        let triangles: Vec<[u32; 3]> = whole
            .triangles()
            .iter()
            .map(|[a, b, c]| if next() < share { [*a, *c, *b] } else { [*a, *b, *c] })
            .collect();
        let turned = triangles.iter().zip(whole.triangles()).filter(|(a, b)| a != b).count();
        let (made, _) = conserved(&TriangleSoup::new(whole.positions().to_vec(), triangles).unwrap());
        assert_eq!(made.report.flipped, turned);
        assert_near(volume(&made.soup), volume(whole), 1e-12);
    }
}

#[test]
fn boxes_that_share_an_edge_or_a_corner_get_one_each() {
    let at = |x: f64, y: f64, z: f64| {
        let min = Vec3::new(x, y, z);
        cuboid(Aabb { min, max: min + Vec3::ONE })
    };
    for other in [at(1.0, 1.0, 0.0), at(1.0, 1.0, 1.0)] {
        let (made, euler) = conserved(&joined(&[at(0.0, 0.0, 0.0), other]));
        assert_eq!((made.soup.len(), made.soup.positions().len(), euler), (24, 16, 4));
        let area: f64 = (0..24).map(|t| area_vector(made.soup.corners(t)).length()).sum();
        assert_near(area, 12.0, 1e-12);
    }
}

#[test]
fn what_bounds_nothing_is_said_to() {
    let sheet = TriangleSoup::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]]).unwrap();
    let config = ConserveConfig { fallback: None, ..ConserveConfig::default() };
    assert_eq!(conserve(&field(&sheet), &config, &Silent), Err(RepairError::Empty));
    let cloud = WindingField::new(sphere_cloud(50), FieldConfig::default());
    assert_eq!(conserve(&cloud, &config, &Silent), Err(RepairError::CloudConserved));
    let bad = ConserveConfig { tolerance: Some(-1.0), ..config };
    assert_eq!(conserve(&field(&sheet), &bad, &Silent), Err(RepairError::BadTolerance(-1.0)));
}

#[test]
fn parts_with_wide_gaps_are_remeshed_and_the_report_says_so() {
    // The six faces of a box, each moved outward.
    let faces = |t: usize| without(&cube(1.0), |u| u / 2 != t);
    let moved = |t: usize| {
        let soup = faces(t);
        let shift = 0.02 * area_vector(soup.corners(0)).normalize();
        let positions = soup.positions().iter().map(|p| *p + shift).collect();
        TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
    };
    let soup = joined(&[0, 1, 2, 3, 4, 5].map(moved));
    let made = conserve(&field(&soup), &ConserveConfig::default(), &Silent).unwrap();
    assert_eq!(made.report.method, RepairMethod::Remesh);
    assert!(matches!(made.report.fallback, Some(Fallback::Disagrees | Fallback::Empty)), "{:?}", made.report);
    // {w >= 1/2} reaches up to the faces.
    assert_near(made.report.volume, 2.04f64.powi(3), 0.01);
}

#[test]
fn a_remeshed_box_without_a_face_has_its_edges_and_a_flat_lid() {
    let soup = without(&cube(1.0), |t| t < 2);
    let config = RemeshConfig { resolution: Some(24), ..RemeshConfig::default() };
    let made = remesh(&field(&soup), &config, &Silent).unwrap();
    let mesh = SurfaceMesh::with_face_normals(made.soup.positions().to_vec(), made.soup.triangles().to_vec());
    assert_eq!(topology(&mesh), (2, 0));
    let distances = made.report.distances.unwrap();
    // Where the lid was its rim is sharp no more: nothing there says so.
    assert!(distances.p99_from_input < 0.2 * distances.spacing, "{distances:?}");
    assert!(distances.most_from_input < 0.5 * distances.spacing, "{distances:?}");
    assert!(distances.on_input > 0.8, "{distances:?}");
    assert!(made.report.agreement > 0.97, "{:?}", made.report);
}

#[test]
fn nothing_runs_through_itself_after_either_repair() {
    // A thin wall that leans, through a box: sharp edges next to each other in one cell.
    let lean = |p: Vec3| Vec3::new(p.x + 0.3 * p.z, 0.02 * p.y + 0.2 * p.x, 1.5 * p.z);
    let wall = cube(1.0);
    let positions = wall.positions().iter().map(|p| lean(*p)).collect();
    let wall = TriangleSoup::new(positions, wall.triangles().to_vec()).unwrap();
    let soup = joined(&[cube(1.0), wall]);
    let crossings = |soup: &TriangleSoup| {
        let found = check(&field(soup), &CheckConfig::default(), &Silent).unwrap();
        (found.self_intersections.unwrap().count, found.boundary.loops.count)
    };
    assert!(crossings(&soup).0 > 0);
    let config = RemeshConfig { resolution: Some(48), ..RemeshConfig::default() };
    let made = remesh(&field(&soup), &config, &Silent).unwrap();
    assert_eq!((crossings(&conserved(&soup).0.soup), crossings(&made.soup)), ((0, 0), (0, 0)));
}

#[test]
fn a_cloud_is_remeshed() {
    let cloud = WindingField::new(sphere_cloud(2000), FieldConfig::default());
    let made = remesh(&cloud, &RemeshConfig::default(), &Silent).unwrap();
    assert_near(made.report.volume, 4.0 / 3.0 * std::f64::consts::PI, 0.02);
    assert!(made.sources.is_empty() && made.report.distances.is_none());
}

#[test]
fn threads_change_no_bit() {
    let soup = damaged(&torus(1.0, 0.4, 40, 16), 5);
    let config = ConserveConfig { fallback: None, ..ConserveConfig::default() };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| conserve(&field(&soup), &config, &Silent).unwrap())
    };
    assert_eq!(on(1), on(2));
}
