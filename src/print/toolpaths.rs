use super::PrintError;
use super::gyroid::gyroid;
use super::hatch::{Hatch, hatch};
use super::order::{Staged, ordered};
use super::path::{LayerPaths, Loop, Path, PathKind, Regions, Report, Toolpaths, length_of};
use super::perimeters::{Walls, area, walls};
use super::seams::place_seams;
use super::settings::{Infill, Seam, ThinWalls, ToolpathSettings};
use super::solid::{Fills, Stack};
use super::thin::{MiddleLine, middle_lines};
use crate::data::{Cancelled, Layer, Monitor, Polygon, map_tasks, threads};
use crate::math::Vec2;
use crate::polygon::{Boolean, EdgeGrid, Join, Stretch, combined, offset, opened, simplify};
use std::f64::consts::FRAC_PI_2;

/// So many lines may lie side by side in a layer: what that takes fits in memory.
pub(super) const MAX_LINES: f64 = 1e5;
/// Overhangs of walls steeper than this cannot be told from a wall without any, in degrees.
const STEEPEST: f64 = 89.0;

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

    let stack = Stack { shapes: &shapes, insides: &insides };
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

    let corners = shapes.iter().flatten().flat_map(|p| &p.outer);
    let from = corners.fold(Vec2::INFINITY, |low, p| low.min(*p));
    let layers_of_paths = in_blocks(count, monitor, "order", &|k| {
        let below = if k > 0 { shapes[k - 1].as_slice() } else { &[] };
        let parts = parts(&shapes[k], &all_walls[k].loops, &fills[k].0, settings);
        let height = layers[k].z_top - layers[k].z_bottom;
        let (paths, overhanging_walls) = if k > 0 {
            split_overhangs(ordered(parts, from), below, height, settings)
        } else {
            (ordered(parts, from), 0.0)
        };
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
        let points = layer.polygons.iter().flat_map(|p| std::iter::once(&p.outer).chain(&p.holes)).flatten();
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
        shape = offset(&shape, grow, Join::Miter);
    }
    let mut dropped = Regions::default();
    if settings.minimum_feature > 0.0 {
        let wide = opened(&shape, 0.5 * settings.minimum_feature);
        let mut rest = combined(&shape, &wide, Boolean::Difference);
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
    let inset = |area: &[Polygon]| offset(area, -(0.5 - overlap) * width, Join::Miter);
    let angle = settings.angle.to_radians() + if layer % 2 == 1 { FRAC_PI_2 } else { 0.0 };
    let mut paths = Vec::new();
    let mut add = |kind: PathKind, lines: Vec<Vec<Vec2>>| {
        let long = lines.into_iter().filter(|line| length_of(line, false) >= 0.5 * width);
        paths.extend(long.map(|points| Path { kind, points, closed: false, width }));
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
        let path = move |MiddleLine { points, closed, width }| Path { kind, points, closed, width };
        middle_lines(strips, settings.line_width, settings.detail).into_iter().map(path)
    };
    let mut paths: Vec<Path> = lines(&walls.gaps, PathKind::Gap).collect();
    if settings.thin_walls == ThinWalls::SingleLine {
        paths.extend(lines(&walls.thin, PathKind::ThinWall));
    }
    paths
}

/// The paths of each polygon: inner walls, then outer ones, then what they hold.
fn parts(shape: &[Polygon], loops: &[Loop], fills: &[Path], settings: &ToolpathSettings) -> Vec<Vec<Staged>> {
    let grid = (shape.len() > 1).then(|| EdgeGrid::new(shape));
    let mut parts: Vec<Vec<Staged>> = (0..=shape.len()).map(|_| Vec::new()).collect();
    let mut add = |path: Path, stage: usize| {
        let Some(&start) = path.points.first() else { return };
        let part = grid.as_ref().map_or(Some(0), |grid| grid.polygon_around(start));
        // The last part takes what lies, by rounding, in none.
        let part = part.unwrap_or(shape.len());
        let is_fixed = path.kind == PathKind::OuterWall || path.kind == PathKind::InnerWall;
        let starts_anywhere = !is_fixed || settings.seam == Seam::Nearest;
        parts[part].push(Staged { path, stage, starts_anywhere });
    };
    for wall in loops {
        let kind = if wall.depth == 0 { PathKind::OuterWall } else { PathKind::InnerWall };
        let path = Path { kind, points: wall.ring.clone(), closed: true, width: settings.line_width };
        add(path, settings.perimeters - wall.depth);
    }
    for path in fills {
        let stage = settings.perimeters + usize::from(path.kind != PathKind::ThinWall);
        add(path.clone(), stage);
    }
    parts
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
    let held = EdgeGrid::new(&offset(below, lean - 0.5 * width, Join::Miter));
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
