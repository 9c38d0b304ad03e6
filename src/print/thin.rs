//! Lines along the middle of what is too narrow for a line on either side.
//!
//! The middle is where circles lie that touch both sides. From samples of the border each such circle is found by shrinking one
//! that touches the sample until nothing is inside it; both sides find the same middle, of which one is kept.
use crate::data::{Polygon, sides};
use crate::math::Vec2;
use crate::polygon::{EdgeGrid, nearest_on_segment};
use rustc_hash::FxHashMap;

/// Samples of the border for each line's width.
const SAMPLES_PER_WIDTH: f64 = 4.0;
/// Circles touch two sides if the sample and what stops them lie at an angle with a cosine below this, seen from the centre:
/// 120°. At the ends of a strip it is 90°, where the middle forks towards the corners.
const OPPOSITE: f64 = -0.5;
/// A line goes on with one width until the strip's differs by this part of the line's width.
const WIDTH_STEP: f64 = 0.25;

/// A line along a middle.
pub(super) struct MiddleLine {
    pub points: Vec<Vec2>,
    pub closed: bool,
    pub width: f64,
}

/// A point of the middle, and how wide the strip is there.
#[derive(Clone, Copy)]
struct Middle {
    at: Vec2,
    width: f64,
}

/// Lines along the middles of strips, each as wide as its strip; `width` is that of a line. Points go that lie within `detail` of the
/// line without them.
pub(super) fn middle_lines(strips: &[Polygon], width: f64, detail: f64) -> Vec<MiddleLine> {
    let grid = EdgeGrid::new(strips);
    let rings = strips.iter().flat_map(Polygon::rings);
    let mut runs: Vec<(Vec<Middle>, bool)> = rings.flat_map(|ring| runs_of(ring, &grid, width)).collect();
    // The longest of two that follow the same middle: the other one may end early at a bend.
    runs.sort_by(|a, b| extent(&b.0).total_cmp(&extent(&a.0)));
    let mut taken = Taken { cell: width, points: FxHashMap::default() };
    let mut lines = Vec::new();
    for (run, closed) in runs {
        let free: Vec<bool> = run.iter().map(|m| !taken.is_near(m.at, 0.3 * m.width.min(width))).collect();
        let stays_closed = closed && free.iter().all(|f| *f);
        let mut start = 0;
        while start < run.len() {
            let end = start + free[start..].iter().take_while(|f| **f).count();
            let part = &run[start..end];
            if extent(part) >= 0.5 * width {
                let pieces = of_one_width(part, stays_closed, width, &grid);
                lines.extend(pieces);
            }
            start = end.max(start + 1);
        }
        run.iter().for_each(|m| taken.add(m.at));
    }
    lines.iter_mut().for_each(|line| line.points = thinned(&line.points, detail));
    lines
}

