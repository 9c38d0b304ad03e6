//! Times and errors of the dual-tree evaluator on the bunny as it is, on its triangles moved apart, and on its barycentres:
//! `RAYON_NUM_THREADS=1 cargo run --release --example dual -- [RESOLUTION] [ORDER DEGREE BETA ETA]`.
use fast_winding::data::{Lattice, OrientedCloud, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::treecode::{
    DualAccuracy, DualTree, LatticeTargets, Outcome, PointTargets, Sources, Targets,
};
use fast_winding::winding::{winding_of_cloud, winding_of_soup};
use std::sync::Arc;
use std::time::Instant;

#[path = "../common/mod.rs"]
mod common;

const LEAF_SIZE: usize = 8;
/// Every so many samples are compared with the direct sum.
const CHECKED: usize = 4999;

fn main() {
    let arguments: Vec<f64> =
        std::env::args().skip(1).map(|a| a.parse().expect("arguments are numbers")).collect();
    let resolution = arguments.first().map_or(100, |r| *r as usize);
    let presets = match &arguments[1.min(arguments.len())..] {
        [order, degree, beta, eta] => {
            vec![DualAccuracy { order: *order as usize, degree: *degree as usize, beta: *beta, eta: *eta }]
        }
        _ => vec![DualAccuracy::FAST, DualAccuracy::DEFAULT, DualAccuracy::FINE, DualAccuracy::FINER],
    };
    let bunny = common::bunny();
    let loose = apart(&bunny);
    let cloud = common::barycentre_cloud(&bunny, 2);
    measure("bunny", &presets, resolution, bunny.clone(), bunny.bounds(), |q| winding_of_soup(&bunny, q));
    measure("loose", &presets, resolution, loose.clone(), loose.bounds(), |q| winding_of_soup(&loose, q));
    let in_cloud: &OrientedCloud = &cloud;
    measure("cloud", &presets, resolution, cloud.clone(), cloud.bounds(), |q| winding_of_cloud(in_cloud, q));
}

/// Every triangle with corners of its own, moved by up to a 300th of the diagonal.
fn apart(soup: &TriangleSoup) -> TriangleSoup {
    let mut random = common::random(5);
    let reach = soup.bounds().diagonal() / 300.0;
    let mut positions = Vec::new();
    for t in 0..soup.len() {
        let shift = reach * (2.0 * Vec3::new(random(), random(), random()) - Vec3::ONE) / 3f64.sqrt();
        positions.extend(soup.corners(t).map(|c| c + shift));
    }
    let triangles = (0..soup.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(positions, triangles).expect("corners are finite")
}

fn measure<S: Sources + Send>(
    name: &str,
    presets: &[DualAccuracy],
    resolution: usize,
    sources: S,
    bounds: Aabb,
    exact: impl Fn(Vec3) -> f64,
) {
    let sources = Arc::new(sources);
    let build = || {
        let start = Instant::now();
        (DualTree::build(sources.clone(), LEAF_SIZE), start.elapsed().as_secs_f64())
    };
    let (tree, _) = build();
    let best = (0..5).map(|_| build().1).fold(f64::INFINITY, f64::min);
    let per_source = tree.bytes() as f64 / sources.len() as f64;
    println!(
        "{name}: {} sources, {} clusters, {per_source:.1} bytes per source, built in {:.1} ms",
        sources.len(),
        tree.clusters(),
        1e3 * best
    );
    let lattice = Lattice::with_resolution(bounds, resolution).expect("the model has a size");
    let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
    let scattered = common::scattered(bounds, lattice.len(), 3);
    let expected: Vec<f64> = points.iter().step_by(CHECKED).map(|q| exact(*q)).collect();
    for accuracy in presets {
        let (time, values, bound) = run(&tree, &LatticeTargets::new(&lattice), lattice.len(), *accuracy);
        let (time_scattered, ..) = run(&tree, &PointTargets::new(&scattered), scattered.len(), *accuracy);
        let errors: Vec<f64> =
            values.iter().step_by(CHECKED).zip(&expected).map(|(v, e)| (v - e).abs()).collect();
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        let max = errors.iter().copied().fold(0.0, f64::max);
        println!(
            "  p {} q {} beta {} eta {}: lattice {:.0} ns, scattered {:.0} ns, rms {rms:.1e}, max {max:.1e}, bound {bound:.1e}",
            accuracy.order,
            accuracy.degree,
            accuracy.beta,
            accuracy.eta,
            1e9 * time / lattice.len() as f64,
            1e9 * time_scattered / lattice.len() as f64,
        );
    }
}

/// Seconds, values and the mean bound.
fn run<S: Sources, T: Targets>(
    tree: &DualTree<S>,
    targets: &T,
    count: usize,
    accuracy: DualAccuracy,
) -> (f64, Vec<f64>, f64) {
    let mut results = vec![0.0; count];
    let (mut sum, mut blocks) = (0.0, 0);
    let start = Instant::now();
    let store = |indices: &[usize], outcome: Outcome<'_>| {
        if let Outcome::Values { values, bound } = outcome {
            indices.iter().zip(values).for_each(|(i, v)| results[*i] = *v);
            sum += bound;
            blocks += 1;
        }
    };
    tree.evaluate(targets, &accuracy, &Silent, |_, _, _| false, store).expect("nothing cancels");
    (start.elapsed().as_secs_f64(), results, sum / f64::from(blocks))
}
