//! Layers, their files and what is printed of them.
use super::facts::Watch;
use super::shapes::Made;
use super::source::Source;
use fast_winding::data::{Layer, Polygon, Shape, sides};
use fast_winding::io::{
    MeshResolution, write_layer_svg, write_layers_3mf, write_layers_dxf, write_layers_json, write_layers_svg,
};
use fast_winding::math::Vec2;
use fast_winding::print::{
    Infill, Origin, Placement, PrinterProfile, Seam, ThinWalls, ToolpathSettings, gcode, toolpaths,
};
use fast_winding::slice::{AdaptiveHeights, LayerPlan, SampleAt, SliceConfig, SliceMode, heat_map, slice};
use fast_winding::winding::{FieldConfig, WindingField};

/// Nearer to a contour than this share of the size, rounding may put a point on either side.
const NEAR: f64 = 1e-6;

fn plan(source: &mut Source, height: f64) -> LayerPlan {
    let share = |source: &mut Source| height * source.setting(&[0.5, 0.25, 0.3, 1.0, 0.1]);
    let adaptive = AdaptiveHeights { least: 0.1 * height, most: 0.5 * height, deviation: 0.2 * height };
    LayerPlan {
        layer_height: share(source),
        first_layer_height: source.flag().then(|| share(source)),
        sample_at: source.pick(&[SampleAt::Bottom, SampleAt::Middle, SampleAt::Top]),
        adaptive: (source.below(8) == 0).then_some(adaptive),
        heights: source
            .flag()
            .then(|| (0..source.below(6)).map(|_| source.setting(&[0.0, 0.5, 1.0, 1.7, 2.0, 3.0])).collect()),
    }
}

/// More layers than a run has time for are not asked for.
const LAYERS: f64 = 40.0;

pub fn layers(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape, is_tame } = source.shape();
    let field = WindingField::new(shape, FieldConfig::default());
    let height = field.bounds().size().z;
    let plan = plan(&mut source, height);
    let config = SliceConfig {
        resolution: source.below(24),
        spacing: source.option(&[0.2, 0.5]).filter(|spacing| too_few_to_wait_for(*spacing, &field)),
        mode: source.pick(&[SliceMode::Winding, SliceMode::Winding, SliceMode::EvenOdd, SliceMode::Largest]),
        simplify: if source.flag() { 0.0 } else { source.setting(&[0.01, 0.3]) },
    };
    let is_long = plan.spans_of(field.shape()).is_ok_and(|spans| spans.len() as f64 > LAYERS);
    if is_long || reaches_far(&field, config.spacing, config.resolution) {
        return;
    }
    let found = slice(&field, &plan, &config, &Watch::new(source.byte()));
    heat_map(&field, source.number(), source.below(8), &Watch::new(0)).ok();
    let Ok(layers) = found else { return };
    layers.iter().for_each(assert_rings);
    write(&layers, &field);
    if is_tame && config.mode == SliceMode::Winding && config.simplify == 0.0 && field.is_closed() {
        layers.iter().for_each(|layer| assert_section(layer, &field, &mut source));
    }
}

/// Whether a lattice of such cells is small.
pub fn too_few_to_wait_for(spacing: f64, field: &WindingField) -> bool {
    const CELLS: f64 = 30.0;
    spacing.is_nan() || spacing <= 0.0 || field.bounds().size().max_element() / spacing < CELLS
}

/// Whether the inside of a cloud reaches over more cells than a run has time for, and yet fewer than are refused.
pub fn reaches_far(field: &WindingField, spacing: Option<f64>, resolution: usize) -> bool {
    const CELLS: std::ops::Range<f64> = 1e4..1e9;
    let size = field.bounds().size().max_element();
    let spacing = spacing.unwrap_or(size / resolution.max(1) as f64);
    match field.shape() {
        Shape::Cloud(cloud) => CELLS.contains(&(cloud.areas().iter().sum::<f64>() / spacing / spacing)),
        Shape::Soup(_) => false,
    }
}

fn assert_rings(layer: &Layer) {
    for ring in layer.polygons.iter().flat_map(Polygon::rings) {
        assert!(ring.len() >= 3, "a ring of {} points", ring.len());
        assert!(ring.iter().all(|p| p.is_finite()), "a ring with a point that is not finite");
    }
}

/// The polygons of a layer hold what is inside of a closed soup.
fn assert_section(layer: &Layer, field: &WindingField, source: &mut Source) {
    let bounds = field.bounds();
    for q in source.queries(bounds, 4) {
        let p = q.truncate();
        let edges = || layer.polygons.iter().flat_map(Polygon::rings).flat_map(|ring| sides(ring));
        let nearest = edges().map(|(a, b)| distance_to_segment(p, a, b)).fold(f64::INFINITY, f64::min);
        if nearest < NEAR * bounds.diagonal() {
            continue;
        }
        let crossed = edges().filter(|(a, b)| crosses(p, *a, *b)).count();
        let (below, above) =
            (above_plane(layer.z_sample, -1.0, field), above_plane(layer.z_sample, 1.0, field));
        let inside = [below, above].map(|z| field.contains_point(p.extend(z)));
        // Where the solid begins or ends at the plane, the layer is that of one of its sides.
        assert!(inside.contains(&(crossed % 2 == 1)), "{p} in the layer at {}: {inside:?}", layer.z_sample);
    }
}

