//! Solids from a field: voxels, each by itself or in bricks; signed distances; combinations of two.
mod boolean;
mod continuation;
mod difference;
mod distance;
mod voxel_surface;
mod voxels;

pub use crate::data::{Brick, VoxelBricks, VoxelRows, Voxels};
pub use boolean::{BooleanConfig, BooleanError, BooleanMesh, BooleanOp, boolean};
pub use difference::{DifferentLattices, VoxelDifference, difference};
pub use distance::{DistanceConfig, DistanceError, DistanceSign, SignedClosest, SignedDistance, Slab};
pub use voxels::{
    PointsOf, VoxelConfig, VoxelError, VoxelMethod, voxelize, voxelize_bricks, voxelize_by_rays,
};
