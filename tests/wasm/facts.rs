//! Integers, topology and classification are equal in both worlds, floats agree to 1e-12 relative. The numbers below are
//! what the native build gives; the closed forms beside them say that they are sound.
use super::common::{joined, random, sphere, sphere_cloud, torus, without};
use fast_winding::PointCloud;
use fast_winding::data::{Lattice, Shape, Silent, TriangleSoup};
use fast_winding::estimate::{self, EstimateConfig};
use fast_winding::io::{self, Geometry, MeshFormat};
use fast_winding::math::Vec3;
use fast_winding::slice::{LayerPlan, SliceConfig, slice};
use fast_winding::solid::{VoxelConfig, voxelize};
use fast_winding::surface::{SurfaceConfig, extract};
use fast_winding::winding::{Accuracy, FieldConfig, Order, WindingField};

fn field(shape: impl Into<Shape>) -> WindingField {
    WindingField::new(shape, FieldConfig::default())
}

/// A torus with every 20th triangle missing, and a sphere in its hole.
fn broken() -> TriangleSoup {
    without(&joined(&[torus(3.0, 1.0, 48, 24), sphere(12)]), |t| t % 20 == 7)
}

fn points(count: usize) -> Vec<Vec3> {
    let mut number = random(5);
    (0..count).map(|_| Vec3::new(8.0 * number() - 4.0, 8.0 * number() - 4.0, 3.0 * number() - 1.5)).collect()
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found:?} is not {expected:?}");
}

/// A number for a sequence of bits, which any change alters: FNV-1a.
fn digest(bits: impl IntoIterator<Item = bool>) -> u64 {
    bits.into_iter().fold(0xcbf2_9ce4_8422_2325, |h, bit| (h ^ u64::from(bit)).wrapping_mul(0x100_0000_01b3))
}

pub fn points_are_classified_alike() {
    let inside = field(broken()).contains(&points(5000), &Silent).unwrap();
    let count = inside.iter().filter(|i| **i).count();
    assert_eq!((count, digest(inside)), (1617, 13_729_516_874_727_454_168));
}

pub fn winding_numbers_agree() {
    let field = field(broken());
    let sum = |accuracy| field.evaluate(&points(500), accuracy, &Silent).unwrap().iter().sum::<f64>();
    assert_close(sum(Accuracy::EXACT), 168.87581617758437);
    assert_close(sum(Accuracy::Explicit { order: Order::Two, beta: 2.0 }), 168.74853228527954);
    assert_close(sum(Accuracy::Explicit { order: Order::Zero, beta: 1.5 }), 153.27850038323402);
}

pub fn voxels_agree() {
    let field = field(broken());
    let lattice = Lattice::with_resolution(field.bounds(), 40).unwrap();
    let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
    let surface = voxels.surface().unwrap();
    assert_eq!((lattice.counts, voxels.count()), ([40, 40, 10], 7900));
    assert_eq!((surface.positions.len(), surface.triangles.len()), (4730, 9456));
    assert_close(voxels.volume(), 63.20000000000002);
}

pub fn layers_agree() {
    let field = field(broken());
    let plan = LayerPlan { layer_height: 0.25, ..LayerPlan::default() };
    let layers = slice(&field, &plan, &SliceConfig::default(), &Silent).unwrap();
    let holes = layers.iter().flat_map(|l| &l.polygons).map(|p| p.holes.len()).sum::<usize>();
    let corners = layers.iter().flat_map(|l| &l.polygons).map(|p| p.outer.len()).sum::<usize>();
    let polygons = layers.iter().map(|l| l.polygons.len()).sum::<usize>();
    assert_eq!((layers.len(), polygons, holes, corners), (8, 16, 8, 1783));
    assert_close(layers.iter().map(|l| l.area()).sum(), 253.45132769963308);
}

pub fn surfaces_agree() {
    let field = field(sphere_cloud(2000));
    let mesh = extract(&field, &SurfaceConfig { resolution: Some(20), ..SurfaceConfig::default() }, &Silent)
        .unwrap();
    // A sphere: twice as many faces as vertices, less four.
    assert_eq!(mesh.triangles.len(), 2 * mesh.positions.len() - 4);
    assert_eq!(mesh.positions.len(), 1896);
    assert_close(mesh.volume(), 4.172376463313182);
}

pub fn clouds_are_completed_alike() {
    let sphere = sphere_cloud(1000);
    let (raw, _) = PointCloud::cleaned(sphere.points().to_vec(), None, None).unwrap();
    let (oriented, warnings) = estimate::orient(&raw, &EstimateConfig::default(), &Silent).unwrap();
    let outward = oriented.points().iter().zip(oriented.normals()).filter(|(p, n)| p.dot(**n) > 0.0).count();
    assert_eq!((outward, warnings.len()), (1000, 1));
    assert_close(oriented.areas().iter().sum(), 12.515343017700227);
    assert_close(field(oriented).at(Vec3::new(0.1, 0.2, 0.3), Accuracy::EXACT), 0.9958267500088142);
}

pub fn files_are_read_alike() {
    let soup = broken();
    for format in [MeshFormat::Stl, MeshFormat::Obj, MeshFormat::Ply, MeshFormat::Off] {
        let mut file = Vec::new();
        io::write_soup(&soup, format, &mut file).unwrap();
        let Geometry::Soup(read) = io::read(&file).unwrap().geometry else {
            panic!("{format:?} gave a cloud")
        };
        assert_eq!(read.len(), soup.len());
        let is_exact = (0..soup.len()).all(|t| read.corners(t) == soup.corners(t));
        assert_eq!(is_exact, format != MeshFormat::Stl, "{format:?}");
    }
}