fn above_plane(z: f64, sign: f64, field: &WindingField) -> f64 {
    z + sign * 1e-9 * field.bounds().diagonal()
}

fn crosses(p: Vec2, a: Vec2, b: Vec2) -> bool {
    (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
}

fn distance_to_segment(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    p.distance(a + if t.is_nan() { 0.0 } else { t } * along)
}

fn write(layers: &[Layer], field: &WindingField) {
    let mut out = Vec::new();
    write_layers_svg(layers, &mut out).expect("memory takes what is written");
    write_layers_dxf(layers, &mut out).expect("memory takes what is written");
    write_layers_json(layers, &mut out).expect("memory takes what is written");
    layers
        .iter()
        .take(2)
        .for_each(|layer| write_layer_svg(layer, &mut out).expect("memory takes what is written"));
    if let fast_winding::data::Shape::Soup(soup) = field.shape() {
        write_layers_3mf(layers, soup, MeshResolution::default(), &mut out).ok();
    }
}

/// Layers of a shape, or of any rings, to G-code.
pub fn prints(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let layers = if source.flag() { any_layers(&mut source) } else { sliced(&mut source) };
    let settings = settings(&mut source);
    let Ok(paths) = toolpaths(&layers, &settings, &Watch::new(source.byte())) else { return };
    let points = || paths.layers.iter().flat_map(|layer| &layer.paths).flat_map(|path| &path.points);
    assert!(points().all(|p| p.is_finite()), "a path leads nowhere");
    let profile = profile(&mut source);
    let Ok(program) = gcode(&paths, &profile) else { return };
    assert!(
        !program.text.contains("NaN") && !program.text.contains("inf "),
        "G-code with a number that is none"
    );
}

fn any_layers(source: &mut Source) -> Vec<Layer> {
    let scale = source.pick(&[1.0, 4.0, 0.1, 1e-9, 1e9]);
    let is_any = source.below(4) == 0;
    let mut z = 0.0;
    let mut layer = |source: &mut Source| {
        let height = source.setting(&[0.2, 0.2, 0.3]);
        let z_bottom = z;
        z += height;
        let point = |source: &mut Source| match is_any {
            true => source.any_point().truncate(),
            false => scale * Vec2::new(f64::from(source.byte() % 16), f64::from(source.byte() % 16)),
        };
        let ring = |source: &mut Source| (0..source.below(9)).map(|_| point(source)).collect::<Vec<Vec2>>();
        let polygon = |source: &mut Source| Polygon {
            outer: ring(source),
            holes: (0..source.below(2)).map(|_| ring(source)).collect(),
        };
        let polygons = (0..source.below(3)).map(|_| polygon(source)).collect();
        Layer { z_bottom, z_top: z, z_sample: 0.5 * (z_bottom + z), polygons }
    };
    (0..1 + source.below(4)).map(|_| layer(source)).collect()
}

fn sliced(source: &mut Source) -> Vec<Layer> {
    let soup = source.soup().shape;
    let field = WindingField::new(soup, FieldConfig::default());
    let plan = LayerPlan { layer_height: field.bounds().size().z / 5.0, ..LayerPlan::default() };
    let config = SliceConfig { resolution: 12, ..SliceConfig::default() };
    slice(&field, &plan, &config, &Watch::new(0)).unwrap_or_default()
}

fn settings(source: &mut Source) -> ToolpathSettings {
    ToolpathSettings {
        line_width: source.setting(&[0.4, 0.5, 1.0, 0.3]),
        perimeters: source.below(5),
        wall_overlap: source.setting(&[0.0, 0.1, 0.5]),
        infill_overlap: source.setting(&[0.15, 0.0, 0.5]),
        infill: source.pick(&[Infill::Rectilinear, Infill::Grid, Infill::Gyroid]),
        density: source.setting(&[0.2, 0.0, 1.0, 0.5]),
        angle: source.setting(&[45.0, 0.0, 90.0, 30.0]),
        bottom_layers: source.below(4),
        top_layers: source.below(4),
        seam: source.pick(&[Seam::Nearest, Seam::Rear, Seam::Aligned, Seam::Random]),
        xy_compensation: source.setting(&[0.0, 0.1, -0.1]),
        elephant_foot: source.setting(&[0.0, 0.1]),
        minimum_feature: source.setting(&[0.0, 0.3]),
        thin_walls: source.pick(&[ThinWalls::SingleLine, ThinWalls::Report]),
        overhang_angle: source.setting(&[50.0, 90.0, 0.0]),
        bridges: source.flag(),
        detail: source.setting(&[0.01, 0.0, 0.5]),
    }
}

fn profile(source: &mut Source) -> PrinterProfile {
    let mut profile = PrinterProfile {
        origin: source.pick(&[Origin::Corner, Origin::Center]),
        placement: source.pick(&[Placement::OnBed, Placement::AsIs, Placement::Centered]),
        nozzle_diameter: source.setting(&[0.4, 0.6]),
        acceleration: source.setting(&[1000.0, 500.0]),
        junction_deviation: source.setting(&[0.02, 0.0]),
        fan: source.setting(&[1.0, 0.0]),
        ..PrinterProfile::default()
    };
    profile.retraction.lift = source.setting(&[0.0, 0.2]);
    profile.speeds.travel = source.setting(&[150.0, 1.0]);
    profile
}
