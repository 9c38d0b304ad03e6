//! Triangles cut along each other, so that what is left meets only in whole edges and vertices.
//!
//! Whether and how two triangles meet is decided by exact predicates (`contacts`). Each point that this makes has a name, so
//! that all triangles around share it, and coordinates of twice the precision (`points`), so that those computed
//! in different ways are equal after rounding; what rounded input puts next to each other is one point (`cells`). A triangle is
//! cut by a constrained Delaunay triangulation in its own coordinates, where the points of its edges lie exactly on them
//! (`triangulate`, `edges`); where segments in it cross, the crossing goes to the other triangles that have them too, until
//! nothing changes (`refine`). Triangles that overlap in a plane get the same pieces there (`coplanar`).
mod cells;
mod contacts;
mod coplanar;
mod edges;
mod points;
mod refine;
mod triangulate;

use crate::bvh::Bvh;
use crate::data::{Cancelled, Monitor, Parts, map_items, map_tasks};
use crate::math::{Aabb, Vec3, normal_signs};
use contacts::{Contacts, Key, Triangles};
use edges::Edges;
use points::Points;
use refine::Work;

/// Which triangles are cut along which.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairs {
    /// Each along all others.
    All,
    /// Those before that number along those from it on, and the other way round.
    Between(usize),
}

/// Triangles cut along each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrangement {
    /// The given positions, unchanged, and then those made, each in a place of its own.
    pub positions: Vec<Vec3>,
    /// Corners of each piece, in the orientation of the triangle it is of: pieces of triangles in the order of these. A triangle
    /// that nothing cuts is its own piece, corner by corner.
    pub pieces: Vec<[u32; 3]>,
    /// The triangle that each piece is of.
    pub sources: Vec<u32>,
    /// Edges of pieces along which triangles that are cut along each other meet, the lower vertex first, sorted: also those
    /// that are edges of one of them.
    pub seams: Vec<[u32; 2]>,
    /// Triangles without area: they are cut where others cut their edges, and cut nothing.
    pub degenerate: usize,
    /// Triangles in which segments still cross, as coordinates are rounded.
    pub unresolved: usize,
}

/// Items of a leaf of the hierarchy of boxes.
const LEAF: usize = 4;
/// Pairs that make a task.
const PAIRS: usize = 1024;
/// Where in the progress the pairs are known, and the triangles cut but for what coplanar ones share.
const MEETING: f64 = 0.4;
const CUT: f64 = 0.9;
/// Pairs between two reports.
const REPORT: usize = 1 << 18;

/// Cuts triangles along each other. Their vertices are to be welded: those in the same place have the same number. The same bits for
/// any number of threads.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn arrange(
    positions: Vec<Vec3>,
    triangles: &[[u32; 3]],
    pairs: Pairs,
    monitor: &dyn Monitor,
) -> Result<Arrangement, Cancelled> {
    let monitor = &Parts::new(monitor);
    let enlargement = enlargement(&positions);
    let positions: Vec<Vec3> = positions.into_iter().map(|p| p * enlargement).collect();
    monitor.begin(0.0, MEETING);
    monitor.report(0.0, "meeting triangles")?;
    let places = |t: usize| triangles[t].map(|v| positions[v as usize]);
    let has_area = map_items(triangles.len(), |t| normal_signs(places(t)) != [0; 3]);
    let degenerate = has_area.iter().filter(|has| !**has).count();
    let candidates = candidates(&positions, triangles, &has_area, pairs);
    let is_kept = |pair: &[u32; 2]| match pairs {
        Pairs::All => false,
        Pairs::Between(first) => ((pair[0] as usize) < first) != ((pair[1] as usize) < first),
    };
    let geometry = Triangles { positions: &positions, corners: triangles };
    let mut found = Contacts::default();
    for (block, some) in candidates.chunks(REPORT).enumerate() {
        monitor.report(block as f64 * REPORT as f64 / candidates.len() as f64, "meeting triangles")?;
        let contacts = map_tasks(some.len().div_ceil(PAIRS), |task| {
            let mut contacts = Contacts::default();
            for pair in &some[task * PAIRS..some.len().min((task + 1) * PAIRS)] {
                geometry.meet(*pair, is_kept(pair), &mut contacts);
            }
            contacts
        });
        contacts.into_iter().filter(|c| !c.is_empty()).for_each(|c| found.extend(c));
    }
    let mut work = start(positions, triangles, &found);
    let mut changed: Vec<u32> =
        work.segments.iter().map(|s| s.0).chain(work.inside.iter().map(|i| i.0)).collect();
    changed.extend(work.around(&work.edges.all()));
    monitor.begin(MEETING, CUT);
    work.refine(changed, monitor)?;
    monitor.begin(CUT, 1.0);
    found.coplanar.sort_unstable();
    work.share_cuts(&found.coplanar, monitor)?;
    Ok(finish(work, degenerate, enlargement))
}

/// A power of two that makes the largest coordinate 1 or more: products of three very small ones would be 0, and predicates wrong.
fn enlargement(positions: &[Vec3]) -> f64 {
    const ONE: u64 = 1f64.to_bits() >> MANTISSA;
    const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;
    let largest = positions.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let exponent = largest.to_bits() >> MANTISSA;
    f64::from_bits((2 * ONE - exponent.min(ONE)) << MANTISSA)
}

