//! Solids from a field: voxels, each by itself or in bricks; signed distances.
mod continuation;
mod difference;
mod distance;
mod voxel_surface;
mod voxels;

pub use crate::data::{Brick, VoxelBricks, VoxelRows, Voxels};
pub use difference::{DifferentLattices, VoxelDifference, difference};
pub use distance::{DistanceConfig, DistanceError, DistanceSign, SignedClosest, SignedDistance, Slab};
pub use voxels::{
    PointsOf, VoxelConfig, VoxelError, VoxelMethod, voxelize, voxelize_bricks, voxelize_by_rays,
};
