//! **fast-winding** answers *inside or outside?* for geometry as it is found: triangle soups with holes, flips,
//! duplicates and self-intersections, and point clouds.
#![deny(unsafe_code)]

pub mod data;
pub mod math;
#[cfg(target_arch = "wasm32")]
pub mod wasm;

pub use data::{Lattice, OrientedCloud, PointCloud, TriangleSoup};
