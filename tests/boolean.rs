//! Booleans of soups and clouds: volumes, closedness, and what happens where operands coincide, miss each other or are broken.
mod common;

use common::*;
use fast_winding::data::{Silent, TriangleSoup, WarningKind};
use fast_winding::math::{Aabb, Mat3, Vec3};
use fast_winding::solid::{BooleanConfig, BooleanError, BooleanMesh, BooleanOp, boolean};
use fast_winding::winding::WindingField;
use std::collections::HashMap;

const UNION: BooleanOp = BooleanOp::Union;
const INTERSECTION: BooleanOp = BooleanOp::Intersection;
const DIFFERENCE: BooleanOp = BooleanOp::Difference;

fn field(soup: &TriangleSoup) -> WindingField {
    WindingField::new(soup.clone(), Default::default())
}

fn combined(a: &TriangleSoup, op: BooleanOp, b: &TriangleSoup) -> BooleanMesh {
    let mesh = boolean(&field(a), &field(b), op, &Default::default(), &Silent).unwrap();
    check(&mesh, a, b);
    mesh
}

/// Every triangle lies in the one it comes from, and is turned as that is, unless it comes of a difference.
fn check(mesh: &BooleanMesh, a: &TriangleSoup, b: &TriangleSoup) {
    assert!(mesh.positions.iter().all(|p| p.is_finite()));
    assert_eq!((mesh.faces.len(), mesh.operands.len()), (mesh.triangles.len(), mesh.triangles.len()));
    for (k, t) in mesh.triangles.iter().enumerate() {
        let source = if mesh.operands[k] == 0 { a } else { b }.corners(mesh.faces[k] as usize);
        for v in t {
            let distance = fast_winding::math::distance_to_triangle(mesh.positions[*v as usize], source);
            assert!(distance < 1e-9, "triangle {k}: {distance}");
        }
    }
}

fn volume(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let at = |v: u32| positions[v as usize];
    triangles.iter().map(|[a, b, c]| at(*a).dot(at(*b).cross(at(*c))) / 6.0).sum()
}

fn volume_of(mesh: &BooleanMesh) -> f64 {
    volume(&mesh.positions, &mesh.triangles)
}

fn volume_of_soup(soup: &TriangleSoup) -> f64 {
    volume(soup.positions(), soup.triangles())
}

