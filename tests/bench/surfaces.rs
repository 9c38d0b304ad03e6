//! Surfaces of clouds beside the truth: points with true normals sampled from closed models.
//!
//! ```text
//! surfaces ours    MODEL [--points N] [--noise S] [--output FILE] [OPTIONS]   samples, makes a surface, compares
//! surfaces cloud   MODEL --output FILE [--points N] [--noise S]    the same samples as raw f64: point, normal
//! surfaces compare MODEL FILE                                      a surface that another program made of them
//! surfaces soup    MODEL [--resolution N] [--sharp A] [--output FILE]   a surface of the model itself, compared with it
//! ```
//! `OPTIONS` are --resolution, --level, --min-component, --trim, --smoothing and --sharp, as in `SurfaceConfig`, and `--bounded 1`, as in
//! `FieldConfig`; `--half 1` leaves half of the model, an open scan. `--normals` estimates normals rather than take the true ones, by
//! propagation, consistency, stochastic, or, with the narrowest widths, SD-A-G, SD-A-GB or LM-AB-GB. Noise is a standard deviation along each axis, in thousandths of the diagonal.
//!
//! Prints JSON: times in seconds, that of all processors together, the growth of memory while the surface is made; distances in
//! percent of the diagonal: `chamfer` is between 200,000 samples of either surface, `floor` that between two such samplings of the
//! truth, `excess` the difference, `off` the mean distance of samples from the plane of the other surface at its nearest sample.
use fast_winding::PointCloud;
use fast_winding::data::{Silent, SurfaceMesh, TriangleSoup};
use fast_winding::estimate::{EstimateConfig, complete};
use fast_winding::io::{self, Geometry, MeshFormat};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::metrics::{
    NearestPoints, SurfaceSamples, chamfer_distance, normal_consistency, sample_surface,
};
use fast_winding::orient::{Bounded, ConsistencyConfig, OrientMethod, StochasticConfig, Widths, orient};
use fast_winding::surface::{SurfaceConfig, extract};
use fast_winding::winding::{FieldConfig, WindingField};
use std::collections::HashMap;
use std::time::Instant;

/// Samples of each surface that is compared.
const SAMPLES: usize = 200_000;

fn main() {
    let mut words = std::env::args().skip(1);
    let (job, model) = (words.next().expect("a job"), read(&words.next().expect("a model")));
    let mut rest: Vec<String> = words.collect();
    let file = (rest.len() % 2 == 1).then(|| rest.remove(0));
    let options = rest.chunks(2).map(|o| (o[0].trim_start_matches("--").to_owned(), o[1].clone())).collect();
    let options = Options(options);
    let model = if options.0.contains_key("half") { half(&model) } else { model };
    match job.as_str() {
        "ours" => ours(&model, &options),
        "cloud" => {
            let samples = cloud_of(&model, &options);
            let pairs = samples.points.iter().zip(&samples.normals);
            let numbers = pairs.flat_map(|(p, n)| [p.to_array(), n.to_array()]).flatten();
            let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
            std::fs::write(options.0["output"].as_str(), bytes).expect("the cloud can be written");
        }
        "soup" => soup(&model, &options),
        "compare" => println!("{{{}}}", compare(&model, &read(&file.expect("a file")))),
        _ => panic!("unknown job '{job}': ours, cloud, compare and soup are known"),
    }
}

/// The triangles below the middle of the x axis: an open scan.
fn half(model: &TriangleSoup) -> TriangleSoup {
    let middle = Aabb::around(model.positions().iter().copied()).center().x;
    let below = |t: &&[u32; 3]| t.iter().all(|v| model.positions()[*v as usize].x < middle);
    let kept = model.triangles().iter().filter(below).copied().collect();
    TriangleSoup::new(model.positions().to_vec(), kept).expect("the indices are those of the model")
}

struct Options(HashMap<String, String>);

