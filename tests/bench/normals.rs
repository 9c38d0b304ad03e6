//! Normals of unoriented clouds.
use fast_winding::data::Silent;
use fast_winding::io::{self, Geometry};
use fast_winding::metrics::{angle_rmse, good_points, sample_surface};
use fast_winding::orient::{Widths, WnncConfig, WnncVariant, wnnc};
use std::time::Instant;

fn main() {
    let path = std::env::args().nth(1).unwrap();
    let count: usize = std::env::args().nth(2).unwrap().parse().unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let Geometry::Soup(soup) = io::read(&bytes).unwrap().geometry else { panic!() };
    let samples = sample_surface(&soup, count, 1).unwrap();
    for variant in [WnncVariant::Plain, WnncVariant::BoundedGradient] {
        for (k, widths) in Widths::ALL.into_iter().enumerate().take(3) {
            let start = Instant::now();
            let found = wnnc(&samples.points, &WnncConfig { variant, widths, ..Default::default() }, &Silent)
                .unwrap();
            println!(
                "{path} {count} {variant:?} l{k}: PGP {:.4} RMSE {:.2} area {:.4} in {:.2} s",
                good_points(&found, &samples.normals).unwrap(),
                angle_rmse(&found, &samples.normals).unwrap(),
                found.iter().map(|v| v.length()).sum::<f64>()
                    / (0..soup.len())
                        .map(|t| fast_winding::math::area_vector(soup.corners(t)).length())
                        .sum::<f64>(),
                start.elapsed().as_secs_f64()
            );
        }
    }
}
