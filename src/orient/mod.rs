//! Normals of clouds that have none: those that make the winding number consistent with itself.
mod schedule;
mod wnnc;

pub use schedule::Widths;
pub use wnnc::{WnncConfig, WnncVariant, wnnc};
