//! The surface of {w ≥ 1/2} as a new mesh.
use super::agreement::agreement;
use super::conserve::volume;
use super::distances::distances;
use super::{RepairError, RepairMethod, RepairReport, Repaired};
use crate::data::{Monitor, Shape, TriangleSoup, ascending};
use crate::surface::{SurfaceConfig, extract};
use crate::winding::WindingField;

/// How a shape is remeshed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RemeshConfig {
    /// Cells along the longest side of the bounds; used when `spacing` is not given. Where neither is, cells of soups are as large as
    /// the median edge is long, but not more than [`RemeshConfig::FINEST`] along the longest side nor fewer than
    /// [`RemeshConfig::COARSEST`]; cells of clouds as large as the distances of their points allow.
    pub resolution: Option<usize>,
    /// Edge of a cell in millimetres.
    pub spacing: Option<f64>,
    /// Degrees from which edges are sharp; none stays sharp if it is not given.
    pub sharp: Option<f64>,
    /// Pieces with less than this share of the largest one's area are left out, as in [`SurfaceConfig::min_component`].
    pub min_component: Option<f64>,
}

impl RemeshConfig {
    pub const COARSEST: usize = 64;
    pub const FINEST: usize = 256;
}

impl Default for RemeshConfig {
    fn default() -> Self {
        RemeshConfig { resolution: None, spacing: None, sharp: Some(SurfaceConfig::SHARP), min_component: None }
    }
}

/// The surface of {w ≥ 1/2}: closed, manifold, oriented outward. Its vertices lie on the input where the input bounds the inside, on
/// w = 1/2 where it is missing.
///
/// # Errors
/// If and only if the shape is empty or nothing is inside, an option is out of range, memory does not suffice or the monitor cancels.
pub fn remesh(field: &WindingField, config: &RemeshConfig, monitor: &dyn Monitor) -> Result<Repaired, RepairError> {
    let longest = field.bounds().size().max_element();
    let spacing = match (config.spacing, config.resolution, field.shape()) {
        (Some(spacing), ..) => Some(spacing),
        (None, None, Shape::Soup(soup)) if longest > 0.0 => Some(spacing_of(soup, longest)),
        _ => None,
    };
    let surface = SurfaceConfig {
        resolution: config.resolution,
        spacing,
        sharp: config.sharp,
        min_component: config.min_component,
        ..SurfaceConfig::default()
    };
    let mesh = extract(field, &surface, monitor)?;
    if mesh.triangles.is_empty() {
        return Err(RepairError::Empty);
    }
    let spacing = spacing.or(config.resolution.map(|count| longest / count as f64));
    let soup = TriangleSoup::from(mesh);
    let measured = match (field.shape(), spacing) {
        (Shape::Soup(input), Some(spacing)) => Some(distances(&soup, input, field, spacing, monitor)?),
        _ => None,
    };
    let report = RepairReport {
        method: RepairMethod::Remesh,
        new: soup.len(),
        closed: true,
        volume: volume(&soup),
        agreement: agreement(&soup, field, monitor)?,
        distances: measured,
        ..RepairReport::default()
    };
    Ok(Repaired { soup, sources: Vec::new(), report })
}

/// The median length of an edge, within limits.
fn spacing_of(soup: &TriangleSoup, longest: f64) -> f64 {
    let sides = (0..soup.len()).flat_map(|t| {
        let [a, b, c] = soup.corners(t);
        [a.distance(b), b.distance(c), c.distance(a)]
    });
    let lengths: Vec<f64> = sides.filter(|length| *length > 0.0).collect();
    let order = ascending(lengths.iter().copied());
    let median = order.get(order.len() / 2).map_or(longest, |place| lengths[*place as usize]);
    let count = |count: usize| longest / count as f64;
    median.clamp(count(RemeshConfig::FINEST), count(RemeshConfig::COARSEST))
}
