//! What is wrong with a soup.
mod boundary;

pub use boundary::boundary_edges;
