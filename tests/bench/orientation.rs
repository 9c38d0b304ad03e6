//! Faces turned by lot and turned back: `cargo run --release --example orientation -- MODEL …` prints for each model, as it is, as
//! loose triangles that were moved apart, and without a tenth of them, the share of the area that runs as the model's own faces
//! do, for each method and each share of faces that were turned; and the time it took. The first share is of none: what is
//! missing there are pieces that are inside out in the model itself, or taken for such.
use fast_winding::TriangleSoup;
use fast_winding::data::Silent;
use fast_winding::io::{self, Geometry};
use fast_winding::math::{Vec3, area_vector};
use fast_winding::orient::{FaceConfig, FaceMethod, orient_soup};
use std::time::Instant;

const SHARES: [f64; 4] = [0.0, 0.01, 0.1, 0.5];
const METHODS: [(&str, FaceMethod); 3] = [
    ("parity", FaceMethod::Parity),
    ("visibility", FaceMethod::Visibility),
    ("consistency", FaceMethod::Consistency),
];

fn main() {
    println!("| model | as | patches | method | 0 % | 1 % | 10 % | 50 % | seconds |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for path in std::env::args().skip(1) {
        let Geometry::Soup(soup) =
            io::read(&std::fs::read(&path).expect("a model")).expect("a model").geometry
        else {
            panic!("{path} is no soup")
        };
        let name = path.rsplit('/').next().unwrap_or(&path);
        let variants = [
            ("it is", soup.clone()),
            ("moved apart", moved_apart(&soup)),
            ("nine tenths", nine_tenths(&soup)),
        ];
        for (kind, soup) in variants {
            for (method, of) in METHODS {
                let config = FaceConfig { method: of, ..FaceConfig::default() };
                let (mut shares, mut seconds, mut patches) = (Vec::new(), Vec::new(), 0);
                for share in SHARES {
                    let start = Instant::now();
                    let (found, report) =
                        orient_soup(&turned(&soup, share), &config, &Silent).expect("not cancelled");
                    seconds.push(start.elapsed().as_secs_f64());
                    patches = report.patches;
                    shares.push(format!("{:.3}", 100.0 * agreement(&soup, &found)));
                }
                seconds.sort_by(f64::total_cmp);
                println!(
                    "| {name} | {kind} | {patches} | {method} | {} | {:.2} |",
                    shares.join(" | "),
                    seconds[2]
                );
            }
        }
    }
}

fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (state ^ (state >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        (mixed >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn turned(soup: &TriangleSoup, share: f64) -> TriangleSoup {
    let mut next = random(11);
    let turn = |[a, b, c]: &[u32; 3]| if next() < share { [*a, *c, *b] } else { [*a, *b, *c] };
    TriangleSoup::new(soup.positions().to_vec(), soup.triangles().iter().map(turn).collect()).expect("a soup")
}

/// Each triangle on its own, shifted by up to a twentieth of the root of its area.
fn moved_apart(soup: &TriangleSoup) -> TriangleSoup {
    let mut next = random(5);
    let mut positions = Vec::new();
    for t in 0..soup.len() {
        let corners = soup.corners(t);
        let step = 0.05 * area_vector(corners).length().sqrt();
        let shift = step * (2.0 * Vec3::new(next(), next(), next()) - Vec3::ONE);
        positions.extend(corners.map(|p| p + shift));
    }
    let triangles = (0..soup.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(positions, triangles).expect("a soup")
}

fn nine_tenths(soup: &TriangleSoup) -> TriangleSoup {
    let mut next = random(3);
    let triangles = soup.triangles().iter().filter(|_| next() < 0.9).copied().collect();
    TriangleSoup::new(soup.positions().to_vec(), triangles).expect("a soup")
}

fn agreement(truth: &TriangleSoup, found: &TriangleSoup) -> f64 {
    let (mut same, mut all) = (0.0, 0.0);
    for t in 0..truth.len() {
        let area = area_vector(truth.corners(t));
        all += area.length();
        same += if area.dot(area_vector(found.corners(t))) > 0.0 { area.length() } else { 0.0 };
    }
    same / all
}
