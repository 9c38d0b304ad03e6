//! Section 12.2: another proxy for lines that are kept; and section 7.3: what the dipole field takes.
use crate::lines::starts;
use crate::shapes;
use crate::solving::timed;
use fast_winding::TriangleSoup;
use fast_winding::charge::{ChargeConfig, ElectricField, LineConfig, first_hits, trace};
use fast_winding::data::Silent;
use std::sync::Arc;
use std::time::Instant;

/// Of the soup, in triangles.
const SIZES: [usize; 2] = [5000, 25_600];
const STEPS: usize = 50;

/// A torus around one of section radius ½.
fn around(triangles: usize, distance: f64) -> TriangleSoup {
    let inner = shapes::torus_of(triangles);
    let section = |p: fast_winding::math::Vec3| {
        let axis = p.with_z(0.0).normalize();
        axis + (p - axis) * ((0.5 + distance) / 0.5)
    };
    let positions = inner.positions().iter().map(|p| section(*p)).collect();
    TriangleSoup::new(positions, inner.triangles().to_vec()).expect("as many corners as before")
}

fn seconds<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}

pub fn proxies() {
    println!(
        "Sections 12.2 and 7.3: seconds for a torus, and for tori around it at 5 % and at 3 % of its diameter"
    );
    println!(
        "{:>9}{:>9} | monopole: {:>9}{:>9}{:>9}{:>11}{:>9} | dipole: {:>9}{:>9}{:>9}",
        "triangles", "around", "charges", "lines", "hits", "hits, 3 %", "met", "charges", "lines", "met"
    );
    for triangles in SIZES {
        let soup = Arc::new(shapes::torus_of(triangles));
        let [proxy, other] = [0.15, 0.09].map(|distance| around(4 * triangles, distance));
        let config = ChargeConfig { refinement: None, tolerance: 1e-4, ..Default::default() };
        let (field, charges) = timed(&soup, &config, 1);
        let (starts, normals) = starts(&soup);
        // Half as far again as the proxy is.
        let lines = LineConfig { steps: STEPS, step: Some(0.225 / STEPS as f64), ..Default::default() };
        let follow = |field: &ElectricField| {
            seconds(|| trace(field, &starts, &normals, &lines, &Silent).expect("starts are good"))
        };
        let (kept, tracing) = follow(&field);
        let count = |hits: &[Option<_>]| hits.iter().filter(|hit| hit.is_some()).count();
        let (first, hitting) = seconds(|| first_hits(&kept, &proxy));
        let (second, again) = seconds(|| first_hits(&kept, &other));
        let met = format!("{:.3}", (count(&first) + count(&second)) as f64 / (2 * starts.len()) as f64);
        let (dipole, dipole_charges) =
            seconds(|| ElectricField::dipole(&soup, &proxy, &config, &Silent).expect("both have areas"));
        let (dipole_lines, dipole_tracing) = follow(&dipole);
        let dipole_met = count(&first_hits(&dipole_lines, &proxy)) as f64 / starts.len() as f64;
        println!(
            "{triangles:>9}{:>9} |           {charges:>9.3}{tracing:>9.3}{hitting:>9.3}{again:>11.3}{met:>9} |         {dipole_charges:>9.3}{dipole_tracing:>9.3}{dipole_met:>9.3}",
            proxy.len()
        );
    }
}
