//! Errors of the areas of points by each method, and of the field made of them, on sampled surfaces (Barill et al. 2018,
//! Fig. 5), and on samples of meshes: `cargo run --release --example areas -- [POINTS] [MODEL...]`.
use common::surfaces::{
    AreaErrors, Place, SURFACES, Sampling, Surface, area_errors, cloud_of, sample, true_areas,
};
use fast_winding::data::Silent;
use fast_winding::estimate::{AreaMethod, EstimateConfig, areas};
use fast_winding::io::{self, Geometry};
use fast_winding::math::{Aabb, Vec3, area_vector};
use fast_winding::metrics::{NearestPoints, sample_surface};
use fast_winding::winding::winding_of_cloud;
use fast_winding::{OrientedCloud, PointCloud};
use std::time::Instant;

/// Places of a mesh's surface for each sample, which tell how much of it is nearest to that.
const PLACES: usize = 200;

/// Points of the cloud that is timed.
const TIMED: usize = 100_000;

#[path = "../common/mod.rs"]
mod common;

const METHODS: [AreaMethod; 4] =
    [AreaMethod::Voronoi, AreaMethod::Curved, AreaMethod::NearestNeighbour, AreaMethod::Uniform];
const SAMPLINGS: [Sampling; 4] = [Sampling::Random, Sampling::Spaced, Sampling::Uneven, Sampling::SixTimes];

fn main() {
    let count =
        std::env::args().nth(1).map_or(5000, |n| n.parse().expect("the argument is a number of points"));
    println!(
        "{count} points; relative errors of areas in %; of w, root mean square at places off the points"
    );
    println!("| surface | sampling | method | median | 95 % | sum | w |");
    println!("|---|---|---|---:|---:|---:|---:|");
    for surface in &SURFACES {
        for sampling in SAMPLINGS {
            let places = sample(surface, sampling, count, 1);
            let truth = true_areas(surface, &places);
            let exact = winding_by(surface, &places, &truth);
            println!("| {} | {sampling:?} | truth | 0 | 0 | 0 | {exact} |", surface.name);
            for method in METHODS {
                let found = areas(&cloud_of(&places), method, &EstimateConfig::default(), &Silent)
                    .expect("the cloud has normals and extent");
                let AreaErrors { median, most, sum } = area_errors(&found, &truth);
                let [median, most, sum] = [median, most, sum].map(|e| 100.0 * e);
                let field = winding_by(surface, &places, &found);
                println!(
                    "| {} | {sampling:?} | {method:?} | {median:.2} | {most:.1} | {sum:+.2} | {field} |",
                    surface.name
                );
            }
        }
    }
    std::env::args().skip(2).for_each(|path| of_mesh(&path, count));
    let many = cloud_of(&sample(&SURFACES[0], Sampling::Random, TIMED, 1));
    for method in METHODS {
        let start = Instant::now();
        areas(&many, method, &EstimateConfig::default(), &Silent).expect("the cloud has normals and extent");
        println!("{method:?} of {TIMED} points: {} ms", start.elapsed().as_millis());
    }
}

/// Samples of a mesh; the truth is what of its surface is nearest to each, which on thin parts may be some of the other side.
fn of_mesh(path: &str, count: usize) {
    let bytes = std::fs::read(path).expect("the model can be read");
    let Geometry::Soup(soup) = io::read(&bytes).expect("the model is understood").geometry else {
        panic!("{path} has no triangles")
    };
    let samples = sample_surface(&soup, count, 1).expect("the model has an area");
    let places = sample_surface(&soup, PLACES * count, 2).expect("the model has an area");
    let whole: f64 = (0..soup.len()).map(|t| area_vector(soup.corners(t)).length()).sum();
    let mut truth = vec![0.0; count];
    for (nearest, _) in NearestPoints::new(&samples.points).of(&places.points) {
        truth[nearest] += whole / places.points.len() as f64;
    }
    let cloud =
        PointCloud::cleaned(samples.points, Some(samples.normals), None).expect("samples are finite").0;
    for method in METHODS {
        let found =
            areas(&cloud, method, &EstimateConfig::default(), &Silent).expect("the cloud has normals");
        let AreaErrors { median, most, sum } = area_errors(&found, &truth);
        let [median, most, sum] = [median, most, sum].map(|e| 100.0 * e);
        let name = std::path::Path::new(path).file_stem().expect("a file").to_string_lossy();
        println!("| {name} | Random | {method:?} | {median:.2} | {most:.1} | {sum:+.2} | – |");
    }
}

/// The root mean square error of w at 500 places of the box, those nearer to a point than 0.1 left out; for closed surfaces.
fn winding_by(surface: &Surface, places: &[Place], areas: &[f64]) -> String {
    if !surface.is_closed {
        return "–".into();
    }
    let points: Vec<Vec3> = places.iter().map(|place| place.point).collect();
    let normals = places.iter().map(|place| place.normal).collect();
    let cloud = OrientedCloud::new(points, normals, areas.to_vec()).expect("areas are finite");
    let queries = common::scattered(Aabb { min: -Vec3::ONE, max: Vec3::ONE }, 500, 2);
    let is_off = |q: &&Vec3| cloud.points().iter().all(|p| p.distance(**q) > 0.1);
    let squares: Vec<f64> = (queries.iter().filter(is_off))
        .map(|q| (winding_of_cloud(&cloud, *q) - f64::from(u8::from(is_inside(surface, *q)))).powi(2))
        .collect();
    format!("{:.4}", (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

fn is_inside(surface: &Surface, q: Vec3) -> bool {
    match surface.name {
        "sphere" => q.length() < 1.0,
        "torus" => (q.truncate().length() - 0.7).hypot(q.z) < 0.3,
        _ => (q / Vec3::new(1.0, 0.6, 0.3)).length() < 1.0,
    }
}
