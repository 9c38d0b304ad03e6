//! Normals of unoriented clouds beside the truth: samples of meshes, clean, uneven, noisy and with parts missing.
//!
//! ```text
//! normals MODEL... [--points N] [--only METHOD]
//! ```
//! For each kind of cloud, the means over the models of the percentage of good points (PGP) and of the root mean square
//! angle, and the mean time.
use fast_winding::data::{PointCloud, Silent, TriangleSoup};
use fast_winding::io::{self, Geometry};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::metrics::{SurfaceSamples, angle_rmse, good_points, sample_surface};
use fast_winding::orient::{Bounded, ConsistencyConfig, OrientMethod, StochasticConfig, Widths, orient};
use std::time::Instant;

mod gcno;
mod lbfgs;
mod voronoi;

use gcno::gcno;

/// Standard deviations along each axis, in longest edges of the box.
const NOISES: [f64; 3] = [0.0025, 0.005, 0.01];
/// Balls without points, and their radius in longest edges of the box.
const HOLES: (usize, f64) = (10, 0.07);

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
            if only.as_ref().is_some_and(|only| !name.contains(only)) {
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

type Method = Box<dyn Fn(&PointCloud) -> Vec<Vec3>>;

/// Most points that the globally consistent methods take.
const MOST: usize = 3000;

fn methods(count: usize) -> Vec<(String, Method)> {
    let by = |method: OrientMethod| -> Method {
        Box::new(move |cloud| {
            let (oriented, _) = orient(cloud, &method, &Silent).expect("there are points");
            oriented.normals().to_vec()
        })
    };
    let consistency = |bounded: Bounded, widths: Option<Widths>| {
        by(OrientMethod::Consistency(ConsistencyConfig { bounded, widths, ..Default::default() }))
    };
    let mut methods = vec![("propagation".into(), by(OrientMethod::Propagation))];
    for (name, bounded) in [
        ("{SD, A, G}", Bounded::Nothing),
        ("{SD, A, G_B}", Bounded::Gradients),
        ("{LM, A_B, G_B}", Bounded::Everything),
    ] {
        for (k, widths) in Widths::ALL.into_iter().enumerate().take(2) {
            methods.push((format!("{name} l{k}"), consistency(bounded, Some(widths))));
        }
        methods.push((format!("{name} chosen"), consistency(bounded, None)));
    }
    if count <= MOST {
        methods.push(("sGCNO".into(), by(OrientMethod::Stochastic(StochasticConfig::default()))));
        let draw = |cloud: &PointCloud| {
            let mut random = Random(11);
            gcno(cloud.points(), || random.unit())
        };
        methods.push(("GCNO".into(), Box::new(draw)));
    }
    methods
}

type Distort = Box<dyn Fn(&TriangleSoup, usize) -> SurfaceSamples>;

fn kinds() -> Vec<(String, Distort)> {
    let mut kinds: Vec<(String, Distort)> = vec![
        ("clean".into(), Box::new(sample)),
        ("uneven".into(), Box::new(uneven)),
        ("parts missing".into(), Box::new(holed)),
    ];
    for noise in NOISES {
        let noisy = move |soup: &TriangleSoup, count: usize| {
            let mut samples = sample(soup, count);
            let (size, mut random) = (size(&samples), Random(7));
            let mut shift = || noise * size * random.normal();
            samples.points.iter_mut().for_each(|p| *p += Vec3::new(shift(), shift(), shift()));
            samples
        };
        kinds.push((format!("noise {} %", 100.0 * noise), Box::new(noisy)));
    }
    kinds
}

fn sample(soup: &TriangleSoup, count: usize) -> SurfaceSamples {
    sample_surface(soup, count, 1).expect("the model has an area")
}

fn size(samples: &SurfaceSamples) -> f64 {
    Aabb::around(samples.points.iter().copied()).size().max_element()
}

/// Up to ten times as many points at one end as at the other.
fn uneven(soup: &TriangleSoup, count: usize) -> SurfaceSamples {
    let all = sample(soup, 3 * count);
    let bounds = Aabb::around(all.points.iter().copied());
    let mut random = Random(5);
    let mut kept =
        keep(all, |p| random.unit() < 0.1 + 0.9 * ((p.x - bounds.min.x) / bounds.size().x).powi(2));
    kept.points.truncate(count);
    kept.normals.truncate(count);
    kept
}

fn holed(soup: &TriangleSoup, count: usize) -> SurfaceSamples {
    let samples = sample(soup, count);
    let (radius, mut random) = (HOLES.1 * size(&samples), Random(9));
    let len = samples.points.len();
    let centers: Vec<Vec3> =
        (0..HOLES.0).map(|_| samples.points[(random.unit() * len as f64) as usize]).collect();
    keep(samples, |p| centers.iter().all(|c| c.distance(p) > radius))
}

fn keep(samples: SurfaceSamples, mut wanted: impl FnMut(Vec3) -> bool) -> SurfaceSamples {
    let (points, normals) =
        samples.points.into_iter().zip(samples.normals).filter(|(p, _)| wanted(*p)).unzip();
    SurfaceSamples { points, normals }
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
    let bytes = std::fs::read(path).expect("the model can be read");
    match io::read(&bytes).expect("the model is understood").geometry {
        Geometry::Soup(soup) => soup,
        Geometry::Cloud(_) => panic!("{path} has no triangles"),
    }
}
