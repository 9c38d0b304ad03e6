//! Booleans of open soups and of clouds: the examples of Barill et al. 2018 (Figs. 13 to 15), in small.
mod common;

use common::*;
use fast_winding::data::{OrientedCloud, Shape, Silent, TriangleSoup, WarningKind};
use fast_winding::math::{Aabb, Vec3, area_vector, barycentre};
use fast_winding::solid::{BooleanConfig, BooleanMesh, BooleanOp, boolean};
use fast_winding::winding::{Accuracy, WindingField};

fn field(shape: impl Into<Shape>) -> WindingField {
    WindingField::new(shape, Default::default())
}

fn combined(a: &WindingField, op: BooleanOp, b: &WindingField) -> BooleanMesh {
    let mesh = boolean(a, b, op, &Default::default(), &Silent).unwrap();
    assert!(mesh.positions.iter().all(|p| p.is_finite()));
    mesh
}

fn expected(op: BooleanOp, a: bool, b: bool) -> bool {
    match op {
        BooleanOp::Union => a || b,
        BooleanOp::Intersection => a && b,
        BooleanOp::Difference => a && !b,
    }
}

/// The share of points at which the result's field says what those of the operands say; points near their level sets do not count.
fn agreement(mesh: &BooleanMesh, a: &WindingField, op: BooleanOp, b: &WindingField) -> f64 {
    let points = scattered(a.bounds().union(b.bounds()), 4000, 3);
    let at = |field: &WindingField| field.evaluate(&points, Accuracy::EXACT, &Silent).unwrap();
    let (of_a, of_b, of_result) = (at(a), at(b), at(&field(mesh.soup())));
    let is_clear = |k: &usize| (of_a[*k] - 0.5).abs() > 0.1 && (of_b[*k] - 0.5).abs() > 0.1;
    let clear: Vec<usize> = (0..points.len()).filter(is_clear).collect();
    assert!(clear.len() > points.len() / 2);
    let agrees = |k: &&usize| (of_result[**k] >= 0.5) == expected(op, of_a[**k] >= 0.5, of_b[**k] >= 0.5);
    clear.iter().filter(agrees).count() as f64 / clear.len() as f64
}

fn is_dropped(seed: u64, share: f64) -> impl Fn(usize) -> bool {
    let mut next = random(seed);
    let lots: Vec<f64> = (0..100_000).map(|_| next()).collect();
    move |t| lots[t] < share
}

/// A can along z.
fn cylinder(radius: f64, height: f64, around: u32, up: u32) -> TriangleSoup {
    let mut positions = Vec::new();
    for j in 0..=up {
        for i in 0..around {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(around)).sin_cos();
            positions.push(Vec3::new(
                radius * cos,
                radius * sin,
                height * (f64::from(j) / f64::from(up) - 0.5),
            ));
        }
    }
    let [bottom, top] = [-0.5, 0.5].map(|z| {
        positions.push(Vec3::new(0.0, 0.0, z * height));
        positions.len() as u32 - 1
    });
    let at = |i: u32, j: u32| j * around + i % around;
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..up {
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        triangles.push([at(i + 1, 0), at(i, 0), bottom]);
        triangles.push([at(i, up), at(i + 1, up), top]);
    }
    TriangleSoup::new(positions, triangles).unwrap()
}

#[test]
fn a_holey_cylinder_and_a_holey_body_combine_as_their_fields_do() {
    // Figure 13.
    let a = field(without(&cylinder(0.6, 3.0, 40, 30), is_dropped(1, 0.04)));
    let b = field(without(&sphere(14), is_dropped(2, 0.04)));
    for op in [BooleanOp::Union, BooleanOp::Intersection, BooleanOp::Difference] {
        let mesh = combined(&a, op, &b);
        assert!(mesh.warnings.iter().any(|w| w.kind == WarningKind::OpenOperands));
        assert!(mesh.operands.contains(&0) && mesh.operands.contains(&1));
        let agreement = agreement(&mesh, &a, op, &b);
        assert!(agreement > 0.99, "{op:?}: {agreement}");
    }
}

/// A square sheet of n × n cells in the plane y = 0.
fn sheet(half: f64, n: u32) -> TriangleSoup {
    let place = |k: u32| half * (2.0 * f64::from(k) / f64::from(n) - 1.0);
    let positions =
        (0..(n + 1) * (n + 1)).map(|k| Vec3::new(place(k % (n + 1)), 0.0, place(k / (n + 1)))).collect();
    let cell = |k: u32| {
        let [a, b] = [k / n * (n + 1) + k % n, (k / n + 1) * (n + 1) + k % n];
        [[a, a + 1, b], [a + 1, b + 1, b]]
    };
    TriangleSoup::new(positions, (0..n * n).flat_map(cell).collect()).unwrap()
}

