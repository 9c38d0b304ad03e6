use super::vertices;
use crate::data::TriangleSoup;
use crate::math::Vec3;
use std::io::{self, Write};

/// The type all numbers of a file are written in.
#[derive(Clone, Copy)]
enum Scalar {
    Float,
    Double,
}

impl Scalar {
    /// The shorter type that holds all `vectors` exactly.
    fn exact_for(mut vectors: impl Iterator<Item = Vec3>) -> Scalar {
        let fits = |v: Vec3| v.as_vec3().as_dvec3() == v;
        if vectors.all(fits) { Scalar::Float } else { Scalar::Double }
    }

    fn name(self) -> &'static str {
        match self {
            Scalar::Float => "float",
            Scalar::Double => "double",
        }
    }

    fn declare(self, names: &[&str], out: &mut impl Write) -> io::Result<()> {
        names.iter().try_for_each(|name| writeln!(out, "property {} {name}", self.name()))
    }

    fn write(self, v: Vec3, out: &mut impl Write) -> io::Result<()> {
        v.to_array().iter().try_for_each(|c| match self {
            Scalar::Float => out.write_all(&(*c as f32).to_le_bytes()),
            Scalar::Double => out.write_all(&c.to_le_bytes()),
        })
    }
}

fn begin(vertices: usize, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment millimetres, written by fast-winding")?;
    writeln!(out, "element vertex {vertices}")
}

pub(super) fn write_soup(soup: &TriangleSoup, out: &mut impl Write) -> io::Result<()> {
    let scalar = Scalar::exact_for(vertices(soup));
    begin(soup.positions().len(), out)?;
    scalar.declare(&["x", "y", "z"], out)?;
    writeln!(out, "element face {}\nproperty list uchar uint vertex_indices\nend_header", soup.len())?;
    vertices(soup).try_for_each(|vertex| scalar.write(vertex, out))?;
    for corners in soup.triangles() {
        out.write_all(&[3])?;
        corners.iter().try_for_each(|index| out.write_all(&index.to_le_bytes()))?;
    }
    Ok(())
}

pub(super) fn write_cloud(points: &[Vec3], normals: Option<&[Vec3]>, out: &mut impl Write) -> io::Result<()> {
    let all = points.iter().chain(normals.unwrap_or_default()).copied();
    let scalar = Scalar::exact_for(all);
    begin(points.len(), out)?;
    scalar.declare(&["x", "y", "z"], out)?;
    if normals.is_some() {
        scalar.declare(&["nx", "ny", "nz"], out)?;
    }
    writeln!(out, "end_header")?;
    for (index, point) in points.iter().enumerate() {
        scalar.write(*point, out)?;
        if let Some(normals) = normals {
            scalar.write(normals[index], out)?;
        }
    }
    Ok(())
}
