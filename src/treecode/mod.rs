//! Barnes–Hut summation of many small sources: far clusters by their multipole moments, near ones singly.
//!
//! Barill et al. 2018, sections 3.2 and 3.3 (algorithm 1, eqs. 6 to 21, appendices A and B), for one query or a block of them;
//! and a dual tree for many queries, in which far clusters act on whole blocks through Taylor polynomials.
mod dual;
mod expansion;
mod frame;
mod kernel;
mod links;
mod moments;
mod mutual;
mod tree;

pub use dual::{
    Cells, DualAccuracy, DualTree, GROUPS, LatticeTargets, NearLeaf, Octet, PointTargets, Proof, QueryBlock,
    QueryGroup, SourceKind, Sources, Targets, groups_of, parts, relative,
};
pub use expansion::Order;
pub use frame::Frame;
pub use kernel::{Kernel, Lanes, Quadrature, direct_sums};
pub use mutual::{Clustered, Mutual};
pub use tree::{Scratch, Tree, TreeConfig};
