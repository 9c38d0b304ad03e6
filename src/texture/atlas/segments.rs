//! Charts grown from seeds over triangles that face alike (after Cohen-Steiner, Alliez & Desbrun 2004 and Lévy et al. 2002): flat
//! enough to be projected, compact, with seams where the surface bends most.
use super::AtlasConfig;
use super::faces::Faces;
use super::merge::merge;
use crate::data::{Cancelled, Monitor};
use crate::math::Vec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Stands for no chart.
pub const NONE: u32 = u32::MAX;
/// How much longer a way is to a triangle that faces across the axis of the chart, in multiples: seams of a rounded cube then follow
/// the middle of its edges.
const BEND: f64 = 20.0;
/// Rounds in which charts are added where none reaches, and in which seeds then move to the middle of their charts.
const ADDING: usize = 24;
const SETTLING: usize = 4;
/// Weight of facing away from the axis, against distance from the middle in radii of the chart, where seeds are chosen.
const FACING: f64 = 4.0;

/// Share of the whole area from which a part that no chart reaches gets its own: dents and bumps are left to the charts around.
const LEAST_PART: f64 = 1e-3;

/// Degrees by which charts that are joined face closer to their axis than those that are grown: what is as wide as can be is also the
/// most distorted.
const CLOSER: f64 = 8.0;

/// Triangles in charts.
#[derive(Clone, Debug, Default)]
pub struct Segments {
    /// The chart of each triangle.
    pub charts: Vec<u32>,
    pub count: u32,
}

/// A place in a queue by its cost; positive numbers are in the order of their bits.
type Entry = Reverse<(u64, u32, u32)>;

/// The charts of a closed mesh: connected over sides that are joined, each facing its axis within the angle of the configuration where
/// that is possible.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn segment(faces: &Faces, config: &AtlasConfig, monitor: &dyn Monitor) -> Result<Segments, Cancelled> {
    let limit = libm::cos(config.cone_degrees.to_radians());
    let mut seeds: Vec<(u32, Vec3)> = Vec::new();
    let mut found = Segments { charts: vec![NONE; faces.len()], count: 0 };
    for round in 0..ADDING {
        monitor.report(0.7 * round as f64 / ADDING as f64, "charts")?;
        let added = deepest_of_unreached(faces, &found.charts);
        if added.is_empty() {
            break;
        }
        seeds.extend(added.iter().map(|t| (*t, faces.normals[*t as usize])));
        found = grow(faces, &seeds, limit);
        seeds = centred(faces, &found);
        found = grow(faces, &seeds, limit);
    }
    for round in 0..SETTLING {
        monitor.report(0.7 + 0.3 * round as f64 / SETTLING as f64, "charts")?;
        seeds = centred(faces, &found);
        found = grow(faces, &seeds, limit);
    }
    adopt_rest(faces, &mut found);
    merge(faces, &mut found, libm::cos((config.cone_degrees - CLOSER).to_radians()));
    separate(faces, &mut found);
    Ok(found)
}

/// Charts around seeds with their axes: each triangle goes to the seed that the shortest way leads from, where ways are longer over what
/// faces away from the axis, and impossible over what faces more than an angle with cosine `limit` away.
pub fn grow(faces: &Faces, seeds: &[(u32, Vec3)], limit: f64) -> Segments {
    let mut charts = vec![NONE; faces.len()];
    let mut queue: BinaryHeap<Entry> = BinaryHeap::new();
    queue.extend((0..).zip(seeds).map(|(chart, (t, _))| Reverse((0, *t, chart))));
    while let Some(Reverse((cost, t, chart))) = queue.pop() {
        if charts[t as usize] != NONE {
            continue;
        }
        charts[t as usize] = chart;
        let axis = seeds[chart as usize].1;
        for next in faces.neighbours(t).map(|n| n as usize).filter(|n| charts[*n] == NONE) {
            let facing = faces.normals[next].dot(axis);
            if facing >= limit {
                let length = faces.centers[next].distance(faces.centers[t as usize]);
                let way = f64::from_bits(cost) + length * (1.0 + BEND * (1.0 - facing).max(0.0));
                queue.push(Reverse((way.to_bits(), next as u32, chart)));
            }
        }
    }
    Segments { charts, count: seeds.len() as u32 }
}

