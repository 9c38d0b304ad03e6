//! Triangles turned so that neighbours agree and face outward.
use super::RepairReport;
use super::faces::Faces;
use crate::data::{Cancelled, Monitor};
use crate::orient::{FaceConfig, orient_soup};

/// Turns triangles over where those on either side of an edge disagree, and pieces that are inside out (see [`orient_soup`]).
pub fn turn(faces: &mut Faces, report: &mut RepairReport, monitor: &dyn Monitor) -> Result<(), Cancelled> {
    let (_, found) = orient_soup(&faces.to_soup(), &FaceConfig::default(), monitor)?;
    found.flipped.iter().for_each(|t| faces.triangles[*t as usize].swap(1, 2));
    report.flipped += found.flipped.len();
    Ok(())
}
