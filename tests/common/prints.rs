//! Layers of shapes with known answers, and what their toolpaths hold.
use fast_winding::data::{Layer, Polygon, Ring, Silent, signed_area};
use fast_winding::math::Vec2;
use fast_winding::print::{LayerPaths, Path, PathKind, ToolpathSettings, Toolpaths, toolpaths};
use std::f64::consts::TAU;

pub const WIDTH: f64 = 0.4;
pub const HEIGHT: f64 = 0.2;

pub fn rectangle(low: (f64, f64), high: (f64, f64)) -> Polygon {
    let outer = [low, (high.0, low.1), high, (low.0, high.1)];
    Polygon { outer: outer.map(Vec2::from).to_vec(), holes: vec![] }
}

pub fn with_hole(mut outer: Polygon, hole: &Ring) -> Polygon {
    let mut hole = hole.clone();
    if signed_area(&hole) > 0.0 {
        hole.reverse();
    }
    outer.holes.push(hole);
    outer
}

pub fn circle(center: (f64, f64), radius: f64, count: usize) -> Ring {
    let at = |k: usize| Vec2::from(center) + radius * Vec2::from_angle(TAU * k as f64 / count as f64);
    (0..count).map(at).collect()
}

/// Layers of 0.2 mm from z = 0, each with what `shape` gives for its number.
pub fn stack(count: usize, shape: impl Fn(usize) -> Vec<Polygon>) -> Vec<Layer> {
    let layer = |k: usize| Layer {
        z_bottom: HEIGHT * k as f64,
        z_top: HEIGHT * (k + 1) as f64,
        z_sample: HEIGHT * (k as f64 + 0.5),
        polygons: shape(k),
    };
    (0..count).map(layer).collect()
}

pub fn cube() -> Vec<Layer> {
    stack(100, |_| vec![rectangle((100.0, 100.0), (120.0, 120.0))])
}

/// A tube of 30 mm around a hole of 16.
pub fn tube() -> Vec<Layer> {
    let outer = Polygon { outer: circle((60.0, 60.0), 15.0, 120), holes: vec![] };
    let shape = with_hole(outer, &circle((60.0, 60.0), 8.0, 120));
    stack(40, |_| vec![shape.clone()])
}

/// A column of 10 mm, and from layer 30 on a plate around it that juts out by 5 mm on all sides.
pub fn tower() -> Vec<Layer> {
    let wide = |k: usize| if k < 30 { 0.0 } else { 5.0 };
    stack(40, |k| vec![rectangle((50.0 - wide(k), 50.0 - wide(k)), (60.0 + wide(k), 60.0 + wide(k)))])
}

/// Two piers of 5 × 20 mm and from layer 20 on a deck from one to the other, 10 mm apart along x.
pub fn bridge() -> Vec<Layer> {
    stack(30, |k| {
        if k < 20 {
            vec![rectangle((10.0, 10.0), (15.0, 30.0)), rectangle((25.0, 10.0), (30.0, 30.0))]
        } else {
            vec![rectangle((10.0, 10.0), (30.0, 30.0))]
        }
    })
}

pub fn all() -> [(&'static str, Vec<Layer>); 4] {
    [("cube", cube()), ("tube", tube()), ("tower", tower()), ("bridge", bridge())]
}

pub fn filled(layers: &[Layer], settings: &ToolpathSettings) -> Toolpaths {
    toolpaths(layers, settings, &Silent).unwrap()
}

pub fn of_kind(layer: &LayerPaths, kind: PathKind) -> Vec<&Path> {
    layer.paths.iter().filter(|p| p.kind == kind).collect()
}

pub fn length(layer: &LayerPaths, kind: PathKind) -> f64 {
    of_kind(layer, kind).iter().map(|p| p.length()).sum()
}

pub fn signed_distance(polygons: &[Polygon], p: Vec2) -> f64 {
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
pub fn along(path: &Path) -> Vec<Vec2> {
    let mut points = path.points.clone();
    points.extend(path.points.first().filter(|_| path.closed));
    let between = points.windows(2).flat_map(|w| (0..5).map(|k| w[0].lerp(w[1], f64::from(k) / 5.0)));
    between.chain(points.last().copied()).collect()
}
