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
pub use soup::{SoupError, TriangleSoup};
pub(crate) use topology::{Edge, LeftOut, Topology};
pub use transform::TransformError;
pub use usable::LARGEST_COORDINATE;
use usable::is_usable;
pub use voxels::{VoxelDataError, VoxelRows, Voxels};
pub use warning::{Warning, WarningKind};

use crate::math::Aabb;
use std::sync::Arc;

/// Geometry that has a winding field.
#[derive(Clone, Debug)]
pub enum Shape {
    Soup(Arc<TriangleSoup>),
    Cloud(Arc<OrientedCloud>),
}

impl Shape {
    /// The smallest box around all triangles or points.
    pub fn bounds(&self) -> Aabb {
        match self {
            Shape::Soup(soup) => soup.bounds(),
            Shape::Cloud(cloud) => cloud.bounds(),
        }
    }

    /// Number of triangles or points.
    pub fn len(&self) -> usize {
        match self {
            Shape::Soup(soup) => soup.len(),
            Shape::Cloud(cloud) => cloud.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl From<TriangleSoup> for Shape {
    fn from(soup: TriangleSoup) -> Self {
        Shape::Soup(Arc::new(soup))
    }
}

impl From<OrientedCloud> for Shape {
    fn from(cloud: OrientedCloud) -> Self {
        Shape::Cloud(Arc::new(cloud))
    }
}

impl From<Arc<TriangleSoup>> for Shape {
    fn from(soup: Arc<TriangleSoup>) -> Self {
        Shape::Soup(soup)
    }
}

impl From<Arc<OrientedCloud>> for Shape {
    fn from(cloud: Arc<OrientedCloud>) -> Self {
        Shape::Cloud(cloud)
    }
}
