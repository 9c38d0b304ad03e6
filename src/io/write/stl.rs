use crate::data::TriangleSoup;
use crate::math::{Vec3, area_vector};
use std::io::{self, Write};

/// Must not begin with "solid", which other readers take for text.
const HEADER: &[u8; 80] = b"binary STL, millimetres, written by fast-winding                                ";

pub(super) fn write(soup: &TriangleSoup, out: &mut impl Write) -> io::Result<()> {
    let count = u32::try_from(soup.len()).map_err(|_| {
        io::Error::new(io::ErrorKind::InvalidInput, "STL holds at most 4,294,967,295 triangles")
    })?;
    out.write_all(HEADER)?;
    out.write_all(&count.to_le_bytes())?;
    for corners in (0..soup.len()).map(|triangle| soup.corners(triangle)) {
        write_vector(area_vector(corners).normalize_or_zero(), out)?;
        for corner in corners {
            write_vector(corner, out)?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

fn write_vector(v: Vec3, out: &mut impl Write) -> io::Result<()> {
    v.to_array().iter().try_for_each(|c| out.write_all(&(*c as f32).to_le_bytes()))
}
