//! One measured job in a process of its own, for `tests/bench/peers/compare.py`.
//!
//! `measure MODEL RESOLUTION VALUES` reads a model (a `.f64` file is a cloud: raw little-endian point, normal and area of
//! each point); builds the field and evaluates it with the paper's parameters on a lattice of RESOLUTION cells along the
//! longest side, as a lattice and point by point; voxelizes; writes the lattice's values as raw f64, x fastest, and prints
//! its times in seconds as JSON.
use fast_winding::data::{Lattice, OrientedCloud, Shape, Silent, TriangleSoup};
use fast_winding::io::{self, Geometry};
use fast_winding::math::Vec3;
use fast_winding::solid::{VoxelConfig, voxelize};
use fast_winding::winding::{Accuracy, FieldConfig, WindingField};
use std::time::Instant;

const BUILDS: usize = 5;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [model, resolution, values] = &arguments[..] else {
        panic!("usage: measure MODEL RESOLUTION VALUES")
    };
    let shape =
        if model.ends_with(".f64") { Shape::from(read_cloud(model)) } else { Shape::from(read_soup(model)) };
    let resolution: usize = resolution.parse().expect("the resolution is a number");

    let mut builds = Vec::new();
    let mut field = None;
    for _ in 0..BUILDS {
        let (time, built) = timed(|| WindingField::new(shape.clone(), FieldConfig::default()));
        builds.push(time);
        field = Some(built);
    }
    builds.sort_by(f64::total_cmp);
    let field = field.expect("it was built");

    let lattice = Lattice::with_resolution(field.bounds(), resolution).expect("the model has a size");
    let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
    let accuracy = Accuracy::of_paper(&shape);
    let (evaluation, grid) =
        timed(|| field.evaluate_lattice(&lattice, accuracy, &Silent).expect("nothing cancels"));
    let (scattered, _) = timed(|| field.evaluate(&points, accuracy, &Silent).expect("nothing cancels"));
    let config = VoxelConfig::default();
    let (voxels, solid) = timed(|| voxelize(&field, &lattice, &config, &Silent).expect("nothing cancels"));
    std::fs::write(values, grid.values.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>())
        .expect("written");
    println!(
        "{{\"elements\": {}, \"build\": {}, \"evaluation\": {evaluation}, \"scattered\": {scattered}, \
         \"voxels\": {voxels}, \"inside\": {}, \"bytes\": {}}}",
        shape.len(),
        builds[BUILDS / 2],
        solid.count(),
        field.report().bytes,
    );
}

fn timed<T>(job: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = job();
    (start.elapsed().as_secs_f64(), result)
}

fn read_soup(path: &str) -> TriangleSoup {
    let bytes = std::fs::read(path).expect("the model can be read");
    match io::read(&bytes).expect("the model is understood").geometry {
        Geometry::Soup(soup) => soup,
        Geometry::Cloud(_) => panic!("{path} has no triangles"),
    }
}

fn read_cloud(path: &str) -> OrientedCloud {
    let records = read_numbers::<7>(path);
    let vector = |at: usize| records.iter().map(|r| Vec3::new(r[at], r[at + 1], r[at + 2])).collect();
    OrientedCloud::new(vector(0), vector(3), records.iter().map(|r| r[6]).collect())
        .expect("the cloud is complete")
}

fn read_numbers<const N: usize>(path: &str) -> Vec<[f64; N]> {
    let bytes = std::fs::read(path).expect("the file can be read");
    let number = |chunk: &[u8]| f64::from_le_bytes(chunk.try_into().expect("eight bytes"));
    let record = |chunk: &[u8]| std::array::from_fn(|k| number(&chunk[8 * k..8 * k + 8]));
    bytes.chunks_exact(8 * N).map(record).collect()
}
