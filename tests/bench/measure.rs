//! One measured job in a process of its own, for the benches beside other implementations and for wasm beside native.
//!
//! ```text
//! measure voxels   MODEL --counts N                            build and classify N³ samples of the bounds
//! measure values   MODEL --counts N | --points FILE [--tolerance T | --paper]
//! measure contains MODEL --points FILE                         classify scattered points
//! measure build    MODEL                                       build only, with memory
//! measure orient   MODEL                                       normals of a cloud as if it had none
//! measure prepare  MODEL                                       areas and build of a cloud, with memory
//! measure oracle   MODEL --points FILE                         the direct sum in f64, not timed
//! ```
//! `--output FILE` writes the answers of the last repeat: raw f64 for values, a byte of 0 or 1 for classifications, x
//! fastest. `--repeats` (5) and `--limit` (3 seconds) bound how often a job is repeated after one unmeasured run.
//! Points are raw little-endian f64; so is a model that ends in `.f64`, a cloud: point, normal and area of each point.
//! Prints JSON: medians of the times in seconds, bytes of the field, growth of resident memory by the first build.
use fast_winding::data::{Lattice, OrientedCloud, PointCloud, Shape, Silent};
use fast_winding::estimate::{self, EstimateConfig};
use fast_winding::io::{self, Geometry};
use fast_winding::math::Vec3;
use fast_winding::orient::{OrientMethod, orient};
use fast_winding::solid::{VoxelConfig, voxelize};
use fast_winding::winding::{Accuracy, FieldConfig, WindingField, winding_of_cloud, winding_of_soup};
use rayon::prelude::*;
use std::collections::HashMap;
use std::time::Instant;

fn main() {
    let mut words = std::env::args().skip(1);
    let (job, model) = (words.next().expect("a job"), words.next().expect("a model"));
    let options = Options { estimates: job == "prepare", ..Options::parse(words) };
    let shape = read_shape(&model);
    let answers = match job.as_str() {
        "build" | "prepare" => measure(&options, &shape, |_| Vec::new()),
        "voxels" => classify_lattice(&options, &shape),
        "values" => evaluate(&options, &shape),
        "contains" => classify_points(&options, &shape),
        "orient" => orient_anew(&options, &shape),
        "oracle" => bytes_of(&sum_directly(&options.points(), &shape)),
        _ => panic!("unknown job '{job}': voxels, values, contains, build and oracle are known"),
    };
    if let Some(path) = options.text("output") {
        std::fs::write(path, answers).expect("the answers can be written");
    }
}

fn classify_lattice(options: &Options, shape: &Shape) -> Vec<u8> {
    let lattice = options.lattice(shape).expect("--counts is given");
    let config = VoxelConfig::default();
    let ask = |field: &WindingField| voxelize(field, &lattice, &config, &Silent).expect("nothing cancels");
    measure(options, shape, ask).to_bytes().expect("the bytes fit")
}

fn evaluate(options: &Options, shape: &Shape) -> Vec<u8> {
    let accuracy = options.accuracy(shape);
    if let Some(lattice) = options.lattice(shape) {
        let ask = |field: &WindingField| {
            field.evaluate_lattice(&lattice, accuracy, &Silent).expect("nothing cancels")
        };
        return bytes_of(&measure(options, shape, ask).values);
    }
    let points = options.points();
    let ask = |field: &WindingField| field.evaluate(&points, accuracy, &Silent).expect("nothing cancels");
    bytes_of(&measure(options, shape, ask))
}

fn classify_points(options: &Options, shape: &Shape) -> Vec<u8> {
    let points = options.points();
    let ask = |field: &WindingField| field.contains(&points, &Silent).expect("nothing cancels");
    measure(options, shape, ask).into_iter().map(u8::from).collect()
}

fn sum_directly(points: &[Vec3], shape: &Shape) -> Vec<f64> {
    let at = |q: &Vec3| match shape {
        Shape::Soup(soup) => winding_of_soup(soup, *q),
        Shape::Cloud(cloud) => winding_of_cloud(cloud, *q),
    };
    points.par_iter().map(at).collect()
}

/// The field; where scattered points are asked for, with what they need.
fn build(options: &Options, shape: &Shape) -> WindingField {
    let shape = if options.estimates { with_own_areas(shape) } else { shape.clone() };
    let field = WindingField::new(shape, FieldConfig::default());
    if options.text("points").is_some() {
        field.prepare_points();
    }
    field
}

/// Builds the field and asks it, again and again; prints the medians. Returns the last answers.
fn measure<T>(options: &Options, shape: &Shape, ask: impl Fn(&WindingField) -> T) -> T {
    let before = Memory::reset();
    let mut field = build(options, shape);
    let after = Memory::now();
    // Once unmeasured, unless that alone is as long as is allowed: then the first run counts.
    let (first, mut answers) = timed(|| ask(&field));
    let (mut builds, mut evaluations, mut totals) = (Vec::new(), Vec::new(), Vec::new());
    let start = Instant::now();
    while builds.is_empty()
        || (builds.len() < options.repeats && start.elapsed().as_secs_f64() < options.limit)
    {
        // The former field goes before the clock starts: nobody else pays for it either.
        drop(field);
        let (build, built) = timed(|| build(options, shape));
        field = built;
        let evaluation = if first > options.limit {
            first
        } else {
            drop(answers);
            let (evaluation, asked) = timed(|| ask(&field));
            answers = asked;
            evaluation
        };
        builds.push(build);
        evaluations.push(evaluation);
        totals.push(build + evaluation);
    }
    println!(
        "{{\"elements\": {}, \"build\": {:e}, \"evaluation\": {:e}, \"total\": {:e}, \"repeats\": {}, \"bytes\": {}, \
         \"resident\": {}, \"peak\": {}, \"process\": {}, \"method\": {:?}}}",
        shape.len(),
        median(&mut builds),
        median(&mut evaluations),
        median(&mut totals),
        totals.len(),
        field.report().bytes,
        after.resident.saturating_sub(before.resident),
        after.peak.saturating_sub(before.resident),
        after.peak,
        field.report().method,
    );
    answers
}

