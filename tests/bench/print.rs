//! A model all the way to G-code, with the time that each step takes:
//!
//! ```text
//! print MODEL [--size MM] [--layer-height MM] [--infill rectilinear|grid|gyroid] [--density SHARE] [--repeats N]
//!             [--gcode FILE] [--draw LAYER --svg FILE]
//! ```
//! `--size` scales the model until its longest side is so long. Prints the median of each step in milliseconds, what share of the
//! whole slicing is, and what the print takes.
use fast_winding::data::{Layer, Shape, Silent, TriangleSoup};
use fast_winding::io::{self, Geometry};
use fast_winding::print::{
    Approach, Infill, LayerPaths, PathKind, PrinterProfile, ToolpathSettings, Toolpaths, gcode, toolpaths,
};
use fast_winding::slice::{LayerPlan, SliceConfig, slice};
use fast_winding::winding::{FieldConfig, WindingField};
use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt::Write;
use std::time::Instant;

const STEPS: [&str; 7] = ["parse", "field", "slice", "walls", "fill", "order", "g-code"];
const FILL: usize = 4;

fn main() {
    let mut words = std::env::args().skip(1);
    let model = words.next().expect("a model");
    let rest: Vec<String> = words.collect();
    let options: HashMap<&str, &str> =
        rest.chunks_exact(2).map(|pair| (pair[0].trim_start_matches("--"), pair[1].as_str())).collect();
    let number =
        |name: &str, default: f64| options.get(name).map_or(default, |text| text.parse().expect("a number"));
    let bytes = std::fs::read(&model).expect("the model can be read");
    let settings = ToolpathSettings {
        infill: match options.get("infill").copied() {
            None | Some("rectilinear") => Infill::Rectilinear,
            Some("grid") => Infill::Grid,
            Some("gyroid") => Infill::Gyroid,
            Some(other) => panic!("unknown infill '{other}'"),
        },
        density: number("density", 0.2),
        ..ToolpathSettings::default()
    };
    let plan = LayerPlan { layer_height: number("layer-height", 0.2), ..LayerPlan::default() };
    let mut times = vec![Vec::new(); STEPS.len()];
    let mut last = None;
    for _ in 0..number("repeats", 3.0) as usize {
        last = Some(prepare(&bytes, number("size", 0.0), &plan, &settings, &mut times));
    }
    let (layers, paths, text) = last.expect("at least one repeat");
    report(&layers, &paths, &text, times);
    if let Some(file) = options.get("gcode") {
        std::fs::write(file, &text).expect("the G-code can be written");
    }
    if let Some(file) = options.get("svg") {
        let layer = number("draw", 0.5 * layers.len() as f64) as usize;
        std::fs::write(file, drawing(&paths.layers[layer])).expect("the drawing can be written");
    }
}

fn prepare(
    bytes: &[u8],
    size: f64,
    plan: &LayerPlan,
    settings: &ToolpathSettings,
    times: &mut [Vec<f64>],
) -> (Vec<Layer>, Toolpaths, String) {
    let mut clock = Clock { step: 0, times, start: Instant::now() };
    let Geometry::Soup(soup) = io::read(bytes).expect("the model is understood").geometry else {
        panic!("a cloud: give a mesh")
    };
    let soup = if size > 0.0 { scaled(&soup, size) } else { soup };
    clock.lap();
    let field = WindingField::new(Shape::from(soup), FieldConfig::default());
    clock.lap();
    let layers = slice(&field, plan, &SliceConfig::default(), &Silent).expect("the model can be sliced");
    clock.lap();
    let clock = RefCell::new(clock);
    // "neighbours" are looked for to fill.
    let step = |stage: &str| STEPS.iter().position(|step| *step == stage).unwrap_or(FILL);
    let stages = |_: f64, stage: &str| {
        let mut clock = clock.borrow_mut();
        if clock.step < step(stage) {
            clock.lap();
        }
        true
    };
    let paths = toolpaths(&layers, settings, &stages).expect("the layers can be filled");
    let mut clock = clock.into_inner();
    clock.lap();
    let program = gcode(&paths, &PrinterProfile::default()).expect("the paths can be printed");
    clock.lap();
    (layers, paths, program.text)
}

