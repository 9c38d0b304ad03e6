//! STL, binary and text: loose triangles, three vertices each. The stored normals are not used: they add nothing
//! to the order of the corners, and are often wrong.
//!
//! Written here rather than taken from `stl_io`, which refuses files whose count is off or whose end is cut.
mod ascii;
mod binary;

pub(super) use binary::is_binary;

use super::ReadError;
use super::parsed::Parsed;

pub(super) fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    if is_binary(bytes) { Ok(binary::read(bytes)) } else { ascii::read(bytes) }
}
