//! One measured job in a process of its own, for `tests/bench/peers/compare.py`.
//!
//! `measure MODEL QUERIES VALUES` reads a model (a `.f64` file is a cloud: raw little-endian point, normal and area of each
//! point), and queries as raw triples; builds the field and evaluates it with the paper's parameters; writes the values as
//! raw f64 and prints its times as JSON.
use fast_winding::data::{OrientedCloud, Shape, Silent, TriangleSoup};
use fast_winding::io::{self, Geometry};
use fast_winding::math::Vec3;
use fast_winding::winding::{Accuracy, FieldConfig, WindingField};
use std::time::Instant;

const BUILDS: usize = 5;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [model, queries, values] = &arguments[..] else { panic!("usage: measure MODEL QUERIES VALUES") };
    let shape =
        if model.ends_with(".f64") { Shape::from(read_cloud(model)) } else { Shape::from(read_soup(model)) };
    let queries: Vec<Vec3> = read_numbers::<3>(queries).into_iter().map(Vec3::from_array).collect();

    let mut builds = Vec::new();
    let mut field = None;
    for _ in 0..BUILDS {
        let start = Instant::now();
        field = Some(WindingField::new(shape.clone(), FieldConfig::default()));
        builds.push(start.elapsed().as_secs_f64());
    }
    builds.sort_by(f64::total_cmp);
    let field = field.expect("it was built");

    let start = Instant::now();
    let result = field.evaluate(&queries, Accuracy::of_paper(&shape), &Silent).expect("nothing cancels");
    let evaluation = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let inside = field.contains(&queries, &Silent).expect("nothing cancels");
    let classification = start.elapsed().as_secs_f64();
    std::fs::write(values, result.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>())
        .expect("values are written");
    println!(
        "{{\"elements\": {}, \"build\": {}, \"evaluation\": {evaluation}, \"classification\": {classification}, \"inside\": {}, \"bytes\": {}}}",
        shape.len(),
        builds[BUILDS / 2],
        inside.iter().filter(|i| **i).count(),
        field.report().bytes,
    );
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
