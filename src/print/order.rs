//! The order in which lines are laid: always the nearest one next.
use super::path::Path;
use super::places::Places;
use crate::math::Vec2;

/// A path with when it is laid: group by group, the nearest next, and stage by stage in each, lower numbers first.
pub(super) struct Staged {
    pub path: Path,
    pub group: usize,
    pub stage: usize,
    /// Whether a closed path may start anywhere.
    pub starts_anywhere: bool,
}

/// What is laid in one go: walls, then what they hold.
#[derive(Default)]
pub(super) struct Part {
    pub walls: Vec<Staged>,
    pub fills: Vec<Staged>,
}

/// All paths, part by part, from one to the nearest next; open ones may be turned round.
pub(super) fn ordered(mut parts: Vec<Part>, from: Vec2) -> Vec<Path> {
    let mut order = Vec::new();
    let entries = parts.iter().map(|part| ends(part.walls.iter().chain(&part.fills))).collect();
    by_nearest(entries, from, |part, at| {
        let Part { walls, fills } = std::mem::take(&mut parts[part]);
        let at = group_by_group(walls, at, &mut order);
        group_by_group(fills, at, &mut order)
    });
    order
}

fn group_by_group(mut paths: Vec<Staged>, from: Vec2, order: &mut Vec<Path>) -> Vec2 {
    paths.sort_by_key(|staged| (staged.group, staged.stage));
    let mut groups: Vec<Vec<Staged>> = Vec::new();
    for staged in paths {
        match groups.last_mut() {
            Some(group) if group[0].group == staged.group => group.push(staged),
            _ => groups.push(vec![staged]),
        }
    }
    let entries = groups.iter().map(|group| ends(group.iter())).collect();
    by_nearest(entries, from, |group, mut at| {
        let mut paths = std::mem::take(&mut groups[group]);
        while !paths.is_empty() {
            let stage = paths[0].stage;
            let rest = paths.split_off(paths.partition_point(|staged| staged.stage == stage));
            at = nearest_next(std::mem::replace(&mut paths, rest), at, order);
        }
        at
    })
}

fn ends<'a>(paths: impl Iterator<Item = &'a Staged>) -> Vec<Vec2> {
    paths.flat_map(|s| [s.path.points.first(), s.path.points.last()]).flatten().copied().collect()
}

/// Visits each number that has an entry, always that with the nearest one next; `visit` gives where it ends.
fn by_nearest(entries: Vec<Vec<Vec2>>, from: Vec2, mut visit: impl FnMut(usize, Vec2) -> Vec2) -> Vec2 {
    let mut first = vec![0];
    first.extend(entries.iter().scan(0, |end, some| {
        *end += some.len();
        Some(*end)
    }));
    let mut places = Places::new(entries.into_iter().flatten().collect());
    let mut at = from;
    while let Some(entry) = places.nearest(at) {
        let number = first.partition_point(|start| *start <= entry) - 1;
        (first[number]..first[number + 1]).for_each(|k| places.remove(k));
        at = visit(number, at);
    }
    at
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
    use crate::print::path::{Approach, PathKind};

    fn open(points: &[(f64, f64)], group: usize, stage: usize) -> Staged {
        let points = points.iter().map(|p| Vec2::from(*p)).collect();
        let path =
            Path { kind: PathKind::Infill, points, closed: false, width: 0.4, approach: Approach::Across };
        Staged { path, group, stage, starts_anywhere: false }
    }

    fn starts(parts: Vec<Part>) -> Vec<[f64; 2]> {
        ordered(parts, Vec2::ZERO).iter().map(|p| p.points[0].to_array()).collect()
    }

    #[test]
    fn the_nearest_end_comes_next() {
        let fills = vec![
            open(&[(0.0, 5.0), (10.0, 5.0)], 0, 0),
            open(&[(10.0, 1.0), (0.0, 1.0)], 0, 0),
            open(&[(0.0, 9.0), (10.0, 9.0)], 0, 0),
        ];
        assert_eq!(starts(vec![Part { walls: vec![], fills }]), [[0.0, 1.0], [10.0, 5.0], [0.0, 9.0]]);
    }

    #[test]
    fn a_part_is_finished_group_by_group_and_stage_by_stage() {
        let walls = vec![
            open(&[(1.0, 0.0), (2.0, 0.0)], 7, 1),
            open(&[(8.0, 0.0), (8.5, 0.0)], 2, 0),
            open(&[(3.0, 0.0), (4.0, 0.0)], 7, 0),
        ];
        let near = Part { walls, fills: vec![open(&[(0.5, 0.0), (0.6, 0.0)], 0, 0)] };
        let far = Part { walls: vec![], fills: vec![open(&[(4.5, 0.0), (5.0, 0.0)], 0, 0)] };
        let xs: Vec<f64> = starts(vec![far, near]).iter().map(|p| p[0]).collect();
        assert_eq!(xs, [3.0, 2.0, 8.0, 0.6, 4.5]);
    }
}
