//! Tables 3 and 4: how fast charges converge, and how their time grows.
use crate::shapes;
use fast_winding::TriangleSoup;
use fast_winding::charge::{ChargeConfig, ElectricField, Integration, Solver};
use fast_winding::data::Silent;
use fast_winding::math::area_vector;
use std::sync::Arc;
use std::time::Instant;

/// Table 3 of the paper, as far as it is compared: triangles, iterations and seconds to 1e-7 and to 1e-10.
///
/// Its errors fall by 1 % with each iteration from the first on, on sphere, torus and cylinder alike: 229 iterations a decade
/// (ln 10 / −ln 0.99), and 137 from 0.395 to 0.1. Exchanges of two charges (eqs. 6 and 8) do not: only elements that take part
/// get another charge, and 2,199 exchanges leave at least 602 of 5,000 elements at what they had. So its counts are none to
/// compare ours with, whose steps are such exchanges; one of its iterations takes about as long as one.
const PAPER: [(&str, [(usize, f64); 2]); 4] = [
    ("sphere", [(1058, 0.68), (1745, 1.12)]),
    ("torus", [(1512, 0.97), (2199, 1.41)]),
    ("cylinder", [(1442, 1.06), (2129, 1.56)]),
    ("cube", [(402_390, 364.0), (403_078, 364.68)]),
];

/// Charges and the seconds they take, the median of some runs.
pub fn timed(soup: &Arc<TriangleSoup>, config: &ChargeConfig, runs: usize) -> (ElectricField, f64) {
    let mut times = Vec::new();
    let mut last = None;
    for _ in 0..runs {
        let start = Instant::now();
        last = Some(ElectricField::solve(soup.clone(), config, &Silent).expect("the shape has an area"));
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    (last.expect("there was a run"), times[runs / 2])
}

pub fn convergence() {
    println!(
        "Table 3: charges to a relative deviation of the potential, steps and seconds (GMRES to 1e-10: median of 3)"
    );
    println!("{:34}{:>18}{:>18}{:>14}", "", "to 1e-7", "to 1e-10", "potential");
    let shapes =
        [shapes::sphere(50, 50), shapes::torus_of(5000), shapes::cylinder(50, 30, 15), shapes::cube(20, 50)];
    for ((name, paper), soup) in PAPER.into_iter().zip(shapes) {
        let of = |(steps, seconds): (usize, f64)| format!("{steps:>8}{seconds:>9.3}s");
        println!("{:34}{}{}", format!("{name}, {}: paper", soup.len()), of(paper[0]), of(paper[1]));
        let soup = Arc::new(soup);
        for (solver, integration) in [
            (Solver::RobinHood, Integration::Quadrature),
            (Solver::RobinHood, Integration::Exact),
            (Solver::Krylov, Integration::Quadrature),
            (Solver::Krylov, Integration::Exact),
        ] {
            let results = [(1e-7, 1), (1e-10, 3)].map(|(tolerance, runs)| {
                let config =
                    ChargeConfig { solver, integration, tolerance, refinement: None, ..Default::default() };
                timed(&soup, &config, if solver == Solver::Krylov { runs } else { 1 })
            });
            let potential = results[1].0.report().potential;
            let [a, b] = results.map(|(field, seconds)| of((field.report().steps, seconds)));
            println!("{:34}{a}{b}{potential:>14.8}", format!("  {solver:?}, {integration:?}"));
            if solver == Solver::RobinHood && integration == Integration::Quadrature {
                println!("    {}", untouched(&soup));
            }
        }
    }
}

/// Elements whose share of the charge is that of their area to 1e-9: steps of two elements each that change no others have to
/// be at least half as many as the others are.
fn untouched(soup: &Arc<TriangleSoup>) -> String {
    let config = ChargeConfig {
        integration: Integration::Quadrature,
        tolerance: 1e-10,
        refinement: None,
        ..Default::default()
    };
    let (field, _) = timed(soup, &config, 1);
    let areas: Vec<f64> = (0..soup.len()).map(|t| area_vector(soup.corners(t)).length()).collect();
    let area: f64 = areas.iter().sum();
    let is_even = |(charge, own): (&f64, &f64)| (charge * area / own - 1.0).abs() < 1e-9;
    let even = field.charges().iter().zip(&areas).filter(|pair| is_even(*pair)).count();
    let least = (soup.len() - even).div_ceil(2);
    format!("of an even charge {even} elements keep theirs: exchanges of two take {least} steps at least")
}

/// Table 4 of the paper: triangles; seconds by Robin Hood with a direct start, with FMM, by LU.
const RATE: [(usize, f64, f64, Option<f64>); 8] = [
    (800, 0.14, 0.22, Some(0.33)),
    (1600, 0.37, 0.40, Some(2.80)),
    (3200, 1.01, 0.76, Some(22.56)),
    (6400, 6.21, 4.33, Some(236.68)),
    (12_800, 14.15, 5.43, Some(1678.71)),
    (25_600, 46.93, 12.19, None),
    (51_200, 197.25, 19.79, None),
    (105_800, 918.38, 36.94, None),
];
/// Beyond, Robin Hood takes minutes: its steps find the entries of their columns anew.
const MOST_BY_ROBIN_HOOD: usize = 3200;

pub fn rate() {
    println!("Table 4: charges of a torus, seconds; ours to 1e-6");
    println!(
        "{:>9} | paper: {:>9}{:>9}{:>9} | ours: {:>12}{:>9}{:>7}{:>12}",
        "triangles", "RH", "RH, FMM", "LU", "Robin Hood", "GMRES", "steps", "rate"
    );
    let mut before: Option<f64> = None;
    for (triangles, direct, fmm, lu) in RATE {
        let soup = Arc::new(shapes::torus_of(triangles));
        let config = ChargeConfig { refinement: None, ..Default::default() };
        let (field, seconds) = timed(&soup, &config, if triangles < 5000 { 3 } else { 1 });
        let by_robin_hood = (triangles <= MOST_BY_ROBIN_HOOD)
            .then(|| timed(&soup, &ChargeConfig { solver: Solver::RobinHood, ..config }, 1).1);
        let optional = |x: Option<f64>| x.map_or("".to_owned(), |x| format!("{x:.2}"));
        let rate = optional(before.map(|before| (seconds / before).log2()));
        println!(
            "{triangles:>9} |        {direct:>9}{fmm:>9}{:>9} |       {:>12}{seconds:>9.2}{:>7}{rate:>12}",
            optional(lu),
            optional(by_robin_hood),
            field.report().steps
        );
        before = Some(seconds);
    }
}
