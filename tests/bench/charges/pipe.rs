//! Figure 15 of the paper: lines from the inside of a pipe, with charges and fields by rules of low degree.
use crate::lines::Points;
use fast_winding::TriangleSoup;
use fast_winding::charge::{
    ChargeConfig, ElectricField, FieldLines, Integration, Integrator, LineConfig, Rule, first_hits, trace,
};
use fast_winding::data::Silent;
use fast_winding::math::Vec3;
use std::f64::consts::TAU;
use std::sync::Arc;

const AROUND: usize = 16;
const ALONG: usize = 4;
const THICKNESS: f64 = 0.1;
const STEP: f64 = 0.02;
const STEPS: usize = 300;

/// 320 triangles of 160 vertices, radius 1, length 4; and the cells of the inside as a start and a normal.
fn pipe() -> (TriangleSoup, Vec<Vec3>, Vec<Vec3>) {
    let at = |k: usize, z: usize, r: f64| {
        let angle = TAU * k as f64 / AROUND as f64;
        Vec3::new(r * angle.cos(), r * angle.sin(), z as f64 - 2.0)
    };
    let inner = 1.0 - THICKNESS;
    let mut cells = Vec::new();
    for k in 0..AROUND {
        for z in 0..ALONG {
            cells.push([at(k + 1, z, inner), at(k, z, inner), at(k, z + 1, inner), at(k + 1, z + 1, inner)]);
        }
    }
    let starts = cells.iter().map(|[a, _, c, _]| a.midpoint(*c)).collect();
    let normals = cells.iter().map(|[a, b, c, _]| (*b - *a).cross(*c - *a).normalize()).collect();
    for k in 0..AROUND {
        for z in 0..ALONG {
            cells.push([at(k, z, 1.0), at(k + 1, z, 1.0), at(k + 1, z + 1, 1.0), at(k, z + 1, 1.0)]);
        }
        cells.push([at(k, ALONG, inner), at(k, ALONG, 1.0), at(k + 1, ALONG, 1.0), at(k + 1, ALONG, inner)]);
        cells.push([at(k, 0, 1.0), at(k, 0, inner), at(k + 1, 0, inner), at(k + 1, 0, 1.0)]);
    }
    let positions: Vec<Vec3> = cells.concat();
    let triangles =
        (0..cells.len() as u32).flat_map(|c| [[4 * c, 4 * c + 1, 4 * c + 2], [4 * c, 4 * c + 2, 4 * c + 3]]);
    (TriangleSoup::new(positions, triangles.collect()).expect("a pipe is a soup"), starts, normals)
}

pub fn through_walls() {
    let (soup, starts, normals) = pipe();
    let soup = Arc::new(soup);
    println!(
        "Figure 15: of {} lines from inside a pipe of {} triangles, those that meet its wall",
        starts.len(),
        soup.len()
    );
    let count = |lines: &FieldLines| {
        let mut free = FieldLines::default();
        (0..lines.len()).for_each(|k| free.push(&lines.line(k)[1..]));
        first_hits(&free, &soup).iter().filter(|hit| hit.is_some()).count()
    };
    let config = ChargeConfig { refinement: None, tolerance: 1e-10, ..Default::default() };
    let solve = |config: &ChargeConfig| {
        ElectricField::solve(soup.clone(), config, &Silent).expect("the pipe has an area")
    };
    let by_rule = solve(&ChargeConfig { integration: Integration::Quadrature, ..config });
    for rule in [Rule::Two, Rule::Four, Rule::Six] {
        let points = Points::of(&by_rule, rule);
        let mut lines = FieldLines::default();
        for (start, normal) in starts.iter().zip(&normals) {
            let mut line = vec![*start, *start + 0.1 * STEP * *normal];
            for _ in 0..STEPS {
                let from = *line.last().expect("a line has a start");
                line.push(from + STEP * points.field(from).normalize());
            }
            lines.push(&line);
        }
        println!("  eq. 9, degree {rule:?}: {}", count(&lines));
    }
    for (name, field) in [("exact", solve(&config)), ("exact, refined", solve(&ChargeConfig::default()))] {
        let config = LineConfig {
            integrator: Integrator::Euler,
            steps: STEPS,
            step: Some(STEP),
            ..Default::default()
        };
        let lines = trace(&field, &starts, &normals, &config, &Silent).expect("starts are good");
        println!("  {name}: {}", count(&lines));
    }
}
