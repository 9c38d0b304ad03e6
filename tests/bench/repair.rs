//! Repairs models and damaged copies of them, for `repairs.mjs` to hand the results to manifold-3d.
//!
//! ```text
//! repair FOLDER [NAME [RESOLUTION [SHARP]]]   all cases, or those whose name begins so; 0 for the default: writes FOLDER/<case>.<method>.f64 and .u32, prints JSON lines
//! ```
//! Models are those of target/bench-models. `.f64` holds positions xyzxyz…, `.u32` three indices for each triangle.
use fast_winding::TriangleSoup;
use fast_winding::check::{CheckConfig, check};
use fast_winding::data::Silent;
use fast_winding::io::{self, Geometry};
use fast_winding::repair::{ConserveConfig, RemeshConfig, RepairError, Repaired, conserve, remesh};
use fast_winding::winding::{FieldConfig, WindingField};
use serde_json::json;
use std::path::Path;
use std::time::Instant;

/// What is done to a model.
#[derive(Clone, Copy)]
enum Damage {
    None,
    /// Share of the faces deleted, flipped, doubled.
    Faces {
        deleted: f64,
        flipped: f64,
        doubled: f64,
    },
    /// A second copy, shifted by this share of the diagonal.
    Overlap(f64),
}

const fn deleted(share: f64) -> Damage {
    Damage::Faces { deleted: share, flipped: 0.0, doubled: 0.0 }
}

const CASES: [(&str, &str, Damage); 17] = [
    ("bunny", "bunny", Damage::None),
    ("loose-bunny", "loose-bunny", Damage::None),
    ("teapot", "teapot", Damage::None),
    ("truck", "truck", Damage::None),
    ("snowden", "snowden", Damage::None),
    ("featuretype", "featuretype", Damage::None),
    ("cycloidal", "cycloidal", Damage::None),
    ("bumpy70k", "bumpy70k", Damage::None),
    ("knot", "knot124k", Damage::None),
    ("knot-deleted-1", "knot124k", deleted(0.01)),
    ("knot-deleted-10", "knot124k", deleted(0.1)),
    ("knot-flipped-1", "knot124k", Damage::Faces { deleted: 0.0, flipped: 0.01, doubled: 0.0 }),
    ("knot-flipped-10", "knot124k", Damage::Faces { deleted: 0.0, flipped: 0.1, doubled: 0.0 }),
    ("knot-doubled-10", "knot124k", Damage::Faces { deleted: 0.0, flipped: 0.0, doubled: 0.1 }),
    ("knot-damaged-10", "knot124k", Damage::Faces { deleted: 0.1, flipped: 0.1, doubled: 0.1 }),
    ("featuretype-overlap", "featuretype", Damage::Overlap(0.1)),
    ("bunny-overlap", "bunny", Damage::Overlap(0.05)),
];

fn main() {
    let mut words = std::env::args().skip(1);
    let folder = words.next().expect("a folder for the results");
    let wanted = words.next().unwrap_or_default();
    let number = |word: String| word.parse::<f64>().expect("a number");
    let resolution = words.next().map(number).filter(|n| *n > 0.0).map(|n| n as usize);
    let sharp =
        words.next().map_or(RemeshConfig::default().sharp, |word| Some(number(word)).filter(|a| *a > 0.0));
    let remeshing = RemeshConfig { resolution, sharp, ..RemeshConfig::default() };
    std::fs::create_dir_all(&folder).expect("the folder can be made");
    for (name, model, damage) in CASES.iter().filter(|case| case.0.starts_with(&wanted)) {
        let path = format!("{}/target/bench-models/{model}.ply", env!("CARGO_MANIFEST_DIR"));
        let Ok(bytes) = std::fs::read(&path) else { continue };
        let Ok(Geometry::Soup(soup)) = io::read(&bytes).map(|read| read.geometry) else { continue };
        let soup = damaged(&soup, *damage);
        for method in ["conserve", "remesh"] {
            let start = Instant::now();
            let field = WindingField::new(soup.clone(), FieldConfig::default());
            let made = match method {
                "conserve" => {
                    conserve(&field, &ConserveConfig { fallback: None, ..Default::default() }, &Silent)
                }
                _ => remesh(&field, &remeshing, &Silent),
            };
            let seconds = start.elapsed().as_secs_f64();
            println!("{}", told(name, method, &soup, made, seconds, Path::new(&folder)));
        }
    }
}

fn told(
    name: &str,
    method: &str,
    soup: &TriangleSoup,
    made: Result<Repaired, RepairError>,
    seconds: f64,
    folder: &Path,
) -> serde_json::Value {
    match made {
        Err(error) => {
            json!({ "case": name, "method": method, "triangles": soup.len(), "error": error.to_string() })
        }
        Ok(made) => {
            let config =
                CheckConfig { limit: 10, thickness: false, resolution: 0, samples: 0, ..Default::default() };
            let found =
                check(&WindingField::new(made.soup.clone(), FieldConfig::default()), &config, &Silent);
            let found = found.expect("the settings are in range");
            let crossings = found.self_intersections.map_or(0, |pairs| pairs.count);
            write(&made.soup, folder, &format!("{name}.{method}"));
            json!({
                "case": name, "method": method, "triangles": soup.len(), "seconds": seconds,
                "result": made.soup.len(), "vertices": made.soup.positions().len(), "report": made.report,
                "crossings": crossings, "open": found.boundary.loops.count,
            })
        }
    }
}

fn write(soup: &TriangleSoup, folder: &Path, name: &str) {
    let numbers = soup.positions().iter().flat_map(|p| p.to_array()).flat_map(f64::to_le_bytes);
    let indices = soup.triangles().as_flattened().iter().flat_map(|v| v.to_le_bytes());
    std::fs::write(folder.join(format!("{name}.f64")), numbers.collect::<Vec<u8>>())
        .expect("it can be written");
    std::fs::write(folder.join(format!("{name}.u32")), indices.collect::<Vec<u8>>())
        .expect("it can be written");
    let mut file = std::fs::File::create(folder.join(format!("{name}.ply"))).expect("it can be written");
    io::write_soup(soup, io::MeshFormat::Ply, &mut file).expect("it can be written");
}

fn damaged(soup: &TriangleSoup, damage: Damage) -> TriangleSoup {
    let mut positions = soup.positions().to_vec();
    let mut next = random();
    let triangles: Vec<[u32; 3]> = match damage {
        Damage::None => soup.triangles().to_vec(),
        Damage::Faces { deleted, flipped, doubled } => {
            let fate = |[a, b, c]: [u32; 3]| match next() {
                x if x < deleted => vec![],
                x if x < deleted + flipped => vec![[a, c, b]],
                x if x < deleted + flipped + doubled => vec![[a, b, c], [b, c, a]],
                _ => vec![[a, b, c]],
            };
            soup.triangles().iter().copied().flat_map(fate).collect()
        }
        Damage::Overlap(share) => {
            let shift = share * soup.bounds().diagonal() * fast_winding::math::Vec3::new(0.6, 0.5, 0.3);
            let count = positions.len() as u32;
            positions.extend(soup.positions().iter().map(|p| *p + shift));
            let moved = soup.triangles().iter().map(|t| t.map(|v| v + count));
            soup.triangles().iter().copied().chain(moved).collect()
        }
    };
    TriangleSoup::new(positions, triangles).expect("the indices are those of the model")
}

/// Evenly distributed numbers in [0, 1).
fn random() -> impl FnMut() -> f64 {
    let mut state = 1u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (state ^ (state >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        (mixed >> 11) as f64 / (1u64 << 53) as f64
    }
}
