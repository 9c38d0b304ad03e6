//! Textures of soups against standard projections, and what a second proxy costs: `cargo run --release --example texture`.
#[path = "../common/mod.rs"]
mod common;

use common::parts::{genus_five, gridded_cube, selector, torn};
use common::{sphere, torus};
use fast_winding::TriangleSoup;
use fast_winding::data::Silent;
use fast_winding::math::Vec3;
use fast_winding::texture::{
    Anchors, Atlas, AtlasConfig, Distortion, Mapping, Projection, Proxy, ProxyConfig, ProxySides, Seams,
    Texture, TextureConfig, apart_by_chart, distortion, projected, seams, smallest_single_offset, texture,
};
use fast_winding::winding::{FieldConfig, WindingField};
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

struct Case {
    name: &'static str,
    clean: TriangleSoup,
    noise: f64,
    /// In longest sides.
    offset: f64,
    samples: Option<usize>,
}

fn cases() -> Vec<Case> {
    let case = |name, clean, noise, offset, samples| Case { name, clean, noise, offset, samples };
    vec![
        case("cube of six charts", gridded_cube(8), 0.0, 0.05, None),
        case("sphere, torn, 4e-3", sphere(16), 4e-3, 0.03, None),
        case("torus, torn, 4e-3", torus(1.0, 0.4, 48, 24), 4e-3, 0.03, None),
        case("cube, torn, 4e-3", gridded_cube(12), 4e-3, 0.03, None),
        case("genus 5, torn, 1e-3", genus_five(4), 1e-3, 0.002, Some(250)),
        case("genus 5, torn, 1e-3", genus_five(4), 1e-3, 0.02, None),
        case("selector, four parts", selector(), 0.0, 0.02, None),
        case("selector, torn, 1e-3", selector(), 1e-3, 0.02, None),
    ]
}

