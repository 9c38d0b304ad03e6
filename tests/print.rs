//! Toolpaths and G-code of shapes with known answers, read back by a checker that shares no code with the writer.
use fast_winding::data::{Cancelled, Layer, Polygon, Ring, Silent, WarningKind, signed_area};
use fast_winding::io;
use fast_winding::math::{Aabb, Vec2, Vec3};
use fast_winding::print::{
    Approach, GCode, Infill, LayerPaths, Origin, Path, PathKind, Placement, PrintError, PrinterProfile,
    ProfileError, Seam, Speeds, ThinWalls, ToolpathSettings, Toolpaths, gcode, toolpaths,
};
use fast_winding::slice::{LayerPlan, SliceConfig, slice};
use fast_winding::winding::{FieldConfig, WindingField};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

mod common;

const WIDTH: f64 = 0.4;
const HEIGHT: f64 = 0.2;

fn rectangle(low: (f64, f64), high: (f64, f64)) -> Polygon {
    let outer = [low, (high.0, low.1), high, (low.0, high.1)];
    Polygon { outer: outer.map(Vec2::from).to_vec(), holes: vec![] }
}

fn with_hole(mut outer: Polygon, hole: &Ring) -> Polygon {
    let mut hole = hole.clone();
    if signed_area(&hole) > 0.0 {
        hole.reverse();
    }
    outer.holes.push(hole);
    outer
}

fn circle(center: (f64, f64), radius: f64, count: usize) -> Ring {
    let at = |k: usize| Vec2::from(center) + radius * Vec2::from_angle(TAU * k as f64 / count as f64);
    (0..count).map(at).collect()
}

/// Layers of 0.2 mm from z = 0, each with what `shape` gives for its number.
fn stack(count: usize, shape: impl Fn(usize) -> Vec<Polygon>) -> Vec<Layer> {
    let layer = |k: usize| Layer {
        z_bottom: HEIGHT * k as f64,
        z_top: HEIGHT * (k + 1) as f64,
        z_sample: HEIGHT * (k as f64 + 0.5),
        polygons: shape(k),
    };
    (0..count).map(layer).collect()
}

fn cube() -> Vec<Layer> {
    stack(100, |_| vec![rectangle((100.0, 100.0), (120.0, 120.0))])
}

/// A tube of 30 mm around a hole of 16.
fn tube() -> Vec<Layer> {
    let outer = Polygon { outer: circle((60.0, 60.0), 15.0, 120), holes: vec![] };
    let shape = with_hole(outer, &circle((60.0, 60.0), 8.0, 120));
    stack(40, |_| vec![shape.clone()])
}

/// A column of 10 mm, and from layer 30 on a plate around it that juts out by 5 mm on all sides.
fn tower() -> Vec<Layer> {
    let wide = |k: usize| if k < 30 { 0.0 } else { 5.0 };
    stack(40, |k| vec![rectangle((50.0 - wide(k), 50.0 - wide(k)), (60.0 + wide(k), 60.0 + wide(k)))])
}

/// Two piers of 5 × 20 mm and from layer 20 on a deck from one to the other, 10 mm apart along x.
fn bridge() -> Vec<Layer> {
    stack(30, |k| {
        if k < 20 {
            vec![rectangle((10.0, 10.0), (15.0, 30.0)), rectangle((25.0, 10.0), (30.0, 30.0))]
        } else {
            vec![rectangle((10.0, 10.0), (30.0, 30.0))]
        }
    })
}

