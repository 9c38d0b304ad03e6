//! Open edges that lie next to each other are joined: vertices welded, edges split where a vertex of another lies on them.
use super::RepairReport;
use super::edges::sides_with_length;
use super::faces::Faces;
use crate::bvh::Bvh;
use crate::data::{Cancelled, Monitor, Sets, by_edge, edge_key, ends, opposite};
use crate::math::{Aabb, Vec3};

/// Most items in a leaf of a tree.
const LEAF_SIZE: usize = 4;
/// Rounds in which edges are split: each splits one side of a triangle at most.
const ROUNDS: usize = 8;

/// Welds vertices of open edges that are no farther apart than `tolerance`, and splits open edges at vertices of others no farther
/// from them than that.
pub fn stitch(
    faces: &mut Faces,
    tolerance: f64,
    report: &mut RepairReport,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    for round in 0..ROUNDS {
        monitor.report(round as f64 / ROUNDS as f64, "stitching")?;
        let welded = weld_open(faces, tolerance);
        let split = split_open(faces, tolerance);
        report.stitched_vertices += welded;
        report.split_edges += split;
        if welded + split == 0 {
            break;
        }
    }
    monitor.report(1.0, "stitching")
}

/// Sides that run along an edge with no other.
fn open_sides(faces: &Faces) -> Vec<u32> {
    let sides = sides_with_length(&faces.triangles);
    by_edge(&sides).filter(|sides| sides.len() == 1).map(|sides| sides[0].1).collect()
}

fn vertices_of(faces: &Faces, sides: &[u32]) -> Vec<u32> {
    let mut vertices: Vec<u32> = sides.iter().flat_map(|side| ends(&faces.triangles, *side)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

fn tree_of(positions: &[Vec3], vertices: &[u32]) -> Bvh {
    let place = |v: &u32| positions[*v as usize];
    let boxes: Vec<Aabb> = vertices.iter().map(|v| Aabb { min: place(v), max: place(v) }).collect();
    Bvh::build(&boxes, LEAF_SIZE)
}

/// Nearest pairs first. Two vertices of one triangle stay apart, and none moves farther than the tolerance.
fn weld_open(faces: &mut Faces, tolerance: f64) -> usize {
    let vertices = vertices_of(faces, &open_sides(faces));
    let bvh = tree_of(&faces.positions, &vertices);
    let mut pairs = Vec::new();
    for a in &vertices {
        let place = faces.positions[*a as usize];
        bvh.for_each(
            |bounds| bounds.padded(tolerance).contains(place),
            |k| {
                let b = vertices[k];
                let distance = place.distance(faces.positions[b as usize]);
                if b > *a && distance <= tolerance {
                    pairs.push((distance, *a, b));
                }
            },
        );
    }
    if pairs.is_empty() {
        return 0;
    }
    pairs.sort_unstable_by(|one, other| one.partial_cmp(other).expect("distances are numbers"));
    let sides = sides_with_length(&faces.triangles);
    let is_edge = |a: u32, b: u32| sides.binary_search_by_key(&edge_key(a, b), |side| side.0).is_ok();
    let mut sets = Sets::new(faces.positions.len());
    let mut members: std::collections::BTreeMap<u32, Vec<u32>> = Default::default();
    let mut welded = 0;
    for (_, a, b) in pairs {
        let (a, b) = (sets.find(a), sets.find(b));
        let [low, high] = [a.min(b), a.max(b)];
        let of = |v: u32| members.get(&v).cloned().unwrap_or_else(|| vec![v]);
        let (kept, moved) = (of(low), of(high));
        let anchor = faces.positions[low as usize];
        let is_near = |v: &u32| faces.positions[*v as usize].distance(anchor) <= tolerance;
        let share_edge = kept.iter().any(|a| moved.iter().any(|b| is_edge(*a, *b)));
        if low != high && moved.iter().all(is_near) && !share_edge {
            sets.join(low, high);
            members.insert(low, [kept, moved].concat());
            welded += 1;
        }
    }
    faces.triangles.iter_mut().flatten().for_each(|v| *v = sets.find(*v));
    welded
}

/// Splits triangles along an open side at the open vertices that lie on it.
fn split_open(faces: &mut Faces, tolerance: f64) -> usize {
    let sides = open_sides(faces);
    let vertices = vertices_of(faces, &sides);
    let bvh = tree_of(&faces.positions, &vertices);
    let mut is_touched = vec![false; faces.triangles.len()];
    let mut split = 0;
    for side in sides {
        let (t, [a, b]) = (side as usize / 3, ends(&faces.triangles, side));
        let on_side =
            if is_touched[t] { vec![] } else { on_segment(faces, side, &vertices, &bvh, tolerance) };
        if on_side.is_empty() {
            continue;
        }
        is_touched[t] = true;
        split += on_side.len();
        let (top, source) = (opposite(&faces.triangles, side), faces.sources[t]);
        let stops: Vec<u32> = std::iter::once(a).chain(on_side).chain([b]).collect();
        let mut parts = stops.windows(2).map(|ends| [ends[0], ends[1], top]);
        faces.triangles[t] = parts.next().expect("an edge has two ends");
        parts.for_each(|part| faces.push(part, source));
    }
    split
}

/// The vertices on a side, in its direction.
fn on_segment(faces: &Faces, side: u32, vertices: &[u32], bvh: &Bvh, tolerance: f64) -> Vec<u32> {
    let ([a, b], top) = (ends(&faces.triangles, side), opposite(&faces.triangles, side));
    let [from, to] = [a, b].map(|v| faces.positions[v as usize]);
    let length = from.distance(to);
    let mut found: Vec<(f64, u32)> = Vec::new();
    if length <= 2.0 * tolerance {
        return Vec::new();
    }
    let segment = Aabb::around([from, to]).padded(tolerance);
    let direction = (to - from) / length;
    bvh.for_each(
        |bounds| bounds.overlaps(&segment),
        |k| {
            let v = vertices[k];
            let offset = faces.positions[v as usize] - from;
            let along = offset.dot(direction);
            let is_between = along > tolerance && along < length - tolerance;
            if ![a, b, top].contains(&v) && is_between && (offset - along * direction).length() <= tolerance {
                found.push((along, v));
            }
        },
    );
    found.sort_unstable_by(|one, other| one.partial_cmp(other).expect("places are numbers"));
    found.into_iter().map(|(_, v)| v).collect()
}
