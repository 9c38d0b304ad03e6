//! Near fields of the dual-tree evaluator: for blocks of queries, in 32-bit floats relative to the block wherever that is safe.
mod angles;
mod dipoles;
mod triangles;
