//! Reports on shapes with known defects.
mod common;

use common::*;
use fast_winding::WindingField;
use fast_winding::check::{
    CheckConfig, CheckError, CheckReport, Rating, ReasonKind, RegionKind, Shell, ShellRole, check,
};
use fast_winding::data::{Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use std::f64::consts::PI;

fn checked_with(soup: TriangleSoup, config: &CheckConfig) -> CheckReport {
    check(&WindingField::new(soup, Default::default()), config, &Silent).unwrap()
}

fn checked(soup: TriangleSoup) -> CheckReport {
    checked_with(soup, &CheckConfig::default())
}

fn slab(min: [f64; 3], max: [f64; 3]) -> TriangleSoup {
    cuboid(Aabb { min: Vec3::from_array(min), max: Vec3::from_array(max) })
}

fn unit(at: [f64; 3]) -> TriangleSoup {
    slab(at, at.map(|c| c + 1.0))
}

/// With faces turned for which that is wanted.
fn turned(soup: &TriangleSoup, wanted: impl Fn(usize) -> bool) -> TriangleSoup {
    let turn = |(t, [a, b, c]): (usize, &[u32; 3])| if wanted(t) { [*a, *c, *b] } else { [*a, *b, *c] };
    let triangles = soup.triangles().iter().enumerate().map(turn).collect();
    TriangleSoup::new(soup.positions().to_vec(), triangles).unwrap()
}

fn crossing_pairs(report: &CheckReport) -> usize {
    report.self_intersections.as_ref().unwrap().count
}

fn assert_near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "{found} instead of {expected}");
}

#[test]
fn a_box_is_clean() {
    let report = checked(slab([0.0; 3], [10.0, 20.0, 30.0]));
    assert_eq!((report.triangles, report.vertices, report.edges, report.unused_vertices), (12, 8, 18, 0));
    assert_eq!(
        (report.boundary.edges, report.non_manifold_edges.count, report.inconsistent_edges.count),
        (0, 0, 0)
    );
    assert_eq!(
        (report.components, report.shells.count, report.euler_number, report.genus),
        (1, 1, 2, Some(0))
    );
    assert_eq!(crossing_pairs(&report), 0);
    assert_near(report.area, 2200.0, 1e-12);
    assert_near(report.volume, 6000.0, 1e-12);
    assert_eq!(report.shells.list[0].role, ShellRole::Boundary);
    let field = report.field.unwrap();
    assert_eq!((field.ambiguous_volume, field.overlap_volume, field.inverted_volume), (0.0, 0.0, 0.0));
    assert_near(field.solid_volume, 6000.0, 1e-12);
    assert_near(field.box_volume, 6000.0, 1e-12);
    let thickness = report.thickness.unwrap();
    assert_near(thickness.minimum, 10.0, 1e-12);
    assert_eq!(thickness.thin_faces.count, 0);
    // Two faces of 600 mm² each are 10 mm apart, two of 300 20 mm, two of 200 30 mm.
    let at = |percent: f64| thickness.percentiles.iter().find(|p| p[0] == percent).unwrap()[1];
    assert!([(50.0, 10.0), (75.0, 20.0), (95.0, 30.0)].iter().all(|(p, d)| (at(*p) - d).abs() < 1e-9));
    assert_eq!((report.verdict.rating, &report.verdict.text[..]), (Rating::Clean, "clean: prints as it is"));
}

#[test]
fn a_box_without_a_face_has_one_hole_that_the_field_closes() {
    let report = checked(without(&unit([0.0; 3]), |t| t < 2));
    assert_eq!((report.boundary.edges, report.boundary.loops.count), (4, 1));
    let hole = &report.boundary.loops.list[0];
    assert_eq!((hole.edges, hole.is_closed, hole.vertices.len()), (4, true, 4));
    assert_near(hole.length, 4.0, 1e-12);
    assert_near(hole.area, 1.0, 1e-12);
    assert_eq!((report.closed_shells, report.genus), (0, None));
    // V − E + F of a disk.
    assert_eq!(report.euler_number, 1);
    // By an oracle: the fraction of the box's volume where the open face takes up so much of all directions.
    let field = report.field.unwrap();
    assert!(field.ambiguous_share > 0.05 && field.ambiguous_share < 0.9, "{}", field.ambiguous_share);
    assert_eq!(field.regions.list[0].kind, RegionKind::Ambiguous);
    assert_eq!(report.verdict.reasons.iter().filter(|r| r.kind == ReasonKind::Holes).count(), 1);
}

