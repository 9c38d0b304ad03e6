//! How long a check takes, and what it says: `cargo run --release --example checks -- model.ply …`
use fast_winding::WindingField;
use fast_winding::check::{CheckConfig, check};
use fast_winding::data::Silent;
use fast_winding::io::{self, Geometry};
use std::time::Instant;

fn main() {
    println!("| model | triangles | field ms | check ms | crossing pairs | verdict |");
    println!("|---|---|---|---|---|---|");
    for path in std::env::args().skip(1) {
        let Geometry::Soup(soup) = io::read(&std::fs::read(&path).unwrap()).unwrap().geometry else {
            continue;
        };
        let triangles = soup.len();
        let soup = std::sync::Arc::new(soup);
        let mut times: Vec<[f64; 2]> = Vec::new();
        let mut last = None;
        for _ in 0..3 {
            let start = Instant::now();
            let field = WindingField::new(soup.clone(), Default::default());
            let built = start.elapsed().as_secs_f64() * 1e3;
            let start = Instant::now();
            last = Some(check(&field, &CheckConfig::default(), &Silent).unwrap());
            times.push([built, start.elapsed().as_secs_f64() * 1e3]);
        }
        let median = |k: usize| {
            let mut of: Vec<f64> = times.iter().map(|t| t[k]).collect();
            of.sort_by(f64::total_cmp);
            of[1]
        };
        let report = last.unwrap();
        let pairs = report.self_intersections.map_or(0, |list| list.count);
        let name = path.rsplit('/').next().unwrap();
        println!(
            "| {name} | {triangles} | {:.0} | {:.0} | {pairs} | {} |",
            median(0),
            median(1),
            report.verdict.text
        );
        if std::env::var_os("STAGES").is_some() {
            let field = WindingField::new(soup.clone(), Default::default());
            let start = Instant::now();
            let last = std::cell::Cell::new(("", 0.0));
            let monitor = |_: f64, stage: &str| {
                let now = start.elapsed().as_secs_f64() * 1e3;
                if stage != last.get().0 {
                    println!("    until {now:.0} ms: {}", last.get().0);
                    last.set((Box::leak(stage.to_owned().into_boxed_str()), now));
                }
                true
            };
            check(&field, &CheckConfig::default(), &monitor).unwrap();
            println!("    until {:.0} ms", start.elapsed().as_secs_f64() * 1e3);
        }
    }
}
