//! Times and errors of the dual-tree evaluator on the bunny as it is, on its triangles moved apart, and on its barycentres:
//! `RAYON_NUM_THREADS=1 cargo run --release --example dual -- [RESOLUTION] [ORDER DEGREE ERROR]…`.
use fast_winding::data::{Lattice, OrientedCloud, Shape, Silent, TriangleSoup};
use fast_winding::math::Vec3;
use fast_winding::treecode::{DualAccuracy, DualTree, LatticeTargets, PointTargets, Proof, Sources, Targets};
use fast_winding::winding::{
    Accuracy, Dipoles, FieldConfig, Triangles, WindingField, winding_of_cloud, winding_of_soup,
};
use std::fs;
use std::sync::Arc;

#[path = "../common/mod.rs"]
mod common;

const LEAF_SIZE: usize = 8;
/// What all samples are compared with.
const REFERENCE: DualAccuracy = DualAccuracy { order: 3, degree: 5, error: 1e-8 };
/// About so many samples of the reference are compared with the direct sum.
const CHECKED: usize = 200;

fn main() {
    let arguments: Vec<f64> =
        std::env::args().skip(1).map(|a| a.parse().expect("arguments are numbers")).collect();
    let resolution = arguments.first().map_or(100, |r| *r as usize);
    let presets = match &arguments[1.min(arguments.len())..] {
        [_, ..] => arguments[1..].chunks_exact(3).map(explicit).collect(),
        [] => vec![DualAccuracy::FAST, DualAccuracy::DEFAULT, DualAccuracy::FINE, DualAccuracy::FINER],
    };
    let bunny = common::bunny();
    let loose = apart(&bunny);
    let cloud = common::barycentre_cloud(&bunny, 2);
    measure("bunny", &presets, resolution, of(&bunny), bunny.clone(), |q| winding_of_soup(&bunny, q));
    measure("loose", &presets, resolution, of(&loose), loose.clone(), |q| winding_of_soup(&loose, q));
    let in_cloud: &OrientedCloud = &cloud;
    let dipoles = Arc::new(Dipoles::new(Arc::new(cloud.clone()), false));
    measure("cloud", &presets, resolution, dipoles, cloud.clone(), |q| winding_of_cloud(in_cloud, q));
}

fn explicit(parameters: &[f64]) -> DualAccuracy {
    DualAccuracy { order: parameters[0] as usize, degree: parameters[1] as usize, error: parameters[2] }
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

fn of(soup: &TriangleSoup) -> Arc<Triangles> {
    Arc::new(Triangles::new(Arc::new(soup.clone())))
}

fn measure(
    name: &str,
    presets: &[DualAccuracy],
    resolution: usize,
    sources: Arc<dyn Sources>,
    shape: impl Into<Shape>,
    exact: impl Fn(Vec3) -> f64,
) {
    let field = WindingField::new(shape, FieldConfig::default());
    let bounds = field.bounds();
    let build = || {
        let start = seconds();
        (DualTree::build(sources.clone(), LEAF_SIZE), seconds() - start)
    };
    let (tree, _) = build();
    let build_time = (0..5).map(|_| build().1).fold(f64::INFINITY, f64::min);
    let per_source = tree.bytes() as f64 / sources.len() as f64;
    println!(
        "{name}: {} sources, {} clusters, {per_source:.1} bytes per source, built in {:.1} ms",
        sources.len(),
        tree.clusters(),
        1e3 * build_time
    );
    let lattice = Lattice::with_resolution(bounds, resolution).expect("the model has a size");
    let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
    let scattered = common::scattered(bounds, lattice.len(), 3);
    let step = (lattice.len() / CHECKED) | 1;
    let expected: Vec<f64> = points.iter().step_by(step).map(|q| exact(*q)).collect();
    let (_, reference, _) = run(&tree, &LatticeTargets::new(&lattice), lattice.len(), REFERENCE);
    let (rms, max) = difference(reference.iter().step_by(step), expected.iter());
    println!("  reference: rms {rms:.1e}, max {max:.1e} of {} samples", expected.len());
    let baseline = best(|| {
        let start = seconds();
        let grid = field.evaluate_lattice(&lattice, Accuracy::of_paper(field.shape()), &Silent);
        (seconds() - start, grid.expect("nothing cancels").values, 0.0)
    });
    println!("  without Taylor polynomials: {:.0} ns", 1e9 * baseline.0 / lattice.len() as f64);
    for accuracy in presets {
        let (time, values, bound) =
            best(|| run(&tree, &LatticeTargets::new(&lattice), lattice.len(), *accuracy));
        let (time_scattered, ..) =
            best(|| run(&tree, &PointTargets::new(&scattered), scattered.len(), *accuracy));
        let (rms, max) = difference(values.iter(), reference.iter());
        println!(
            "  p {} q {} error {:.0e}: lattice {:.0} ns, scattered {:.0} ns, rms {rms:.1e}, max {max:.1e}, bound {bound:.1e}",
            accuracy.order,
            accuracy.degree,
            accuracy.error,
            1e9 * time / lattice.len() as f64,
            1e9 * time_scattered / lattice.len() as f64,
        );
    }
}

/// The root mean square and the largest of the differences.
fn difference<'a>(
    values: impl Iterator<Item = &'a f64>,
    expected: impl Iterator<Item = &'a f64>,
) -> (f64, f64) {
    let errors: Vec<f64> = values.zip(expected).map(|(v, e)| (v - e).abs()).collect();
    let square = errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64;
    (square.sqrt(), errors.into_iter().fold(0.0, f64::max))
}

const RUNS: usize = 3;

/// The fastest of some runs.
fn best(run: impl Fn() -> (f64, Vec<f64>, f64)) -> (f64, Vec<f64>, f64) {
    (0..RUNS).map(|_| run()).min_by(|a, b| a.0.total_cmp(&b.0)).expect("there is a run")
}

/// Seconds, values and the mean bound.
fn run(tree: &DualTree, targets: &dyn Targets, count: usize, accuracy: DualAccuracy) -> (f64, Vec<f64>, f64) {
    let mut results = vec![0.0; count];
    let (mut sum, mut blocks) = (0.0, 0);
    let start = seconds();
    let mut store = |indices: &[usize], values: &[f64], bound: f64| {
        indices.iter().zip(values).for_each(|(i, v)| results[*i] = *v);
        sum += bound;
        blocks += 1;
    };
    tree.evaluate(targets, &accuracy, &Silent, Proof::Bounds, &mut store).expect("nothing cancels");
    (seconds() - start, results, sum / f64::from(blocks))
}

/// Processor time that all threads of this process have taken: what other programs take does not count.
fn seconds() -> f64 {
    let of_thread = |path: std::path::PathBuf| -> f64 {
        let text = fs::read_to_string(path.join("schedstat")).unwrap_or_default();
        text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()).unwrap_or(0.0)
    };
    let threads = fs::read_dir("/proc/self/task").expect("this needs Linux");
    threads.map(|thread| of_thread(thread.expect("threads can be listed").path())).sum::<f64>() / 1e9
}