/// Words of the command line: `--name value`, or `--name` alone.
struct Options {
    words: HashMap<String, String>,
    repeats: usize,
    limit: f64,
    /// Whether areas are estimated before a field is built.
    estimates: bool,
}

impl Options {
    fn parse(words: impl Iterator<Item = String>) -> Options {
        let mut named = HashMap::new();
        let mut words = words.peekable();
        while let Some(word) = words.next() {
            let name = word.strip_prefix("--").unwrap_or_else(|| panic!("'{word}' is no option")).to_string();
            let value = words.next_if(|next| !next.starts_with("--")).unwrap_or_default();
            named.insert(name, value);
        }
        let number = |name: &str, default: f64| {
            named.get(name).map_or(default, |text| text.parse().expect("a number"))
        };
        Options {
            repeats: number("repeats", 5.0) as usize,
            limit: number("limit", 3.0),
            words: named,
            estimates: false,
        }
    }

    fn text(&self, name: &str) -> Option<&str> {
        self.words.get(name).map(String::as_str)
    }

    fn lattice(&self, shape: &Shape) -> Option<Lattice> {
        let count = self.text("counts")?.parse().expect("--counts is a number");
        Some(Lattice::with_counts(shape.bounds(), [count; 3]).expect("the model has a size"))
    }

    fn points(&self) -> Vec<Vec3> {
        let path = self.text("points").expect("--points is given");
        read_numbers::<3>(path).into_iter().map(Vec3::from_array).collect()
    }

    fn accuracy(&self, shape: &Shape) -> Accuracy {
        match self.text("tolerance") {
            Some(tolerance) => Accuracy::Tolerance(tolerance.parse().expect("--tolerance is a number")),
            None if self.text("paper").is_some() => Accuracy::of_paper(shape),
            None => Accuracy::default(),
        }
    }
}

/// Prints the median time, and answers the normals.
fn orient_anew(options: &Options, shape: &Shape) -> Vec<u8> {
    let Shape::Cloud(cloud) = shape else { panic!("only clouds have normals to estimate") };
    let (bare, _) = PointCloud::cleaned(cloud.points().to_vec(), None, None).expect("the cloud is complete");
    let run = || timed(|| orient(&bare, &OrientMethod::default(), &Silent).expect("there are points").0);
    let mut runs: Vec<(f64, OrientedCloud)> = (0..options.repeats.clamp(1, 3)).map(|_| run()).collect();
    let mut times: Vec<f64> = runs.iter().map(|run| run.0).collect();
    println!("{{\"elements\": {}, \"evaluation\": {:e}}}", shape.len(), median(&mut times));
    let oriented = runs.pop().expect("it ran").1;
    bytes_of(&oriented.normals().iter().flat_map(|n| n.to_array()).collect::<Vec<f64>>())
}

/// The cloud with areas estimated anew.
fn with_own_areas(shape: &Shape) -> Shape {
    let Shape::Cloud(cloud) = shape else { panic!("only clouds have areas to estimate") };
    let given = (cloud.points().to_vec(), Some(cloud.normals().to_vec()));
    let (bare, _) = PointCloud::cleaned(given.0, given.1, None).expect("the cloud is complete");
    Shape::from(estimate::complete(&bare, &EstimateConfig::default(), &Silent).expect("the points are apart"))
}

/// Resident memory of this process in bytes: now, and at its highest since the reset. Zero where Linux's /proc is missing.
struct Memory {
    resident: usize,
    peak: usize,
}

impl Memory {
    fn reset() -> Memory {
        // Not everywhere allowed: then the peak is that since the start.
        let _ = std::fs::write("/proc/self/clear_refs", "5");
        Memory::now()
    }

    fn now() -> Memory {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let kilobytes = |name: &str| {
            let line = status.lines().find(|line| line.starts_with(name));
            line.and_then(|line| line.split_whitespace().nth(1)).map_or(0, |word| word.parse().unwrap_or(0))
        };
        Memory { resident: 1024 * kilobytes("VmRSS"), peak: 1024 * kilobytes("VmHWM") }
    }
}

fn timed<T>(job: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = job();
    (start.elapsed().as_secs_f64(), result)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn read_shape(path: &str) -> Shape {
    if path.ends_with(".f64") {
        return Shape::from(read_cloud(path));
    }
    let bytes = std::fs::read(path).expect("the model can be read");
    match io::read(&bytes).expect("the model is understood").geometry {
        Geometry::Soup(soup) => Shape::from(soup),
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

fn bytes_of(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}
