//! The order in which lines are laid: always the nearest one next.
use super::path::Path;
use super::places::Places;
use crate::math::Vec2;

/// Paths of one part of a layer that are laid before others: those with a lower number come first.
pub(super) struct Staged {
    pub path: Path,
    pub stage: usize,
    /// Whether a closed path may start anywhere.
    pub starts_anywhere: bool,
}

/// All paths, part by part, stage by stage, from one to the nearest next; open ones may be turned round.
pub(super) fn ordered(parts: Vec<Vec<Staged>>, from: Vec2) -> Vec<Path> {
    let mut at = from;
    let mut doors: Vec<(Vec2, usize)> = Vec::new();
    for (part, paths) in parts.iter().enumerate() {
        let ends = paths.iter().flat_map(|s| [s.path.points.first(), s.path.points.last()]);
        doors.extend(ends.flatten().map(|p| (*p, part)));
    }
    let mut parts: Vec<Option<Vec<Staged>>> = parts.into_iter().map(Some).collect();
    let mut places = Places::new(doors.iter().map(|(p, _)| *p).collect());
    let mut order = Vec::new();
    while let Some(door) = places.nearest(at) {
        let part = doors[door].1;
        // The doors of a part follow one another.
        let first = doors.partition_point(|(_, other)| *other < part);
        (first..).take_while(|k| doors.get(*k).is_some_and(|d| d.1 == part)).for_each(|k| places.remove(k));
        let mut paths = parts[part].take().unwrap_or_default();
        paths.sort_by_key(|staged| staged.stage);
        while !paths.is_empty() {
            let stage = paths[0].stage;
            let rest = paths.split_off(paths.partition_point(|staged| staged.stage == stage));
            at = nearest_next(std::mem::replace(&mut paths, rest), at, &mut order);
        }
    }
    order
}

/// Appends paths from one to the nearest next; gives where the last ends.
fn nearest_next(paths: Vec<Staged>, from: Vec2, order: &mut Vec<Path>) -> Vec2 {
    // Each way into a path: its number, and the vertex.
    let mut doors: Vec<(usize, usize)> = Vec::new();
    let mut first_door = vec![0];
    for (number, Staged { path, starts_anywhere, .. }) in paths.iter().enumerate() {
        let count = path.points.len();
        match (path.closed, starts_anywhere) {
            (true, true) => doors.extend((0..count).map(|vertex| (number, vertex))),
            (true, false) => doors.push((number, 0)),
            (false, _) => doors.extend([(number, 0), (number, count - 1)]),
        }
        first_door.push(doors.len());
    }
    let places = doors.iter().map(|(number, vertex)| paths[*number].path.points[*vertex]);
    let mut places = Places::new(places.collect());
    let mut paths: Vec<Option<Path>> = paths.into_iter().map(|staged| Some(staged.path)).collect();
    let mut at = from;
    while let Some(door) = places.nearest(at) {
        let (number, vertex) = doors[door];
        (first_door[number]..first_door[number + 1]).for_each(|k| places.remove(k));
        let Some(mut path) = paths[number].take() else { continue };
        if path.closed {
            path.points.rotate_left(vertex);
        } else if vertex > 0 {
            path.points.reverse();
        }
        at = path.end().unwrap_or(at);
        order.push(path);
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print::path::PathKind;

    fn open(points: &[(f64, f64)], stage: usize) -> Staged {
        let points = points.iter().map(|p| Vec2::from(*p)).collect();
        let path = Path { kind: PathKind::Infill, points, closed: false, width: 0.4 };
        Staged { path, stage, starts_anywhere: false }
    }

    #[test]
    fn the_nearest_end_comes_next() {
        let lines = vec![
            open(&[(0.0, 5.0), (10.0, 5.0)], 0),
            open(&[(10.0, 1.0), (0.0, 1.0)], 0),
            open(&[(0.0, 9.0), (10.0, 9.0)], 0),
        ];
        let order = ordered(vec![lines], Vec2::ZERO);
        let starts: Vec<[f64; 2]> = order.iter().map(|p| p.points[0].to_array()).collect();
        assert_eq!(starts, [[0.0, 1.0], [10.0, 5.0], [0.0, 9.0]]);
    }

    #[test]
    fn a_part_is_finished_stage_by_stage() {
        let near = vec![open(&[(1.0, 0.0), (2.0, 0.0)], 1), open(&[(3.0, 0.0), (4.0, 0.0)], 0)];
        let far = vec![open(&[(4.5, 0.0), (5.0, 0.0)], 0)];
        let order = ordered(vec![far, near], Vec2::ZERO);
        let starts: Vec<f64> = order.iter().map(|p| p.points[0].x).collect();
        assert_eq!(starts, [3.0, 2.0, 4.5]);
    }
}