fn all() -> [(&'static str, Vec<Layer>); 4] {
    [("cube", cube()), ("tube", tube()), ("tower", tower()), ("bridge", bridge())]
}

fn filled(layers: &[Layer], settings: &ToolpathSettings) -> Toolpaths {
    toolpaths(layers, settings, &Silent).unwrap()
}

fn of_kind(layer: &LayerPaths, kind: PathKind) -> Vec<&Path> {
    layer.paths.iter().filter(|p| p.kind == kind).collect()
}

fn length(layer: &LayerPaths, kind: PathKind) -> f64 {
    of_kind(layer, kind).iter().map(|p| p.length()).sum()
}

fn signed_distance(polygons: &[Polygon], p: Vec2) -> f64 {
    let mut nearest = f64::INFINITY;
    let mut crossings = 0;
    for ring in polygons.iter().flat_map(|p| std::iter::once(&p.outer).chain(&p.holes)) {
        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let share = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            nearest = nearest.min(p.distance(a + share * (b - a)));
            let crosses = (a.y <= p.y) != (b.y <= p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x;
            crossings += usize::from(crosses);
        }
    }
    if crossings % 2 == 1 { -nearest } else { nearest }
}

/// Points along a path, its vertices and some between.
fn along(path: &Path) -> Vec<Vec2> {
    let mut points = path.points.clone();
    points.extend(path.points.first().filter(|_| path.closed));
    let between = points.windows(2).flat_map(|w| (0..5).map(|k| w[0].lerp(w[1], f64::from(k) / 5.0)));
    between.chain(points.last().copied()).collect()
}

#[test]
fn walls_of_a_cube_are_as_long_as_they_should_be() {
    let paths = filled(&cube(), &ToolpathSettings::default());
    assert_eq!(paths.layers.len(), 100);
    for layer in &paths.layers {
        let (outer, inner) = (length(layer, PathKind::OuterWall), length(layer, PathKind::InnerWall));
        assert!((outer - 4.0 * (20.0 - WIDTH)).abs() < 1e-6, "{outer}");
        assert!((inner - 4.0 * (20.0 - 3.0 * WIDTH)).abs() < 1e-6, "{inner}");
        assert!(of_kind(layer, PathKind::OuterWall).iter().all(|p| p.closed));
        let order: Vec<PathKind> = layer.paths.iter().map(|p| p.kind).take(2).collect();
        assert_eq!(order, [PathKind::InnerWall, PathKind::OuterWall], "inner walls come first");
    }
}

#[test]
fn infill_covers_the_share_asked_for() {
    let inside = (20.0 - 4.0 * WIDTH + 2.0 * 0.15 * WIDTH) - WIDTH;
    for (infill, slack) in [(Infill::Rectilinear, 0.05), (Infill::Grid, 0.05), (Infill::Gyroid, 0.06)] {
        for density in [0.1, 0.25, 0.5] {
            let settings = ToolpathSettings { infill, density, ..ToolpathSettings::default() };
            let paths = filled(&cube(), &settings);
            let sparse = &paths.layers[10..90];
            let covered: f64 = sparse.iter().map(|l| WIDTH * length(l, PathKind::Infill)).sum::<f64>();
            let share = covered / (sparse.len() as f64 * inside * inside);
            assert!((share / density - 1.0).abs() < slack, "{infill:?} {density}: {share}");
        }
    }
}

#[test]
fn no_line_leaves_the_shape() {
    for (name, layers) in all() {
        for infill in [Infill::Rectilinear, Infill::Grid, Infill::Gyroid] {
            let settings = ToolpathSettings { infill, ..ToolpathSettings::default() };
            let paths = filled(&layers, &settings);
            for (layer, lines) in layers.iter().zip(&paths.layers).step_by(7) {
                for path in &lines.paths {
                    let out = along(path).into_iter().map(|p| signed_distance(&layer.polygons, p));
                    let farthest = out.fold(f64::NEG_INFINITY, f64::max);
                    // Lines end half a width inside at least; the detail goes off that.
                    assert!(farthest <= -0.5 * path.width + 0.015, "{name} {:?} {farthest}", path.kind);
                }
            }
        }
    }
}

#[test]
fn solid_lines_fill_their_shape() {
    for (name, layers) in all() {
        let settings = ToolpathSettings { density: 1.0, infill_overlap: 0.0, ..ToolpathSettings::default() };
        let paths = filled(&layers, &settings);
        let solid: f64 = layers.iter().map(|l| l.area() * HEIGHT).sum();
        assert!((paths.volume() / solid - 1.0).abs() < 0.02, "{name}: {} of {solid}", paths.volume());
    }
}

#[test]
fn bottoms_and_tops_are_solid_and_the_rest_is_not() {
    let settings = ToolpathSettings { bottom_layers: 3, top_layers: 5, ..ToolpathSettings::default() };
    let paths = filled(&cube(), &settings);
    let kinds = |k: usize| {
        let has = |kind| usize::from(length(&paths.layers[k], kind) > 0.0);
        [PathKind::Bottom, PathKind::Solid, PathKind::Top, PathKind::Infill].map(has)
    };
    assert_eq!(
        (kinds(0), kinds(1), kinds(2), kinds(3)),
        ([1, 0, 0, 0], [0, 1, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1])
    );
    assert_eq!(
        (kinds(94), kinds(95), kinds(98), kinds(99)),
        ([0, 0, 0, 1], [0, 1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0])
    );
    let open = filled(&cube(), &ToolpathSettings { bottom_layers: 0, top_layers: 0, ..settings });
    assert!(open.layers.iter().all(|l| length(l, PathKind::Solid) + length(l, PathKind::Top) == 0.0));
}

#[test]
fn a_deck_between_piers_is_bridged_across_the_gap() {
    let paths = filled(&bridge(), &ToolpathSettings::default());
    let deck = of_kind(&paths.layers[20], PathKind::Bridge);
    let span: f64 = deck.iter().map(|p| p.length()).sum();
    assert!(span * WIDTH > 0.9 * 10.0 * (20.0 - 4.0 * WIDTH), "{span}");
    let steps = deck.iter().flat_map(|p| p.points.windows(2)).map(|w| (w[1] - w[0]).abs());
    let (across, beside) = steps.fold((0.0, 0.0), |(x, y), step| (x + step.x, y + step.y));
    assert!(across > 10.0 * beside, "lines run from pier to pier: {across} along x, {beside} along y");
    assert_eq!((paths.report.bridges.count, paths.report.overhangs.count), (1, 0));
    assert!((paths.report.bridges.area - 10.0 * 18.4).abs() < 1.0, "{:?}", paths.report.bridges);
    assert!(of_kind(&paths.layers[21], PathKind::Bridge).is_empty());
    // The walls between the piers hang, those on them do not.
    let hanging = length(&paths.layers[20], PathKind::Overhang);
    assert!((hanging - 2.0 * 2.0 * 10.0).abs() < 2.0, "{hanging}");
    let plain = filled(&bridge(), &ToolpathSettings { bridges: false, ..ToolpathSettings::default() });
    assert!(of_kind(&plain.layers[20], PathKind::Bridge).is_empty());
    assert!(length(&plain.layers[20], PathKind::Bottom) > 400.0);
}

#[test]
fn a_plate_that_juts_out_is_reported_as_an_overhang() {
    let paths = filled(&tower(), &ToolpathSettings::default());
    let report = &paths.report;
    assert_eq!((report.bridges.count, report.overhangs.count), (0, 1));
    assert!((report.overhangs.area - (18.4 * 18.4 - 100.0)).abs() < 3.0, "{report:?}");
    let walls = 4.0 * (20.0 - WIDTH) + 4.0 * (20.0 - 3.0 * WIDTH);
    assert!((report.overhanging_walls - walls).abs() < 1e-6, "{report:?}");
    assert!(report.warnings().iter().any(|w| w.kind == WarningKind::Overhangs));
    assert_eq!(filled(&cube(), &ToolpathSettings::default()).report, Default::default());
}

#[test]
fn walls_that_lean_little_are_no_overhangs() {
    // 0.1 mm out for each 0.2 mm up is 27° from the vertical.
    let cone = stack(30, |k| {
        let r = 10.0 + 0.1 * k as f64;
        vec![rectangle((50.0 - r, 50.0 - r), (50.0 + r, 50.0 + r))]
    });
    let at = |overhang_angle: f64| {
        filled(&cone, &ToolpathSettings { overhang_angle, ..ToolpathSettings::default() })
            .report
            .overhanging_walls
    };
    assert!(at(30.0) < 1e-9 && at(90.0) == 0.0);
    assert!(at(20.0) > 29.0 * 4.0 * 19.6, "outer walls hang, inner ones lie on them");
}

#[test]
fn thin_walls_get_a_single_line_or_are_reported() {
    // A frame of walls 0.35 mm thick.
    let frame =
        with_hole(rectangle((10.0, 10.0), (40.0, 40.0)), &rectangle((10.35, 10.35), (39.65, 39.65)).outer);
    let layers = stack(5, |_| vec![frame.clone()]);
    let single = filled(&layers, &ToolpathSettings::default());
    assert_eq!(single.report.thin_walls.count, 5);
    assert!((single.report.thin_walls.area - 5.0 * frame.area()).abs() < 0.1);
    let volume: f64 = layers.iter().map(|l| l.area() * HEIGHT).sum();
    assert!((single.volume() / volume - 1.0).abs() < 0.03, "{} of {volume}", single.volume());
    assert!(single.layers[0].paths.iter().all(|p| p.kind == PathKind::ThinWall));
    let settings = ToolpathSettings { thin_walls: ThinWalls::Report, ..ToolpathSettings::default() };
    let reported = filled(&layers, &settings);
    assert_eq!((reported.volume(), reported.report.thin_walls.count), (0.0, 5));
    let warnings = reported.report.warnings();
    assert!(warnings.iter().any(|w| w.kind == WarningKind::ThinWalls && w.count == 5));
}

#[test]
fn gaps_between_walls_are_filled() {
    let layers = stack(5, |_| vec![rectangle((10.0, 10.0), (11.1, 40.0))]);
    let paths = filled(&layers, &ToolpathSettings::default());
    let gap = of_kind(&paths.layers[2], PathKind::Gap);
    assert!(gap.len() == 1 && (gap[0].width - 0.3).abs() < 1e-6);
    let volume = 5.0 * HEIGHT * 1.1 * 30.0;
    assert!((paths.volume() / volume - 1.0).abs() < 0.01, "{} of {volume}", paths.volume());
}

#[test]
fn outlines_are_compensated() {
    let extent = |layer: &LayerPaths| {
        let points = of_kind(layer, PathKind::OuterWall)[0].points.iter();
        let (low, high) =
            points.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.x), h.max(p.x)));
        high - low + WIDTH
    };
    let settings =
        ToolpathSettings { xy_compensation: -0.05, elephant_foot: 0.15, ..ToolpathSettings::default() };
    let paths = filled(&cube(), &settings);
    assert!((extent(&paths.layers[0]) - 19.6).abs() < 1e-6 && (extent(&paths.layers[1]) - 19.9).abs() < 1e-6);
}

