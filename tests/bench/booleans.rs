//! Booleans of closed meshes: times of the parts.
use fast_winding::arrangement::{Pairs, arrange};
use fast_winding::data::Silent;
use fast_winding::io::{self, Geometry};
use fast_winding::math::{Mat3, Vec3};
use std::time::Instant;

fn main() {
    let path = std::env::args().nth(1).expect("a model");
    let Geometry::Soup(soup) = io::read(&std::fs::read(path).unwrap()).unwrap().geometry else { panic!() };
    let size = soup.bounds().size();
    let turn = Mat3::from_rotation_z(0.3) * Mat3::from_rotation_x(0.2);
    let moved: Vec<Vec3> = soup.positions().iter().map(|p| turn * *p + 0.25 * size).collect();
    let first = soup.positions().len() as u32;
    let positions: Vec<Vec3> = soup.positions().iter().copied().chain(moved).collect();
    let second = soup.triangles().iter().map(|t| t.map(|v| v + first));
    let triangles: Vec<[u32; 3]> = soup.triangles().iter().copied().chain(second).collect();
    for _ in 0..4 {
        let start = Instant::now();
        let last = std::cell::RefCell::new((Instant::now(), String::new()));
        let monitor = |_: f64, stage: &str| {
            let mut last = last.borrow_mut();
            if last.1 != stage {
                println!("  {} {:?}", last.1, last.0.elapsed());
                *last = (Instant::now(), stage.to_owned());
            }
            true
        };
        let result = arrange(positions.clone(), &triangles, Pairs::Between(soup.len()), &monitor).unwrap();
        println!(
            "{:?}: {} pieces of {}, seams {}, unresolved {}",
            start.elapsed(),
            result.pieces.len(),
            triangles.len(),
            result.seams.len(),
            result.unresolved
        );
    }
    let _ = Silent;
}
