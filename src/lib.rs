//! **fast-winding** answers *inside or outside?* for geometry as it is found: triangle soups with holes, flips,
//! duplicates and self-intersections, and point clouds.
#![deny(unsafe_code)]

pub mod bvh;
pub mod check;
pub mod data;
pub mod estimate;
pub mod io;
pub mod levelset;
pub mod math;
pub mod slice;
pub mod solid;
pub mod surface;
pub mod treecode;
#[cfg(target_arch = "wasm32")]
pub mod wasm;
pub mod winding;

pub use data::{Lattice, OrientedCloud, PointCloud, TriangleSoup};
pub use winding::WindingField;
