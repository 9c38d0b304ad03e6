//! A closed, oriented soup as a manifold: what touches itself along an edge or in a vertex gets edges and vertices of its own.
use super::RepairReport;
use super::edges::sides_with_length;
use super::faces::Faces;
use crate::data::{Sets, by_edge, ends, next_side, opposite};
use crate::math::Vec3;

const NONE: u32 = u32::MAX;

/// Gives each edge two triangles that run through it in opposite directions, and each vertex one fan of them, by vertices in the same
/// places. Where more than two triangles meet in an edge those are joined that have the inside between them. Whether it could be
/// done: whether each edge was run through as often in one direction as in the other.
pub fn separate(faces: &mut Faces, report: &mut RepairReport) -> bool {
    let (mates, is_closed) = mates(faces);
    let before = faces.positions.len();
    let (corners, new) = fans(&faces.triangles, &mates, before);
    faces.positions.extend(new.iter().map(|v| faces.positions[*v as usize]).collect::<Vec<Vec3>>());
    let old = std::mem::replace(&mut faces.triangles, corners.as_chunks().0.to_vec());
    debug_assert_eq!(old.len(), faces.triangles.len());
    while is_closed && split_double_edges(faces) {}
    report.separated_vertices += faces.positions.len() - before;
    is_closed
}

/// For each side the one that it is joined with.
fn mates(faces: &Faces) -> (Vec<u32>, bool) {
    let sides = sides_with_length(&faces.triangles);
    let mut mates = vec![NONE; 3 * faces.triangles.len()];
    let mut is_closed = true;
    for same in by_edge(&sides) {
        let lower = (same[0].0 >> 32) as u32;
        let is_up = |side: u32| ends(&faces.triangles, side)[0] == lower;
        let up = same.iter().filter(|(_, side)| is_up(*side)).count();
        if 2 * up != same.len() {
            is_closed = false;
            continue;
        }
        let around: Vec<(u32, bool)> = match same {
            [one, other] => vec![(one.1, false), (other.1, true)],
            _ => around(faces, same),
        };
        for (one, other) in matched(&around) {
            (mates[one as usize], mates[other as usize]) = (other, one);
        }
    }
    (mates, is_closed)
}

/// The sides along an edge by the angle of their triangles around it, counter-clockwise about its direction from the lower vertex to the
/// higher; true for those that run in that direction, which have the inside before them, the others behind.
fn around(faces: &Faces, same: &[(u64, u32)]) -> Vec<(u32, bool)> {
    let (lower, higher) = ((same[0].0 >> 32) as u32, same[0].0 as u32);
    let [from, to] = [lower, higher].map(|v| faces.positions[v as usize]);
    let axis = (to - from).normalize_or_zero();
    let (x, y) = axis.any_orthonormal_pair();
    let mut all: Vec<(f64, bool, u32)> = same
        .iter()
        .map(|(_, side)| {
            let offset = faces.positions[opposite(&faces.triangles, *side) as usize] - from;
            let angle = libm::atan2(offset.dot(y), offset.dot(x));
            (angle, ends(&faces.triangles, *side)[0] == lower, *side)
        })
        .collect();
    // In the same place the inside ends before it begins anew: no wall without thickness comes to be.
    all.sort_unstable_by(|one, other| {
        (one.0, !one.1, one.2).partial_cmp(&(other.0, !other.1, other.2)).expect("angles are numbers")
    });
    all.into_iter().map(|(_, is_up, side)| (side, is_up)).collect()
}

/// Pairs sides on a circle like brackets: one behind which the inside begins with that before which it ends.
fn matched(around: &[(u32, bool)]) -> Vec<(u32, u32)> {
    let step = |is_end: bool| if is_end { -1 } else { 1 };
    let (mut depth, mut least, mut start) = (0, 0, 0);
    for (k, (_, is_end)) in around.iter().enumerate() {
        depth += step(*is_end);
        if depth < least {
            (least, start) = (depth, k + 1);
        }
    }
    let (mut open, mut pairs) = (Vec::new(), Vec::new());
    for k in 0..around.len() {
        let (side, is_end) = around[(start + k) % around.len()];
        match (is_end, open.last()) {
            (true, Some(begun)) => {
                pairs.push((*begun, side));
                open.pop();
            }
            _ => open.push(side),
        }
    }
    pairs
}

/// Vertices of corners, one for each fan of joined triangles: the first of a vertex keeps its number, others are numbered from `count`;
/// and which vertex each of those is in the place of.
fn fans(triangles: &[[u32; 3]], mates: &[u32], count: usize) -> (Vec<u32>, Vec<u32>) {
    let mut sets = Sets::new(mates.len());
    for (side, mate) in (0..).zip(mates).filter(|(_, mate)| **mate != NONE) {
        sets.join(side, next_side(*mate));
    }
    let mut is_used = vec![false; count];
    let mut of_fans = vec![NONE; mates.len()];
    let mut new = Vec::new();
    let corner = |side: u32| {
        let fan = sets.find(side) as usize;
        let vertex = triangles[side as usize / 3][side as usize % 3];
        if of_fans[fan] == NONE {
            of_fans[fan] = if std::mem::replace(&mut is_used[vertex as usize], true) {
                new.push(vertex);
                (count + new.len() - 1) as u32
            } else {
                vertex
            };
        }
        of_fans[fan]
    };
    let corners = (0..mates.len() as u32).map(corner).collect();
    (corners, new)
}

/// Puts a vertex in the middle of one of several edges between the same two vertices; whether there were any.
fn split_double_edges(faces: &mut Faces) -> bool {
    let (mates, _) = mates(faces);
    let sides = sides_with_length(&faces.triangles);
    let mut is_touched = vec![false; faces.triangles.len()];
    let mut is_split = false;
    for same in by_edge(&sides).filter(|sides| sides.len() > 2) {
        let one = same.iter().map(|side| side.1).find(|side| {
            let mate = mates[*side as usize];
            mate != NONE && !is_touched[*side as usize / 3] && !is_touched[mate as usize / 3]
        });
        let Some(one) = one else { continue };
        let [a, b] = ends(&faces.triangles, one).map(|v| faces.positions[v as usize]);
        let middle = faces.positions.len() as u32;
        faces.positions.push(a + 0.5 * (b - a));
        for side in [one, mates[one as usize]] {
            let t = side as usize / 3;
            let ([from, to], top) = (ends(&faces.triangles, side), opposite(&faces.triangles, side));
            faces.triangles[t] = [from, middle, top];
            faces.push([middle, to, top], faces.sources[t]);
            is_touched[t] = true;
        }
        is_split = true;
    }
    is_split
}