/// A fine sphere with some small holes.
#[test]
fn small_holes_print_as_seen() {
    let soup = without(&sphere(40), |t| [100, 5000, 9000].contains(&t));
    let report = checked(soup);
    assert_eq!((report.boundary.loops.count, report.boundary.edges), (3, 9));
    assert_eq!(report.verdict.rating, Rating::PrintsAsSeen);
    assert!(
        report.verdict.text.starts_with("prints as seen: 3 holes are closed by the field"),
        "{}",
        report.verdict.text
    );
    assert_eq!((report.internal_faces.count, report.outside_faces.count), (0, 0));
}

#[test]
fn ambiguous_volume_is_that_of_a_dense_count() {
    let soup = without(&cube(1.0), |t| t < 2);
    let field = WindingField::new(soup, Default::default());
    let report = check(&field, &CheckConfig::default(), &Silent).unwrap().field.unwrap();
    let points = scattered(field.bounds(), 40_000, 5);
    let w = field.evaluate(&points, fast_winding::winding::Accuracy::EXACT, &Silent).unwrap();
    let share = |wanted: &dyn Fn(f64) -> bool| w.iter().filter(|w| wanted(**w)).count() as f64 / 40_000.0;
    // Three standard deviations of the count, and the lattice's own error.
    assert!((report.ambiguous_share - share(&|w| w > 0.1 && w < 0.9)).abs() < 0.01);
    assert!((report.solid_volume / 8.0 - share(&|w| w >= 0.5)).abs() < 0.01);
}

#[test]
fn flipped_faces_are_named() {
    let report = checked(turned(&sphere(10), |t| [3, 99, 200].contains(&t)));
    assert_eq!(report.flipped_faces.list, [3, 99, 200]);
    assert_eq!(report.inconsistent_edges.count, 9);
    assert_eq!(report.verdict.rating, Rating::Doubtful);
    assert!(report.verdict.text.contains("flip 3 faces in 1 shell"), "{}", report.verdict.text);
    let whole = checked(flipped(&sphere(10)));
    assert_eq!(
        (whole.flipped_faces.count, whole.inconsistent_edges.count, whole.inverted_shells),
        (800, 0, 1)
    );
    assert_eq!(whole.verdict.rating, Rating::Doubtful);
    assert!(whole.volume < 0.0 && whole.shells.list[0].volume.unwrap() < 0.0);
    assert_near(-whole.field.unwrap().inverted_volume, whole.volume, 0.02);
    let open = checked(without(&flipped(&sphere(10)), |t| t < 30));
    assert_eq!(
        (open.flipped_faces.count, open.inverted_shells, open.verdict.rating),
        (770, 1, Rating::Doubtful)
    );
    // A twentieth of the faces of a sphere that is inside out as well: the others are to be turned.
    let both = checked(turned(&flipped(&sphere(10)), |t| t % 20 == 7));
    assert_eq!(both.flipped_faces.count, 760);
    assert!(both.flipped_faces.list.iter().all(|t| t % 20 != 7));
}

