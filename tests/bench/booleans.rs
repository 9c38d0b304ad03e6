//! Booleans of closed meshes with themselves, turned and shifted: times with the making of the fields, and what is found.
//!
//!     cargo run --release --example booleans MODEL...
use fast_winding::TriangleSoup;
use fast_winding::WindingField;
use fast_winding::data::Silent;
use fast_winding::io::{self, Geometry};
use fast_winding::math::Mat3;
use fast_winding::solid::{BooleanConfig, BooleanOp, boolean};
use std::time::Instant;

const RUNS: usize = 5;

fn main() {
    for path in std::env::args().skip(1) {
        let bytes = std::fs::read(&path).expect("a model to be read");
        let Geometry::Soup(soup) = io::read(&bytes).expect("a model").geometry else {
            panic!("{path} has no triangles")
        };
        let size = soup.bounds().size();
        let turn = Mat3::from_rotation_z(0.3) * Mat3::from_rotation_x(0.2);
        let moved = soup.positions().iter().map(|p| turn * *p + 0.25 * size).collect();
        let moved = TriangleSoup::new(moved, soup.triangles().to_vec()).expect("a model that is moved");
        for op in [BooleanOp::Union, BooleanOp::Intersection, BooleanOp::Difference] {
            let mut times = Vec::new();
            let mut count = 0;
            for _ in 0..RUNS {
                let (a, b) = (soup.clone(), moved.clone());
                let start = Instant::now();
                let [a, b] = [a, b].map(|soup| WindingField::new(soup, Default::default()));
                let mesh = boolean(&a, &b, op, &BooleanConfig::default(), &Silent).expect("a result");
                times.push(start.elapsed().as_secs_f64() * 1e3);
                count = mesh.triangles.len();
            }
            times.sort_by(f64::total_cmp);
            println!("{path} {op:?}: {:.0} ms, {count} triangles", times[RUNS / 2]);
        }
    }
}
