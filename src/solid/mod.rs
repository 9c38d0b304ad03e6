//! Solids from a field: voxels, signed distances.
mod distance;
mod voxel_surface;
mod voxels;

pub use distance::{DistanceConfig, DistanceError, DistanceSign, SignedClosest, SignedDistance, Slab};
pub use voxels::{VoxelConfig, VoxelError, VoxelMethod, Voxels, voxelize};