#[test]
fn duplicate_degenerate_and_sliver_faces_are_counted() {
    let cube = unit([0.0; 3]);
    let mut positions = cube.positions().to_vec();
    positions.push(Vec3::new(0.5, 0.0, 0.0));
    positions.push(Vec3::new(5.0, 5.0, 5.0));
    let [a, b, c] = cube.triangles()[4];
    // The same turning the same way, one with two corners in one place, one on a line.
    let more = [[b, c, a], [a, a, b], [0, 1, 8]];
    let soup = TriangleSoup::new(positions, [cube.triangles(), &more].concat()).unwrap();
    let report = checked(soup);
    assert_eq!((report.duplicate_faces.count, &report.duplicate_faces.list[..]), (1, &[12][..]));
    assert_eq!(report.degenerate_faces.list, [13, 14]);
    assert_eq!((report.vertices, report.unused_vertices), (9, 1));
    let sliver = slab([0.0; 3], [1000.0, 1.0, 1.0]);
    assert_eq!(checked(sliver).sliver_faces.count, 8);
}

fn shell_of(report: &CheckReport, first_face: u32) -> &Shell {
    report.shells.list.iter().find(|shell| shell.first_face == first_face).unwrap()
}

#[test]
fn shells_in_shells_are_cavities_or_solids() {
    let [outer, inner, innermost] = [4.0, 2.0, 1.0].map(cube);
    let cavity = checked(joined(&[outer.clone(), flipped(&inner), innermost.clone()]));
    assert_eq!(
        (cavity.components, cavity.closed_shells, cavity.nested_shells, cavity.inverted_shells),
        (3, 3, 2, 0)
    );
    let depths = [0, 12, 24].map(|face| shell_of(&cavity, face).depth.unwrap());
    assert_eq!(depths, [0, 1, 2]);
    assert!(cavity.shells.list.iter().all(|shell| shell.role == ShellRole::Boundary));
    assert_near(cavity.volume, 512.0 - 64.0 + 8.0, 1e-12);
    assert_eq!((cavity.internal_faces.count, cavity.flipped_faces.count), (0, 0));
    assert_eq!(cavity.verdict.rating, Rating::Clean);
    // The wall of the cavity is 2 mm thick, the cube in it 2 mm.
    assert_near(cavity.thickness.unwrap().minimum, 2.0, 1e-9);

    let solid = checked(joined(&[outer.clone(), inner.clone()]));
    assert_eq!(shell_of(&solid, 12).role, ShellRole::Internal);
    assert_eq!(solid.internal_faces.list, (12..24).collect::<Vec<u32>>());
    // Rays go through what is inside.
    assert_near(solid.thickness.unwrap().minimum, 8.0, 1e-9);
    assert_near(solid.field.as_ref().unwrap().overlap_volume, 64.0, 1e-9);
    assert_eq!(solid.field.unwrap().regions.count, 1);

    let beside = checked(joined(&[cube(1.0), flipped(&unit([5.0, 0.0, 0.0]))]));
    assert_eq!((beside.inverted_shells, beside.nested_shells, beside.flipped_faces.count), (1, 0, 12));
    assert_eq!(beside.flipped_faces.list, (12..24).collect::<Vec<u32>>());
}

#[test]
fn overlapping_cubes_cross_and_neighbours_do_not() {
    let report = checked(joined(&[unit([0.0; 3]), unit([0.5, 0.4, 0.3])]));
    let pairs = &report.self_intersections.as_ref().unwrap();
    // Oracle: all pairs by the exact test, of which those within one cube are none.
    let soup = joined(&[unit([0.0; 3]), unit([0.5, 0.4, 0.3])]);
    let all: Vec<[u32; 2]> = (0..24u32)
        .flat_map(|i| (i + 1..24).map(move |j| [i, j]))
        .filter(|[i, j]| {
            fast_winding::math::triangles_meet(soup.corners(*i as usize), soup.corners(*j as usize))
        })
        .collect();
    assert!(all.len() >= 6 && all.iter().all(|[i, j]| *i < 12 && *j >= 12));
    assert_eq!((pairs.count, &pairs.list), (all.len(), &all));
    assert_near(report.field.unwrap().overlap_volume, 0.5 * 0.6 * 0.7, 0.1);
    assert_eq!(report.verdict.rating, Rating::PrintsAsSeen);
    // In one plane, and capped.
    let coplanar = joined(&[unit([0.0; 3]), unit([0.5, 0.0, 0.0])]);
    let capped = checked_with(coplanar, &CheckConfig { limit: 2, ..CheckConfig::default() });
    let pairs = capped.self_intersections.unwrap();
    assert!(pairs.count >= 8 && pairs.list.len() == 2, "{}", pairs.count);
    // Against each other, side by side: two faces lie on each other, of which both sides are inside.
    let touching = checked(joined(&[unit([0.0; 3]), unit([1.0, 0.0, 0.0])]));
    assert_eq!(touching.internal_faces.count, 4);
}

