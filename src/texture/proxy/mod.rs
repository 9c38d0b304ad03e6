//! Offset proxies: closed manifold meshes at a distance from a soup (Schier et al. 2018, section 5).
mod components;
mod smooth;
mod suggest;

pub use suggest::smallest_single_offset;

use crate::data::{Cancelled, Monitor, SurfaceMesh, TriangleSoup, Warning, WarningKind};
use crate::surface::{OffsetConfig, OffsetError, offset, two_sided_offset};
use crate::winding::{FieldError, WindingField};
use components::{Pieces, keep_outer};

/// On which sides of a soup its proxy lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ProxySides {
    /// The surface of signed distance o: what has w ≥ 1/2 counts as inside, so that openings which the soup surrounds are closed.
    #[default]
    Outer,
    /// The surface of distance o without a sign, which passes through openings wider than 2 o; what of it lies inside is kept beside
    /// the proxy, for dipole fields.
    Both,
}

/// How a proxy is made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProxyConfig {
    /// Distance from the soup, in millimetres; [`ProxyConfig::SHARE`] of the longest side of its bounds where it is not given.
    pub offset: Option<f64>,
    /// Samples along the longest side of the soup's bounds; two for each offset where it is not given, [`ProxyConfig::MOST_SAMPLES`] at
    /// most. Fewer than two for each offset give a warning.
    pub samples: Option<usize>,
    pub sides: ProxySides,
    /// Rounds of Laplacian smoothing, each halfway to the mean of the neighbours.
    pub smoothing: usize,
}

impl ProxyConfig {
    pub const SHARE: f64 = 0.03;
    pub const MOST_SAMPLES: usize = 400;

    /// # Errors
    /// If and only if a number is out of its range, whatever the soup.
    pub fn check(&self) -> Result<(), ProxyError> {
        match (self.offset, self.samples) {
            (Some(offset), _) if !(offset.is_finite() && offset > 0.0) => Err(ProxyError::BadOffset(offset)),
            (_, Some(samples @ (0 | 1))) => Err(ProxyError::TooFewSamples(samples)),
            _ => Ok(()),
        }
    }
}

/// Why there is no proxy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProxyError {
    #[error("an offset of {0} is not possible: a finite number above 0 is needed")]
    BadOffset(f64),
    #[error("{0} samples are too few: at least 2 along the longest side are needed")]
    TooFewSamples(usize),
    #[error("the soup has no triangles")]
    NoTriangles,
    #[error(transparent)]
    Surface(#[from] OffsetError),
    #[error(transparent)]
    Field(#[from] FieldError),
}

impl From<Cancelled> for ProxyError {
    fn from(cancelled: Cancelled) -> ProxyError {
        FieldError::from(cancelled).into()
    }
}

/// A closed, manifold mesh around a soup, oriented outward.
#[derive(Clone, Debug, PartialEq)]
pub struct Proxy {
    /// Its outer components.
    pub mesh: SurfaceMesh,
    /// The component of each triangle, counted from 0 in the order in which they come.
    pub component: Vec<u32>,
    /// Outer components: more than one where the gaps between parts of the soup are wider than two offsets.
    pub components: usize,
    /// Components inside others, which lines from outside never meet: the inner side of a two-sided proxy.
    pub inner: SurfaceMesh,
    /// In millimetres.
    pub offset: f64,
    /// Edge of the cells in which it was traced, in millimetres.
    pub spacing: f64,
    pub warnings: Vec<Warning>,
}

/// Two samples for each offset, as the sampling theorem asks: the paper's Table 1, whose first row (10 %, 13 samples) has fewer.
const SAMPLES_OF_OFFSET: f64 = 2.0;

impl Proxy {
    /// Traces the surface at the offset, leaves out what is inside of it, and smooths the rest.
    ///
    /// # Errors
    /// If and only if the soup is empty, the offset is not a finite number above 0, samples are too few or too many, nothing encloses
    /// anything, or the monitor cancels.
    pub fn new(
        field: &WindingField,
        config: &ProxyConfig,
        monitor: &dyn Monitor,
    ) -> Result<Proxy, ProxyError> {
        config.check()?;
        let longest = longest_side(field)?;
        let offset = config.offset.unwrap_or(ProxyConfig::SHARE * longest);
        if !(offset.is_finite() && offset > 0.0) {
            return Err(ProxyError::BadOffset(offset));
        }
        let needed = (SAMPLES_OF_OFFSET * longest / offset).ceil().max(2.0);
        let samples = config.samples.unwrap_or(needed.min(ProxyConfig::MOST_SAMPLES as f64) as usize);
        // What lies in one place has no size but that of its proxy.
        let spacing = if longest > offset { longest / samples as f64 } else { offset / SAMPLES_OF_OFFSET };
        let traced = trace(field, offset, spacing, config.sides, monitor)?;
        let Pieces { mesh, component, components, inner } = keep_outer(traced, monitor)?;
        if mesh.triangles.is_empty() {
            return Err(OffsetError::NothingLeft(offset).into());
        }
        let mut warnings = Vec::new();
        if (samples as f64) < needed && longest > offset {
            warnings.push(Warning::new(WarningKind::CoarseProxy, needed as usize));
        }
        if components > 1 {
            warnings.push(Warning::new(WarningKind::SeveralProxies, components));
        }
        let mesh = smooth::smoothed(mesh, config.smoothing, monitor)?;
        Ok(Proxy { mesh, component, components, inner, offset, spacing, warnings })
    }

    pub fn soup(&self) -> TriangleSoup {
        self.mesh.clone().into()
    }
}

fn longest_side(field: &WindingField) -> Result<f64, ProxyError> {
    let bounds = field.bounds();
    if bounds.is_empty() { Err(ProxyError::NoTriangles) } else { Ok(bounds.size().max_element()) }
}

fn trace(
    field: &WindingField,
    distance: f64,
    spacing: f64,
    sides: ProxySides,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, OffsetError> {
    let config = OffsetConfig { distance, spacing: Some(spacing), ..OffsetConfig::default() };
    match sides {
        ProxySides::Outer => offset(field, &config, monitor),
        ProxySides::Both => two_sided_offset(field, &config, monitor),
    }
}