#[test]
fn small_features_are_dropped_and_counted() {
    let fin = [
        (100.0, 100.0),
        (120.0, 100.0),
        (120.0, 109.0),
        (125.0, 109.0),
        (125.0, 109.8),
        (120.0, 109.8),
        (120.0, 120.0),
        (100.0, 120.0),
    ];
    let shape = Polygon { outer: fin.map(Vec2::from).to_vec(), holes: vec![] };
    let layers = stack(3, |_| vec![shape.clone()]);
    let dropped = |minimum_feature: f64| {
        filled(&layers, &ToolpathSettings { minimum_feature, ..ToolpathSettings::default() }).report.dropped
    };
    assert_eq!(dropped(0.0).count, 0);
    assert_eq!(dropped(0.5).count, 0);
    assert_eq!(dropped(1.0).count, 3);
    assert!((dropped(1.0).area - 3.0 * 4.0).abs() < 0.01);
}

#[test]
fn seams_are_where_they_are_wanted() {
    let starts = |seam: Seam, layers: &[Layer]| -> Vec<Vec2> {
        let paths =
            filled(layers, &ToolpathSettings { seam, overhang_angle: 90.0, ..ToolpathSettings::default() });
        paths.layers.iter().map(|l| of_kind(l, PathKind::OuterWall)[0].points[0]).collect()
    };
    let round = stack(60, |k| {
        let turned = circle((50.0, 50.0), 10.0 + 0.02 * k as f64, 90 + k);
        vec![Polygon { outer: turned, holes: vec![] }]
    });
    let aligned = starts(Seam::Aligned, &round);
    assert!(aligned.windows(2).all(|w| w[0].distance(w[1]) < 0.1));
    assert!(starts(Seam::Rear, &round).iter().all(|p| p.y > 59.5));
    let corners = starts(Seam::Aligned, &cube());
    assert!(corners.iter().all(|p| p.distance(Vec2::new(100.2, 119.8)) < 1e-6));
    let random = starts(Seam::Random, &round);
    let mean = random.iter().sum::<Vec2>() / random.len() as f64;
    assert!(mean.distance(Vec2::splat(50.0)) < 5.0);
    assert_eq!(random, starts(Seam::Random, &round));
}