#[test]
fn a_bow_tie_is_one_vertex_and_two_shells() {
    let report = checked(joined(&[unit([0.0; 3]), unit([1.0, 1.0, 1.0])]));
    assert_eq!((report.non_manifold_vertices.count, report.non_manifold_edges.count), (1, 0));
    assert_eq!((report.components, report.shells.count, report.vertices), (1, 2, 15));
    assert_eq!((report.euler_number, report.genus, crossing_pairs(&report)), (4, Some(0), 0));
    // Along an edge: four faces there, and two closed shells still.
    let report = checked(joined(&[unit([0.0; 3]), unit([1.0, 1.0, 0.0])]));
    assert_eq!((report.non_manifold_edges.count, report.non_manifold_vertices.count), (1, 0));
    assert_eq!((report.closed_shells, report.genus, report.boundary.edges), (2, Some(0), 0));
}

#[test]
fn a_vertex_on_an_edge_leaves_a_slit() {
    // One of two triangles of a face is cut in two at the middle of its long side.
    let cube = unit([0.0; 3]);
    let mut positions = cube.positions().to_vec();
    let [a, b, c] = cube.triangles()[0];
    let long = [(a, b, c), (b, c, a), (c, a, b)]
        .into_iter()
        .find(|(s, t, _)| positions[*s as usize].distance(positions[*t as usize]) > 1.1)
        .unwrap();
    positions.push(0.5 * (positions[long.0 as usize] + positions[long.1 as usize]));
    let mut triangles = cube.triangles()[1..].to_vec();
    triangles.extend([[long.0, 8, long.2], [8, long.1, long.2]]);
    let report = checked(TriangleSoup::new(positions, triangles).unwrap());
    assert_eq!((report.boundary.edges, report.boundary.loops.count, crossing_pairs(&report)), (3, 1, 0));
    assert!(report.boundary.loops.list[0].area < 1e-15);
    // A fin along an edge of a face.
    let fin =
        joined(&[cube, TriangleSoup::new(vec![Vec3::ZERO, Vec3::X, -Vec3::Y], vec![[0, 1, 2]]).unwrap()]);
    let report = checked(fin);
    assert_eq!((report.non_manifold_edges.list.len(), report.boundary.edges), (1, 2));
    assert!(!report.boundary.loops.list[0].is_closed);
    assert_eq!(report.outside_faces.list, [12]);
}

#[test]
fn a_torus_has_a_handle_and_a_strip_with_a_half_turn_no_sides() {
    let report = checked(torus(3.0, 1.0, 60, 30));
    assert_eq!((report.euler_number, report.genus, report.vertices, report.edges), (0, Some(1), 1800, 5400));
    // The polygon of 30 corners has so much less area than the circle.
    let polygon = 15.0 * (PI / 15.0).sin() / PI;
    assert_near(report.volume, 2.0 * PI * PI * 3.0 * polygon, 0.005);
    let strip: Vec<[u32; 3]> = vec![[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 0], [4, 0, 1]];
    let place = |k: usize| Vec3::new((k * k % 5) as f64, (3 * k % 7) as f64, (k * k * k % 11) as f64);
    let report = checked(TriangleSoup::new((0..5).map(place).collect(), strip).unwrap());
    assert_eq!((report.shells.list[0].is_orientable, report.genus), (false, None));
    assert_eq!((report.flipped_faces.count, report.boundary.loops.count), (0, 1));
}

