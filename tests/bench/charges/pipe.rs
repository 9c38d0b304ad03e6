//! Figure 15 of the paper: lines from the inside of a pipe, with charges and fields by rules of low degree.
use crate::lines::Points;
use fast_winding::TriangleSoup;
use fast_winding::charge::{
    ChargeConfig, ElectricField, FieldLines, Integration, Integrator, LineConfig, Rule, first_hits, trace,
};
use fast_winding::data::Silent;
use fast_winding::math::{Vec3, area_vector};
use std::f64::consts::TAU;
use std::sync::Arc;

const AROUND: usize = 16;
const ALONG: usize = 4;
const THICKNESS: f64 = 0.1;
const STEP: f64 = 0.02;
const STEPS: usize = 300;
/// How far from the wall lines begin. The paper does not say.
const OFFSETS: [f64; 5] = [0.002, 0.01, 0.03, 0.1, 0.2];

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

/// The corners of the cells of the inside, each once, and the mean normals of the cells around them.
fn corners_of(pipe: &TriangleSoup, cells: usize) -> (Vec<Vec3>, Vec<Vec3>) {
    let mut corners: Vec<(Vec3, Vec3)> = Vec::new();
    for t in 0..2 * cells {
        let triangle = pipe.corners(t);
        for corner in triangle {
            let same = corners.iter_mut().find(|(other, _)| other.distance(corner) < 1e-9);
            match same {
                Some((_, normal)) => *normal += area_vector(triangle),
                None => corners.push((corner, area_vector(triangle))),
            }
        }
    }
    corners.into_iter().unzip()
}

/// How many lines meet the wall after their second points.
fn into_walls(lines: &FieldLines, pipe: &TriangleSoup) -> usize {
    let mut free = FieldLines::default();
    (0..lines.len()).for_each(|k| free.push(&lines.line(k)[1..]));
    first_hits(&free, pipe).iter().filter(|hit| hit.is_some()).count()
}

/// Lines by eq. 9.
fn by_points(points: &Points, starts: &[Vec3], normals: &[Vec3], offset: f64) -> FieldLines {
    let mut lines = FieldLines::default();
    for (start, normal) in starts.iter().zip(normals) {
        let mut line = vec![*start, *start + offset * normal.normalize()];
        for _ in 0..STEPS {
            let from = *line.last().expect("a line has a start");
            line.push(from + STEP * points.field(from).normalize());
        }
        lines.push(&line);
    }
    lines
}

pub fn through_walls() {
    let (soup, middles, normals) = pipe();
    let soup = Arc::new(soup);
    let config = ChargeConfig { refinement: None, tolerance: 1e-10, ..Default::default() };
    let solve = |config: &ChargeConfig| {
        ElectricField::solve(soup.clone(), config, &Silent).expect("the pipe has an area")
    };
    let by_rule = solve(&ChargeConfig { integration: Integration::Quadrature, ..config });
    let exact = [("exact", solve(&config)), ("exact, refined", solve(&ChargeConfig::default()))];
    let (corners, corner_normals) = corners_of(&soup, middles.len());
    for (name, starts, normals) in
        [("corners", &corners, &corner_normals), ("middles of cells", &middles, &normals)]
    {
        println!(
            "Figure 15: of {} lines from {name} inside a pipe of {} triangles, those that meet its wall, by how far from it they begin",
            starts.len(),
            soup.len()
        );
        println!("{:>24}{}", "", OFFSETS.map(|offset| format!("{offset:>8}")).concat());
        for rule in [Rule::Two, Rule::Four, Rule::Six] {
            let points = Points::of(&by_rule, rule);
            let count = |offset: f64| into_walls(&by_points(&points, starts, normals, offset), &soup);
            let counts = OFFSETS.map(|offset| format!("{:>8}", count(offset))).concat();
            println!("{:>24}{counts}", format!("eq. 9, degree {rule:?}"));
        }
        for (name, field) in &exact {
            let count = |offset: f64| {
                let config = LineConfig {
                    integrator: Integrator::Euler,
                    steps: STEPS,
                    step: Some(STEP),
                    start_offset: Some(offset),
                    ..Default::default()
                };
                let lines = trace(field, starts, normals, &config, &Silent).expect("starts are good");
                into_walls(&lines, &soup)
            };
            println!("{name:>24}{}", OFFSETS.map(|offset| format!("{:>8}", count(offset))).concat());
        }
    }
}