/// Of each connected part that belongs to no chart, the triangle farthest from all charts; of small ones next to a chart none.
fn deepest_of_unreached(faces: &Faces, charts: &[u32]) -> Vec<u32> {
    let mut depth = vec![f64::INFINITY; faces.len()];
    let mut queue: BinaryHeap<Entry> = BinaryHeap::new();
    let is_free = |t: usize| charts[t] == NONE;
    for t in (0..faces.len()).filter(|t| is_free(*t)) {
        let is_at_rim = (3 * t..3 * t + 3)
            .any(|side| faces.joined[side] == Faces::NONE || !is_free(faces.joined[side] as usize / 3));
        if is_at_rim {
            depth[t] = 0.0;
            queue.push(Reverse((0, t as u32, 0)));
        }
    }
    while let Some(Reverse((cost, t, _))) = queue.pop() {
        let cost = f64::from_bits(cost);
        if cost > depth[t as usize] {
            continue;
        }
        for next in faces.neighbours(t).filter(|n| is_free(*n as usize)) {
            let way = cost + faces.centers[next as usize].distance(faces.centers[t as usize]);
            if way < depth[next as usize] {
                depth[next as usize] = way;
                queue.push(Reverse((way.to_bits(), next, 0)));
            }
        }
    }
    // A part without a rim, a component that has no chart yet, begins at its first triangle.
    let least = LEAST_PART * faces.areas.iter().sum::<f64>();
    let mut is_seen = vec![false; faces.len()];
    let mut deepest = Vec::new();
    for first in (0..faces.len() as u32).filter(|t| is_free(*t as usize)) {
        if is_seen[first as usize] {
            continue;
        }
        is_seen[first as usize] = true;
        let (mut open, mut best) = (vec![first], first);
        let (mut area, mut is_alone) = (0.0, true);
        while let Some(t) = open.pop() {
            area += faces.areas[t as usize];
            is_alone &= faces.neighbours(t).all(|n| is_free(n as usize));
            let (at, of_best) = (depth[t as usize], depth[best as usize]);
            if at.is_finite() && (at, Reverse(t)) > (of_best, Reverse(best)) {
                best = t;
            }
            for next in faces.neighbours(t).filter(|n| is_free(*n as usize)) {
                if !std::mem::replace(&mut is_seen[next as usize], true) {
                    open.push(next);
                }
            }
        }
        if is_alone || area >= least {
            deepest.push(best);
        }
    }
    deepest
}

/// Of each chart, the triangle next to its middle that faces its mean normal, and that normal.
fn centred(faces: &Faces, found: &Segments) -> Vec<(u32, Vec3)> {
    let count = found.count as usize;
    let (mut normals, mut centers, mut areas) =
        (vec![Vec3::ZERO; count], vec![Vec3::ZERO; count], vec![0.0; count]);
    for (t, chart) in found.charts.iter().enumerate().filter(|(_, chart)| **chart != NONE) {
        let (chart, area) = (*chart as usize, faces.areas[t]);
        normals[chart] += area * faces.normals[t];
        centers[chart] += area * faces.centers[t];
        areas[chart] += area;
    }
    let mut best = vec![(f64::INFINITY, NONE); count];
    for (t, chart) in (0u32..).zip(&found.charts).filter(|(_, chart)| **chart != NONE) {
        let chart = *chart as usize;
        let away = faces.centers[t as usize] - centers[chart] / areas[chart].max(f64::MIN_POSITIVE);
        let axis = normals[chart].normalize_or_zero();
        let facing = 1.0 - faces.normals[t as usize].dot(axis);
        let cost = away.length_squared() / areas[chart].max(f64::MIN_POSITIVE) + FACING * facing;
        if cost < best[chart].0 {
            best[chart] = (cost, t);
        }
    }
    let seed = |(chart, (_, t)): (usize, &(f64, u32))| (*t, normals[chart].normalize_or_zero());
    best.iter().enumerate().filter(|(_, (_, t))| *t != NONE).map(seed).collect()
}

/// What no chart reaches goes to the neighbour that faces most alike, ring by ring.
fn adopt_rest(faces: &Faces, found: &mut Segments) {
    loop {
        let mut changes = Vec::new();
        for t in (0..faces.len() as u32).filter(|t| found.charts[*t as usize] == NONE) {
            let by_facing = faces
                .neighbours(t)
                .map(|n| n as usize)
                .filter(|n| found.charts[*n] != NONE)
                .map(|n| (faces.normals[n].dot(faces.normals[t as usize]), found.charts[n]))
                .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            changes.extend(by_facing.map(|(_, chart)| (t, chart)));
        }
        if changes.is_empty() {
            break;
        }
        changes.iter().for_each(|(t, chart)| found.charts[*t as usize] = *chart);
    }
    separate(faces, found);
}

/// Numbers charts anew, connected parts apart.
pub fn separate(faces: &Faces, found: &mut Segments) {
    let before = std::mem::replace(&mut found.charts, vec![NONE; faces.len()]);
    found.count = 0;
    for first in 0..faces.len() as u32 {
        if found.charts[first as usize] != NONE {
            continue;
        }
        let mut open = vec![first];
        found.charts[first as usize] = found.count;
        while let Some(t) = open.pop() {
            for next in faces.neighbours(t).map(|n| n as usize) {
                if found.charts[next] == NONE && before[next] == before[t as usize] {
                    found.charts[next] = found.count;
                    open.push(next as u32);
                }
            }
        }
        found.count += 1;
    }
}
