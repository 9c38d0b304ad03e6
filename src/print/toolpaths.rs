use super::PrintError;
use super::areas::{area, grown, without};
use super::gyroid::gyroid;
use super::hatch::{Hatch, hatch};
use super::order::{Part, Staged, ordered};
use super::path::{Approach, LayerPaths, Loop, Path, PathKind, Regions, Report, Toolpaths, length_of};
use super::perimeters::{Walls, walls};
use super::places::Places;
use super::seams::place_seams;
use super::settings::{Infill, Seam, ThinWalls, ToolpathSettings};
use super::solid::{Fills, Stack, common};
use super::thin::{MiddleLine, middle_lines};
use crate::data::{Cancelled, Layer, Monitor, Parts, Polygon, map_tasks, threads};
use crate::math::Vec2;
use crate::polygon::{EdgeGrid, Stretch, opened, simplify};
use std::f64::consts::FRAC_PI_2;

/// So many lines may lie side by side in a layer: what that takes fits in memory.
pub(super) const MAX_LINES: f64 = 1e5;
/// Overhangs of walls steeper than this cannot be told from a wall without any, in degrees.
const STEEPEST: f64 = 89.0;

/// Where in the progress the walls end, the neighbours and the fill.
const WALLS: f64 = 0.3;
const NEIGHBOURS: f64 = 0.4;
const FILL: f64 = 0.9;

/// Fills layers with lines: walls, skins and infill, in the order they are laid.
///
/// The layers are a stack, bottom to top, as [`slice`](crate::slice::slice()) makes it. Progress comes in the stages "walls",
/// "fill" and "order".
///
/// # Errors
/// If and only if a setting is out of range, a layer has no thickness, does not lie above the one before, has a coordinate that is
/// not finite or is too wide for lines this narrow, or the monitor cancels.
#[inline(never)]
pub fn toolpaths(
    layers: &[Layer],
    settings: &ToolpathSettings,
    monitor: &dyn Monitor,
) -> Result<Toolpaths, PrintError> {
    settings.check()?;
    check(layers, settings)?;
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, WALLS);
    let count = layers.len();
    let mut report = Report::default();

    let outlines = in_blocks(count, monitor, "walls", &|k| {
        let (shape, dropped) = outline(&layers[k].polygons, k == 0, settings);
        let walls = walls(&shape, settings);
        (shape, walls, dropped)
    })?;
    let (mut shapes, mut insides, mut all_walls) = (Vec::new(), Vec::new(), Vec::new());
    for (shape, mut walls, dropped) in outlines {
        report.dropped.add(dropped);
        report.thin_walls.add(walls.thin_walls);
        shapes.push(shape);
        insides.push(std::mem::take(&mut walls.inside));
        all_walls.push(walls);
    }

    monitor.begin(WALLS, NEIGHBOURS);
    let in_common = |layers: usize| -> Result<Vec<Vec<Polygon>>, Cancelled> {
        let mut cancelled = None;
        let common = common(&shapes, layers, |count, task| {
            in_blocks(count, monitor, "neighbours", task).unwrap_or_else(|stop| {
                cancelled = Some(stop);
                vec![Vec::new(); count]
            })
        });
        cancelled.map_or(Ok(common), Err)
    };
    let common_below = in_common(settings.bottom_layers)?;
    let common_above = if settings.top_layers == settings.bottom_layers {
        common_below.clone()
    } else {
        in_common(settings.top_layers)?
    };
    let (common_below, common_above) = (&common_below, &common_above);
    let stack = Stack { shapes: &shapes, insides: &insides, common_below, common_above };
    monitor.begin(NEIGHBOURS, FILL);
    let fills = in_blocks(count, monitor, "fill", &|k| {
        let fills = stack.fills(k, settings);
        let mut paths = fill_paths(&fills, k, layers[k].z_top, settings);
        let narrow = narrow_paths(&all_walls[k], settings);
        let single_lines = narrow.iter().filter(|path| path.kind == PathKind::ThinWall).count();
        paths.extend(narrow);
        (paths, Report { single_lines, ..fills.report })
    })?;
    let mut loops: Vec<&mut Vec<Loop>> = all_walls.iter_mut().map(|walls| &mut walls.loops).collect();
    place_seams(&mut loops, settings.seam, settings.line_width);

    monitor.begin(FILL, 1.0);
    let corners = shapes.iter().flatten().flat_map(|p| &p.outer);
    let from = corners.fold(Vec2::INFINITY, |low, p| low.min(*p));
    let layers_of_paths = in_blocks(count, monitor, "order", &|k| {
        let below = if k > 0 { shapes[k - 1].as_slice() } else { &[] };
        let parts = parts(&shapes[k], &all_walls[k].loops, &fills[k].0, settings);
        let height = layers[k].z_top - layers[k].z_bottom;
        let paths = ordered(parts, from);
        let (mut paths, overhanging_walls) =
            if k > 0 { split_overhangs(paths, below, height, settings) } else { (paths, 0.0) };
        tell_approaches(&mut paths, &insides[k]);
        (LayerPaths { z: layers[k].z_top, height, paths }, overhanging_walls)
    })?;
    let mut result = Vec::with_capacity(count);
    for ((paths, overhanging_walls), (_, found)) in layers_of_paths.into_iter().zip(&fills) {
        report.add(&Report { overhanging_walls, ..*found });
        result.push(paths);
    }
    Ok(Toolpaths { layers: result, report })
}