/// What the nozzle travels within layers.
fn travels(paths: &Toolpaths) -> f64 {
    let of = |layer: &LayerPaths| -> f64 {
        layer.paths.windows(2).map(|w| w[0].end().unwrap().distance(w[1].points[0])).sum()
    };
    paths.layers.iter().map(of).sum()
}

#[test]
fn the_nearest_next_is_shorter_than_any_order() {
    // 100 columns, one after the other by rows of polygons in a shuffled order.
    let column = |k: usize| {
        let k = (37 * k) % 100;
        let (x, y) = ((k % 10) as f64, (k / 10) as f64);
        rectangle((8.0 * x, 8.0 * y), (8.0 * x + 4.0, 8.0 * y + 4.0))
    };
    let layers = stack(3, |_| (0..100).map(column).collect());
    let paths = filled(
        &layers,
        &ToolpathSettings { density: 0.0, bottom_layers: 0, top_layers: 0, ..Default::default() },
    );
    let mut unordered = paths.clone();
    for layer in &mut unordered.layers {
        layer
            .paths
            .sort_by_key(|p| ((p.points[0].x * 7919.0) as u64 ^ (p.points[0].y * 104729.0) as u64) % 1009);
    }
    assert!(travels(&paths) < 0.25 * travels(&unordered), "{} {}", travels(&paths), travels(&unordered));
    // A column is done before the next one begins.
    let walls = &paths.layers[0].paths;
    assert!(walls.chunks(2).all(|w| w[0].points[0].distance(w[1].points[0]) < 4.0));
}

