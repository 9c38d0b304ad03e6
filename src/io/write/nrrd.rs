//! NRRD, *nearly raw raster data*, as teem.sourceforge.net/nrrd/format.html describes it: a header of text, a byte for each voxel.
use super::Shortest;
use crate::data::VoxelRows;
use crate::math::Vec3;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::{self, BufWriter, Write};

/// How the voxels of a NRRD file are packed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum NrrdEncoding {
    #[default]
    Gzip,
    Raw,
}

/// Writes voxels as NRRD, 0 or 1 each, with their places in millimetres: `space origin` is the centre of the first voxel.
///
/// # Errors
/// If and only if `out` refuses to be written to.
pub fn write_nrrd(voxels: &dyn VoxelRows, encoding: NrrdEncoding, out: &mut impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let lattice = voxels.lattice();
    let [nx, ny, nz] = lattice.counts;
    let [x, y, z] = lattice.spacing.to_array();
    let axes = [Vec3::X * x, Vec3::Y * y, Vec3::Z * z].map(Vector);
    let encoded = match encoding {
        NrrdEncoding::Gzip => "gzip",
        NrrdEncoding::Raw => "raw",
    };
    write!(
        out,
        "NRRD0005\n# 1 is inside\ntype: uint8\ndimension: 3\nspace: 3D-right-handed\nsizes: {nx} {ny} {nz}\n\
         space directions: {} {} {}\nspace origin: {}\nspace units: \"mm\" \"mm\" \"mm\"\n\
         centers: cell cell cell\nkinds: domain domain domain\nencoding: {encoded}\n\n",
        axes[0],
        axes[1],
        axes[2],
        Vector(lattice.origin)
    )?;
    match encoding {
        NrrdEncoding::Raw => write_rows(voxels, &mut out)?,
        NrrdEncoding::Gzip => {
            let mut packed = GzEncoder::new(&mut out, Compression::fast());
            write_rows(voxels, &mut packed)?;
            packed.finish()?;
        }
    }
    out.flush()
}

fn write_rows(voxels: &dyn VoxelRows, out: &mut dyn Write) -> io::Result<()> {
    let [nx, ny, nz] = voxels.lattice().counts;
    let mut row = vec![0; nx];
    for (j, k) in (0..nz).flat_map(|k| (0..ny).map(move |j| (j, k))) {
        voxels.row([0, j, k], &mut row);
        out.write_all(&row)?;
    }
    Ok(())
}

/// A vector as the format has it.
struct Vector(Vec3);

impl std::fmt::Display for Vector {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.0.to_array().map(Shortest);
        write!(f, "({x},{y},{z})")
    }
}
