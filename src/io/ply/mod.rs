//! PLY: text or binary in either byte order; faces of any number of corners and triangle strips, or points with
//! their normals. Other elements and properties are passed over.
//!
//! Written here rather than taken from `ply-rs-bw`, which gives nothing of a cut file and reads a property at a
//! time through a map of names.
mod body;
mod header;
mod values;

use super::ReadError;
use super::parsed::Parsed;

/// Reads faces; in a file that declares no faces the vertices are a cloud.
pub(super) fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let header = header::read(bytes)?;
    body::read(bytes, &header)
}

#[cfg(test)]
mod tests;
