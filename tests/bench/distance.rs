//! Times of distances: `distance MODEL [--points FILE] [--lattice N] [--sign hard|smooth|none] [--band MM] [--rounds N] [--output FILE]`.
//! With `--offset MM` or `--hollow MM` instead, and `--resolution N` and `--sharp A`: surfaces at a distance, walls of a thickness.
//!
//! FILE holds the points as raw f64, x, y, z; a lattice has N samples along each side of the model's bounds, grown by a tenth of their
//! diagonal. Prints JSON: medians in seconds of the field (`field`), the tree (`tree`) and the distances (`query`), in nanoseconds for
//! each place (`each`). `--output` takes the distances as raw f64.
use fast_winding::data::{Lattice, Shape, Silent, SurfaceMesh};
use fast_winding::estimate::{EstimateConfig, complete};
use fast_winding::io::{self, Geometry};
use fast_winding::math::Vec3;
use fast_winding::solid::{DistanceConfig, DistanceSign, SignedDistance};
use fast_winding::surface::{HollowConfig, OffsetConfig, hollow, offset};
use fast_winding::winding::WindingField;
use std::collections::HashMap;
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let options: HashMap<&str, &str> =
        words[1..].chunks(2).map(|o| (o[0].trim_start_matches("--"), o[1].as_str())).collect();
    let shape: Shape = match io::read(&std::fs::read(&words[0]).expect("a model")).expect("a model").geometry
    {
        Geometry::Soup(soup) => soup.into(),
        Geometry::Cloud(cloud) => {
            complete(&cloud, &EstimateConfig::default(), &Silent).expect("a cloud").into()
        }
    };
    let sign = match options.get("sign").copied().unwrap_or("hard") {
        "hard" => DistanceSign::Hard,
        "smooth" => DistanceSign::Smooth,
        "none" => DistanceSign::None,
        other => panic!("unknown sign '{other}': hard, smooth and none are known"),
    };
    let band = options.get("band").map(|b| b.parse().expect("millimetres"));
    let config = DistanceConfig { sign, band };
    let rounds = options.get("rounds").map_or(5, |r| r.parse().expect("a number"));
    let (mut fields, mut trees, mut queries, mut found) = (vec![], vec![], vec![], vec![]);
    for _ in 0..rounds {
        let start = Instant::now();
        let field = WindingField::new(shape.clone(), Default::default());
        fields.push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let distance = SignedDistance::new(&field);
        trees.push(start.elapsed().as_secs_f64());
        let bounds = field.bounds().padded(0.1 * field.bounds().diagonal());
        let start = Instant::now();
        if let Some(made) = surface(&field, &options) {
            queries.push(start.elapsed().as_secs_f64());
            found = vec![made.volume(); made.triangles.len()];
        } else if let Some(count) = options.get("lattice") {
            let count = count.parse().expect("a number");
            let lattice = Lattice::with_counts(bounds, [count; 3]).expect("a lattice");
            let start = Instant::now();
            let grid = distance.lattice(&lattice, &config, &Silent).expect("distances");
            queries.push(start.elapsed().as_secs_f64());
            found = grid.values.into_iter().map(f64::from).collect();
        } else {
            let points = read_points(options["points"]);
            let start = Instant::now();
            found = distance.distances(&points, &config, &Silent).expect("distances");
            queries.push(start.elapsed().as_secs_f64());
        }
    }
    if let Some(path) = options.get("output") {
        let bytes: Vec<u8> = found.iter().flat_map(|d| d.to_le_bytes()).collect();
        std::fs::write(path, bytes).expect("the distances can be written");
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let (field, tree, query) = (median(&mut fields), median(&mut trees), median(&mut queries));
    let each = 1e9 * query / found.len() as f64;
    println!(
        "{{\"field\": {field:.5}, \"tree\": {tree:.5}, \"query\": {query:.5}, \"each\": {each:.1}, \"places\": {}}}",
        found.len()
    );
}

/// A surface at a distance, or walls, if they are asked for.
fn surface(field: &WindingField, options: &HashMap<&str, &str>) -> Option<SurfaceMesh> {
    let number = |name: &str| options.get(name).map(|n| n.parse::<f64>().expect("a number"));
    let resolution = number("resolution").map(|n| n as usize);
    let sharp = number("sharp");
    if let Some(distance) = number("offset") {
        let config = OffsetConfig { distance, resolution, sharp, ..OffsetConfig::default() };
        return Some(offset(field, &config, &Silent).expect("a surface"));
    }
    let thickness = number("hollow")?;
    let config = HollowConfig { thickness, resolution, sharp, ..HollowConfig::default() };
    Some(hollow(field, &config, &Silent).expect("walls"))
}

fn read_points(path: &str) -> Vec<Vec3> {
    let bytes = std::fs::read(path).expect("points");
    let numbers: Vec<f64> =
        bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight bytes"))).collect();
    numbers.chunks_exact(3).map(Vec3::from_slice).collect()
}
