//! The winding field of a soup or a cloud: one question, *how many times is this point inside?*
//!
//! `exact` is the definition and the oracle; `field` builds a tree once and answers fast (Barill et al. 2018). `hierarchy`
//! and `parity` are the methods that the paper compares itself with.
mod buckets;
#[allow(dead_code, reason = "cycles and components are for the closure")]
mod chain;
mod dipoles;
mod exact;
mod field;
mod gradient;
mod hierarchy;
mod parity;
mod triangles;

pub use crate::treecode::{Order, Scratch};
pub use exact::{winding, winding_of_cloud, winding_of_soup};
pub use field::{Accuracy, FieldConfig, FieldError, FieldReport, WindingField};
pub use gradient::{edge_gradient, winding_gradient, winding_gradient_of_cloud, winding_gradient_of_soup};
pub use hierarchy::ExactHierarchy;
pub use parity::{RayParity, Rays};