#[test]
fn ten_thousand_parts_are_ordered_in_no_time() {
    let part = |k: usize| {
        let (x, y) = (2.0 * (k % 100) as f64, 2.0 * (k / 100) as f64);
        rectangle((x, y), (x + 1.0, y + 1.0))
    };
    let layers = stack(1, |_| (0..10_000).map(part).collect());
    let start = std::time::Instant::now();
    let paths = filled(&layers, &ToolpathSettings::default());
    assert!(paths.layers[0].paths.len() >= 10_000);
    // It takes a second or two where nothing else runs; a quadratic order takes minutes.
    assert!(start.elapsed().as_secs() < 60);
}

// --- G-code ---

/// What a program does, as a simple reader of G-code understands it.
#[derive(Default)]
struct Read {
    /// Net filament in millimetres, for each `;TYPE:` too.
    filament: f64,
    by_type: HashMap<String, f64>,
    low: Option<Vec3>,
    high: Option<Vec3>,
    /// z of each `;LAYER:`'s lines.
    layers: Vec<f64>,
    retracted: f64,
    retractions: usize,
    extruded: f64,
}

fn read(text: &str) -> Read {
    let mut read = Read::default();
    let mut at = [f64::NAN; 3];
    let (mut absolute, mut relative_extrusion, mut feed) = (false, false, 0.0);
    let (mut kind, mut is_printing) = (String::new(), false);
    for line in text.lines() {
        if let Some(number) = line.strip_prefix(";LAYER:") {
            assert_eq!(number.parse::<usize>().unwrap(), read.layers.len(), "layers count up");
            read.layers.push(f64::NAN);
            is_printing = true;
        }
        if let Some(name) = line.strip_prefix(";TYPE:") {
            kind = name.to_owned();
        }
        let mut words = line.split(';').next().unwrap().split_whitespace();
        let Some(command) = words.next() else { continue };
        let values: HashMap<char, f64> = words
            .map(|w| (w.chars().next().unwrap(), w[1..].parse().unwrap_or_else(|_| panic!("{line}"))))
            .collect();
        match command {
            "G90" => absolute = true,
            "M83" => relative_extrusion = true,
            "G91" | "M82" => panic!("not in this dialect"),
            "G0" | "G1" => {
                assert!(absolute && relative_extrusion, "modes are set before moves");
                feed = values.get(&'F').copied().unwrap_or(feed);
                assert!(feed > 0.0, "{line}: no speed");
                let before = at;
                for (k, axis) in ['X', 'Y', 'Z'].into_iter().enumerate() {
                    at[k] = values.get(&axis).copied().unwrap_or(at[k]);
                }
                let moves = at[..2] != before[..2];
                let e = values.get(&'E').copied().unwrap_or(0.0);
                assert!(command == "G1" || e == 0.0, "{line}: a travel pushes filament");
                read.filament += e;
                *read.by_type.entry(kind.clone()).or_default() += e;
                if is_printing && at.iter().all(|x| x.is_finite()) {
                    let p = Vec3::from(at);
                    read.low = Some(read.low.map_or(p, |low| low.min(p)));
                    read.high = Some(read.high.map_or(p, |high| high.max(p)));
                }
                if e > 0.0 && moves {
                    assert!(read.retracted.abs() < 1e-9, "{line}: extrudes while drawn back");
                    read.extruded += (at[0] - before[0]).hypot(at[1] - before[1]);
                    *read.layers.last_mut().expect("lines are in layers") = at[2];
                } else if e != 0.0 {
                    read.retracted -= e;
                    read.retractions += usize::from(e < 0.0);
                    assert!((-1e-9..=10.0).contains(&read.retracted), "{line}: {}", read.retracted);
                }
            }
            _ => {}
        }
    }
    read
}