fn check(layers: &[Layer], settings: &ToolpathSettings) -> Result<(), PrintError> {
    for (number, layer) in layers.iter().enumerate() {
        let height = layer.z_top - layer.z_bottom;
        if !(height > 0.0 && height.is_finite()) {
            return Err(PrintError::BadHeight { layer: number, height });
        }
        if number > 0 && layer.z_top <= layers[number - 1].z_top {
            return Err(PrintError::NotAscending { layer: number, z: layer.z_top });
        }
        let points = layer.polygons.iter().flat_map(Polygon::rings).flatten();
        if points.clone().any(|p| !p.is_finite()) {
            return Err(PrintError::NonFinite { layer: number });
        }
        let (low, high) =
            points.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let extent = (high - low).max_element();
        if extent > MAX_LINES * settings.line_width {
            return Err(PrintError::TooFine { layer: number, extent, width: settings.line_width });
        }
    }
    Ok(())
}

/// What `task` gives for each layer; some layers for each thread between reports.
fn in_blocks<R: Send>(
    count: usize,
    monitor: &dyn Monitor,
    stage: &str,
    task: &(dyn Fn(usize) -> R + Sync),
) -> Result<Vec<R>, Cancelled> {
    let mut results = Vec::with_capacity(count);
    let size = 4 * threads();
    while results.len() < count {
        let first = results.len();
        monitor.report(first as f64 / count as f64, stage)?;
        results.extend(map_tasks(size.min(count - first), |k| task(first + k)));
    }
    monitor.report(1.0, stage)?;
    Ok(results)
}

/// The polygons that are printed, and what was too narrow of them.
fn outline(polygons: &[Polygon], is_first: bool, settings: &ToolpathSettings) -> (Vec<Polygon>, Regions) {
    let grow = settings.xy_compensation - if is_first { settings.elephant_foot } else { 0.0 };
    let mut shape = simplify(polygons, settings.detail);
    if grow != 0.0 {
        shape = grown(&shape, grow);
    }
    let mut dropped = Regions::default();
    if settings.minimum_feature > 0.0 {
        let wide = opened(&shape, 0.5 * settings.minimum_feature);
        let mut rest = without(&shape, &wide);
        // Beyond rounded corners, which lose slivers only.
        rest.retain(|piece| piece.area() > 0.1 * settings.minimum_feature.powi(2));
        dropped = Regions { count: rest.len(), area: area(&rest) };
        shape = wide;
    }
    (shape, dropped)
}