fn main() {
    let only = std::env::args().nth(1);
    table_one();
    let mut rows = Vec::new();
    for case in
        cases().into_iter().filter(|c| only.as_ref().is_none_or(|only| c.name.contains(only.as_str())))
    {
        rows.push(run(&case));
    }
    println!(
        "\n| model | triangles | offset | proxy | charts | across | moved | folded | squashed | unfolded | flipped | torn | lost | weak |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    rows.iter().for_each(|row| println!("{}", row.counts));
    println!(
        "\n| model | texture | angles: mean ratio | largest | areas: spread | flipped + flat | pieces | seams, mm |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    rows.iter().flat_map(|row| &row.distortions).for_each(|line| println!("{line}"));
    println!(
        "\n| model | proxy ms | atlas ms | charges and lines ms | anchors and texture ms | share of all for another proxy's correspondence |"
    );
    println!("|---|---|---|---|---|---|");
    rows.iter().for_each(|row| println!("{}", row.times));
}

/// The paper's Table 1: a cylinder of radius 1 and height 2.
fn table_one() {
    let cylinder = common::parts::turned(&[(0.0, -1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 1.0)], 128);
    let field = WindingField::new(cylinder, FieldConfig::default());
    println!(
        "| offset % | samples | 2/o | vertices | triangles | paper: samples, vertices, triangles | warned |"
    );
    println!("|---|---|---|---|---|---|---|");
    let paper = [
        (10.0, 13, 576, 1148),
        (5.0, 40, 6894, 13784),
        (3.0, 67, 21376, 42748),
        (2.0, 100, 50086, 100168),
        (1.0, 200, 210814, 421624),
    ];
    for (percent, samples, vertices, triangles) in paper {
        let config = ProxyConfig {
            offset: Some(2.0 * percent / 100.0),
            samples: Some(samples),
            sides: ProxySides::Both,
            smoothing: 0,
        };
        let proxy = Proxy::new(&field, &config, &Silent).unwrap();
        println!(
            "| {percent} | {samples} | {:.0} | {} | {} | {samples}, {vertices}, {triangles} | {} |",
            200.0 / percent,
            proxy.mesh.positions.len(),
            proxy.mesh.triangles.len(),
            if proxy.warnings.is_empty() { "no" } else { "too few samples" }
        );
    }
}

struct Row {
    counts: String,
    distortions: Vec<String>,
    times: String,
}

fn run(case: &Case) -> Row {
    let clean = &case.clean;
    let soup = if case.noise > 0.0 { torn(clean, case.noise, 7) } else { clean.clone() };
    let soup = Arc::new(soup);
    let longest = clean.bounds().size().max_element();
    let offset = case.offset * longest;
    let config = TextureConfig {
        proxy: ProxyConfig {
            offset: Some(offset),
            samples: case.samples,
            smoothing: 3,
            ..ProxyConfig::default()
        },
        ..TextureConfig::default()
    };
    let start = Instant::now();
    let made = texture(soup.clone(), &config, &Silent).unwrap();
    let whole = start.elapsed().as_secs_f64() * 1e3;
    let report = made.report();
    let mapping = &report.mapping;
    let counts = format!(
        "| {} | {} | {:.1} % | {} in {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
        case.name,
        mapping.triangles,
        100.0 * case.offset,
        report.proxy_triangles,
        report.proxy_components,
        report.charts,
        mapping.across_charts,
        mapping.moved,
        mapping.folded,
        mapping.squashed,
        mapping.unfolded,
        mapping.flipped,
        mapping.torn,
        mapping.lost_lines,
        mapping.weak_field
    );
    let vertices = welded(clean);
    let mut distortions = vec![line(case.name, "proxy", &report.proxy_distortion, None)];
    // Differences of half a mean edge are noise, not seams.
    let edge = mean_edge(clean);
    let by_chart = apart_by_chart(&made.mapping.uv, &made.mapping.charts);
    let ours = seams(clean, &by_chart, &vertices, 0.5 * edge * made.atlas.scale, None);
    distortions.push(line(case.name, "ours", &mapping.distortion, Some(ours)));
    for (name, projection) in [
        ("planar", Projection::Planar),
        ("tri-planar", Projection::Triplanar),
        ("cylindrical", Projection::Cylindrical),
        ("spherical", Projection::Spherical),
    ] {
        let (uv, turn) = projected(&soup, projection);
        let found = distortion((0..soup.len()).map(|t| (soup.corners(t), uv[t])));
        let cuts = seams(clean, &uv, &vertices, 0.5 * edge, turn);
        distortions.push(line(case.name, name, &found, Some(cuts)));
    }
    let times = times(case, whole, &config, &made);
    if case.noise == 0.0 && case.name.contains("parts") {
        let field = WindingField::new(soup.clone(), FieldConfig::default());
        let suggested = smallest_single_offset(&field, ProxySides::Outer, &Silent).unwrap();
        eprintln!(
            "{}: smallest offset of one component {:.2} % of the longest side",
            case.name,
            100.0 * suggested / longest
        );
    }
    Row { counts, distortions, times }
}

fn line(model: &str, name: &str, found: &Distortion, seams: Option<Seams>) -> String {
    let cuts = seams.map_or("|".into(), |s| format!("{} | {:.1}", s.pieces, s.length));
    format!(
        "| {model} | {name} | {:.3} | {:.1} | {:.3} | {} | {cuts} |",
        found.mean_ratio,
        found.largest_ratio,
        found.area_spread,
        found.flipped + found.flat
    )
}

/// Stages by themselves, medians of three; charges and lines are the rest of one run of all. What another offset costs beside its proxy
/// and atlas is the last.
fn times(case: &Case, whole: f64, config: &TextureConfig, made: &Texture) -> String {
    let median = |run: &mut dyn FnMut()| {
        let mut all: Vec<f64> = (0..3)
            .map(|_| {
                let start = Instant::now();
                run();
                start.elapsed().as_secs_f64() * 1e3
            })
            .collect();
        all.sort_by(f64::total_cmp);
        all[1]
    };
    let soup = &made.soup;
    let field = WindingField::new(soup.clone(), FieldConfig::default());
    let proxy = median(&mut || drop(Proxy::new(&field, &config.proxy, &Silent).unwrap()));
    let atlas = median(&mut || drop(Atlas::new(&made.proxy.mesh, &AtlasConfig::default(), &Silent).unwrap()));
    let again = median(&mut || {
        let anchors = Anchors::new(&made.lines, &made.proxy, &Silent).unwrap();
        drop(Mapping::new(soup, &made.lines, &anchors, &made.proxy, &made.atlas, &Silent).unwrap());
    });
    let lines = whole - proxy - atlas - again;
    format!(
        "| {} | {proxy:.0} | {atlas:.0} | {lines:.0} | {again:.0} | {:.3} |",
        case.name,
        again / (lines + again)
    )
}

fn mean_edge(soup: &TriangleSoup) -> f64 {
    let lengths = (0..soup.len()).flat_map(|t| {
        let [a, b, c] = soup.corners(t);
        [a.distance(b), b.distance(c), c.distance(a)]
    });
    lengths.sum::<f64>() / (3 * soup.len()) as f64
}

/// Corners by vertices in the same place.
fn welded(soup: &TriangleSoup) -> Vec<[u32; 3]> {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
    let number = |p: Vec3, numbers: &mut HashMap<[u64; 3], u32>| {
        let next = numbers.len() as u32;
        *numbers.entry((p + Vec3::ZERO).to_array().map(f64::to_bits)).or_insert(next)
    };
    soup.triangles().iter().map(|t| t.map(|v| number(soup.positions()[v as usize], &mut numbers))).collect()
}
