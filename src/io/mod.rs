//! Bytes to geometry and back: STL, OBJ, PLY, XYZ, OFF and 3MF in; STL, OBJ, PLY, OFF and XYZ out, and
//! layers as SVG, DXF, JSON and 3MF, voxels as VOX and NRRD.
//!
//! Files come as they are found. What is damaged in part gives what is readable, with [`Warning`]s; what is
//! damaged in whole gives a [`ReadError`]. No input makes a reader panic, and none makes it take memory beyond
//! a small multiple of the input's size (of the unpacked size for 3MF, itself bounded).
mod decimal;
mod error;
mod obj;
mod off;
mod parsed;
mod ply;
mod sniff;
mod stl;
mod text;
mod threemf;
mod unit;
mod write;
mod xyz;

pub use error::{Location, ReadError};
pub use unit::{Unit, UnknownUnit};
pub use write::{
    CloudFormat, MeshFormat, MeshResolution, NrrdEncoding, SliceStackError, VoxContent, VoxError,
    write_cloud, write_layer_svg, write_layers_3mf, write_layers_dxf, write_layers_json, write_layers_svg,
    write_nrrd, write_soup, write_vox,
};
pub use write::{write_material_library, write_textured_obj};

use crate::data::{PointCloud, TriangleSoup, Warning};
use std::fmt;

/// A format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    Stl,
    Obj,
    Ply,
    Xyz,
    Off,
    ThreeMf,
}

impl Format {
    pub fn name(self) -> &'static str {
        match self {
            Format::Stl => "STL",
            Format::Obj => "OBJ",
            Format::Ply => "PLY",
            Format::Xyz => "XYZ",
            Format::Off => "OFF",
            Format::ThreeMf => "3MF",
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What a file holds: triangles if there are any, else points.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    Soup(TriangleSoup),
    Cloud(PointCloud),
}

/// What [`read`] returns: never empty, in millimetres.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    pub geometry: Geometry,
    pub format: Format,
    /// What was put right or left out, at most one for each kind.
    pub warnings: Vec<Warning>,
}

/// How to read what a file does not say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// Unit of the coordinates; 3MF says its own, for which this is ignored.
    pub unit: Unit,
}

/// Reads triangles or points from a file's content, in millimetres; the format is told from the content.
///
/// ```
/// use fast_winding::io::{Geometry, read};
/// let file = b"v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n";
/// let Geometry::Soup(soup) = read(file)?.geometry else { panic!("a file with faces is a soup") };
/// assert_eq!(soup.len(), 2);
/// # Ok::<(), fast_winding::io::ReadError>(())
/// ```
///
/// # Errors
/// If and only if the format is unknown, the content breaks its format beyond what can be skipped, or no
/// usable triangle or point is left.
pub fn read(bytes: &[u8]) -> Result<Imported, ReadError> {
    read_with(bytes, &ReadOptions::default())
}

/// As [`read`], with the unit given.
///
/// # Errors
/// As [`read`].
pub fn read_with(bytes: &[u8], options: &ReadOptions) -> Result<Imported, ReadError> {
    let format = sniff::format_of(bytes)?;
    let parsed = match format {
        Format::Stl => stl::read(bytes),
        Format::Obj => obj::read(bytes),
        Format::Ply => ply::read(bytes),
        Format::Xyz => xyz::read(bytes),
        Format::Off => off::read(bytes),
        Format::ThreeMf => threemf::read(bytes),
    }?;
    // What 3MF gives is in millimetres already.
    let scale = if format == Format::ThreeMf { 1.0 } else { options.unit.millimetres() };
    parsed.import(format, scale)
}