struct Clock<'a> {
    step: usize,
    times: &'a mut [Vec<f64>],
    start: Instant,
}

impl Clock<'_> {
    fn lap(&mut self) {
        self.times[self.step].push(1e3 * self.start.elapsed().as_secs_f64());
        self.step += 1;
        self.start = Instant::now();
    }
}

fn scaled(soup: &TriangleSoup, size: f64) -> TriangleSoup {
    let factor = size / soup.bounds().size().max_element();
    let positions = soup.positions().iter().map(|p| factor * *p).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).expect("scaled vertices are finite")
}

fn report(layers: &[Layer], paths: &Toolpaths, text: &str, mut times: Vec<Vec<f64>>) {
    let medians: Vec<f64> = times
        .iter_mut()
        .map(|times| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        })
        .collect();
    let whole: f64 = medians.iter().sum();
    for (step, time) in STEPS.iter().zip(&medians) {
        println!("{step:>10} {time:9.1} ms {:5.1} %", 100.0 * time / whole);
    }
    let count = paths.layers.iter().map(|l| l.paths.len()).sum::<usize>();
    let points: usize = paths.layers.iter().flat_map(|l| &l.paths).map(|p| p.points.len()).sum();
    let corners: usize = layers.iter().flat_map(|l| &l.polygons).map(|p| p.outer.len()).sum();
    println!("{} layers of {corners} outer vertices, {count} paths of {points} points", layers.len());
    println!("{:.1} MB of G-code, {} lines", 1e-6 * text.len() as f64, text.lines().count());
    let solid: f64 = layers.iter().map(|l| l.area() * (l.z_top - l.z_bottom)).sum();
    println!("volume of the lines {:.0} mm³, of the model {solid:.0} mm³", paths.volume());
    let estimate = paths.estimate(&PrinterProfile::default()).expect("the profile is good");
    println!("{estimate:?}\n{:?}", paths.report);
}

/// One layer, each line as wide as it is laid.
fn drawing(layer: &LayerPaths) -> String {
    let points = layer.paths.iter().flat_map(|p| &p.points);
    let (low, high) = points.fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(low, high), p| {
        ([low[0].min(p.x), low[1].min(p.y)], [high[0].max(p.x), high[1].max(p.y)])
    });
    let (x, y) = (low[0] - 1.0, -high[1] - 1.0);
    let (width, height) = (high[0] - low[0] + 2.0, high[1] - low[1] + 2.0);
    let mut svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x} {y} {width} {height}" fill="none" stroke-linecap="round" stroke-linejoin="round">"#
    );
    let mut at = None;
    for path in &layer.paths {
        let mut d = String::new();
        for (k, p) in path.points.iter().enumerate() {
            let _ = write!(d, "{}{:.3} {:.3}", if k == 0 { "M" } else { "L" }, p.x, -p.y);
        }
        let end = if path.closed { "Z" } else { "" };
        let (stroke, line) = (color(path.kind), 0.85 * path.width);
        let _ = writeln!(svg, r#"<path stroke="{stroke}" stroke-width="{line:.3}" d="{d}{end}"/>"#);
        let start = path.points[0];
        if let Some((x, y)) = at {
            let color = if path.approach == Approach::Across { "#000" } else { "#f0f" };
            let (to_x, to_y) = (start.x, -start.y);
            let _ = writeln!(
                svg,
                r##"<path stroke="{color}" stroke-width="0.05" d="M{x:.3} {y:.3}L{to_x:.3} {to_y:.3}"/>"##
            );
        }
        at = path.end().map(|p| (p.x, -p.y));
    }
    svg + "</svg>\n"
}

fn color(kind: PathKind) -> &'static str {
    match kind {
        PathKind::OuterWall => "#d1495b",
        PathKind::InnerWall => "#edae49",
        PathKind::ThinWall => "#7b2d8b",
        PathKind::Gap => "#c77dff",
        PathKind::Overhang => "#1d3557",
        PathKind::Bottom => "#66a182",
        PathKind::Top => "#2e8b57",
        PathKind::Solid => "#8ab17d",
        PathKind::Bridge => "#00b4d8",
        PathKind::Infill => "#8d99ae",
    }
}
