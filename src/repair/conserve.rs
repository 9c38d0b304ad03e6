//! Repair that keeps the triangles of the input.
//!
//! The triangles, put right and closed by caps, are a soup whose winding number is an integer everywhere. Split along each other, its
//! parts bound cells; the parts with w ≥ 1/2 on one side alone bound those inside: a closed surface, whatever the caps ran through.
use super::agreement::agreement;
use super::bounding::bounding;
use super::edges::{net_edges, sides_with_length};
use super::faces::{Faces, NEW};
use super::holes::close;
use super::manifold::separate;
use super::orientation::turn;
use super::remesh::{median_edge, remesh};
use super::stitch::stitch;
use super::{Fallback, RemeshConfig, RepairError, RepairMethod, RepairReport, Repaired};
use crate::arrangement::{Pairs, arrange};
use crate::data::{Monitor, Parts, Sets, Shape, TriangleSoup, by_edge};
use crate::math::{area_vector, signed_volume};
use crate::winding::WindingField;

/// How a soup is repaired with its own triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConserveConfig {
    /// Open edges are stitched that are no farther apart, in millimetres. Where it is not given, 1e-5 of the diagonal; and if that does
    /// not agree with the field as it is to, up to 1e-3 of it, but no more than a tenth of the median edge.
    pub tolerance: Option<f64>,
    /// Whether triangles are turned over where neighbours disagree, and pieces that are inside out.
    pub orient: bool,
    /// The least agreement of the result with {w ≥ 1/2} of the input, from 0 to 1, before the surface is made anew; see
    /// [`RepairReport::agreement`].
    pub least_agreement: f64,
    /// How the surface is made anew where the triangles of the input do not suffice; the report says so. Without it the result is then
    /// what came of them.
    pub fallback: Option<RemeshConfig>,
}

impl Default for ConserveConfig {
    fn default() -> Self {
        ConserveConfig {
            tolerance: None,
            orient: true,
            least_agreement: 0.8,
            fallback: Some(RemeshConfig::default()),
        }
    }
}

/// Tolerances in diagonals, and in median edges how wide all but the first may be.
const TOLERANCES: [f64; 4] = [1e-5, 1e-4, 3e-4, 1e-3];
const OF_EDGE: f64 = 0.1;
/// The part of the remaining progress that an attempt with a tolerance tells: mostly the first suffices.
const ATTEMPT: f64 = 0.6;
/// Times that what is open after splitting is closed and split again.
const ROUNDS: usize = 3;
/// A piece with less volume than this times its area to the power 3/2 is a sheet: a plate of that shape is 3e-6 as thick as it is wide.
const SHEET: f64 = 1e-6;

/// The triangles of a soup as a closed manifold that bounds {w ≥ 1/2}. A soup that is one already comes back as it is, bit for bit.
///
/// # Errors
/// If and only if `field` is that of a cloud, an option is out of range, nothing is inside, memory does not suffice or the monitor
/// cancels.
pub fn conserve(
    field: &WindingField,
    config: &ConserveConfig,
    monitor: &dyn Monitor,
) -> Result<Repaired, RepairError> {
    let Shape::Soup(soup) = field.shape() else { return Err(RepairError::CloudConserved) };
    check(config)?;
    let monitor = &Parts::new(monitor);
    let mut best: Option<Repaired> = None;
    let tolerances = tolerances(soup, config);
    for (k, tolerance) in tolerances.iter().enumerate() {
        let is_last = k + 1 == tolerances.len();
        monitor.begin_attempt(ATTEMPT);
        let Some(made) = stitched(field, soup, *tolerance, is_last, config, monitor)? else { continue };
        let is_better = |best: &Repaired| made.report.agreement > best.report.agreement;
        if best.as_ref().is_none_or(is_better) {
            best = Some(made);
        }
        if best.as_ref().is_some_and(|best| lack_of(best, config).is_none()) {
            break;
        }
    }
    let Some(result) = best else { return Err(RepairError::Empty) };
    match (lack_of(&result, config), &config.fallback) {
        (None, _) => Ok(result),
        (Some(fallback), Some(remeshing)) => {
            monitor.begin_attempt(0.1);
            let (mut faces, mut report) = righted(soup, tolerances[0], monitor)?;
            if config.orient {
                turn(&mut faces, &mut report, monitor)?;
            }
            let is_turned = report.flipped > 0;
            let rebuilt = is_turned.then(|| WindingField::new(faces.to_soup(), Default::default()));
            monitor.begin_attempt(1.0);
            let mut made = remesh(rebuilt.as_ref().unwrap_or(field), remeshing, monitor)?;
            (made.report.fallback, made.report.flipped) = (Some(fallback), report.flipped);
            Ok(made)
        }
        (Some(Fallback::Empty), None) => Err(RepairError::Empty),
        (Some(_), None) => Ok(result),
    }
}

/// The tolerances that are tried one after the other.
fn tolerances(soup: &TriangleSoup, config: &ConserveConfig) -> Vec<f64> {
    if let Some(tolerance) = config.tolerance {
        return vec![tolerance];
    }
    let (diagonal, edge) = (soup.bounds().diagonal(), median_edge(soup));
    let wide = TOLERANCES[1..].iter().map(|share| share * diagonal).filter(|t| *t <= OF_EDGE * edge);
    std::iter::once(TOLERANCES[0] * diagonal).chain(wide).collect()
}