/// Area of what is left of the first operand.
fn area_left(mesh: &BooleanMesh) -> f64 {
    let corners = |k: usize| mesh.triangles[k].map(|v| mesh.positions[v as usize]);
    (0..mesh.triangles.len())
        .filter(|k| mesh.operands[*k] == 0)
        .map(|k| area_vector(corners(k)).length())
        .sum()
}

#[test]
fn parts_of_a_facade_end_at_a_body() {
    // Figure 14: the sheet has no inside, so that what is left of the body is not asked.
    let body = field(cuboid(Aabb { min: Vec3::new(-0.5, -1.0, -0.4), max: Vec3::new(0.7, 1.0, 0.3) }));
    for n in [1, 7] {
        let mesh = combined(&field(sheet(1.0, n)), BooleanOp::Difference, &body);
        assert!((area_left(&mesh) - (4.0 - 1.2 * 0.7)).abs() < 1e-12);
    }
}

#[test]
fn where_the_body_is_open_a_sheet_is_cut_along_its_level_set() {
    // Of a half sphere without its disc, w is 1/2 on that disc.
    let half = field(without(&sphere(24), |t| {
        let n = 24 * 24;
        (t / n) & 4 != 0
    }));
    let chord = (0..half.shape().len()).count();
    assert_eq!(chord, 4 * 24 * 24);
    for n in [1, 9, 20] {
        let a = field(sheet(1.3, n));
        let mesh = combined(&a, BooleanOp::Difference, &half);
        let inner = 2.6 * 2.6 - area_left(&mesh);
        assert!((inner - 0.5 * std::f64::consts::PI).abs() < 0.01, "{n}: {inner}");
        for (k, t) in mesh.triangles.iter().enumerate().filter(|(k, _)| mesh.operands[*k] == 0) {
            let center = barycentre(t.map(|v| mesh.positions[v as usize]));
            let inside = center.length() < 0.98 && center.z > 0.02;
            assert!(!inside, "piece {k} of face {} at {center}", mesh.faces[k]);
        }
    }
    let finer = BooleanConfig { tolerance: Some(0.005), ..Default::default() };
    let mesh = boolean(&field(sheet(1.3, 9)), &half, BooleanOp::Difference, &finer, &Silent).unwrap();
    let inner = 2.6 * 2.6 - area_left(&mesh);
    assert!((inner - 0.5 * std::f64::consts::PI).abs() < 5e-3, "{inner}");
}

#[test]
fn a_cloud_and_ribbons_are_joined() {
    // Figure 15.
    let a: OrientedCloud = sphere_cloud(3000);
    let ribbons = without(&torus(1.0, 0.4, 48, 24), |t| t / 48 % 6 == 0);
    let (a, b) = (field(a), field(ribbons));
    for op in [BooleanOp::Union, BooleanOp::Difference] {
        let mesh = combined(&a, op, &b);
        let agreement = agreement(&mesh, &a, op, &b);
        assert!(agreement > 0.985, "{op:?}: {agreement}");
    }
}

#[test]
fn clouds_combine_to_closed_surfaces() {
    let a = sphere_cloud(2500);
    let points = a.points().iter().map(|p| *p + 0.8 * Vec3::X).collect();
    let b = OrientedCloud::new(points, a.normals().to_vec(), a.areas().to_vec()).unwrap();
    let (a, b) = (field(a), field(b));
    // Two caps of height 0.6.
    let lens = 2.0 * std::f64::consts::PI * 0.6 * 0.6 * (1.0 - 0.2);
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    for (op, volume) in [
        (BooleanOp::Union, 2.0 * ball - lens),
        (BooleanOp::Intersection, lens),
        (BooleanOp::Difference, ball - lens),
    ] {
        let mesh = combined(&a, op, &b);
        let result = field(mesh.soup());
        assert!(result.is_closed());
        let at = |v: u32| mesh.positions[v as usize];
        let found: f64 = mesh.triangles.iter().map(|[a, b, c]| at(*a).dot(at(*b).cross(at(*c))) / 6.0).sum();
        assert!((found / volume - 1.0).abs() < 0.02, "{op:?}: {found} of {volume}");
    }
}
