//! Normals of unoriented clouds beside the truth: samples of meshes, clean, uneven, noisy and with parts missing.
//!
//! ```text
//! normals MODEL... [--points N] [--only METHOD]
//! ```
//! For each kind of cloud, the means over the models of the percentage of good points (PGP) and of the root mean square
//! angle, and the mean time. Globally consistent normal orientation and its stochastic form are among the methods where there
//! are no more than 3,000 points; `--only` takes the methods whose names begin with its word.
mod clouds;
mod gcno;
mod lbfgs;
mod methods;
mod voronoi;

use clouds::kinds;
use fast_winding::data::{PointCloud, TriangleSoup};
use fast_winding::io::{self, Geometry};
use fast_winding::metrics::{angle_rmse, good_points};
use methods::methods;
use std::time::Instant;

fn main() {
    let mut words = std::env::args().skip(1);
    let (mut count, mut soups) = (40_000, Vec::new());
    let mut only: Option<String> = None;
    while let Some(word) = words.next() {
        match word.as_str() {
            "--only" => only = words.next(),
            "--points" => count = words.next().and_then(|n| n.parse().ok()).expect("a number of points"),
            path => soups.push(read(path)),
        }
    }
    println!("| cloud | method | PGP | angle RMSE | time |\n|---|---|---:|---:|---:|");
    for (kind, distort) in kinds() {
        for (name, method) in methods(count) {
            if only.as_ref().is_some_and(|only| !name.starts_with(only)) {
                continue;
            }
            let mut sums = [0.0; 3];
            for soup in &soups {
                let samples = distort(soup, count);
                let (cloud, _) =
                    PointCloud::cleaned(samples.points, None, None).expect("the points are finite");
                let start = Instant::now();
                let normals = method(&cloud);
                sums[2] += start.elapsed().as_secs_f64();
                sums[0] += good_points(&normals, &samples.normals).expect("as many");
                sums[1] += angle_rmse(&normals, &samples.normals).expect("as many");
            }
            let [pgp, angle, time] = sums.map(|s| s / soups.len() as f64);
            println!("| {kind} | {name} | {:.2} % | {angle:.1}° | {time:.2} s |", 100.0 * pgp);
        }
    }
}

fn read(path: &str) -> TriangleSoup {
    let bytes = std::fs::read(path).expect("the model can be read");
    match io::read(&bytes).expect("the model is understood").geometry {
        Geometry::Soup(soup) => soup,
        Geometry::Cloud(_) => panic!("{path} has no triangles"),
    }
}
