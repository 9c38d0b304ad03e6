//! Openings closed: every cycle of boundary edges gets a cap.
use super::RepairReport;
use super::edges::{net_edges, sides_with_length};
use super::faces::{Faces, NEW};
use super::refine::Cap;
use super::span::span;
use crate::data::{Monitor, edge_key, ends, map_items};
use crate::math::{Vec3, area_vector};
use crate::winding::{FieldError, WindingField, cycles};

/// Rims of fewer edges get caps without vertices of their own.
const LEAST_RIM: usize = 7;

/// Closes all openings, with caps that follow w = 1/2 of `field` where they are large; without a field, as flat as they can be.
/// Every edge is then run through as often in one direction as in the other.
pub fn close(
    faces: &mut Faces,
    field: Option<&WindingField>,
    report: &mut RepairReport,
    monitor: &dyn Monitor,
) -> Result<(), FieldError> {
    let rims = cycles(&net_edges(&faces.triangles));
    if rims.is_empty() {
        return Ok(());
    }
    monitor.report(0.0, "closing holes")?;
    let sides = sides_with_length(&faces.triangles);
    let caps = map_items(rims.len(), |k| flat_cap(faces, &sides, &rims[k]));
    let total = rims.len();
    for (k, (rim, mut cap)) in rims.into_iter().zip(caps).enumerate() {
        if let Some(field) = field.filter(|_| rim.len() >= LEAST_RIM) {
            monitor.report(k as f64 / total as f64, "closing holes")?;
            cap.refine();
            cap.settle(field, monitor)?;
        }
        add(faces, &rim, &cap, report);
    }
    Ok(monitor.report(1.0, "closing holes")?)
}

/// A cap over a cycle in the direction of the triangles beside it, which it runs against.
fn flat_cap(faces: &Faces, sides: &[(u64, u32)], rim: &[u32]) -> Cap {
    let count = rim.len();
    let points: Vec<Vec3> = rim.iter().rev().map(|v| faces.positions[*v as usize]).collect();
    let normal = |k: usize| {
        // Edge k of the reversed rim.
        let [from, to] = [rim[(2 * count - 2 - k) % count], rim[count - 1 - k]];
        let first = sides.partition_point(|side| side.0 < edge_key(from, to));
        let along = sides[first..].iter().take_while(|side| side.0 == edge_key(from, to));
        let own = along.map(|side| side.1).find(|side| ends(&faces.triangles, *side) == [from, to]);
        own.map_or(Vec3::ZERO, |side| area_vector(faces.corners(side as usize / 3)).normalize_or_zero())
    };
    let beside: Vec<Vec3> = (0..count).map(normal).collect();
    Cap { triangles: span(&points, &beside), points, rim: count }
}

fn add(faces: &mut Faces, rim: &[u32], cap: &Cap, report: &mut RepairReport) {
    let first = faces.positions.len() as u32;
    faces.positions.extend_from_slice(&cap.points[cap.rim..]);
    let number = |v: u32| match rim.len().checked_sub(1 + v as usize) {
        Some(k) => rim[k],
        None => first + v - rim.len() as u32,
    };
    let area = |t: &[u32; 3]| area_vector(t.map(|v| cap.points[v as usize])).length();
    cap.triangles.iter().for_each(|t| faces.push(t.map(number), NEW));
    let area = cap.triangles.iter().map(area).sum::<f64>();
    report.holes += 1;
    report.cap_triangles += cap.triangles.len();
    report.cap_area += area;
    report.largest_cap_area = report.largest_cap_area.max(area);
}
