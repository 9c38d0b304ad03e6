//! Voxels: ways of making them side by side, in bricks, and where they differ.
mod common;

use common::{bunny, cube, damaged, flipped, joined, sphere, sphere_cloud, torus, without};
use fast_winding::data::{Shape, Silent};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::solid::{
    PointsOf, VoxelConfig, VoxelError, VoxelMethod, Voxels, difference, voxelize, voxelize_bricks,
};
use fast_winding::winding::{
    Order, RayParity, Rays, StabCount, Stabbing, WindingField, winding_of_cloud, winding_of_soup,
};
use fast_winding::{Lattice, TriangleSoup};

fn field(shape: impl Into<Shape>) -> WindingField {
    WindingField::new(shape, Default::default())
}

fn by(method: VoxelMethod, field: &WindingField, lattice: &Lattice) -> Voxels {
    voxelize(field, lattice, &VoxelConfig { method, threshold: 0.5 }, &Silent).unwrap()
}

fn rays(count: StabCount, majority: bool) -> VoxelMethod {
    VoxelMethod::Rays(Stabbing { count, majority })
}

/// A little larger than the shape, so that no sample lies on a face of a cube.
fn lattice(soup: &TriangleSoup, resolution: usize) -> Lattice {
    let bounds = soup.bounds();
    let by = 0.013 * bounds.size();
    Lattice::with_resolution(Aabb { min: bounds.min - by, max: bounds.max + 1.7 * by }, resolution).unwrap()
}

#[test]
fn rays_agree_with_the_field_off_closed_surfaces() {
    for soup in [torus(2.0, 0.7, 40, 20), sphere(9), flipped(&sphere(5))] {
        let (lattice, field) = (lattice(&soup, 30), field(soup.clone()));
        let exact = by(VoxelMethod::Lattice, &field, &lattice);
        let is_flipped = exact.count() == 0;
        for majority in [false, true] {
            assert_eq!(by(rays(StabCount::Signed, majority), &field, &lattice), exact);
            let parity = by(rays(StabCount::Parity, majority), &field, &lattice);
            // Parity knows no orientation.
            assert_eq!(parity == exact, !is_flipped);
            assert!(parity.count() > 1000);
        }
    }
}

#[test]
fn parity_along_rows_is_that_of_single_rays() {
    // Rays of the oracle run along +x, rows are counted from −x: what closes them is a whole number of crossings of the row.
    let soup = joined(&[sphere(6), cube(0.6), torus(0.8, 0.3, 20, 12)]);
    let (lattice, field) = (lattice(&soup, 23), field(soup.clone()));
    let found = by(rays(StabCount::Parity, false), &field, &lattice);
    let oracle = RayParity::new(&soup, Rays::Axis);
    let expected: Vec<u8> =
        (0..lattice.len()).map(|i| u8::from(oracle.contains(lattice.point(lattice.sample(i))))).collect();
    assert_eq!(found.to_bytes().unwrap(), expected);
    // Where two of the three overlap parity leaves a hole, the field none.
    let exact = by(VoxelMethod::Lattice, &field, &lattice);
    let change = difference(&exact, &found).unwrap();
    assert!(change.lost.len() > 500 && change.gained.is_empty(), "{}", change.count());
}

#[test]
fn a_vote_of_three_axes_bridges_a_hole_that_one_of_them_meets() {
    let sphere = sphere(12);
    let open = without(&sphere, |t| {
        let middle = sphere.corners(t).into_iter().sum::<Vec3>() / 3.0;
        middle.x < -0.9
    });
    let (lattice, whole, open) = (lattice(&sphere, 24), field(sphere), field(open));
    let exact = by(VoxelMethod::Lattice, &whole, &lattice);
    let one = by(rays(StabCount::Parity, false), &open, &lattice);
    let vote = by(rays(StabCount::Parity, true), &open, &lattice);
    let wrong = |found: &Voxels| {
        let change = difference(&exact, found).unwrap();
        [change.lost, change.gained].concat()
    };
    assert!(wrong(&one).len() > 400, "{}", wrong(&one).len());
    // Two of the three rays meet it near its rim only.
    let is_near = |i: &u32| lattice.point(lattice.sample(*i as usize)).x < -0.8;
    assert!(wrong(&vote).len() < 100 && wrong(&vote).iter().all(is_near), "{}", wrong(&vote).len());
}

#[test]
fn approximations_differ_from_the_truth_where_it_is_near_the_threshold() {
    let soup = bunny();
    let (lattice, field) = (lattice(&soup, 11), field(soup.clone()));
    let exact = by(VoxelMethod::Lattice, &field, &lattice);
    let fast = by(VoxelMethod::Fast { order: Order::Two, beta: 2.0 }, &field, &lattice);
    for index in difference(&exact, &fast).unwrap().gained {
        let w = winding_of_soup(&soup, lattice.point(lattice.sample(index as usize)));
        assert!((w - 0.5).abs() < 0.05, "{w}");
    }
    let direct = by(VoxelMethod::Fast { order: Order::Two, beta: 1e6 }, &field, &lattice);
    assert_eq!(difference(&exact, &direct).unwrap().count(), 0);
}