impl Options {
    fn number(&self, name: &str) -> Option<f64> {
        self.0.get(name).map(|n| n.parse().unwrap_or_else(|_| panic!("--{name} needs a number")))
    }
}

fn cloud_of(model: &TriangleSoup, options: &Options) -> SurfaceSamples {
    let count = options.number("points").unwrap_or(35_000.0) as usize;
    let mut samples = sample_surface(model, count, 1).expect("the model has an area");
    let noise = 1e-3 * options.number("noise").unwrap_or(0.0) * diagonal(model);
    let mut random = Random(7);
    let mut shift = || noise * random.normal();
    samples.points.iter_mut().for_each(|p| *p += Vec3::new(shift(), shift(), shift()));
    if let Some(method) = options.0.get("normals") {
        let (bare, _) = PointCloud::cleaned(samples.points.clone(), None, None).expect("they are finite");
        let (oriented, _) = orient(&bare, &method_of(method), &Silent).expect("there are points");
        samples.normals = oriented.normals().to_vec();
    }
    samples
}

fn method_of(name: &str) -> OrientMethod {
    let narrow = |bounded: Bounded| {
        let widths = Some(Widths::ALL[0]);
        OrientMethod::Consistency(ConsistencyConfig { bounded, widths, ..Default::default() })
    };
    match name {
        "propagation" => OrientMethod::Propagation,
        "consistency" => OrientMethod::default(),
        "stochastic" => OrientMethod::Stochastic(StochasticConfig::default()),
        "SD-A-G" => narrow(Bounded::Nothing),
        "SD-A-GB" => narrow(Bounded::Gradients),
        "LM-AB-GB" => narrow(Bounded::Everything),
        _ => panic!("unknown method '{name}'"),
    }
}

fn diagonal(model: &TriangleSoup) -> f64 {
    Aabb::around(model.positions().iter().copied()).diagonal()
}

fn ours(model: &TriangleSoup, options: &Options) {
    let samples = cloud_of(model, options);
    let (cloud, _) =
        PointCloud::cleaned(samples.points, Some(samples.normals), None).expect("they are as many");
    let config = SurfaceConfig {
        resolution: options.number("resolution").map(|n| n as usize),
        level: options.number("level"),
        min_component: options.number("min-component"),
        trim: options.number("trim"),
        smoothing: options.number("smoothing"),
        sharp: options.number("sharp"),
        ..SurfaceConfig::default()
    };
    let (start, began) = (Instant::now(), processor_time());
    let oriented = complete(&cloud, &EstimateConfig::default(), &Silent).expect("the cloud has normals");
    let areas = start.elapsed().as_secs_f64();
    let bounded = options.0.contains_key("bounded");
    let field = WindingField::new(oriented, FieldConfig { bounded, ..FieldConfig::default() });
    let built = start.elapsed().as_secs_f64();
    let before = resident("VmRSS");
    let mesh = extract(&field, &config, &Silent).expect("nothing cancels");
    let megabytes = 1e-6 * (resident("VmHWM") - before);
    let total = start.elapsed().as_secs_f64();
    let processors = processor_time() - began;
    let times = format!(
        "\"areas\": {areas:.3}, \"field\": {:.3}, \"surface\": {:.3}, \"total\": {total:.3}, \"processors\": {processors:.2}, \"megabytes\": {megabytes:.0}, ",
        built - areas,
        total - built
    );
    let (vertices, normals) = (mesh.positions.len(), of_vertices(model, &mesh));
    let soup = TriangleSoup::from(mesh);
    write(&soup, options);
    println!(
        "{{{times}\"vertices\": {vertices}, \"vertexNormals\": {normals:.5}, {}}}",
        compare(model, &soup)
    );
}

fn write(surface: &TriangleSoup, options: &Options) {
    if let Some(path) = options.0.get("output") {
        let mut bytes = Vec::new();
        io::write_soup(surface, MeshFormat::Ply, &mut bytes).expect("memory takes all");
        std::fs::write(path, bytes).expect("the surface can be written");
    }
}