/// Lines of infill, skins and bridges.
fn fill_paths(fills: &Fills, layer: usize, z: f64, settings: &ToolpathSettings) -> Vec<Path> {
    let width = settings.line_width;
    // Without walls there is nothing to reach into.
    let overlap = if settings.perimeters > 0 { settings.infill_overlap } else { 0.0 };
    let inset = |area: &[Polygon]| grown(area, -(0.5 - overlap) * width);
    let angle = settings.angle.to_radians() + if layer % 2 == 1 { FRAC_PI_2 } else { 0.0 };
    let mut paths = Vec::new();
    let mut add = |kind: PathKind, lines: Vec<Vec<Vec2>>| {
        let long = lines.into_iter().filter(|line| length_of(line, false) >= 0.5 * width);
        paths.extend(long.map(|points| Path {
            kind,
            points,
            closed: false,
            width,
            approach: Approach::Across,
        }));
    };
    let skins = [
        (PathKind::Bottom, &fills.bottom),
        (PathKind::Top, &fills.top),
        (PathKind::Solid, &fills.solid),
        (PathKind::Overhang, &fills.overhangs),
    ];
    for (kind, area) in skins {
        add(kind, hatch(&inset(area), Hatch { angle, spacing: width, linked: true }));
    }
    for (bridge, angle) in &fills.bridges {
        let how = Hatch { angle: *angle, spacing: width, linked: true };
        add(PathKind::Bridge, hatch(&inset(std::slice::from_ref(bridge)), how));
    }
    if settings.density > 0.0 {
        let (sparse, spacing) = (inset(&fills.sparse), width / settings.density);
        match settings.infill {
            Infill::Rectilinear => {
                add(PathKind::Infill, hatch(&sparse, Hatch { angle, spacing, linked: false }))
            }
            Infill::Grid => {
                for angle in [0.0, FRAC_PI_2].map(|turn| settings.angle.to_radians() + turn) {
                    let how = Hatch { angle, spacing: 2.0 * spacing, linked: false };
                    add(PathKind::Infill, hatch(&sparse, how));
                }
            }
            Infill::Gyroid => {
                let angle = settings.angle.to_radians();
                add(PathKind::Infill, gyroid(&sparse, z, angle, width, settings.density));
            }
        }
    }
    paths
}

/// Lines along what has no room for one on either side.
fn narrow_paths(walls: &Walls, settings: &ToolpathSettings) -> Vec<Path> {
    let lines = |strips: &[Polygon], kind: PathKind| {
        let path = move |MiddleLine { points, closed, width }| Path {
            kind,
            points,
            closed,
            width,
            approach: Approach::Across,
        };
        middle_lines(strips, settings.line_width, settings.detail).into_iter().map(path)
    };
    let mut paths: Vec<Path> = lines(&walls.gaps, PathKind::Gap).collect();
    if settings.thin_walls == ThinWalls::SingleLine {
        paths.extend(lines(&walls.thin, PathKind::ThinWall));
    }
    paths
}

/// The paths of each polygon: walls, contour by contour from the inside out, then what they hold.
fn parts(shape: &[Polygon], loops: &[Loop], fills: &[Path], settings: &ToolpathSettings) -> Vec<Part> {
    let grid = (shape.len() > 1).then(|| EdgeGrid::new(shape));
    // The last part takes what lies, by rounding, in none.
    let mut parts: Vec<Part> = (0..=shape.len()).map(|_| Part::default()).collect();
    let part_of = |path: &Path| {
        let around = grid.as_ref().map_or(Some(0), |grid| grid.polygon_around(path.points[0]));
        around.unwrap_or(shape.len())
    };
    let outermost = outermost(loops);
    for (wall, group) in loops.iter().zip(outermost) {
        let kind = if wall.depth == 0 { PathKind::OuterWall } else { PathKind::InnerWall };
        let (points, width) = (wall.ring.clone(), settings.line_width);
        let path = Path { kind, points, closed: true, width, approach: Approach::Across };
        let starts_anywhere = settings.seam == Seam::Nearest;
        let stage = settings.perimeters - wall.depth;
        parts[part_of(&path)].walls.push(Staged { path, group, stage, starts_anywhere });
    }
    for path in fills.iter().filter(|path| !path.points.is_empty()) {
        let stage = usize::from(path.kind != PathKind::ThinWall);
        let staged = Staged { path: path.clone(), group: 0, stage, starts_anywhere: true };
        parts[part_of(path)].fills.push(staged);
    }
    parts
}

