//! Solids from a field: voxels.
mod voxel_surface;
mod voxels;

pub use voxels::{VoxelConfig, VoxelError, VoxelMethod, Voxels, voxelize};
