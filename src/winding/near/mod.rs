//! Near fields of the dual-tree evaluator: for blocks of queries, in 32-bit floats relative to the block wherever that is safe.
mod angles;
mod dipoles;
mod solid_angles;
mod triangles;

use crate::data::BLOCK;
use crate::math::Vec3;
use crate::treecode::GROUPS;

/// Queries in a group of a block.
const GROUP: usize = BLOCK / GROUPS;
/// Queries in a vector of 64-bit floats.
const LANES: usize = 4;

fn single(v: Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}