#[test]
fn a_thin_plate_is_measured_and_its_faces_listed() {
    let plate = joined(&[slab([0.0; 3], [20.0, 20.0, 0.5]), slab([40.0, 0.0, 0.0], [60.0, 20.0, 20.0])]);
    let report = checked_with(plate, &CheckConfig { minimum_thickness: 0.6, ..CheckConfig::default() });
    let thickness = report.thickness.unwrap();
    assert_near(thickness.minimum, 0.5, 1e-9);
    assert_eq!(thickness.thin_faces.list, [8, 9, 10, 11]);
    assert_near(thickness.thin_area, 800.0, 1e-9);
    assert_eq!((thickness.thinnest_face / 4, thickness.unbounded), (2, 0));
    assert!(
        report.verdict.text.contains("4 faces are thinner than 0.6 mm: 0.5 mm at the thinnest"),
        "{}",
        report.verdict.text
    );
}

#[test]
fn overhangs_are_those_of_the_solid() {
    // A column with a plate on top: its lower side juts out by 10 mm around.
    let column = slab([10.0, 10.0, 0.0], [20.0, 20.0, 20.0]);
    let plate = slab([0.0, 0.0, 20.0], [30.0, 30.0, 25.0]);
    let report = checked(joined(&[column, plate]));
    // The plate's lower face is counted by samples where it is above the column.
    assert_near(report.overhangs.area, 900.0 - 100.0, 0.01);
    assert_eq!(report.overhangs.by_angle.len(), 18);
    // A sphere: 2πr² sin(…) below the angle; of its parts within 40° of the lowest point, 2π (1 − cos 40°).
    let report = checked(sphere(60));
    assert_near(report.overhangs.area, 2.0 * PI * (1.0 - 40f64.to_radians().cos()), 0.02);
    assert_near(report.overhangs.by_angle[0][1], 2.0 * PI, 0.02);
    let upside_down = checked(flipped(&sphere(60)));
    assert_eq!(upside_down.overhangs.area, 0.0);
    assert_eq!(checked(unit([0.0; 3])).overhangs.area, 0.0);
}

#[test]
fn the_bed_and_the_settings_are_heeded() {
    let bed = |bed: [f64; 3]| {
        let config = CheckConfig { bed: Some(bed), ..CheckConfig::default() };
        let report = checked_with(slab([0.0; 3], [10.0, 20.0, 30.0]), &config);
        let fit = report.bed.unwrap();
        (fit.fits, fit.fits_turned, report.verdict.rating)
    };
    assert_eq!(bed([10.0, 20.0, 30.0]), (true, false, Rating::Clean));
    assert_eq!(bed([25.0, 15.0, 40.0]), (false, true, Rating::Clean));
    assert_eq!(bed([25.0, 25.0, 25.0]), (false, false, Rating::Doubtful));
    let field = WindingField::new(cube(1.0), Default::default());
    let wrong = CheckConfig { overhang_angle: 91.0, ..CheckConfig::default() };
    let error = check(&field, &wrong, &Silent).unwrap_err();
    assert!(error.to_string().contains("overhangAngle is 91"), "{error}");
    let cloud = WindingField::new(sphere_cloud(100), Default::default());
    assert_eq!(check(&cloud, &CheckConfig::default(), &Silent), Err(CheckError::Cloud { points: 100 }));
    let empty = checked(TriangleSoup::default());
    assert_eq!((empty.verdict.rating, empty.triangles, empty.genus), (Rating::NoSolid, 0, None));
    assert!(check(&field, &CheckConfig::default(), &|_: f64, _: &str| false).is_err());
}

#[test]
fn a_damaged_scan_is_told_the_same_with_any_number_of_threads_and_as_json() {
    let soup = damaged(&torus(3.0, 1.0, 60, 30), 7);
    let report = checked(soup.clone());
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(|| checked(soup));
    assert_eq!(report, alone);
    let json: serde_json::Value = serde_json::to_value(&report).unwrap();
    assert_eq!(json["triangles"], report.triangles);
    assert_eq!(json["boundary"]["loops"]["list"][0]["isClosed"], true);
    assert_eq!(json["verdict"]["rating"], "doubtful");
}