/// A line without points that lie within a tolerance of it (Ramer 1972, Douglas and Peucker 1973).
fn thinned(points: &[Vec2], tolerance: f64) -> Vec<Vec2> {
    let mut kept = vec![false; points.len()];
    let mut open = vec![(0, points.len().saturating_sub(1))];
    while let Some((from, to)) = open.pop() {
        (kept[from], kept[to]) = (true, true);
        let distance = |k: usize| nearest_on_segment(points[k], points[from], points[to]).distance(points[k]);
        let farthest = (from + 1..to).max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        if let Some(farthest) = farthest.filter(|k| distance(*k) > tolerance) {
            open.extend([(from, farthest), (farthest, to)]);
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(p, _)| *p).collect()
}

fn extent(run: &[Middle]) -> f64 {
    run.windows(2).map(|w| w[0].at.distance(w[1].at)).sum()
}

/// The middles found from the samples of a ring, where neighbours are near each other; whether they go all around.
fn runs_of(ring: &[Vec2], grid: &EdgeGrid, width: f64) -> Vec<(Vec<Middle>, bool)> {
    let step = width / SAMPLES_PER_WIDTH;
    let mut middles: Vec<Option<Middle>> = Vec::new();
    for (a, b) in sides(ring) {
        let length = a.distance(b);
        if length == 0.0 {
            continue;
        }
        let inward = (b - a).perp() / length;
        let count = (length / step).ceil().max(1.0) as usize;
        middles.extend((0..count).map(|k| {
            let at = a.lerp(b, (k as f64 + 0.5) / count as f64);
            middle_from(at, inward, grid, width)
        }));
    }
    if middles.is_empty() {
        return Vec::new();
    }
    let goes_on = |a: &Option<Middle>, b: &Option<Middle>| match (a, b) {
        (Some(a), Some(b)) => a.at.distance(b.at) < 3.0 * step,
        _ => false,
    };
    let count = middles.len();
    let Some(first) = (0..count).find(|&k| !goes_on(&middles[(k + count - 1) % count], &middles[k])) else {
        return vec![(middles.into_iter().flatten().collect(), true)];
    };
    middles.rotate_left(first);
    let mut runs: Vec<(Vec<Middle>, bool)> = Vec::new();
    for (k, middle) in middles.iter().enumerate() {
        let Some(found) = middle else { continue };
        match runs.last_mut() {
            Some((run, _)) if k > 0 && goes_on(&middles[k - 1], middle) => run.push(*found),
            _ => runs.push((vec![*found], false)),
        }
    }
    runs
}

/// The centre of the largest circle inside that touches the border at a sample, if it touches the other side too.
fn middle_from(sample: Vec2, inward: Vec2, grid: &EdgeGrid, width: f64) -> Option<Middle> {
    let mut radius = 1.5 * width;
    let mut touched = None;
    // Each round the circle shrinks onto what is nearest to its centre; a handful is enough for straight sides.
    for _ in 0..32 {
        let center = sample + radius * inward;
        let Some(nearest) = grid.nearest_on_edges(center, radius * (1.0 - 1e-9)) else { break };
        let towards = nearest - sample;
        let height = towards.dot(inward);
        if height <= 1e-12 * width {
            break;
        }
        let next = 0.5 * towards.length_squared() / height;
        touched = Some(nearest);
        if next >= radius * (1.0 - 1e-7) {
            break;
        }
        radius = next;
    }
    let center = sample + radius * inward;
    let (a, b) = ((sample - center).normalize_or_zero(), (touched? - center).normalize_or_zero());
    (a.dot(b) < OPPOSITE).then_some(Middle { at: center, width: 2.0 * radius })
}

/// A run cut where its width changes, each piece with its mean width; open ends reach nearly to the end of the strip.
fn of_one_width(run: &[Middle], closed: bool, width: f64, grid: &EdgeGrid) -> Vec<MiddleLine> {
    let mut lines: Vec<MiddleLine> = Vec::new();
    let mut start = 0;
    while start + 1 < run.len() {
        let mut end = start + 1;
        while end + 1 < run.len() && (run[end + 1].width - run[start].width).abs() < WIDTH_STEP * width {
            end += 1;
        }
        let part = &run[start..=end];
        let mean = part.iter().map(|m| m.width).sum::<f64>() / part.len() as f64;
        lines.push(MiddleLine { points: part.iter().map(|m| m.at).collect(), closed: false, width: mean });
        start = end;
    }
    if let ([only], true) = (lines.as_mut_slice(), closed) {
        only.closed = true;
        return lines;
    }
    if let (Some(first), false) = (lines.first_mut(), closed) {
        first.points.reverse();
        reach_out(&mut first.points, first.width, grid);
        first.points.reverse();
    }
    if let (Some(last), false) = (lines.last_mut(), closed) {
        reach_out(&mut last.points, last.width, grid);
    }
    if let ([first, .., last], true) = (lines.as_mut_slice(), closed) {
        last.points.push(first.points[0]);
    }
    lines
}

/// Moves the end of a line on by a quarter of its width: circles stop half a width before the end of a strip, and a line's own end
/// is round.
fn reach_out(points: &mut Vec<Vec2>, width: f64, grid: &EdgeGrid) {
    let [.., before, end] = points[..] else { return };
    let further = end + 0.25 * width * (end - before).normalize_or_zero();
    if grid.contains(further) {
        points.push(further);
    }
}

/// Points of lines that are there already.
struct Taken {
    cell: f64,
    points: FxHashMap<(i64, i64), Vec<Vec2>>,
}

impl Taken {
    fn cell_of(&self, p: Vec2) -> (i64, i64) {
        ((p.x / self.cell).floor() as i64, (p.y / self.cell).floor() as i64)
    }

    fn add(&mut self, p: Vec2) {
        self.points.entry(self.cell_of(p)).or_default().push(p);
    }

    /// Whether one is nearer than `reach`, which is at most a cell.
    fn is_near(&self, p: Vec2, reach: f64) -> bool {
        let (x, y) = self.cell_of(p);
        let near = |cell: (i64, i64)| {
            self.points.get(&cell).is_some_and(|some| some.iter().any(|q| q.distance(p) < reach))
        };
        (-1..=1).any(|dx| (-1..=1).any(|dy| near((x + dx, y + dy))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Ring;
    use crate::print::path::length_of;
    use std::f64::consts::TAU;

    fn ring(corners: &[(f64, f64)]) -> Ring {
        corners.iter().map(|c| Vec2::from(*c)).collect()
    }

    #[test]
    fn a_strip_gets_one_line_along_its_middle() {
        let strip =
            Polygon { outer: ring(&[(0.0, 0.0), (10.0, 0.0), (10.0, 0.3), (0.0, 0.3)]), holes: vec![] };
        let lines = middle_lines(&[strip], 0.4, 0.01);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].points.iter().all(|p| (p.y - 0.15).abs() < 1e-9));
        assert!((lines[0].width - 0.3).abs() < 1e-9);
        let length = length_of(&lines[0].points, false);
        assert!((9.7..10.0).contains(&length), "{length}");
    }

    #[test]
    fn a_tube_gets_a_closed_line() {
        let circle =
            |r: f64| -> Ring { (0..200).map(|k| r * Vec2::from_angle(TAU * k as f64 / 200.0)).collect() };
        let mut hole = circle(5.0);
        hole.reverse();
        let lines = middle_lines(&[Polygon { outer: circle(5.5), holes: vec![hole] }], 0.4, 0.01);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].closed && (lines[0].width - 0.5).abs() < 0.01, "{}", lines[0].width);
        assert!((length_of(&lines[0].points, true) - TAU * 5.25).abs() < 0.05);
    }

    #[test]
    fn a_wedge_gets_lines_of_several_widths() {
        let wedge =
            Polygon { outer: ring(&[(0.0, 0.0), (20.0, 0.0), (20.0, 0.6), (0.0, 0.2)]), holes: vec![] };
        let lines = middle_lines(std::slice::from_ref(&wedge), 0.4, 0.01);
        let volume: f64 = lines.iter().map(|l| l.width * length_of(&l.points, l.closed)).sum();
        assert!(lines.len() > 2 && (volume / wedge.area() - 1.0).abs() < 0.03, "{volume}");
    }

    #[test]
    fn branches_get_lines_of_their_own() {
        let t = ring(&[
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 0.4),
            (5.2, 0.4),
            (5.2, 8.0),
            (4.8, 8.0),
            (4.8, 0.4),
            (0.0, 0.4),
        ]);
        let lines = middle_lines(&[Polygon { outer: t, holes: vec![] }], 0.4, 0.01);
        let length: f64 = lines.iter().map(|l| length_of(&l.points, l.closed)).sum();
        assert!((16.0..18.0).contains(&length), "{length}");
    }
}
