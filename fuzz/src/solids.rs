//! Voxels and booleans.
use super::facts::{Watch, imbalance, place};
use super::shapes::Made;
use super::slices::reaches_far;
use super::source::Source;
use fast_winding::data::{Lattice, Shape, Silent, TriangleSoup, VoxelBricks};
use fast_winding::io::{NrrdEncoding, VoxContent, write_nrrd, write_vox};
use fast_winding::math::{Vec3, squared_distance_to_triangle};
use fast_winding::solid::{
    BooleanConfig, BooleanOp, PointsOf, VoxelConfig, VoxelMethod, boolean, voxelize, voxelize_bricks,
};
use fast_winding::winding::{FieldConfig, Order, StabCount, Stabbing, WindingField};

pub fn voxels(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape, is_tame } = source.shape();
    let field = WindingField::new(shape, FieldConfig::default());
    let Ok(mut lattice) = Lattice::with_resolution(field.bounds(), 1 + source.below(10)) else { return };
    if source.below(4) == 0 {
        lattice.origin += lattice.spacing * source.grid_point();
        lattice.counts = [1 + source.below(6), 1 + source.below(6), 1 + source.below(12)];
    }
    let stabbing =
        Stabbing { count: source.pick(&[StabCount::Parity, StabCount::Signed]), majority: source.flag() };
    let fast =
        VoxelMethod::Fast { order: source.pick(&[Order::Zero, Order::Two]), beta: source.setting(&[2.0]) };
    let methods = [
        VoxelMethod::Lattice,
        VoxelMethod::Lattice,
        VoxelMethod::Continuation,
        VoxelMethod::Rays(stabbing),
        fast,
        VoxelMethod::Points(source.pick(&[PointsOf::Vertices, PointsOf::Barycentres])),
    ];
    let config = VoxelConfig { method: source.pick(&methods), threshold: source.setting(&[0.5, 0.5, 1.5]) };
    let Ok(voxels) = voxelize(&field, &lattice, &config, &Watch::new(source.byte())) else { return };
    let inside = voxels.to_bytes().expect("the voxels are few");
    if is_tame && config.method == VoxelMethod::Lattice && config.threshold == 0.5 {
        let [nx, ny, _] = lattice.counts;
        let at = |k: usize| {
            let steps = Vec3::new((k % nx) as f64, (k / nx % ny) as f64, (k / (nx * ny)) as f64);
            lattice.origin + lattice.spacing * steps
        };
        let samples: Vec<Vec3> = (0..inside.len()).map(at).collect();
        let expected = field.contains(&samples, &Silent).expect("nobody cancels");
        if matches!(field.shape(), Shape::Soup(_)) {
            let wrong = (0..inside.len()).find(|k| (inside[*k] == 1) != expected[*k]);
            assert_eq!(wrong.map(at), None, "a voxel is other than the point");
        }
    }
    let mut out = Vec::new();
    for content in [VoxContent::Shell, VoxContent::Solid] {
        write_vox(&voxels, content, &mut out).expect("memory takes what is written");
    }
    write_nrrd(&voxels, NrrdEncoding::Raw, &mut out).expect("memory takes what is written");
    let bricks = VoxelBricks::from_voxels(&voxels).expect("the voxels are few");
    assert_eq!(bricks.to_voxels().expect("the voxels are few"), voxels, "bricks are the voxels");
    if let Ok(bricks) = voxelize_bricks(&field, &lattice, &config, &Watch::new(0)) {
        assert_eq!(
            bricks.to_voxels().expect("the voxels are few"),
            voxels,
            "bricks made at once are the voxels"
        );
    }
    voxels.surface().expect("the voxels are few");
}

/// Nearer to a surface than this share of the size, rounding may put a point on either side.
const NEAR: f64 = 1e-6;
/// Points in which booleans are held against their operands.
const PROBES: usize = 8;

pub fn booleans(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let closed = source.below(4) > 0;
    let operand = |source: &mut Source| {
        if closed {
            let Made { shape, is_tame } = source.solid();
            Made { shape: Shape::from(shape), is_tame }
        } else {
            source.shape()
        }
    };
    let (a, b) = (operand(&mut source), operand(&mut source));
    let is_tame = a.is_tame && b.is_tame;
    let [a, b] = [a.shape, b.shape].map(|shape| WindingField::new(shape, FieldConfig::default()));
    let op = source.pick(&[BooleanOp::Union, BooleanOp::Intersection, BooleanOp::Difference]);
    // Where nothing is open, no tolerance counts.
    let tolerance = source.option(&[0.2, 0.5]).filter(|t| closed || t.is_nan() || *t >= 0.1 || *t <= 0.0);
    let config = BooleanConfig { tolerance, resolution: Some(source.below(12)) };
    let watch = Watch::new(source.byte());
    if [&a, &b].iter().any(|field| reaches_far(field, None, config.resolution.unwrap_or(1))) {
        return;
    }
    let Ok(mesh) = boolean(&a, &b, op, &config, &watch) else { return };
    assert!(mesh.positions.iter().all(|p| p.is_finite()), "a boolean with a vertex that is not finite");
    assert!(mesh.triangles.iter().flatten().all(|v| (*v as usize) < mesh.positions.len()));
    assert_eq!((mesh.operands.len(), mesh.faces.len()), (mesh.triangles.len(), mesh.triangles.len()));
    if !(closed && is_tame) {
        return;
    }
    let places = mesh.triangles.iter().map(|t| t.map(|v| place(mesh.positions[v as usize])));
    let open = imbalance(places);
    assert!(
        open.is_empty(),
        "{op:?} of closed soups is open at {} edges, warnings {:?}",
        open.len(),
        mesh.warnings
    );
    let soup = mesh.soup();
    let bounds = a.bounds().union(b.bounds());
    let result = WindingField::new(soup.clone(), FieldConfig::default());
    for q in source.queries(bounds, PROBES) {
        let limit = (NEAR * bounds.diagonal()).powi(2);
        let is_near = |soup: &TriangleSoup| {
            (0..soup.len()).any(|t| squared_distance_to_triangle(q, soup.corners(t)) < limit)
        };
        let near = [&a, &b].iter().any(|field| matches!(field.shape(), Shape::Soup(soup) if is_near(soup)));
        if near || is_near(&soup) {
            continue;
        }
        let (in_a, in_b) = (a.contains_point(q), b.contains_point(q));
        let expected = match op {
            BooleanOp::Union => in_a || in_b,
            BooleanOp::Intersection => in_a && in_b,
            BooleanOp::Difference => in_a && !in_b,
        };
        assert_eq!(result.contains_point(q), expected, "{op:?} at {q}, warnings {:?}", mesh.warnings);
    }
}