fn program(layers: &[Layer], profile: &PrinterProfile) -> (Toolpaths, GCode) {
    let paths = filled(layers, &ToolpathSettings::default());
    let program = gcode(&paths, profile).unwrap();
    (paths, program)
}

fn check(paths: &Toolpaths, program: &GCode, profile: &PrinterProfile) -> Read {
    let read = read(&program.text);
    let area = 0.25 * PI * profile.filament_diameter.powi(2);
    let volume = paths.volume();
    assert!((read.filament * area / volume - 1.0).abs() < 1e-4, "{} {volume}", read.filament * area);
    let (low, high) = (read.low.unwrap(), read.high.unwrap());
    let bed = profile.reach();
    assert!(low.z > 0.0 && bed.contains(low) && bed.contains(high), "{low} {high}");
    assert!(read.layers.windows(2).all(|w| w[0] < w[1]), "{:?}", read.layers);
    assert!(read.retracted.abs() < 1e-9, "what is drawn back is pushed again");
    read
}

#[test]
fn gcode_lays_what_the_paths_say() {
    let lifted = PrinterProfile {
        origin: Origin::Center,
        filament_diameter: 2.85,
        retraction: fast_winding::print::Retraction { lift: 0.4, ..Default::default() },
        ..PrinterProfile::default()
    };
    for (name, layers) in all() {
        for profile in [PrinterProfile::default(), lifted.clone()] {
            let (paths, program) = program(&layers, &profile);
            let read = check(&paths, &program, &profile);
            assert_eq!(read.layers.len(), layers.len(), "{name}");
            assert!((read.layers[0] - HEIGHT).abs() < 1e-9);
            let estimate = paths.estimate(&profile).unwrap();
            assert!((read.filament / estimate.filament_length - 1.0).abs() < 1e-4);
            assert!((read.extruded / estimate.extruded_length - 1.0).abs() < 1e-3);
            assert_eq!(read.retractions, estimate.retractions);
        }
    }
}

#[test]
fn gcode_names_the_kinds_of_lines_as_viewers_do() {
    let profile = PrinterProfile::default();
    let (paths, program) = program(&cube(), &profile);
    let read = read(&program.text);
    let area = 0.25 * PI * profile.filament_diameter.powi(2);
    for (kind, name) in
        [(PathKind::OuterWall, "WALL-OUTER"), (PathKind::InnerWall, "WALL-INNER"), (PathKind::Infill, "FILL")]
    {
        let volume: f64 = paths.layers.iter().map(|l| l.height * WIDTH * length(l, kind)).sum();
        assert!((read.by_type[name] * area / volume - 1.0).abs() < 1e-3, "{name}");
    }
    assert!(program.text.starts_with(";FLAVOR:Marlin\n;TIME:"));
    assert!(program.text.contains(";LAYER_COUNT:100\n"));
}

