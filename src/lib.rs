//! **fast-winding** answers *inside or outside?* for geometry as it is found: triangle soups with holes, flips,
//! duplicates and self-intersections, and point clouds.
//!
//! Bytes become a [`TriangleSoup`] or a [`PointCloud`] ([`io::read`]); a cloud is completed with normals and areas
//! ([`estimate`]) to an [`OrientedCloud`]; either gets a [`WindingField`], built once; the features ([`solid`],
//! [`slice`](mod@slice), [`surface`], [`check`](mod@check)) ask that field. Results are plain data; broken soups are made whole
//! ([`repair`]), layers go on to a printer ([`print`](mod@print)).
//!
//! Right-handed frame, z up, millimetres; normals point outward; the winding number is 1 inside. The method is that of
//! Barill et al. 2018, *Fast Winding Numbers for Soups and Clouds*.
#![deny(unsafe_code)]

pub mod arrangement;
pub mod bvh;
pub mod charge;
pub mod check;
pub mod data;
pub mod distance;
pub mod estimate;
pub mod io;
pub mod levelset;
pub mod math;
pub mod metrics;
pub mod orient;
pub mod polygon;
pub mod print;
pub mod repair;
pub mod slice;
pub mod solid;
pub mod surface;
pub mod texture;
pub mod treecode;
#[cfg(target_arch = "wasm32")]
pub mod wasm;
pub mod winding;

pub use data::{Lattice, OrientedCloud, PointCloud, TriangleSoup};
pub use winding::WindingField;

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The examples of the documents.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../docs/winding-numbers.md")]
    struct WindingNumbers;
    #[doc = include_str!("../docs/voxels.md")]
    struct Voxels;
    #[doc = include_str!("../docs/distances.md")]
    struct Distances;
    #[doc = include_str!("../docs/surfaces.md")]
    struct Surfaces;
    #[doc = include_str!("../docs/booleans.md")]
    struct Booleans;
}
