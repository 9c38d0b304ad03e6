//! Solids from a field: voxels, each by itself or in bricks.
mod continuation;
mod difference;
mod voxel_surface;
mod voxels;

pub use crate::data::{Brick, VoxelBricks, VoxelRows, Voxels};
pub use difference::{DifferentLattices, VoxelDifference, difference};
pub use voxels::{
    PointsOf, VoxelConfig, VoxelError, VoxelMethod, voxelize, voxelize_bricks, voxelize_by_rays,
};
