//! The contours of shapes that are not closed: the section where it separates inside from outside, and arcs between its ends.
use super::arcs::Arcs;
use super::arrangement::pieces;
use super::chains::{Chains, join, key};
use super::disjoint::polygons_of_disjoint;
use super::kept::{Directed, kept};
use super::plane::Plane;
use super::section::Segment;
use crate::data::Polygon;
use crate::math::{Aabb, Vec2};
use crate::polygon::{Fill, enclosed, surrounds};
use rustc_hash::FxHashMap;

/// Nodes along the longer side of an opening's surroundings where contours are compared with the field.
const SCAN: f64 = 12.0;
/// Nodes along the longer side of the section in openings as large as that.
const FINEST_SCAN: f64 = 48.0;
/// Nodes of a section.
const MOST_NODES: usize = 1 << 13;
/// Contours that touch no surface, found one after the other.
const MOST_ARCS: usize = 64;

/// The polygons of what is inside, or none where arcs did not come to an end or the field is inside elsewhere.
///
/// `openings` are boxes around what bounds the openings: within them and next to them the contours are compared with the field.
pub(super) fn polygons(segments: &[Segment], plane: &Plane, openings: &[Aabb]) -> Option<Vec<Polygon>> {
    let mut parts = kept(&pieces(segments), plane);
    close(&mut parts, plane)?;
    let scan = nodes(openings, plane);
    let inside = plane.all_inside(&scan);
    for _ in 0..MOST_ARCS {
        let polygons = polygons_of(&parts);
        let is_wrong = |k: &usize| within(&polygons, scan[*k]) != inside[*k];
        let wrong: Vec<usize> = (0..scan.len()).filter(is_wrong).collect();
        if wrong.is_empty() {
            return Some(polygons);
        }
        let ring = wrong.iter().find_map(|k| missing(*k, &scan, &polygons, &parts, plane))?;
        match ring {
            Missing::Nothing => return Some(polygons),
            Missing::Ring(ring) => {
                let next = ring.iter().copied().cycle().skip(1);
                parts.extend(ring.iter().copied().zip(next).map(|(a, b)| [a, b]));
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
    let mut open = |p: Vec2, sign: i32| {
        let count = excess.get_mut(&key(p)).filter(|count| **count * sign > 0)?;
        *count -= sign;
        Some(p)
    };
    let mut ends: Vec<Vec2> = parts.iter().filter_map(|part| open(part[0], 1)).collect();
    let starts: Vec<Vec2> = parts.iter().filter_map(|part| open(part[1], -1)).collect();
    let mut arcs = Vec::new();
    let tracer = Arcs::new(plane, parts);
    for start in starts {
        let (points, end) = tracer.from_end(start, &ends)?;
        ends.swap_remove(end);
        let mut from = start;
        for to in points {
            arcs.push([from, to]);
            from = to;
        }
    }
    parts.extend(arcs);
    ends.is_empty().then_some(())
}

fn polygons_of(parts: &[Directed]) -> Vec<Polygon> {
    let Chains { loops, branches, .. } = join(parts);
    let disjoint = if branches { None } else { polygons_of_disjoint(&loops) };
    disjoint.unwrap_or_else(|| enclosed(&loops, Fill::Positive))
}

fn within(polygons: &[Polygon], p: Vec2) -> bool {
    polygons
        .iter()
        .any(|polygon| surrounds(&polygon.outer, p) && !polygon.holes.iter().any(|hole| surrounds(hole, p)))
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
