//! Timing, subsampling and tables.
use fast_winding::data::{Lattice, TriangleSoup};
use fast_winding::math::Vec3;
use std::time::Instant;

/// A quick job is repeated until it has been timed for so many seconds, or so often.
const ENOUGH_SECONDS: f64 = 0.3;
const MOST_REPEATS: usize = 5;

/// The median time of a job in seconds, and its last result.
pub fn median<T>(mut job: impl FnMut() -> T) -> (f64, T) {
    let mut times: Vec<f64> = Vec::new();
    loop {
        let start = Instant::now();
        let result = job();
        times.push(start.elapsed().as_secs_f64());
        if times.len() == MOST_REPEATS || times.iter().sum::<f64>() > ENOUGH_SECONDS {
            times.sort_by(f64::total_cmp);
            return (times[times.len() / 2], result);
        }
    }
}

/// `side`³ samples in the middles of the cells that fill the box of a soup.
pub fn lattice(soup: &TriangleSoup, side: usize) -> Lattice {
    Lattice::with_counts(soup.bounds(), [side; 3]).expect("the model has a size")
}

pub fn points(lattice: &Lattice) -> Vec<Vec3> {
    (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect()
}

/// Every k-th of `points`, as many as a job of `seconds_for` some of them does in `budget` seconds; an odd k, so that all
/// rows and columns take part.
pub fn affordable(points: &[Vec3], budget: f64, seconds_for: impl Fn(&[Vec3]) -> f64) -> Vec<Vec3> {
    const PROBES: usize = 400;
    let every = |k: usize| -> Vec<Vec3> { points.iter().step_by(k | 1).copied().collect() };
    if points.len() <= PROBES {
        return points.to_vec();
    }
    let probe = every(points.len() / PROBES);
    let whole = seconds_for(&probe) * points.len() as f64 / probe.len() as f64;
    if whole <= budget { points.to_vec() } else { every((whole / budget).ceil() as usize) }
}

/// Prints a Markdown table.
pub fn print_table(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) {
    println!("| {} |", header.join(" | "));
    println!("|---|{}", "--:|".repeat(header.len() - 1));
    rows.into_iter().for_each(|row| println!("| {} |", row.join(" | ")));
    println!();
}

/// With three significant digits.
pub fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = 2 - x.abs().log10().floor() as i32;
    if (0..=5).contains(&digits) {
        format!("{x:.*}", digits as usize)
    } else if (-4..0).contains(&digits) {
        format!("{x:.0}")
    } else {
        format!("{x:.1e}")
    }
}