#[test]
fn a_model_goes_all_the_way() {
    let bounds = Aabb { min: Vec3::new(-10.0, -5.0, 3.0), max: Vec3::new(10.0, 5.0, 9.0) };
    let field = WindingField::new(common::cuboid(bounds), FieldConfig::default());
    let plan = LayerPlan { layer_height: 0.3, ..LayerPlan::default() };
    let layers = slice(&field, &plan, &SliceConfig::default(), &Silent).unwrap();
    let profile = PrinterProfile::default();
    let (paths, program) = program(&layers, &profile);
    let read = check(&paths, &program, &profile);
    assert_eq!(read.layers.len(), 20);
    assert!((read.layers[0] - 0.3).abs() < 1e-9, "it stands on the bed though it hung in the air");
    // Half of it lay off the bed: it was moved to the middle.
    assert!(program.warnings.iter().any(|w| w.kind == WarningKind::MovedToBed));
    assert!((program.shift.truncate() - Vec2::splat(110.0)).length() < 0.1, "{}", program.shift);
    assert!(io::read(program.text.as_bytes()).is_err(), "G-code is no geometry");
}

#[test]
fn a_print_off_the_bed_is_refused_or_moved() {
    let layers = stack(3, |_| vec![rectangle((210.0, 10.0), (230.0, 30.0))]);
    let paths = filled(&layers, &ToolpathSettings::default());
    let place =
        |placement: Placement| gcode(&paths, &PrinterProfile { placement, ..PrinterProfile::default() });
    let error = place(Placement::AsIs).unwrap_err();
    assert!(matches!(error, PrintError::OffBed { axis: 'x', .. }));
    assert_eq!(error.to_string(), "the print reaches x = 230.00 mm, the bed goes from 0 to 220 mm");
    assert_eq!(place(Placement::OnBed).unwrap().shift.truncate(), Vec2::new(-110.0, 90.0));
    assert!(place(Placement::Centered).unwrap().warnings.is_empty());
    let large = stack(3, |_| vec![rectangle((0.0, 0.0), (260.0, 30.0))]);
    let paths = filled(&large, &ToolpathSettings::default());
    let error = gcode(&paths, &PrinterProfile::default()).unwrap_err();
    assert_eq!(error.to_string(), "the model is 260 mm wide, the bed 220 mm");
}

#[test]
fn templates_are_filled_in() {
    let paths = filled(&cube(), &ToolpathSettings::default());
    let with = |start: &str| {
        let profile = PrinterProfile { start: start.into(), end: String::new(), ..PrinterProfile::default() };
        gcode(&paths, &profile).map(|program| program.text)
    };
    let text = with("M109 S{nozzleTemperature}\nM117 {layerCount} layers {} { {x").unwrap();
    assert!(text.contains("M109 S210\nM117 100 layers {} { {x\n"));
    let error = with("M109 S{temperature}").unwrap_err();
    assert!(matches!(&error, PrintError::Placeholder { template: "start", name } if name == "temperature"));
    assert!(error.to_string().contains("{temperature} is not known in the start template"), "{error}");
}

