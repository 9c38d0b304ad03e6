//! Geometry to bytes. Coordinates are in millimetres.
mod dxf;
mod json;
mod nrrd;
mod obj;
mod off;
mod ply;
mod stl;
mod svg;
mod textured;
mod threemf;
mod vox;
mod xyz;

pub use dxf::write_layers_dxf;
pub use json::write_layers_json;
pub use nrrd::{NrrdEncoding, write_nrrd};
pub use svg::{write_layer_svg, write_layers_svg};
pub use textured::{write_material_library, write_textured_obj};
pub use threemf::{MeshResolution, SliceStackError, write_layers_3mf};
pub use vox::{VoxContent, VoxError, write_vox};

use crate::data::{Polygon, Ring, TriangleSoup};
use crate::math::Vec3;
use std::fmt;
use std::io::{self, BufWriter, Write};

/// A format that triangles can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// Binary; coordinates are rounded to `f32`.
    Stl,
    /// Text, exact.
    Obj,
    /// Binary little endian, exact: `double` if `float` cannot hold every coordinate.
    Ply,
    /// Text, exact.
    Off,
    /// Packed text, exact; vertices in the same place become one.
    ThreeMf,
}

/// A format that points can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CloudFormat {
    /// Binary little endian, exact: `double` if `float` cannot hold every number.
    Ply,
    /// Text, exact.
    Xyz,
}

/// Writes triangles. Vertices that no triangle uses are kept, for the indices; if not finite, as zero.
///
/// # Errors
/// If and only if `out` refuses to be written to, or 3MF would be larger than 4 GiB.
pub fn write_soup(soup: &TriangleSoup, format: MeshFormat, out: &mut impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    match format {
        MeshFormat::Stl => stl::write(soup, &mut out),
        MeshFormat::Obj => obj::write(soup, &mut out),
        MeshFormat::Ply => ply::write_soup(soup, &mut out),
        MeshFormat::Off => off::write(soup, &mut out),
        MeshFormat::ThreeMf => threemf::write_mesh_3mf(soup, &mut out),
    }?;
    out.flush()
}

/// Writes points, with their normals if given.
///
/// # Panics
/// If there are not as many normals as points.
///
/// # Errors
/// If and only if `out` refuses to be written to.
pub fn write_cloud(
    points: &[Vec3],
    normals: Option<&[Vec3]>,
    format: CloudFormat,
    out: &mut impl Write,
) -> io::Result<()> {
    assert!(normals.is_none_or(|n| n.len() == points.len()), "there must be as many normals as points");
    let mut out = BufWriter::new(out);
    match format {
        CloudFormat::Ply => ply::write_cloud(points, normals, &mut out),
        CloudFormat::Xyz => xyz::write(points, normals, &mut out),
    }?;
    out.flush()
}

/// The vertices of a soup, with zeros for those that are not finite, which no triangle uses.
fn vertices(soup: &TriangleSoup) -> impl Iterator<Item = Vec3> + '_ {
    soup.positions().iter().map(|p| if p.is_finite() { *p } else { Vec3::ZERO })
}

/// The rings of polygons, each outer one before its holes.
fn rings(polygons: &[Polygon]) -> impl Iterator<Item = &Ring> {
    polygons.iter().flat_map(Polygon::rings)
}

/// A number in as few digits as give the same one back.
struct Shortest(f64);

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Plain digits where they are short; 1e300 would take 301 of them.
        match self.0.abs() {
            0.0 | 1e-5..1e16 => write!(f, "{}", self.0),
            _ => write!(f, "{:e}", self.0),
        }
    }
}

/// Writes three numbers with blanks between them.
fn write_vector(v: Vec3, out: &mut impl Write) -> io::Result<()> {
    let [x, y, z] = v.to_array().map(Shortest);
    write!(out, "{x} {y} {z}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_exact() {
        let v = Vec3::new(0.1, -1e-9, 2.5e300);
        let mut text = Vec::new();
        write_vector(v, &mut text).unwrap();
        assert_eq!(text, b"0.1 -1e-9 2.5e300");
    }
}
