//! The tables of Schier et al. 2018 with ours beside them.
mod shapes;

use fast_winding::TriangleSoup;
use fast_winding::charge::*;
use fast_winding::data::Silent;
use fast_winding::math::Vec3;
use std::sync::Arc;
use std::time::Instant;

fn main() {
    for (name, soup) in [
        ("sphere", shapes::sphere(50, 50)),
        ("torus", shapes::torus_of(5000)),
        ("cylinder", shapes::cylinder(50, 30, 15)),
        ("cube", shapes::cube(20, 50)),
    ] {
        let soup = Arc::new(soup);
        for solver in [Solver::Krylov, Solver::RobinHood] {
            for integration in [Integration::Exact, Integration::Quadrature] {
                let start = Instant::now();
                let config = ChargeConfig {
                    solver,
                    integration,
                    tolerance: 1e-10,
                    refinement: None,
                    ..Default::default()
                };
                let field = ElectricField::solve(soup.clone(), &config, &Silent).unwrap();
                println!(
                    "{name} {} {solver:?} {integration:?}: {:.3} s {:?}",
                    soup.len(),
                    start.elapsed().as_secs_f64(),
                    field.report()
                );
            }
        }
    }
}
