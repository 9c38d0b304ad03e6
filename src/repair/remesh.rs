//! The surface of {w ≥ 1/2} as a new mesh.
use super::agreement::agreement;
use super::conserve::{drop_sheets, resolved, volume};
use super::distances::distances;
use super::faces::Faces;
use super::manifold::separate;
use super::{RepairError, RepairMethod, RepairReport, Repaired};
use crate::data::{Monitor, Parts, Shape, TriangleSoup, ascending};
use crate::surface::{SurfaceConfig, extract};
use crate::winding::WindingField;

/// How a shape is remeshed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RemeshConfig {
    /// Cells along the longest side of the bounds; used when `spacing` is not given. Where neither is, cells of soups are as large as
    /// the median edge is long, from [`RemeshConfig::COARSEST`] to [`RemeshConfig::FINE`] along the longest side, and halved up to
    /// [`RemeshConfig::FINEST`] while they miss walls, so that the result agrees with less than 0.97 of {w ≥ 1/2}; cells of clouds as
    /// large as the distances of their points allow.
    pub resolution: Option<usize>,
    /// Edge of a cell in millimetres.
    pub spacing: Option<f64>,
    /// Degrees from which edges are sharp; none stays sharp if it is not given.
    pub sharp: Option<f64>,
    /// Pieces with less than this share of the largest one's area are left out, as in [`SurfaceConfig::min_component`].
    pub min_component: Option<f64>,
}

/// Cells are halved below this agreement.
const AGREEMENT: f64 = 0.97;
/// The part of the remaining progress that cells of one size tell.
const ATTEMPT: f64 = 0.6;

impl RemeshConfig {
    pub const COARSEST: usize = 64;
    pub const FINE: usize = 256;
    pub const FINEST: usize = 600;
}

impl Default for RemeshConfig {
    fn default() -> Self {
        RemeshConfig {
            resolution: None,
            spacing: None,
            sharp: Some(SurfaceConfig::SHARP),
            min_component: None,
        }
    }
}

/// The surface of {w ≥ 1/2}: closed, manifold, oriented outward, without triangles that run through each other. Its vertices lie on the input where the input bounds the inside, on
/// w = 1/2 where it is missing.
///
/// # Errors
/// If and only if the shape is empty or nothing is inside, an option is out of range, memory does not suffice or the monitor cancels.
pub fn remesh(
    field: &WindingField,
    config: &RemeshConfig,
    monitor: &dyn Monitor,
) -> Result<Repaired, RepairError> {
    let monitor = &Parts::new(monitor);
    let longest = field.bounds().size().max_element();
    let Shape::Soup(input) = field.shape() else { return traced(field, config, config.spacing, monitor) };
    if config.spacing.is_some() || config.resolution.is_some() || longest == 0.0 {
        let spacing = config.spacing.or(config.resolution.map(|count| longest / count as f64));
        return traced(field, config, spacing, monitor);
    }
    let mut spacing = spacing_of(input, longest);
    loop {
        let finer = 0.5 * spacing;
        let is_last = finer < longest / RemeshConfig::FINEST as f64;
        monitor.begin_attempt(if is_last { 1.0 } else { ATTEMPT });
        match traced(field, config, Some(spacing), monitor) {
            Err(RepairError::Empty) if !is_last => {}
            Ok(made) if !is_last && made.report.agreement < AGREEMENT => {}
            made => return made,
        }
        spacing = finer;
    }
}

/// The surface in cells of a size.
fn traced(
    field: &WindingField,
    config: &RemeshConfig,
    spacing: Option<f64>,
    monitor: &dyn Monitor,
) -> Result<Repaired, RepairError> {
    let surface = SurfaceConfig {
        resolution: config.resolution,
        spacing,
        sharp: config.sharp,
        min_component: config.min_component,
        ..SurfaceConfig::default()
    };
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.5);
    let mesh = extract(field, &surface, monitor)?;
    monitor.begin(0.5, 0.8);
    if mesh.triangles.is_empty() {
        return Err(RepairError::Empty);
    }
    let mut found = RepairReport::default();
    let soup = untangled(TriangleSoup::from(mesh), &mut found, monitor)?;
    monitor.begin(0.8, 0.95);
    let measured = match (field.shape(), spacing) {
        (Shape::Soup(input), Some(spacing)) => Some(distances(&soup, input, field, spacing, monitor)?),
        _ => None,
    };
    monitor.begin(0.95, 1.0);
    let report = RepairReport {
        method: RepairMethod::Remesh,
        new: soup.len(),
        closed: true,
        volume: volume(&soup),
        agreement: agreement(&soup, field, monitor)?,
        distances: measured,
        intersecting: found.intersecting,
        parts: found.parts,
        unresolved: found.unresolved,
        ..RepairReport::default()
    };
    Ok(Repaired { soup, sources: Vec::new(), report })
}

/// A closed mesh without the few triangles that run through each other where sharp edges were put into narrow places: split there, and
/// the parts kept that bound the inside.
fn untangled(
    soup: TriangleSoup,
    report: &mut RepairReport,
    monitor: &dyn Monitor,
) -> Result<TriangleSoup, RepairError> {
    let mut faces = resolved(&Faces::of(&soup), report, monitor)?;
    if report.intersecting == 0 {
        return Ok(soup);
    }
    let is_closed = separate(&mut faces, &mut RepairReport::default());
    drop_sheets(&mut faces, &mut RepairReport::default());
    Ok(if is_closed && !faces.triangles.is_empty() { faces.to_soup() } else { soup })
}

/// The median length of an edge, within limits.
fn spacing_of(soup: &TriangleSoup, longest: f64) -> f64 {
    let count = |count: usize| longest / count as f64;
    median_edge(soup).clamp(count(RemeshConfig::FINE), count(RemeshConfig::COARSEST))
}

/// The median length of the sides that have one; 0 if there are none.
pub fn median_edge(soup: &TriangleSoup) -> f64 {
    let sides = (0..soup.len()).flat_map(|t| {
        let [a, b, c] = soup.corners(t);
        [a.distance(b), b.distance(c), c.distance(a)]
    });
    let lengths: Vec<f64> = sides.filter(|length| *length > 0.0).collect();
    let order = ascending(lengths.iter().copied());
    order.get(order.len() / 2).map_or(0.0, |place| lengths[*place as usize])
}
