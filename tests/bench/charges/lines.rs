//! Tables 2, 5 and 6: potentials, field lines, and the order of their integrators.
use crate::shapes::{self, torus_at, torus_normal};
use crate::solving::timed;
use fast_winding::charge::{
    ChargeConfig, ElectricField, FieldLines, Integrator, LineConfig, Opening, Rule, trace,
};
use fast_winding::data::Silent;
use fast_winding::math::{Vec3, area_vector};
use fast_winding::texture::{Proxy, ProxyConfig, ProxySides};
use fast_winding::{TriangleSoup, WindingField};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// Eq. 9 of the paper as it stands: a sum over the points of each triangle, in f64.
pub struct Points(Vec<(f64, Vec3)>);

impl Points {
    pub fn of(field: &ElectricField, rule: Rule) -> Points {
        let soup = field.soup();
        let charged =
            |t: usize| rule.points(soup.corners(t)).map(move |(weight, y)| (weight * field.charges()[t], y));
        Points((0..soup.len()).flat_map(charged).collect())
    }

    pub fn field(&self, x: Vec3) -> Vec3 {
        self.0
            .iter()
            .map(|(q, y)| {
                let r = x - *y;
                let square = r.length_squared();
                *q / (square * square.sqrt()) * r
            })
            .sum()
    }

    fn potential(&self, x: Vec3) -> f64 {
        self.0.iter().map(|(q, y)| q / x.distance(*y)).sum()
    }
}

