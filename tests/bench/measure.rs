//! One measured job in a process of its own, for `tests/bench/peers/compare.py`.
//!
//! `measure MODEL QUERIES VALUES [cloud]` reads a model, and queries as raw little-endian f64 triples; builds the field
//! and evaluates it with the paper's parameters; writes the values as raw f64 and prints its times as JSON.
use fast_winding::data::{OrientedCloud, Shape, Silent, TriangleSoup};
use fast_winding::io::{self, Geometry};
use fast_winding::math::{Vec3, area_vector, barycentre};
use fast_winding::winding::{Accuracy, FieldConfig, WindingField};
use std::time::Instant;

const BUILDS: usize = 5;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [model, queries, values, rest @ ..] = &arguments[..] else {
        panic!("usage: measure MODEL QUERIES VALUES [cloud]");
    };
    let bytes = std::fs::read(model).expect("the model can be read");
    let Geometry::Soup(soup) = io::read(&bytes).expect("the model is understood").geometry else {
        panic!("{model} has no triangles");
    };
    let shape =
        if rest.iter().any(|a| a == "cloud") { Shape::from(barycentres(&soup)) } else { Shape::from(soup) };
    let queries = read_points(queries);

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

/// The cloud that compare.py makes too: barycentres with the triangles' normals and areas.
fn barycentres(soup: &TriangleSoup) -> OrientedCloud {
    let corners = (0..soup.len()).map(|t| soup.corners(t)).filter(|t| area_vector(*t).length() > 0.0);
    let (points, vectors): (Vec<Vec3>, Vec<Vec3>) = corners.map(|t| (barycentre(t), area_vector(t))).unzip();
    let areas = vectors.iter().map(|v| v.length()).collect();
    OrientedCloud::new(points, vectors, areas).expect("triangles with an area have a normal")
}

fn read_points(path: &str) -> Vec<Vec3> {
    let bytes = std::fs::read(path).expect("the queries can be read");
    let number = |chunk: &[u8]| f64::from_le_bytes(chunk.try_into().expect("eight bytes"));
    bytes.chunks_exact(24).map(|p| Vec3::new(number(&p[..8]), number(&p[8..16]), number(&p[16..]))).collect()
}
