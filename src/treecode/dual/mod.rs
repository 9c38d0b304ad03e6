//! A fast multipole method for fields of many sources at many queries that come in blocks: of a lattice, or sorted.
//!
//! Clusters far from a block act on it through one Taylor polynomial for all of its queries (M2L, Greengard & Rokhlin 1987,
//! in Cartesian form), which smaller blocks inherit (L2L). At blocks of 64 queries, clusters that are far only from some of
//! them act by their multipole series (M2P, Barill et al. 2018), and what is near is summed singly (P2P).
mod accuracy;
mod bounds;
mod clusters;
mod derivatives;
mod factors;
mod far;
mod harmonic;
mod local;
mod moments;
mod multipole;
mod near;
mod octet;
mod place;
mod reach;
mod saved;
mod sources;
mod targets;
mod tree;
mod walk;

pub use accuracy::{DualAccuracy, SourceKind};
pub use octet::{Octet, parts};
pub use sources::{NearLeaf, QueryBlock, QueryGroup, Sources, groups_of, relative};
pub use targets::{Cells, LatticeTargets, PointTargets, Targets};
pub use tree::{DualTree, Proof};

use crate::data::BLOCK;
use local::MAX_DEGREE;
use moments::MAX_ORDER;

/// Queries in a group, and clusters that are taken together.
pub const WIDTH: usize = 8;
/// Groups of queries in a block.
pub const GROUPS: usize = BLOCK / WIDTH;