/// Edges, by the places of their ends, that run one way more often than the other.
fn open_edges(mesh: &BooleanMesh) -> usize {
    let mut numbers: HashMap<[u64; 3], usize> = HashMap::new();
    let mut number = |v: &u32| {
        let next = numbers.len();
        *numbers
            .entry((mesh.positions[*v as usize] + Vec3::ZERO).to_array().map(f64::to_bits))
            .or_insert(next)
    };
    let mut net: HashMap<(usize, usize), i32> = HashMap::new();
    for t in &mesh.triangles {
        let [a, b, c] = [number(&t[0]), number(&t[1]), number(&t[2])];
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *net.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    net.values().filter(|n| **n != 0).count()
}

fn has_warning(mesh: &BooleanMesh, kind: WarningKind) -> bool {
    mesh.warnings.iter().any(|w| w.kind == kind)
}

fn moved(soup: &TriangleSoup, turn: Mat3, shift: Vec3) -> TriangleSoup {
    let positions = soup.positions().iter().map(|p| turn * *p + shift).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
}

fn cube_at(min: Vec3, size: f64) -> TriangleSoup {
    cuboid(Aabb { min, max: min + Vec3::splat(size) })
}

/// Volumes of union, intersection and difference; each closed, and as much as the operands have.
fn volumes(a: &TriangleSoup, b: &TriangleSoup) -> [f64; 3] {
    let [u, i, d] = [UNION, INTERSECTION, DIFFERENCE].map(|op| {
        let mesh = combined(a, op, b);
        assert_eq!(open_edges(&mesh), 0, "{op:?}");
        volume_of(&mesh)
    });
    let (of_a, of_b) = (volume_of_soup(a), volume_of_soup(b));
    let scale = 1e-9 * (of_a + of_b);
    assert!((u + i - of_a - of_b).abs() < scale, "{u} + {i} and {of_a} + {of_b}");
    assert!((d + i - of_a).abs() < scale, "{d} + {i} and {of_a}");
    [u, i, d]
}

/// As [`volumes`] for surfaces that nearly coincide.
fn nearly_volumes(a: &TriangleSoup, b: &TriangleSoup) {
    let [u, i, d] = [UNION, INTERSECTION, DIFFERENCE].map(|op| {
        let mesh = combined(a, op, b);
        assert_eq!(open_edges(&mesh), 0, "{op:?} {:?}", mesh.warnings);
        volume_of(&mesh)
    });
    let (of_a, of_b) = (volume_of_soup(a), volume_of_soup(b));
    assert!((u + i - of_a - of_b).abs() < 1e-8 && (d + i - of_a).abs() < 1e-8, "{u} {i} {d}");
}

#[test]
fn cubes_in_all_positions_have_the_volumes_of_boxes() {
    let a = cube_at(Vec3::ZERO, 2.0);
    for (x, y, z, size) in (0..4 * 4 * 4 * 3).map(|k| (k % 4, k / 4 % 4, k / 16 % 4, 1 + k / 64)) {
        let min = Vec3::new(f64::from(x), f64::from(y), f64::from(z)) - Vec3::ONE;
        let b = cube_at(min, f64::from(size));
        let common = (Vec3::splat(2.0).min(min + f64::from(size)) - min.max(Vec3::ZERO)).max(Vec3::ZERO);
        let [_, i, _] = volumes(&a, &b);
        assert!((i - common.x * common.y * common.z).abs() < 1e-9, "{min} {size}: {i}");
    }
}

#[test]
fn curved_solids_obey_their_volumes() {
    let turn = Mat3::from_rotation_z(0.3) * Mat3::from_rotation_x(1.1);
    let ring = torus(2.0, 0.7, 60, 30);
    volumes(&ring, &moved(&ring, turn, Vec3::new(1.0, 0.3, 0.2)));
    volumes(&ring, &moved(&sphere(16), turn, Vec3::new(1.8, 0.1, 0.0)));
    // Symmetric positions, in which vertices and edges meet.
    let ball = sphere(8);
    volumes(&ball, &moved(&ball, Mat3::from_cols(Vec3::Y, -Vec3::X, Vec3::Z), Vec3::ZERO));
    volumes(&ball, &moved(&ball, Mat3::IDENTITY, 0.5 * Vec3::X));
    // Not quite in the same place.
    let quarter = Mat3::from_rotation_z(std::f64::consts::FRAC_PI_2);
    nearly_volumes(&ball, &moved(&ball, quarter, Vec3::ZERO));
    let flush = moved(&cube(1.0), quarter * quarter * quarter, 2.0 * Vec3::X + 0.3 * Vec3::Y);
    nearly_volumes(&cube(1.0), &flush);
    volumes(&ball, &moved(&ball, Mat3::from_diagonal(Vec3::splat(0.5)), Vec3::ZERO));
}

#[test]
fn faces_away_from_the_cut_stay_as_they_are() {
    let (a, b) = (torus(2.0, 0.7, 60, 30), moved(&sphere(10), Mat3::IDENTITY, Vec3::new(2.0, 0.1, 0.2)));
    let mesh = combined(&a, DIFFERENCE, &b);
    let mut whole = 0;
    for (k, t) in mesh.triangles.iter().enumerate().filter(|(k, _)| mesh.operands[*k] == 0) {
        let corners = t.map(|v| mesh.positions[v as usize]);
        whole += usize::from(corners == a.corners(mesh.faces[k] as usize));
    }
    assert!(whole > a.len() / 2 && mesh.operands.contains(&1), "{whole} of {}", a.len());
    // Vertices are shared as before: a closed mesh has half as many, and two.
    let used: std::collections::HashSet<u32> = mesh.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), mesh.positions.len());
    assert!(mesh.positions.len() < mesh.triangles.len());
}

#[test]
fn equal_operands_are_their_union_and_intersection() {
    let ball = sphere(6);
    for op in [UNION, INTERSECTION] {
        let mesh = combined(&ball, op, &ball);
        assert_eq!(mesh.triangles, ball.triangles());
        assert_eq!(mesh.positions, ball.positions());
    }
    let none = combined(&ball, DIFFERENCE, &ball);
    assert!(none.triangles.is_empty() && has_warning(&none, WarningKind::EmptyResult));
    // The same surface in other triangles and in another order.
    let mut triangles: Vec<[u32; 3]> = ball.triangles().iter().map(|[a, b, c]| [*b, *c, *a]).collect();
    triangles.reverse();
    let other = TriangleSoup::new(ball.positions().to_vec(), triangles).unwrap();
    let [u, i, d] = volumes(&ball, &other);
    assert!((u - i).abs() < 1e-12 && d == 0.0);
}

