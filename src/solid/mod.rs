//! Solids from fields: voxels, and combinations of two.
mod boolean;
mod voxel_surface;
mod voxels;

pub use boolean::{BooleanConfig, BooleanError, BooleanMesh, BooleanOp, boolean};
pub use voxels::{VoxelConfig, VoxelError, VoxelMethod, Voxels, voxelize};
