//! How good normals, surfaces and classifications are, by the measures of the papers: each compares with a known truth.
mod classification;
mod nearest;
mod normals;
mod sampling;
mod surfaces;

pub use classification::intersection_over_union;
pub use nearest::NearestPoints;
pub use normals::{angle_rmse, good_points};
pub use sampling::{SurfaceSamples, sample_surface};
pub use surfaces::{chamfer_distance, f_score, normal_consistency};

/// Why two things cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MetricError {
    #[error("there are {found} values to compare with {expected} true ones: as many are needed")]
    LengthMismatch { found: usize, expected: usize },
    #[error("there is nothing to compare: at least one value on each side is needed")]
    Empty,
    #[error("the {triangles} triangles have no area to sample, or one that is not finite")]
    NoArea { triangles: usize },
}

fn check_lengths(found: usize, expected: usize) -> Result<(), MetricError> {
    match found {
        _ if found != expected => Err(MetricError::LengthMismatch { found, expected }),
        0 => Err(MetricError::Empty),
        _ => Ok(()),
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}