/// The soup conserved with one tolerance; nothing if most of its edges are open then, unless that tolerance `is_last`.
fn stitched(
    field: &WindingField,
    soup: &TriangleSoup,
    tolerance: f64,
    is_last: bool,
    config: &ConserveConfig,
    monitor: &dyn Monitor,
) -> Result<Option<Repaired>, RepairError> {
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.1);
    let (mut faces, mut report) = righted(soup, tolerance, monitor)?;
    if !is_last && 2 * faces.open_edges() > faces.triangles.len() {
        return Ok(None);
    }
    monitor.begin(0.1, 0.2);
    if config.orient {
        turn(&mut faces, &mut report, monitor)?;
    }
    let is_same = faces.triangles.len() == soup.len() && report == RepairReport::default();
    let rebuilt = (!is_same).then(|| WindingField::new(faces.to_soup(), Default::default()));
    let field = rebuilt.as_ref().unwrap_or(field);
    monitor.begin(0.2, 0.5);
    close(&mut faces, Some(field), &mut report, monitor)?;
    monitor.begin(0.5, 0.9);
    for _ in 0..ROUNDS {
        faces = resolved(&faces, &mut report, monitor)?;
        if net_edges(&faces.triangles).is_empty() {
            break;
        }
        close(&mut faces, None, &mut report, monitor)?;
    }
    report.closed = separate(&mut faces, &mut report);
    drop_sheets(&mut faces, &mut report);
    report.tolerance = tolerance;
    monitor.begin(0.9, 1.0);
    finished(soup, &faces, report, field, monitor).map(Some)
}

fn check(config: &ConserveConfig) -> Result<(), RepairError> {
    if let Some(tolerance) = config.tolerance.filter(|t| !(t.is_finite() && *t >= 0.0)) {
        return Err(RepairError::BadTolerance(tolerance));
    }
    match config.least_agreement {
        least if !(0.0..=1.0).contains(&least) => Err(RepairError::BadAgreement(least)),
        _ => Ok(()),
    }
}

/// The triangles without duplicates and those without area, seams stitched.
fn righted(
    soup: &TriangleSoup,
    tolerance: f64,
    monitor: &dyn Monitor,
) -> Result<(Faces, RepairReport), RepairError> {
    let (mut faces, mut report) = (Faces::of(soup), RepairReport::default());
    faces.drop_degenerate(&mut report);
    faces.merge_coincident(&mut report);
    if faces.open_edges() > 0 {
        stitch(&mut faces, tolerance, &mut report, monitor)?;
        faces.drop_degenerate(&mut report);
        faces.merge_coincident(&mut report);
    }
    Ok((faces, report))
}

/// The parts of a closed soup that bound its inside.
pub(super) fn resolved(
    faces: &Faces,
    report: &mut RepairReport,
    monitor: &dyn Monitor,
) -> Result<Faces, RepairError> {
    let made = arrange(faces.positions.clone(), &faces.triangles, Pairs::All, monitor)?;
    for parts in made.sources.chunk_by(|one, other| one == other).filter(|parts| parts.len() > 1) {
        report.intersecting += 1;
        report.parts += parts.len();
    }
    report.unresolved += made.unresolved;
    let pieces = Faces { positions: made.positions, triangles: made.pieces, sources: made.sources };
    Ok(bounding(faces, &pieces, report, monitor)?)
}

/// Drops pieces, triangles joined by edges, that enclose next to nothing.
pub(super) fn drop_sheets(faces: &mut Faces, report: &mut RepairReport) {
    let sides = sides_with_length(&faces.triangles);
    let mut sets = Sets::new(faces.triangles.len());
    by_edge(&sides).for_each(|same| same.iter().for_each(|(_, side)| sets.join(same[0].1 / 3, side / 3)));
    let of = sets.into_least();
    let mut sizes = vec![(0.0, 0.0); of.len()];
    for (t, piece) in of.iter().enumerate() {
        let anchor = faces.corners(*piece as usize)[0];
        let corners = faces.corners(t);
        let size = &mut sizes[*piece as usize];
        let area = area_vector(corners.map(|p| p - anchor)).length();
        *size = (size.0 + signed_volume(corners, anchor), size.1 + area);
    }
    let is_sheet = |piece: u32| {
        let (volume, area): (f64, f64) = sizes[piece as usize];
        volume.abs() <= SHEET * area * area.sqrt()
    };
    report.sheets += (0..of.len() as u32).filter(|t| of[*t as usize] == *t && is_sheet(*t)).count();
    faces.retain(|t| !is_sheet(of[t]));
}

fn finished(
    soup: &TriangleSoup,
    faces: &Faces,
    mut report: RepairReport,
    field: &WindingField,
    monitor: &dyn Monitor,
) -> Result<Repaired, RepairError> {
    let is_same = faces.triangles == soup.triangles() && faces.positions == soup.positions();
    let result = if is_same { soup.clone() } else { faces.to_soup() };
    report.method = RepairMethod::Conserve;
    report.new = faces.sources.iter().filter(|source| **source == NEW).count();
    report.kept = faces.sources.len() - report.new;
    report.volume = volume(&result);
    report.agreement = if result.is_empty() { 0.0 } else { agreement(&result, field, monitor)? };
    Ok(Repaired { soup: result, sources: faces.sources.clone(), report })
}

/// The volume that a closed soup encloses.
pub fn volume(soup: &TriangleSoup) -> f64 {
    let anchor = soup.bounds().center();
    (0..soup.len()).map(|t| signed_volume(soup.corners(t), anchor)).sum()
}

fn lack_of(result: &Repaired, config: &ConserveConfig) -> Option<Fallback> {
    match &result.report {
        _ if result.soup.is_empty() => Some(Fallback::Empty),
        report if !report.closed => Some(Fallback::Open),
        report if report.agreement < config.least_agreement => Some(Fallback::Disagrees),
        _ => None,
    }
}
