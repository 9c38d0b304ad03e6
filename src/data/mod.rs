//! What goes in and what comes out: soups, clouds, lattices, voxels, layers, warnings. Plain data, validated once.
mod bits;
mod blocks;
mod bricks;
mod cloud;
mod directory;
mod edges;
mod lattice;
mod layers;
mod lazy;
mod mesh;
mod monitor;
mod pairs;
mod parallel;
mod saved;
mod sets;
mod shape;
mod soup;
mod soup_cloud;
mod topology;
mod transform;
mod usable;
mod voxels;
mod warning;

pub use bits::set_bit;
pub(crate) use bits::{bit, byte_of, ones};
pub use blocks::{BLOCK, OutOfMemory, fill_blocks, fill_in_blocks, for_each_lattice_block, zeroed};
pub use bricks::{BRICK_SIDE, Brick, BrickBits, VoxelBricks};
pub(crate) use bricks::{bit_of, mask_of_brick};
pub use cloud::{CloudError, OrientedCloud, PointCloud};
pub(crate) use directory::{Directory, INSIDE, OUTSIDE};
pub(crate) use edges::{
    by_edge, edge_between, edge_key, edge_of_key, edges, ends, next_side, opposite, sides_by_edge, sorted,
    turn_alike,
};
pub use lattice::{Grid, Lattice, LatticeError};
pub use layers::{Layer, Polygon, Ring, sides, signed_area};
pub(crate) use lazy::Lazy;
pub use mesh::SurfaceMesh;
pub use monitor::{Cancelled, Monitor, Parts, Silent};
pub(crate) use pairs::{ascending, sorted_pairs};
pub(crate) use parallel::{map_items, map_parts, map_tasks, set_each, sort_keyed, threads};
pub use saved::SavedError;
pub(crate) use saved::{Loader, Saver};
pub(crate) use sets::{Sets, TwoKinds};
pub use shape::Shape;
pub use soup::{SoupError, TriangleSoup};
pub(crate) use topology::{Edge, LeftOut, Topology};
pub use transform::TransformError;
pub use usable::LARGEST_COORDINATE;
use usable::is_usable;
pub use voxels::{VoxelDataError, VoxelRows, Voxels};
pub use warning::{Warning, WarningKind};