#[test]
fn touching_and_disjoint_operands_have_defined_results() {
    let (a, b) = (cube_at(Vec3::ZERO, 1.0), cube_at(Vec3::X, 1.0));
    let joined = combined(&a, UNION, &b);
    let is_inner = |t: &[u32; 3]| t.iter().all(|v| joined.positions[*v as usize].x == 1.0);
    assert!(!joined.triangles.iter().any(is_inner), "the face between them is gone");
    assert!(combined(&a, INTERSECTION, &b).triangles.is_empty());
    assert_eq!(combined(&a, DIFFERENCE, &b).triangles.len(), 12);
    let far = cube_at(Vec3::splat(9.0), 1.0);
    assert_eq!(combined(&a, UNION, &far).triangles.len(), 24);
    assert!(has_warning(&combined(&a, INTERSECTION, &far), WarningKind::EmptyResult));
    let whole = combined(&a, DIFFERENCE, &far).soup();
    assert!(
        (0..12).all(|t| whole.corners(t) == a.corners(t))
            && whole.len() == 12
            && whole.positions().len() == 8
    );
    let inner = cube_at(Vec3::splat(0.25), 0.5);
    assert_eq!(combined(&a, UNION, &inner).triangles.len(), 12);
    assert_eq!(combined(&a, DIFFERENCE, &inner).triangles.len(), 24);
    assert!(combined(&inner, DIFFERENCE, &a).triangles.is_empty());
    let none = TriangleSoup::default();
    assert_eq!(combined(&a, UNION, &none).triangles.len(), 12);
    assert!(combined(&none, INTERSECTION, &a).triangles.is_empty());
}

#[test]
fn operands_that_cross_themselves_are_resolved() {
    let twice = joined(&[cube_at(Vec3::ZERO, 2.0), cube_at(Vec3::ONE, 2.0)]);
    let b = cube_at(Vec3::new(0.5, 0.25, 1.5), 1.0);
    for op in [UNION, INTERSECTION, DIFFERENCE] {
        let mesh = combined(&twice, op, &b);
        assert_eq!(open_edges(&mesh), 0);
        // Both cubes together have 15; of b, what lies in either of them: by halves along x, y and z.
        let of_b = 1.0;
        let first = 1.0 * 1.0 * 0.5;
        let second = 0.5 * 0.25 * 1.0;
        let both = 0.5 * 0.25 * 0.5;
        let common = first + second - both;
        let expected = match op {
            BooleanOp::Union => 15.0 + of_b - common,
            BooleanOp::Intersection => common,
            BooleanOp::Difference => 15.0 - common,
        };
        assert!((volume_of(&mesh) - expected).abs() < 1e-9, "{op:?}: {} of {expected}", volume_of(&mesh));
        assert!(has_warning(&mesh, WarningKind::SelfCrossing));
    }
}

/// Two boxes of one operand have faces of one plane; turned, these are some roundings apart.
#[test]
fn parts_with_nearly_coplanar_faces_are_resolved() {
    let upright = |min: Vec3, max: Vec3| cuboid(Aabb { min, max });
    let a = upright(Vec3::Z, Vec3::new(1.0, 2.0, 3.0));
    let parts = [
        upright(Vec3::new(0.0, 2.0, 0.0), Vec3::new(1.0, 3.0, 2.0)),
        upright(Vec3::new(0.0, 2.0, 1.0), Vec3::new(3.0, 3.0, 2.0)),
    ];
    let turn = Mat3::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.3);
    let b = moved(&joined(&parts), turn, Vec3::ZERO);
    let [u, i, d] = [UNION, INTERSECTION, DIFFERENCE].map(|op| {
        let mesh = combined(&a, op, &b);
        assert_eq!(open_edges(&mesh), 0, "{op:?} {:?}", mesh.warnings);
        volume_of(&mesh)
    });
    // The boxes of 2 and 3 have 1 in common.
    let (of_a, of_b) = (4.0, 2.0 + 3.0 - 1.0);
    assert!((u + i - of_a - of_b).abs() < 1e-8 && (d + i - of_a).abs() < 1e-8, "{u} {i} {d}");
}

#[test]
fn bad_options_and_doubtful_scales_are_told() {
    let (a, b) = (cube(1.0), cube(1000.0));
    let mesh = combined(&a, INTERSECTION, &b);
    assert!(has_warning(&mesh, WarningKind::DifferentScales) && mesh.triangles.len() == 12);
    for tolerance in [0.0, -1.0, f64::NAN] {
        let config = BooleanConfig { tolerance: Some(tolerance), ..Default::default() };
        let refused = boolean(&field(&a), &field(&b), UNION, &config, &Silent);
        assert!(matches!(refused, Err(BooleanError::BadTolerance(_))));
    }
    let cancelled = boolean(&field(&a), &field(&b), UNION, &Default::default(), &|_: f64, _: &str| false);
    assert!(matches!(cancelled, Err(BooleanError::Cancelled(_))));
}
