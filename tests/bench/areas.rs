//! Errors of the areas of points by each method, and of the field made of them, on sampled surfaces (Barill et al. 2018,
//! Fig. 5): `cargo run --release --example areas -- [POINTS]`.
use common::surfaces::{
    AreaErrors, Place, SURFACES, Sampling, Surface, area_errors, cloud_of, sample, true_areas,
};
use fast_winding::OrientedCloud;
use fast_winding::data::Silent;
use fast_winding::estimate::{AreaMethod, EstimateConfig, areas};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::winding::winding_of_cloud;
use std::time::Instant;

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
    let many = cloud_of(&sample(&SURFACES[0], Sampling::Random, TIMED, 1));
    for method in METHODS {
        let start = Instant::now();
        areas(&many, method, &EstimateConfig::default(), &Silent).expect("the cloud has normals and extent");
        println!("{method:?} of {TIMED} points: {} ms", start.elapsed().as_millis());
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