/// Bytes of this process in memory now, or most of them since the last question; 0 where the system does not tell.
fn resident(what: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    // Forgets the highest so far.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let line = status.lines().find(|line| line.starts_with(what)).unwrap_or_default();
    line.split_whitespace()
        .nth(1)
        .and_then(|kilobytes| kilobytes.parse().ok())
        .map_or(0.0, |k: f64| 1024.0 * k)
}

/// Seconds that all processors together spent on this process; 0 where the system does not tell.
fn processor_time() -> f64 {
    const TICKS_PER_SECOND: f64 = 100.0;
    let status = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let words = status.rsplit(')').next().unwrap_or_default().split_whitespace();
    words.skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / TICKS_PER_SECOND
}

fn soup(model: &TriangleSoup, options: &Options) {
    let resolution = options.number("resolution").map(|n| n as usize);
    let start = Instant::now();
    let field = WindingField::new(model.clone(), FieldConfig::default());
    let built = start.elapsed().as_secs_f64();
    let config = SurfaceConfig { resolution, sharp: options.number("sharp"), ..SurfaceConfig::default() };
    let mesh = extract(&field, &config, &Silent).expect("nothing cancels");
    let surface = start.elapsed().as_secs_f64() - built;
    let volume = mesh.volume();
    let soup = TriangleSoup::from(mesh);
    write(&soup, options);
    println!(
        "{{\"field\": {built:.3}, \"surface\": {surface:.3}, \"volume\": {volume:.6}, {}}}",
        compare(model, &soup)
    );
}

/// The mean cosine between the normals of vertices and that of the truth nearest to them.
fn of_vertices(model: &TriangleSoup, mesh: &SurfaceMesh) -> f64 {
    let truth = sample_surface(model, 5 * SAMPLES, 5).expect("the model has an area");
    let near = NearestPoints::new(&truth.points).of(&mesh.positions);
    let cosines = near.iter().zip(&mesh.normals).map(|(near, n)| n.dot(truth.normals[near.0]));
    cosines.sum::<f64>() / mesh.normals.len() as f64
}

fn compare(model: &TriangleSoup, found: &TriangleSoup) -> String {
    let sampled = |soup, seed| sample_surface(soup, SAMPLES, seed).expect("the surface has an area");
    let [truth, again, surface] = [sampled(model, 2), sampled(model, 3), sampled(found, 4)];
    let percent = 100.0 / diagonal(model);
    let chamfer = |s: &SurfaceSamples| percent * chamfer_distance(&truth.points, &s.points).expect("samples");
    let (chamfer, floor) = (chamfer(&surface), chamfer(&again));
    let off = 0.5 * percent * (off_plane(&surface, &truth) + off_plane(&truth, &surface));
    let consistency = normal_consistency(&truth, &surface).expect("samples");
    format!(
        "\"triangles\": {}, \"chamfer\": {chamfer:.5}, \"floor\": {floor:.5}, \"excess\": {:.5}, \"off\": {off:.5}, \"normals\": {consistency:.5}",
        found.len(),
        chamfer - floor
    )
}

/// The mean distance of `a` from the planes at the nearest of `b`.
fn off_plane(a: &SurfaceSamples, b: &SurfaceSamples) -> f64 {
    let near = NearestPoints::new(&b.points).of(&a.points);
    let off =
        near.iter().zip(&a.points).map(|(near, p)| (*p - b.points[near.0]).dot(b.normals[near.0]).abs());
    off.sum::<f64>() / a.points.len() as f64
}

/// A linear congruential generator (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Normally distributed, nearly: a sum of twelve.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }
}

fn read(path: &str) -> TriangleSoup {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    match io::read(&bytes).expect("the model is understood").geometry {
        Geometry::Soup(soup) => soup,
        Geometry::Cloud(_) => panic!("{path} has no triangles"),
    }
}
