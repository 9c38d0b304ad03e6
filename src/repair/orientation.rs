//! Triangles turned so that neighbours agree, and pieces so that they enclose something.
use super::RepairReport;
use super::edges::{edges, ends, sides_by_edge};
use super::faces::Faces;
use crate::data::Monitor;
use crate::math::{Vec3, barycentre};
use crate::winding::{Accuracy, FieldError, WindingField};

const HALF: f64 = 0.5;
/// Volumes below this times the area to the power 3/2 have no sign.
const LEAST: f64 = 1e-6;

/// Turns triangles over where those on either side of an edge disagree, the smaller area of each piece; then pieces whose volume,
/// their openings closed, is negative, unless they bound a hollow of another.
pub fn turn(faces: &mut Faces, report: &mut RepairReport, monitor: &dyn Monitor) -> Result<(), FieldError> {
    monitor.report(0.0, "orientation")?;
    let pieces = pieces(faces);
    let count = pieces.iter().map(|(piece, _)| piece + 1).max().unwrap_or(0) as usize;
    let mut areas = vec![[0.0; 2]; count];
    for (t, (piece, is_turned)) in pieces.iter().enumerate() {
        areas[*piece as usize][usize::from(*is_turned)] += faces.area(t);
    }
    let mut turned: Vec<bool> =
        pieces.iter().map(|(piece, is_turned)| is_turned ^ (areas[*piece as usize][1] > areas[*piece as usize][0])).collect();
    turn_those(faces, &turned);
    let is_inverted = inverted(faces, &pieces, count, monitor)?;
    let again: Vec<bool> = pieces.iter().map(|(piece, _)| is_inverted[*piece as usize]).collect();
    turn_those(faces, &again);
    turned.iter_mut().zip(again).for_each(|(turned, again)| *turned ^= again);
    report.flipped += turned.into_iter().filter(|turned| *turned).count();
    Ok(())
}

fn turn_those(faces: &mut Faces, turned: &[bool]) {
    faces.triangles.iter_mut().zip(turned).filter(|(_, turned)| **turned).for_each(|(t, _)| t.swap(1, 2));
}

const NONE: u32 = u32::MAX;

/// Of each triangle its piece, numbered from 0, of those joined by edges that no third has; and whether it disagrees with the piece's
/// first triangle. Where a piece has one side only, with one of the answers.
fn pieces(faces: &Faces) -> Vec<(u32, bool)> {
    let across = across(faces);
    let mut found = vec![(NONE, false); faces.triangles.len()];
    let mut count = 0;
    let mut open = Vec::new();
    for first in 0..faces.triangles.len() {
        if found[first].0 != NONE {
            continue;
        }
        found[first] = (count, false);
        open.push(first as u32);
        while let Some(t) = open.pop() {
            for side in 3 * t..3 * t + 3 {
                let other = across[side as usize];
                if other != NONE && found[other as usize / 3].0 == NONE {
                    let agree = ends(&faces.triangles, side)[0] != ends(&faces.triangles, other)[0];
                    found[other as usize / 3] = (count, found[t as usize].1 ^ !agree);
                    open.push(other / 3);
                }
            }
        }
        count += 1;
    }
    found
}

/// Of each side the only other one along its edge, if it has just that.
fn across(faces: &Faces) -> Vec<u32> {
    let sides = sides_by_edge(&faces.triangles);
    let mut across = vec![NONE; 3 * faces.triangles.len()];
    for pair in edges(&sides).filter(|sides| sides.len() == 2) {
        (across[pair[0].1 as usize], across[pair[1].1 as usize]) = (pair[1].1, pair[0].1);
    }
    across
}

/// Pieces that enclose a negative volume, and are not the walls of a hollow: the others do not have w ≥ 1/2 beside them.
fn inverted(
    faces: &Faces,
    pieces: &[(u32, bool)],
    count: usize,
    monitor: &dyn Monitor,
) -> Result<Vec<bool>, FieldError> {
    let mut largest = vec![(-1.0, 0); count];
    let mut areas = vec![0.0; count];
    for (t, (piece, _)) in pieces.iter().enumerate() {
        let (area, own) = (faces.area(t), &mut largest[*piece as usize]);
        areas[*piece as usize] += area;
        if area > own.0 {
            *own = (area, t);
        }
    }
    let volumes = volumes(faces, pieces, count).into_iter().zip(areas);
    let mut is_inverted: Vec<bool> = volumes.map(|(volume, area)| volume < -LEAST * area * area.sqrt()).collect();
    let those: Vec<usize> = (0..count).filter(|piece| is_inverted[*piece]).collect();
    if those.is_empty() {
        return Ok(is_inverted);
    }
    let mut others = faces.clone();
    others.retain(|t| !is_inverted[pieces[t].0 as usize]);
    let field = WindingField::new(others.to_soup(), Default::default());
    let places: Vec<Vec3> = those.iter().map(|piece| barycentre(faces.corners(largest[*piece].1))).collect();
    let values = field.evaluate(&places, Accuracy::default(), monitor)?;
    those.iter().zip(values).for_each(|(piece, w)| is_inverted[*piece] = w < HALF);
    Ok(is_inverted)
}

/// What each piece encloses with a cone over its open sides, from the middle of these.
fn volumes(faces: &Faces, pieces: &[(u32, bool)], count: usize) -> Vec<f64> {
    let mut sums = vec![(Vec3::ZERO, 0.0); count];
    for (side, _) in (0u32..).zip(across(faces)).filter(|(_, other)| *other == NONE) {
        let sum = &mut sums[pieces[side as usize / 3].0 as usize];
        for v in ends(&faces.triangles, side) {
            *sum = (sum.0 + faces.positions[v as usize], sum.1 + 1.0);
        }
    }
    for (t, (piece, _)) in pieces.iter().enumerate() {
        let sum = &mut sums[*piece as usize];
        if sum.1 == 0.0 {
            *sum = (faces.corners(t)[0], 1.0);
        }
    }
    let mut volumes = vec![0.0; count];
    for (t, (piece, _)) in pieces.iter().enumerate() {
        let (sum, number) = sums[*piece as usize];
        let [a, b, c] = faces.corners(t).map(|p| p - sum / number);
        volumes[*piece as usize] += a.dot(b.cross(c)) / 6.0;
    }
    volumes
}
