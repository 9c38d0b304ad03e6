//! Options of voxels.
use super::AccuracyOptions;
use crate::data::Lattice;
use crate::math::Aabb;
use crate::solid::{PointsOf, VoxelConfig, VoxelMethod};
use crate::wasm::failure::Failure;
use crate::winding::{Accuracy, StabCount, Stabbing};
use serde::Deserialize;

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum VoxelFormat {
    #[default]
    Bytes,
    Bits,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum VoxelMethodName {
    Lattice,
    /// The same.
    Exact,
    Continuation,
    Rays,
    Fast,
    Cloud,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum StabCountName {
    Parity,
    Signed,
}

#[derive(Clone, Copy, Default, Deserialize)]
struct RayOptions {
    count: Option<StabCountName>,
    #[serde(default)]
    majority: bool,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum PointsOfName {
    Vertices,
    Barycentres,
}

/// Which voxels are wanted, and how.
#[derive(Default, Deserialize)]
pub struct VoxelOptions {
    resolution: Option<usize>,
    spacing: Option<f64>,
    counts: Option<[usize; 3]>,
    threshold: Option<f64>,
    method: Option<VoxelMethodName>,
    rays: Option<RayOptions>,
    order: Option<u8>,
    beta: Option<f64>,
    points: Option<PointsOfName>,
    #[serde(default)]
    pub format: VoxelFormat,
    #[serde(default)]
    pub surface: bool,
}

/// Cells along the longest side where nothing is said of them.
const RESOLUTION: usize = 64;

/// The cells over a box: by one of the three, or by none.
pub fn lattice_of(
    bounds: Aabb,
    resolution: Option<usize>,
    spacing: Option<f64>,
    counts: Option<[usize; 3]>,
) -> Result<Lattice, Failure> {
    let lattice = match (resolution, spacing, counts) {
        (resolution, None, None) => Lattice::with_resolution(bounds, resolution.unwrap_or(RESOLUTION)),
        (None, Some(spacing), None) => Lattice::with_spacing(bounds, spacing),
        (None, None, Some(counts)) => Lattice::with_counts(bounds, counts),
        _ => return Err(Failure::invalid("give only one of resolution, spacing and counts")),
    };
    Ok(lattice?)
}

impl VoxelOptions {
    pub fn lattice(&self, bounds: Aabb) -> Result<Lattice, Failure> {
        lattice_of(bounds, self.resolution, self.spacing, self.counts)
    }

    /// `of_paper` completes an order or a β that is not given.
    pub fn config(&self, of_paper: Accuracy) -> Result<VoxelConfig, Failure> {
        let method = match self.method {
            None | Some(VoxelMethodName::Lattice | VoxelMethodName::Exact) => VoxelMethod::Lattice,
            Some(VoxelMethodName::Continuation) => VoxelMethod::Continuation,
            Some(VoxelMethodName::Rays) => {
                let rays = self.rays.unwrap_or_default();
                let count = match rays.count {
                    None | Some(StabCountName::Parity) => StabCount::Parity,
                    Some(StabCountName::Signed) => StabCount::Signed,
                };
                VoxelMethod::Rays(Stabbing { count, majority: rays.majority })
            }
            Some(VoxelMethodName::Fast) => {
                let options =
                    AccuracyOptions { order: self.order, beta: self.beta, ..AccuracyOptions::default() };
                let given = options.accuracy(of_paper)?;
                let explicit = if let Accuracy::Explicit { .. } = given { given } else { of_paper };
                let Accuracy::Explicit { order, beta } = explicit else {
                    return Err(Failure::invalid("the method 'fast' takes an order and a beta"));
                };
                VoxelMethod::Fast { order, beta }
            }
            Some(VoxelMethodName::Cloud) => VoxelMethod::Points(match self.points {
                None | Some(PointsOfName::Vertices) => PointsOf::Vertices,
                Some(PointsOfName::Barycentres) => PointsOf::Barycentres,
            }),
        };
        Ok(VoxelConfig { threshold: self.threshold.unwrap_or(VoxelConfig::default().threshold), method })
    }
}
