use super::write_vector;
use crate::math::Vec3;
use std::io::{self, Write};

pub(super) fn write(points: &[Vec3], normals: Option<&[Vec3]>, out: &mut impl Write) -> io::Result<()> {
    for (index, point) in points.iter().enumerate() {
        write_vector(*point, out)?;
        if let Some(normals) = normals {
            write!(out, " ")?;
            write_vector(normals[index], out)?;
        }
        writeln!(out)?;
    }
    Ok(())
}