/// Pairs of triangles whose boxes overlap.
fn candidates(positions: &[Vec3], triangles: &[[u32; 3]], has_area: &[bool], pairs: Pairs) -> Vec<[u32; 2]> {
    let of_box = |t: u32| Aabb::around(triangles[t as usize].map(|v| positions[v as usize]));
    let with_area = |range: std::ops::Range<usize>| -> Vec<u32> {
        range.filter(|t| has_area[*t]).map(|t| t as u32).collect()
    };
    match pairs {
        Pairs::All => {
            let items = with_area(0..triangles.len());
            let boxes = map_items(items.len(), |i| of_box(items[i]));
            let tree = Bvh::build(&boxes, LEAF);
            let own = tree.own_overlaps(&boxes);
            own.into_iter().map(|pair| pair.map(|i| items[i as usize])).collect()
        }
        Pairs::Between(first) => {
            let first = first.min(triangles.len());
            let sides = [with_area(0..first), with_area(first..triangles.len())];
            let boxes = [0, 1].map(|side| map_items(sides[side].len(), |i| of_box(sides[side][i])));
            let bounds = [0, 1].map(|side| boxes[side].iter().copied().fold(Aabb::EMPTY, Aabb::union));
            let mut kept: [(Vec<u32>, Vec<Aabb>); 2] = Default::default();
            for side in 0..2 {
                let reaches = |b: &Aabb| b.overlaps(&bounds[1 - side]);
                let near =
                    sides[side].iter().copied().zip(boxes[side].iter().copied()).filter(|(_, b)| reaches(b));
                kept[side] = near.unzip();
            }
            let trees = [0, 1].map(|side| Bvh::build(&kept[side].1, LEAF));
            let found = trees[0].overlaps(&kept[0].1, &trees[1], &kept[1].1);
            found.into_iter().map(|[a, b]| [kept[0].0[a as usize], kept[1].0[b as usize]]).collect()
        }
    }
}

/// Makes the points, and puts them where they lie.
fn start<'a>(positions: Vec<Vec3>, corners: &'a [[u32; 3]], found: &Contacts) -> Work<'a> {
    let mut keys: Vec<Key> = found.on_edges.iter().map(|(_, key)| *key).collect();
    keys.extend(found.inside.iter().map(|(_, key)| *key));
    keys.extend(found.segments.iter().flat_map(|(ends, _)| *ends));
    keys.sort_unstable();
    keys.dedup();
    let mut points = Points::new(positions);
    found.on_edges.iter().flat_map(|(edge, _)| *edge).for_each(|v| points.name(v));
    found.inside.iter().flat_map(|(t, _)| corners[*t as usize]).for_each(|v| points.name(v));
    found
        .segments
        .iter()
        .flat_map(|(_, pair)| *pair)
        .flat_map(|t| corners[t as usize])
        .for_each(|v| points.name(v));
    for key in &keys {
        if let Key::Vertex(v) = key {
            points.name(*v); // one that only touches another triangle, too
        }
    }
    let numbers = points.resolve(&keys, corners);
    let number = |key: &Key| numbers[keys.binary_search(key).expect("every key was collected")];
    let mut edges = Edges::default();
    edges.add(found.on_edges.iter().filter_map(|(edge, key)| Some((*edge, number(key)?))).collect(), &points);
    let mut inside: Vec<(u32, u32)> =
        found.inside.iter().filter_map(|(t, key)| Some((*t, number(key)?))).collect();
    inside.sort_unstable();
    inside.dedup();
    let mut segments = Vec::new();
    for (ends, pair) in &found.segments {
        if let (Some(a), Some(b)) = (number(&ends[0]), number(&ends[1]))
            && a != b
        {
            segments.extend(pair.map(|t| (t, [a.min(b), a.max(b)])));
        }
    }
    segments.sort_unstable();
    segments.dedup();
    Work {
        corners,
        points,
        edges,
        segments,
        inside,
        pieces: Default::default(),
        wishes: Vec::new(),
        most_events: Default::default(),
        unresolved: 0,
    }
}

fn finish(mut work: Work, degenerate: usize, enlargement: f64) -> Arrangement {
    let (mut pieces, mut sources) = (Vec::new(), Vec::new());
    for (t, corners) in work.corners.iter().enumerate() {
        match work.pieces.remove(&(t as u32)) {
            Some(cut) => {
                sources.extend(std::iter::repeat_n(t as u32, cut.triangles.len()));
                pieces.extend(cut.triangles);
            }
            None => {
                sources.push(t as u32);
                pieces.push(*corners);
            }
        }
    }
    let mut seams: Vec<[u32; 2]> = work.segments.iter().map(|(_, ends)| *ends).collect();
    seams.sort_unstable();
    seams.dedup();
    Arrangement {
        positions: work.points.into_positions().into_iter().map(|p| p / enlargement).collect(),
        pieces,
        sources,
        seams,
        degenerate,
        unresolved: work.unresolved,
    }
}