/// Vertices of a soup in use and the mean normals of the triangles around them.
pub fn starts(soup: &TriangleSoup) -> (Vec<Vec3>, Vec<Vec3>) {
    // Vertices of the torus's two seams are there twice: in the same place.
    let mut normals: std::collections::BTreeMap<[i64; 3], (Vec3, Vec3)> = Default::default();
    for t in 0..soup.len() {
        let corners = soup.corners(t);
        for corner in corners {
            let key = (1e9 * corner).round().to_array().map(|x| x as i64);
            normals.entry(key).or_insert((corner, Vec3::ZERO)).1 += area_vector(corners);
        }
    }
    normals.into_values().unzip()
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Table 2 of the paper: triangles of the torus; samples of the two-sided proxy that the dipole field takes; all triangles; seconds
/// direct, by FMM with θ = 0.1 and 0.4.
const POTENTIALS: [(usize, Option<usize>, usize, [f64; 3]); 6] = [
    (5000, None, 5000, [1.352, 0.721, 0.178]),
    (5000, Some(40), 20_312, [24.476, 6.192, 0.855]),
    (5000, Some(80), 65_256, [324.395, 23.259, 2.771]),
    (2450, None, 2450, [0.302, 0.168, 0.074]),
    (2450, Some(40), 17_754, [17.519, 4.838, 0.743]),
    (2450, Some(80), 62_590, [283.918, 18.984, 2.944]),
];
/// Of the proxies: 5 % of the torus's diameter.
const PROXY_OFFSET: f64 = 0.15;
/// More potentials are not summed directly: the time of so many stands for that of all.
const MOST_DIRECT_POTENTIALS: usize = 5000;

pub fn potentials() {
    println!("Table 2: potentials at all barycentres, seconds (ours: median of 5)");
    println!(
        "{:>13}{:>9} | paper: {:>9}{:>9}{:>9}{:>9} | ours: {:>9}{:>8}{:>9}{:>16}",
        "", "torus", "all", "direct", "θ = 0.1", "θ = 0.4", "all", "direct", "tree", "rms error"
    );
    for (triangles, samples, all, [direct, fine, coarse]) in POTENTIALS {
        let soup = Arc::new(shapes::torus_of(triangles));
        let field = match samples {
            None => timed(&soup, &ChargeConfig { refinement: None, ..Default::default() }, 1).0,
            Some(samples) => dipole(&soup, samples),
        };
        let points = Points::of(&field, Rule::Six);
        let soup = field.soup();
        let centers: Vec<Vec3> =
            (0..soup.len()).map(|t| soup.corners(t).iter().sum::<Vec3>() / 3.0).collect();
        let median = |work: &dyn Fn()| {
            let mut times: Vec<f64> = (0..5).map(|_| seconds(work)).collect();
            times.sort_by(f64::total_cmp);
            times[2]
        };
        let some: Vec<Vec3> =
            centers.iter().copied().step_by(centers.len().div_ceil(MOST_DIRECT_POTENTIALS)).collect();
        let share = centers.len() as f64 / some.len() as f64;
        let own_direct = median(&|| {
            std::hint::black_box(some.par_iter().map(|x| points.potential(*x)).collect::<Vec<f64>>());
        });
        let own_tree = median(&|| {
            std::hint::black_box(field.potential(&centers));
        });
        // Relative to the largest: those of dipoles are of both signs.
        let exact: Vec<f64> = some.par_iter().map(|x| field.direct(*x).0).collect();
        let largest = exact.iter().fold(0.0, |most: f64, p| most.max(p.abs()));
        let sum = field.potential(&some).iter().zip(&exact).map(|(p, e)| (p - e) * (p - e)).sum::<f64>();
        let rms = (sum / exact.len() as f64).sqrt() / largest;
        println!(
            "{:>13}{triangles:>9} |        {all:>9}{direct:>9}{fine:>9}{coarse:>9} |       {:>9}{:>8.3}{own_tree:>9.4}{rms:>16.1e}",
            samples.map_or("monopole".to_owned(), |samples| format!("dipole ({samples})")),
            soup.len(),
            share * own_direct,
        );
    }
}

/// The dipole field of a torus with both sides of a proxy around it.
fn dipole(soup: &Arc<TriangleSoup>, samples: usize) -> ElectricField {
    let field = WindingField::new(soup.clone(), Default::default());
    let config = ProxyConfig {
        offset: Some(PROXY_OFFSET),
        samples: Some(samples),
        sides: ProxySides::Both,
        smoothing: 0,
    };
    let Proxy { mut mesh, inner, .. } = Proxy::new(&field, &config, &Silent).expect("it has a proxy");
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(inner.positions);
    mesh.triangles.extend(inner.triangles.iter().map(|corners| corners.map(|i| first + i)));
    let config = ChargeConfig { refinement: None, tolerance: 1e-2, ..Default::default() };
    ElectricField::dipole(soup, &mesh.into(), &config, &Silent).expect("both have areas")
}

/// Table 5 of the paper: triangles; seconds of 50 steps by FMM with θ = 0.4, 0.1, and direct.
const LINES: [(usize, f64, f64, Option<f64>); 9] = [
    (800, 2.18, 2.53, Some(0.94)),
    (1600, 2.84, 6.24, Some(4.03)),
    (3200, 1.99, 8.87, Some(16.83)),
    (6400, 3.53, 32.44, Some(75.37)),
    (12_800, 8.22, 124.96, Some(333.97)),
    (25_600, 17.13, 361.96, Some(1402.52)),
    (51_200, 35.71, 724.67, Some(5584.04)),
    (102_400, 68.69, 1434.35, None),
    (204_800, 164.71, 2820.83, None),
];
const STEPS: usize = 50;
/// All steps lead a twentieth of the torus's diameter away.
const STEP: f64 = 0.15 / STEPS as f64;
/// Up to so many triangles eq. 9 is summed too.
const MOST_DIRECTLY: usize = 1600;

fn euler_lines(field: &ElectricField, starts: &[Vec3], normals: &[Vec3]) -> FieldLines {
    let config =
        LineConfig { integrator: Integrator::Euler, steps: STEPS, step: Some(STEP), ..Default::default() };
    trace(field, starts, normals, &config, &Silent).expect("starts are good")
}

/// The same by eq. 9.
fn direct_lines(points: &Points, starts: &[Vec3], normals: &[Vec3]) -> Vec<Vec3> {
    let line = |k: usize| {
        let start = starts[k] + 0.1 * STEP * normals[k].normalize();
        (0..STEPS).fold(start, |x, _| x + STEP * points.field(x).normalize())
    };
    (0..starts.len()).into_par_iter().map(line).collect()
}

/// Errors relative to what is exact: median, 99 % and largest.
fn errors(exact: &[Vec3], found: &[Vec3]) -> [f64; 3] {
    let mut errors: Vec<f64> = found.iter().zip(exact).map(|(f, e)| f.distance(*e) / e.length()).collect();
    errors.sort_by(f64::total_cmp);
    [errors.len() / 2, errors.len() * 99 / 100, errors.len() - 1].map(|k| errors[k])
}

pub fn rate() {
    println!("Table 5: lines from all vertices of a torus, {STEPS} steps by Euler's method, seconds");
    println!(
        "{:>9} | paper: {:>9}{:>9}{:>9} | ours: {:>9}{:>9}{:>7} | scaled, paper θ = 0.4 / ours | errors (median, 99 %, largest): directions of steps; field by tree, eq. 9",
        "triangles", "θ = 0.4", "θ = 0.1", "direct", "direct", "tree", "rate"
    );
    let mut scale = None;
    let mut before: Option<f64> = None;
    for (triangles, coarse, fine, direct) in LINES {
        let soup = Arc::new(shapes::torus_of(triangles));
        let (field, _) =
            timed(&soup, &ChargeConfig { refinement: None, tolerance: 1e-4, ..Default::default() }, 1);
        let (starts, normals) = starts(&soup);
        let mut lines = FieldLines::default();
        let mut times: Vec<f64> =
            (0..3).map(|_| seconds(|| lines = euler_lines(&field, &starts, &normals))).collect();
        times.sort_by(f64::total_cmp);
        let own = times[1];
        let points = Points::of(&field, Rule::Six);
        let own_direct = (triangles <= MOST_DIRECTLY)
            .then(|| seconds(|| drop(std::hint::black_box(direct_lines(&points, &starts, &normals)))));
        if let (Some(own_direct), Some(direct)) = (own_direct, direct) {
            scale = Some(own_direct / direct);
        }
        let count = (40_000_000 / triangles).clamp(100, 2000);
        // Points of lines, and the steps from there.
        let (at, steps): (Vec<Vec3>, Vec<Vec3>) = (0..count)
            .map(|k| {
                let line = lines.line(k * lines.len() / count);
                let n = 1 + (k * 7919) % (line.len() - 2);
                (line[n], (line[n + 1] - line[n]) / STEP)
            })
            .unzip();
        let exact: Vec<Vec3> = at.par_iter().map(|x| field.direct(*x).1).collect();
        let directions: Vec<Vec3> = exact.iter().map(|field| field.normalize()).collect();
        let of_steps = errors(&directions, &steps);
        let by_tree = errors(&exact, &field.field(&at));
        let by_points: Vec<Vec3> = at.par_iter().map(|x| points.field(*x)).collect();
        let by_points = errors(&exact, &by_points);
        let optional = |x: Option<f64>| x.map_or("".to_owned(), |x| format!("{x:.2}"));
        let rate = optional(before.map(|before| (own / before).log2()));
        let ratio = optional(scale.map(|scale| scale * coarse / own));
        let list = |e: [f64; 3]| e.map(|e| format!("{e:.1e}")).join(" ");
        println!(
            "{triangles:>9} |        {coarse:>9}{fine:>9}{:>9} |       {:>9}{own:>9.3}{rate:>7} | {ratio:>28} | {}; {}, {}",
            optional(direct),
            optional(own_direct),
            list(of_steps),
            list(by_tree),
            list(by_points)
        );
        before = Some(own);
    }
    println!("lines for one field: {:?}", Opening::default());
}

/// Table 6 of the paper: step; errors by Euler's method and by the midpoint method.
const ORDER: [(f64, f64, Option<f64>); 5] = [
    (1.0, 3.522e-1, Some(2.5148e-1)),
    (1e-1, 3.1137e-2, Some(1.9424e-3)),
    (1e-2, 3.2753e-3, Some(3.2174e-5)),
    (1e-3, 3.301e-4, Some(3.482e-7)),
    (1e-4, 3.3034e-5, None),
];

pub fn order() {
    println!(
        "Table 6: mean distance of the ends of 400 lines of a torus from those of the midpoint method with steps of 1e-4"
    );
    println!(
        "{:>8} | paper: {:>12}{:>12} | ours: {:>12}{:>12}",
        "step", "Euler", "midpoint", "Euler", "midpoint"
    );
    let soup = Arc::new(shapes::torus(20, 20));
    let (field, _) =
        timed(&soup, &ChargeConfig { refinement: None, tolerance: 1e-10, ..Default::default() }, 1);
    let at = |k: usize| ((k % 20) as f64 / 20.0, (k / 20) as f64 / 20.0);
    let starts: Vec<Vec3> = (0..400).map(|k| torus_at(at(k).0, at(k).1)).collect();
    let normals: Vec<Vec3> = (0..400).map(|k| torus_normal(at(k).0, at(k).1)).collect();
    let ends = |integrator: Integrator, step: f64| -> Vec<Vec3> {
        let steps = (1.0 / step).round() as usize;
        let config = LineConfig {
            integrator,
            steps,
            step: Some(step),
            start_offset: Some(0.05),
            ..Default::default()
        };
        let lines = trace(&field, &starts, &normals, &config, &Silent).expect("starts are good");
        (0..400).map(|k| *lines.line(k).last().expect("a line has points")).collect()
    };
    let reference = ends(Integrator::Midpoint, 1e-4);
    for (step, euler, midpoint) in ORDER {
        let error = |integrator: Integrator| {
            ends(integrator, step).iter().zip(&reference).map(|(a, b)| a.distance(*b)).sum::<f64>() / 400.0
        };
        let own_midpoint = midpoint.map_or("".to_owned(), |_| format!("{:.3e}", error(Integrator::Midpoint)));
        let paper_midpoint = midpoint.map_or("".to_owned(), |e| format!("{e:.3e}"));
        println!(
            "{step:>8} |        {euler:>12.3e}{paper_midpoint:>12} |       {:>12.3e}{own_midpoint:>12}",
            error(Integrator::Euler)
        );
    }
}
