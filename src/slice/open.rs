//! The contours of shapes that are not closed: the section where it separates inside from outside, and arcs between its ends.
use super::arcs::Arcs;
use super::arrangement::pieces;
use super::chains::{join, key};
use super::disjoint::polygons_of;
use super::kept::{Directed, kept};
use super::plane::Plane;
use super::section::Segment;
use crate::data::{Polygon, sides};
use crate::math::{Aabb, Vec2};
use crate::polygon::surrounds;
use rustc_hash::FxHashMap;

/// Nodes along the longer side of an opening's surroundings where contours are compared with the field.
const SCAN: f64 = 5.0;
/// Nodes along the longer side of the section in openings as large as that.
const FINEST_SCAN: f64 = 48.0;
/// Nodes of a section.
const MOST_NODES: usize = 1 << 13;
/// Contours that touch no surface, found one after the other.
const MOST_ARCS: usize = 64;
/// Nodes from which a contour that is missing is looked for, one after the other, until there is one.
const MOST_TRIED: usize = 8;

/// The polygons of what is inside, or none where arcs did not come to an end or the field is inside elsewhere.
///
/// `openings` are boxes around what bounds the openings: within them and next to them the contours are compared with the field.
pub(super) fn polygons(segments: &[Segment], plane: &Plane, openings: &[Aabb]) -> Option<Vec<Polygon>> {
    let mut parts = kept(&pieces(segments), plane, openings);
    close(&mut parts, plane)?;
    let scan = nodes(openings, plane);
    let inside = plane.all_inside(&scan);
    for _ in 0..MOST_ARCS {
        let polygons = polygons_of(&join(&parts));
        let within = all_within(&polygons, &scan);
        let wrong: Vec<usize> = (0..scan.len()).filter(|k| within[*k] != inside[*k]).collect();
        if wrong.is_empty() {
            return Some(polygons);
        }
        let mut tried = wrong.iter().step_by(wrong.len().div_ceil(MOST_TRIED));
        let ring = tried.find_map(|k| missing(*k, &scan, &polygons, &parts, plane))?;
        match ring {
            Missing::Nothing => return Some(polygons),
            Missing::Ring(ring) => {
                parts.extend(sides(&ring).map(|(a, b)| [a, b]));
            }
        }
    }
    None
}

/// Adds arcs between the points where parts end and those where they start.
fn close(parts: &mut Vec<Directed>, plane: &Plane) -> Option<()> {
    let mut excess: FxHashMap<u128, i32> = FxHashMap::default();
    for [from, to] in parts.iter() {
        *excess.entry(key(*from)).or_default() += 1;
        *excess.entry(key(*to)).or_default() -= 1;
    }
    join_next(&mut excess, parts, 4.0 * plane.aside);
    let mut starts: Vec<(Vec2, usize)> = Vec::new();
    let mut ends: Vec<Vec2> = Vec::new();
    for [from, to] in parts.iter() {
        for p in [from, to] {
            match excess.remove(&key(*p)) {
                Some(count) if count > 0 => ends.extend(std::iter::repeat_n(*p, count as usize)),
                Some(count) if count < 0 => starts.push((*p, count.unsigned_abs() as usize)),
                _ => {}
            }
        }
    }
    let mut arcs = Vec::new();
    let tracer = Arcs::new(plane, parts);
    for (start, count) in starts {
        for arc in tracer.departing_from(start, count, &ends)? {
            let place = ends.iter().position(|end| *end == arc.end)?;
            ends.swap_remove(place);
            let from = std::iter::once(&start).chain(&arc.points);
            arcs.extend(from.zip(&arc.points).map(|(a, b)| [*a, *b]));
        }
    }
    parts.extend(arcs);
    ends.is_empty().then_some(())
}

