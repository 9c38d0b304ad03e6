//! Toolpaths of shapes with known answers.
use fast_winding::data::{Cancelled, Layer, Polygon, WarningKind};
use fast_winding::math::Vec2;
use fast_winding::print::{
    Infill, LayerPaths, PathKind, PrintError, Seam, ThinWalls, ToolpathSettings, Toolpaths, toolpaths,
};

mod common;

use common::prints::*;

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
fn ten_thousand_parts_are_ordered_too() {
    let part = |k: usize| {
        let (x, y) = (2.0 * (k % 100) as f64, 2.0 * (k / 100) as f64);
        rectangle((x, y), (x + 1.0, y + 1.0))
    };
    let layers = stack(1, |_| (0..10_000).map(part).collect());
    let paths = filled(&layers, &ToolpathSettings::default());
    assert!(paths.layers[0].paths.len() >= 10_000);
    // Neighbours are a millimetre apart; nearest neighbours leave some behind and have to come back for them.
    let mean = travels(&paths) / 10_000.0;
    assert!((0.9..2.0).contains(&mean), "{mean} mm from part to part");
}

// --- G-code ---

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