#[test]
fn points_stand_for_triangles() {
    let soup = torus(2.0, 0.7, 60, 30);
    let (lattice, field) = (lattice(&soup, 24), field(soup.clone()));
    for (points, cloud) in
        [(PointsOf::Vertices, soup.vertex_cloud().0), (PointsOf::Barycentres, soup.barycentre_cloud().0)]
    {
        let found = by(VoxelMethod::Points(points), &field, &lattice);
        let w = |i: usize| winding_of_cloud(&cloud, lattice.point(lattice.sample(i)));
        assert!((0..lattice.len()).all(|i| found.get(lattice.sample(i)) == (w(i) >= 0.5)));
    }
    let cloud = self::field(sphere_cloud(400));
    let lattice = Lattice::with_resolution(cloud.bounds(), 12).unwrap();
    let as_it_is = by(VoxelMethod::Points(PointsOf::Vertices), &cloud, &lattice);
    assert_eq!(as_it_is, by(VoxelMethod::Lattice, &cloud, &lattice));
}

#[test]
fn bricks_hold_the_same_voxels() {
    let open = without(&sphere(10), |t| t % 97 == 3);
    let shapes: [Shape; 5] = [
        torus(2.0, 0.7, 40, 20).into(),
        open.into(),
        damaged(&sphere(18), 5).into(),
        sphere_cloud(500).into(),
        bunny().into(),
    ];
    for shape in shapes {
        let (bounds, field) = (shape.bounds(), field(shape));
        let lattice = Lattice::with_resolution(bounds, 43).unwrap();
        for method in [VoxelMethod::Lattice, VoxelMethod::Continuation] {
            let config = VoxelConfig { method, threshold: 0.3 };
            let voxels = voxelize(&field, &lattice, &config, &Silent).unwrap();
            let bricks = voxelize_bricks(&field, &lattice, &config, &Silent).unwrap();
            assert_eq!(bricks.to_voxels().unwrap(), voxels);
            assert_eq!(bricks.count(), voxels.count());
            assert_eq!(bricks.surface().unwrap(), voxels.surface().unwrap());
            assert_eq!(difference(&bricks, &voxels).unwrap().count(), 0);
        }
    }
}

#[test]
fn memory_of_bricks_grows_with_the_surface() {
    let field = field(sphere(30));
    let bytes = |resolution: usize| {
        let lattice = Lattice::with_resolution(field.bounds(), resolution).unwrap();
        let config = VoxelConfig::default();
        voxelize_bricks(&field, &lattice, &config, &Silent).unwrap().bytes() as f64
    };
    // Four times as much surface; a bit for each voxel would take eight times as much.
    let growth = bytes(512) / bytes(256);
    assert!((3.2..4.8).contains(&growth), "{growth}");
}

#[test]
fn requests_that_cannot_be_are_refused() {
    let (soup, cloud) = (field(cube(1.0)), field(sphere_cloud(50)));
    let lattice = Lattice::with_resolution(soup.bounds(), 4).unwrap();
    let with = |field: &WindingField, method, threshold| {
        voxelize_bricks(field, &lattice, &VoxelConfig { method, threshold }, &Silent).map(|v| v.count())
    };
    let parity = rays(StabCount::Parity, false);
    assert_eq!(with(&cloud, parity, 0.5), Err(VoxelError::NoTriangles { points: 50 }));
    assert!(matches!(with(&soup, parity, f64::NAN), Err(VoxelError::BadThreshold(_))));
    let fast = |beta| VoxelMethod::Fast { order: Order::Zero, beta };
    assert_eq!(with(&soup, fast(-1.0), 0.5), Err(VoxelError::BadBeta(-1.0)));
    assert_eq!(with(&soup, VoxelMethod::Lattice, 0.5), Ok(64));
    let other = Lattice { origin: Vec3::ZERO, ..lattice };
    let voxels = |lattice: &Lattice| by(VoxelMethod::Lattice, &soup, lattice);
    assert!(difference(&voxels(&lattice), &voxels(&other)).is_err());
    let stop = |_: f64, _: &str| false;
    for method in [VoxelMethod::Lattice, VoxelMethod::Continuation, parity, fast(2.0)] {
        let config = VoxelConfig { method, threshold: 0.5 };
        let found = voxelize_bricks(&soup, &lattice, &config, &stop).map(|v| v.count());
        assert!(matches!(found, Err(VoxelError::Cancelled(_))), "{found:?}");
    }
}

#[test]
fn lattices_without_samples_have_no_voxels() {
    let soup = field(cube(1.0));
    for counts in [[0, 3, 3], [3, 0, 3], [3, 3, 0]] {
        let lattice = Lattice { origin: Vec3::ZERO, spacing: Vec3::ONE, counts };
        let rays = rays(StabCount::Parity, true);
        for method in [VoxelMethod::Lattice, VoxelMethod::Continuation, rays] {
            let config = VoxelConfig { method, threshold: 0.5 };
            let voxels = voxelize(&soup, &lattice, &config, &Silent).unwrap();
            let bricks = voxelize_bricks(&soup, &lattice, &config, &Silent).unwrap();
            assert_eq!((voxels.count(), bricks.count()), (0, 0));
            assert!(voxels.surface().unwrap().positions.is_empty());
            assert!(bricks.surface().unwrap().positions.is_empty());
        }
    }
}