/// Joins ends that rounding has moved apart.
fn join_next(excess: &mut FxHashMap<u128, i32>, parts: &mut Vec<Directed>, reach: f64) {
    let open: Vec<Vec2> = parts.iter().flatten().copied().filter(|p| excess[&key(*p)] != 0).collect();
    for (k, p) in open.iter().enumerate() {
        for q in &open[..k] {
            let (at_p, at_q) = (excess[&key(*p)], excess[&key(*q)]);
            if at_p * at_q < 0 && p.distance(*q) <= reach {
                let (from, to) = if at_p < 0 { (*p, *q) } else { (*q, *p) };
                parts.push([from, to]);
                excess.insert(key(from), excess[&key(from)] + 1);
                excess.insert(key(to), excess[&key(to)] - 1);
            }
        }
    }
}

fn within(polygons: &[Polygon], p: Vec2) -> bool {
    polygons
        .iter()
        .any(|polygon| surrounds(&polygon.outer, p) && !polygon.holes.iter().any(|hole| surrounds(hole, p)))
}

/// Whether each of some nodes is in polygons; nodes come in rows of equal y, of which the crossings with all sides are found together.
fn all_within(polygons: &[Polygon], nodes: &[Vec2]) -> Vec<bool> {
    let mut crossings: Vec<f64> = Vec::new();
    let mut of_row = f64::NAN;
    let is_within = |p: &Vec2| {
        if p.y != of_row {
            of_row = p.y;
            let all = polygons.iter().flat_map(Polygon::rings).flat_map(|ring| sides(ring));
            let crossed = all.filter(|(a, b)| (a.y <= p.y) != (b.y <= p.y));
            crossings.clear();
            crossings.extend(crossed.map(|(a, b)| a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)));
            crossings.sort_by(f64::total_cmp);
        }
        crossings.partition_point(|x| *x <= p.x) % 2 == 1
    };
    nodes.iter().map(is_within).collect()
}

/// Nodes of grids over the surroundings of openings that the plane passes, half as large again to each side: bulges in them.
fn nodes(openings: &[Aabb], plane: &Plane) -> Vec<Vec2> {
    let around = openings.iter().map(|b| {
        let margin = 0.5 * b.size().max_element();
        Aabb { min: b.min - margin, max: b.max + margin }
    });
    let passed: Vec<Aabb> = around.filter(|b| b.min.z <= plane.z && plane.z <= b.max.z).collect();
    let each = (MOST_NODES / passed.len().max(1)).max(1);
    let grid = |b: &Aabb| {
        let size = b.size().truncate();
        let step = (size.max_element() / SCAN).min(plane.size / FINEST_SCAN);
        let step = step.max((size.x * size.y / each as f64).sqrt()).max(1e-3 * size.max_element());
        let [nx, ny] = [size.x, size.y].map(|s| (s / step).ceil().max(1.0) as usize);
        let low = b.min.truncate();
        (0..nx * ny).map(move |k| low + step * Vec2::new((k % nx) as f64 + 0.5, (k / nx) as f64 + 0.5))
    };
    passed.iter().flat_map(grid).collect()
}

enum Missing {
    Ring(Vec<Vec2>),
    /// The node is next to a contour that is there.
    Nothing,
}

/// The contour between a node at which the polygons are wrong and one at which they are right.
fn missing(
    wrong: usize,
    scan: &[Vec2],
    polygons: &[Polygon],
    parts: &[Directed],
    plane: &Plane,
) -> Option<Missing> {
    let is_wrong = |p: Vec2| within(polygons, p) != plane.is_inside(p);
    let from = scan[wrong];
    let spread = plane.size / 16.0;
    // Outwards along the axes, until the polygons are right.
    let directions = [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y];
    let right = (1..40).find_map(|k| {
        let distance = spread * 1e-4 * 1.5f64.powi(k);
        directions.iter().map(|d| from + distance * *d).find(|p| !is_wrong(*p))
    })?;
    let (mut low, mut high) = (from, right);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if is_wrong(middle) { &mut low } else { &mut high }) = middle;
    }
    if high.distance(from) < 1e-4 * plane.size {
        return Some(Missing::Nothing);
    }
    Arcs::new(plane, parts).around(high).map(Missing::Ring)
}
