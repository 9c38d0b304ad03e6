//! What is wrong with a soup.
mod boundary;
mod components;

pub use boundary::boundary_edges;
pub use components::components;
