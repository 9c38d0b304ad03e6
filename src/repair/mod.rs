//! Repair: from a soup or a cloud to a closed, oriented manifold that bounds {w ≥ 1/2}.
//!
//! [`remesh`] traces that surface anew, of soups and of clouds, with the sharp edges of the input (Barill et al. 2018, Fig. 2).
//! [`conserve`] keeps the triangles of a soup: it drops what bounds nothing, turns over, stitches, closes openings with caps that follow
//! w = 1/2, splits what intersects and keeps the parts that bound the inside.
mod agreement;
mod bounding;
mod conserve;
mod distances;
mod edges;
mod faces;
mod holes;
mod manifold;
mod orientation;
mod refine;
mod remesh;
mod report;
mod span;
mod stitch;

pub use conserve::{ConserveConfig, conserve};
pub use remesh::{RemeshConfig, remesh};
pub use report::{Distances, Fallback, RepairMethod, RepairReport};

use crate::data::{Cancelled, TriangleSoup};
use crate::surface::SurfaceError;
use crate::winding::FieldError;

/// A repaired mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// Closed, oriented outward, manifold: by its indices each edge has two triangles and each vertex one fan of them. Vertices may lie
    /// in the same place where parts touch.
    pub soup: TriangleSoup,
    /// Of each triangle the one of the input that it is, or is a part of; [`Repaired::NEW`] for others. Empty if all are new.
    pub sources: Vec<u32>,
    pub report: RepairReport,
}

impl Repaired {
    /// Stands for the source of a triangle that has none.
    pub const NEW: u32 = faces::NEW;
}

/// Why something could not be repaired.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RepairError {
    #[error("a cloud has no triangles to conserve: it can be remeshed")]
    CloudConserved,
    #[error("the tolerance is {0}: a finite length from 0 is needed")]
    BadTolerance(f64),
    #[error("an agreement of {0} cannot be asked for: a share from 0 to 1 is needed")]
    BadAgreement(f64),
    #[error("nothing is inside: there is no place with w of 1/2 or more, so no surface to be made")]
    Empty,
    #[error(transparent)]
    Field(#[from] FieldError),
    #[error(transparent)]
    Surface(#[from] SurfaceError),
}

impl From<Cancelled> for RepairError {
    fn from(cancelled: Cancelled) -> RepairError {
        FieldError::from(cancelled).into()
    }
}