/// The number of the outermost wall that each wall follows: that whose line is nearest, depth by depth.
fn outermost(loops: &[Loop]) -> Vec<usize> {
    let mut found: Vec<usize> = (0..loops.len()).collect();
    let mut outside: (Vec<usize>, Places) = (Vec::new(), Places::new(Vec::new()));
    let mut start = 0;
    // Loops come in the order of their depths.
    for depth in loops.chunk_by(|a, b| a.depth == b.depth) {
        let numbers = start..start + depth.len();
        for number in numbers.clone() {
            if let Some(vertex) = outside.1.nearest(loops[number].ring[0]) {
                found[number] = found[outside.0[vertex]];
            }
        }
        let vertices =
            numbers.clone().flat_map(|number| loops[number].ring.iter().map(move |p| (number, *p)));
        let (owners, places): (Vec<usize>, Vec<Vec2>) = vertices.unzip();
        outside = (owners, Places::new(places));
        start = numbers.end;
    }
    found
}

/// Finds the paths whose start is reached over the inside.
fn tell_approaches(paths: &mut [Path], inside: &[Polygon]) {
    let grid = EdgeGrid::new(inside);
    let mut at: Option<Vec2> = None;
    for path in paths {
        if let (Some(from), Some(&to)) = (at, path.points.first())
            && path.kind != PathKind::OuterWall
            && grid.cut(&[from, to], false).iter().all(|way| way.is_inside)
        {
            path.approach = Approach::Inside;
        }
        at = path.end();
    }
}

/// Walls cut where what is below no longer holds them; with how long those parts are.
fn split_overhangs(
    paths: Vec<Path>,
    below: &[Polygon],
    height: f64,
    settings: &ToolpathSettings,
) -> (Vec<Path>, f64) {
    if settings.overhang_angle > STEEPEST {
        return (paths, 0.0);
    }
    let width = settings.line_width;
    let lean = height * libm::tan(settings.overhang_angle.to_radians());
    // The middle of a line is half its width inside of where the wall leans out to.
    let held = EdgeGrid::new(&grown(below, lean - 0.5 * width));
    let mut length = 0.0;
    let mut split = Vec::with_capacity(paths.len());
    for path in paths {
        let is_wall = matches!(path.kind, PathKind::OuterWall | PathKind::InnerWall | PathKind::ThinWall);
        let mut line = path.points.clone();
        line.extend(path.points.first().filter(|_| path.closed));
        let stretches = if is_wall { told_apart(held.cut(&line, false), width) } else { Vec::new() };
        let hanging = stretches.iter().filter(|s| !s.is_inside).map(|s| length_of(&s.points, false));
        length += hanging.sum::<f64>();
        match stretches.as_slice() {
            [] => split.push(path),
            [only] if only.is_inside => split.push(path),
            [_] => split.push(Path { kind: PathKind::Overhang, ..path }),
            _ => split.extend(stretches.into_iter().map(|s| Path {
                kind: if s.is_inside { path.kind } else { PathKind::Overhang },
                points: s.points,
                closed: false,
                width: path.width,
                approach: Approach::Across,
            })),
        }
    }
    (split, length)
}

/// Stretches without those that hang for less than a line's width.
fn told_apart(stretches: Vec<Stretch>, width: f64) -> Vec<Stretch> {
    let mut told: Vec<Stretch> = Vec::new();
    for mut stretch in stretches {
        stretch.is_inside |= length_of(&stretch.points, false) < width;
        match told.last_mut() {
            Some(last) if last.is_inside == stretch.is_inside => last.points.extend(&stretch.points[1..]),
            _ => told.push(stretch),
        }
    }
    told
}
