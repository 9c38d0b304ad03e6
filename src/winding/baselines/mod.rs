//! The methods that papers compare theirs with: the exact hierarchy of Jacobson et al. 2013, and rays.
mod hierarchy;
mod parity;
mod stab;

pub use hierarchy::ExactHierarchy;
pub use parity::{RayParity, Rays};
pub use stab::{StabCount, Stabbing, stab_lattice};
