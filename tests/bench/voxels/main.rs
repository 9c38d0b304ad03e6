//! Ways of making voxels beside each other, and fields that are saved.
//!
//! ```text
//! voxels tables                              the tables of Pimentel, Scrivener & To 2022 with ours beside them
//! voxels sparse MODEL [--resolution 1024]    bricks and, where they fit, all voxels: times and memory
//! voxels saves  MODEL…                       fields built, saved and loaded: times and bytes
//! voxels files  MODEL FOLDER [--resolution N]   NRRD and VOX, for peers/voxels.py to read
//! ```
//! Models are files, or `bunny`, `loose:FILE` (each triangle for itself) and `points:FILE` (a cloud of its vertices). Prints Markdown;
//! times are medians.
mod files;
mod saves;
mod sparse;
mod tables;

use fast_winding::data::{Shape, TriangleSoup};
use fast_winding::io::{self, Geometry};
use std::time::Instant;

fn main() {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let resolution = match words.iter().position(|word| word == "--resolution") {
        Some(at) => {
            let value = words.drain(at..at + 2).next_back().expect("--resolution needs a number");
            Some(value.parse().expect("--resolution is a number"))
        }
        None => None,
    };
    match words.first().map(String::as_str) {
        Some("tables") => tables::print(),
        Some("sparse") => {
            words[1..].iter().for_each(|model| sparse::print(model, resolution.unwrap_or(1024)))
        }
        Some("saves") => saves::print(&words[1..]),
        Some("files") => files::write(&read(&words[1]), &words[2], resolution.unwrap_or(300)),
        _ => panic!("a job is needed: tables, sparse, saves or files"),
    }
}

fn models(name: &str) -> String {
    format!("{}/target/bench-models/{name}.ply", env!("CARGO_MANIFEST_DIR"))
}

fn read_soup(path: &str) -> TriangleSoup {
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    match io::read(&bytes).unwrap_or_else(|error| panic!("{path}: {error}")).geometry {
        Geometry::Soup(soup) => soup,
        Geometry::Cloud(_) => panic!("{path} has no triangles"),
    }
}

fn read(model: &str) -> Shape {
    match model.split_once(':') {
        Some(("loose", path)) => {
            let soup = read_soup(path);
            let corners: Vec<_> = (0..soup.len()).flat_map(|t| soup.corners(t)).collect();
            // Moved apart a little, so that no two of them share an edge.
            let middle = soup.bounds().center();
            let apart = |k: usize| corners[k] + 1e-9 * (1 + k / 3 % 7) as f64 * (corners[k] - middle);
            let triangles = (0..soup.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
            TriangleSoup::new((0..corners.len()).map(apart).collect(), triangles)
                .expect("they are those of a soup")
                .into()
        }
        Some(("points", path)) => read_soup(path).vertex_cloud().0.into(),
        _ => read_soup(model).into(),
    }
}

fn timed<T>(job: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = job();
    (start.elapsed().as_secs_f64(), result)
}

/// The median time of a job that is repeated for about a second, three times at least unless it is long, and its last result.
fn median<T>(job: impl Fn() -> T) -> (f64, T) {
    let (first, mut result) = timed(&job);
    let mut times = vec![first];
    while times.iter().sum::<f64>() < 1.0 && times.len() < 15 {
        let (time, again) = timed(&job);
        times.push(time);
        result = again;
    }
    times.sort_by(f64::total_cmp);
    (times[times.len() / 2], result)
}

fn milliseconds(seconds: f64) -> String {
    let ms = 1e3 * seconds;
    if ms < 10.0 { format!("{ms:.2}") } else { with_commas(ms.round() as usize) }
}

fn with_commas(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Resident memory of this process now, and the most since the last reset, in bytes.
fn memory(reset: bool) -> [usize; 2] {
    if reset {
        let _ = std::fs::write("/proc/self/clear_refs", "5");
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    ["VmRSS:", "VmHWM:"].map(|key| {
        let line = status.lines().find(|line| line.starts_with(key));
        let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)).and_then(|n| n.parse().ok());
        1024 * kilobytes.unwrap_or(0)
    })
}