#[test]
fn what_cannot_be_printed_is_named() {
    let settings = ToolpathSettings::default();
    let of = |layers: &[Layer]| toolpaths(layers, &settings, &Silent).unwrap_err();
    let flat = Layer { z_bottom: 1.0, z_top: 1.0, z_sample: 1.0, polygons: vec![] };
    assert_eq!(of(&[flat]), PrintError::BadHeight { layer: 0, height: 0.0 });
    let mut twice = cube();
    twice.swap(3, 4);
    assert!(matches!(of(&twice), PrintError::NotAscending { layer: 4, .. }));
    let mut broken = cube();
    broken[7].polygons[0].outer[2].y = f64::NAN;
    assert_eq!(of(&broken), PrintError::NonFinite { layer: 7 });
    let wide = stack(1, |_| vec![rectangle((0.0, 0.0), (1e6, 1.0))]);
    assert!(matches!(of(&wide), PrintError::TooFine { layer: 0, .. }));
    let wrong = ToolpathSettings { line_width: -1.0, ..settings.clone() };
    let error = toolpaths(&cube(), &wrong, &Silent).unwrap_err();
    assert_eq!(error.to_string(), "lineWidth cannot be -1: a width from 0.01 to 50 mm is wanted");
    let empty = filled(&stack(3, |_| vec![]), &settings);
    assert_eq!(gcode(&empty, &PrinterProfile::default()), Err(PrintError::Empty));
    let speeds = Speeds { infill: 0.0, ..Speeds::default() };
    let profile = PrinterProfile { speeds, ..PrinterProfile::default() };
    let error = gcode(&filled(&cube(), &settings), &profile).unwrap_err();
    assert!(matches!(error, PrintError::Profile(ProfileError::BadValue { field: "speeds.infill", .. })));
}

#[test]
fn lines_that_suit_no_nozzle_are_warned_of() {
    let paths = filled(&cube(), &ToolpathSettings::default());
    let kinds = |nozzle_diameter: f64| -> Vec<WarningKind> {
        let profile = PrinterProfile { nozzle_diameter, ..PrinterProfile::default() };
        gcode(&paths, &profile).unwrap().warnings.iter().map(|w| w.kind).collect()
    };
    assert_eq!(kinds(0.4), []);
    assert_eq!(kinds(0.15), [WarningKind::HighLayers]);
    assert_eq!(kinds(1.0), [WarningKind::NarrowLines]);
}

#[test]
fn estimates_are_those_of_a_single_line() {
    let points = vec![Vec2::new(10.0, 10.0), Vec2::new(110.0, 10.0)];
    let path = Path { kind: PathKind::Infill, points, closed: false, width: 0.5, approach: Approach::Across };
    let layers =
        (1..=2).map(|k| LayerPaths { z: 0.2 * f64::from(k), height: 0.2, paths: vec![path.clone()] });
    let paths = Toolpaths { layers: layers.collect(), ..Toolpaths::default() };
    let profile = PrinterProfile::default();
    let estimate = paths.estimate(&profile).unwrap();
    assert!((estimate.filament_volume - 2.0 * 0.5 * 0.2 * 100.0).abs() < 1e-9);
    assert!((estimate.filament_mass - 20.0 * 1.24e-3).abs() < 1e-9);
    assert!((estimate.travel_length - 100.2).abs() < 1e-9 && estimate.retractions == 1);
    // The lines at 20 and at 80 mm/s, the way back at 150, each with its ramps.
    let lines = 100.0 / 20.0 + 20.0 / 1000.0 + 100.0 / 80.0 + 80.0 / 1000.0;
    let back = 100.0 / 150.0 + 150.0 / 1000.0;
    let rest = estimate.seconds - lines - back;
    assert!((0.05..0.15).contains(&rest), "the filament and the way up take {rest} s");
}

#[test]
fn any_number_of_threads_gives_the_same_lines() {
    for (name, layers) in all() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                filled(&layers, &ToolpathSettings { infill: Infill::Gyroid, ..Default::default() })
            })
        };
        assert!(with(1) == with(3), "{name}");
    }
}

#[test]
fn a_monitor_hears_of_it_and_may_stop_it() {
    let stages = std::cell::RefCell::new(Vec::new());
    let heard = |fraction: f64, stage: &str| {
        assert!((0.0..=1.0).contains(&fraction));
        let mut stages = stages.borrow_mut();
        if stages.last().is_none_or(|last| last != stage) {
            stages.push(stage.to_owned());
        }
        true
    };
    toolpaths(&cube(), &ToolpathSettings::default(), &heard).unwrap();
    assert_eq!(stages.into_inner(), ["walls", "neighbours", "fill", "order"]);
    for stop in ["walls", "neighbours", "fill", "order"] {
        let refuse = |_: f64, stage: &str| stage != stop;
        let result = toolpaths(&cube(), &ToolpathSettings::default(), &refuse);
        assert_eq!(result, Err(PrintError::Cancelled(Cancelled)), "{stop}");
    }
}
