//! G-code of shapes with known answers, read back by a checker that shares no code with the writer.
use fast_winding::data::{Layer, Silent, WarningKind};
use fast_winding::io;
use fast_winding::math::{Aabb, Vec2, Vec3};
use fast_winding::print::{
    Approach, GCode, LayerPaths, Origin, Path, PathKind, Placement, PrintError, PrinterProfile, ProfileError,
    Speeds, ToolpathSettings, Toolpaths, gcode, toolpaths,
};
use fast_winding::slice::{LayerPlan, SliceConfig, slice};
use fast_winding::winding::{FieldConfig, WindingField};
use std::collections::HashMap;
use std::f64::consts::PI;

mod common;

use common::prints::*;

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
