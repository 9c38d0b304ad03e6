//! Times of layers: `slices MODEL [--layers N] [--rounds N] [--spacing MM]` prints JSON, medians in seconds: reading and the field, the
//! layers alone; their sum; what the contours hold; how many layers were traced on a grid; and the total area, to compare.
use fast_winding::data::{Shape, Silent};
use fast_winding::estimate::{EstimateConfig, complete};
use fast_winding::io::{self, Geometry};
use fast_winding::slice::{LayerPlan, SliceConfig, slice_each};
use fast_winding::winding::WindingField;
use std::collections::HashMap;
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let bytes = std::fs::read(&words[0]).expect("a model");
    let options: HashMap<&str, &str> =
        words[1..].chunks(2).map(|o| (o[0].trim_start_matches("--"), o[1].as_str())).collect();
    let option = |name: &str, value: usize| options.get(name).map_or(value, |v| v.parse().expect("a number"));
    let (count, rounds) = (option("layers", 100), option("rounds", 3));
    let config = SliceConfig {
        spacing: options.get("spacing").map(|v| v.parse().expect("millimetres")),
        ..SliceConfig::default()
    };
    let (mut builds, mut slices, mut reads) = (vec![], vec![], vec![]);
    let mut last = (0, 0, 0, 0.0);
    for _ in 0..rounds {
        let start = Instant::now();
        let geometry = io::read(&bytes).expect("a model").geometry;
        reads.push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let shape: Shape = match geometry {
            Geometry::Soup(soup) => soup.into(),
            Geometry::Cloud(cloud) => {
                complete(&cloud, &EstimateConfig::default(), &Silent).expect("a cloud").into()
            }
        };
        let field = WindingField::new(shape, Default::default());
        builds.push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let plan = LayerPlan { layer_height: field.bounds().size().z / count as f64, ..LayerPlan::default() };
        let (mut vertices, mut rings, mut area) = (0, 0, 0.0);
        let report = slice_each(&field, &plan, &config, &Silent, &mut |_, layer| {
            for polygon in &layer.polygons {
                rings += 1 + polygon.holes.len();
                vertices += polygon.outer.len() + polygon.holes.iter().map(Vec::len).sum::<usize>();
            }
            area += layer.area();
        });
        slices.push(start.elapsed().as_secs_f64());
        last = (vertices, rings, report.expect("layers").approximated, area);
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let (read, build, slice) = (median(&mut reads), median(&mut builds), median(&mut slices));
    let (vertices, rings, approximated, area) = last;
    println!(
        "{{\"read\": {read:.4}, \"build\": {build:.4}, \"slice\": {slice:.4}, \"sum\": {:.4}, \"layers\": {count}, \
         \"vertices\": {vertices}, \"rings\": {rings}, \"approximated\": {approximated}, \"area\": {area:e}}}",
        read + build + slice
    );
}
