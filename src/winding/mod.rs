//! The winding field of a soup or a cloud: one question, *how many times is this point inside?*
//!
//! `exact` is the definition and the oracle; `field` builds a tree once and answers fast (Barill et al. 2018).
mod dipoles;
mod exact;
mod field;
mod near;
mod triangles;

pub use crate::treecode::{Order, Scratch};
pub use exact::{winding, winding_of_cloud, winding_of_soup};
pub use field::{Accuracy, FieldConfig, FieldError, FieldReport, WindingField};
