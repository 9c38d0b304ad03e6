//! Voxels in bricks, and what is done with voxels that JavaScript holds: compared, drawn, written.
use super::convert::bytes_to;
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::options::{self, VoxelOptions, from_js};
use super::results::{lattice_to, mesh_to};
use crate::data::{Brick, BrickBits, Lattice, VoxelBricks, VoxelRows, Voxels};
use crate::io::{NrrdEncoding, VoxContent, VoxError, write_nrrd, write_vox};
use crate::math::Vec3;
use crate::solid::{self, difference};
use js_sys::{Object, Reflect, Uint8Array, Uint32Array};
use serde::Deserialize;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Handle {
    /// Which cells of a lattice are inside, in bricks: `{ counts, origin, spacing, bricks: { mixed, bits, full }, count, volume }`.
    ///
    /// # Errors
    /// As [`Handle::voxelize`].
    #[wasm_bindgen(js_name = voxelBricks)]
    pub fn voxel_bricks(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: VoxelOptions = options::from_js(options)?;
        let lattice = options.lattice(self.bounds())?;
        let config = options.config(self.of_paper())?;
        let field = self.field(None, job)?;
        let bricks = solid::voxelize_bricks(field, &lattice, &config, job).map_err(Failure::from)?;
        Ok(bricks_to(&bricks, options.surface)?)
    }
}

fn bricks_to(bricks: &VoxelBricks, surface: bool) -> Result<Object, Failure> {
    let [nx, ny, _] = bricks.counts();
    let (mut mixed, mut bits, mut full) = (vec![], vec![], vec![]);
    for ([i, j, k], brick) in bricks.each() {
        let place = ((k * ny + j) * nx + i) as u32;
        match brick {
            Brick::Mixed(own) => {
                mixed.push(place);
                bits.extend_from_slice(own.map(u64::to_le_bytes).as_flattened());
            }
            _ => full.push(place),
        }
    }
    let parts = object([
        ("mixed", Uint32Array::from(&mixed[..]).into()),
        ("bits", bytes_to(&bits)?.into()),
        ("full", Uint32Array::from(&full[..]).into()),
    ]);
    let [counts, origin, spacing] = lattice_to(bricks.lattice());
    let surface = surface.then(|| bricks.surface()).transpose()?.as_ref().map(mesh_to).transpose()?;
    Ok(object([
        counts,
        origin,
        spacing,
        ("bricks", parts.into()),
        ("count", bricks.count().into()),
        ("volume", bricks.volume().into()),
        ("surface", surface.map_or(JsValue::UNDEFINED, JsValue::from)),
    ]))
}

/// Voxels that JavaScript holds.
enum Held {
    Each(Voxels),
    Bricks(VoxelBricks),
}

impl Held {
    fn rows(&self) -> &dyn VoxelRows {
        match self {
            Held::Each(voxels) => voxels,
            Held::Bricks(bricks) => bricks,
        }
    }
}

#[derive(Default, Deserialize)]
struct LatticeObject {
    counts: [usize; 3],
    origin: [f64; 3],
    spacing: [f64; 3],
}

fn get(object: &JsValue, name: &str) -> JsValue {
    Reflect::get(object, &name.into()).unwrap_or(JsValue::UNDEFINED)
}

fn array<T: JsCast>(object: &JsValue, name: &str) -> Result<T, Failure> {
    let class = if name == "bits" || name == "inside" { "Uint8Array" } else { "Uint32Array" };
    get(object, name).dyn_into().map_err(|_| Failure::invalid(format!("voxels: {name} must be a {class}")))
}

fn held_from(voxels: &JsValue) -> Result<Held, Failure> {
    if !voxels.is_object() {
        return Err(Failure::invalid("voxels are needed, as voxelize or voxelBricks gives them"));
    }
    let lattice: LatticeObject = from_js(
        object([
            ("counts", get(voxels, "counts")),
            ("origin", get(voxels, "origin")),
            ("spacing", get(voxels, "spacing")),
        ])
        .into(),
    )?;
    let lattice = Lattice {
        origin: Vec3::from_array(lattice.origin),
        spacing: Vec3::from_array(lattice.spacing),
        counts: lattice.counts,
    };
    let bricks = get(voxels, "bricks");
    if !bricks.is_object() {
        let inside = array::<Uint8Array>(voxels, "inside")?.to_vec();
        // Eight a byte, if there are too few for one each.
        let is_packed = inside.len() != lattice.len() && inside.len() == lattice.len().div_ceil(8);
        return Ok(Held::Each(match is_packed {
            true => Voxels::from_bits(lattice, inside)?,
            false => Voxels::from_bytes(lattice, &inside)?,
        }));
    }
    let numbers = |name: &str| array::<Uint32Array>(&bricks, name).map(|numbers| numbers.to_vec());
    let bytes = array::<Uint8Array>(&bricks, "bits")?.to_vec();
    let (words, left) = bytes.as_chunks::<8>();
    let (bits, over) = words.as_chunks::<8>();
    if !left.is_empty() || !over.is_empty() {
        let message = format!("voxels: {} bytes of bricks: a multiple of 64 is needed", bytes.len());
        return Err(Failure::invalid(message));
    }
    let bits: Vec<BrickBits> = bits.iter().map(|brick| brick.map(u64::from_le_bytes)).collect();
    Ok(Held::Bricks(VoxelBricks::from_parts(lattice, &numbers("mixed")?, &bits, &numbers("full")?)?))
}

/// The faces between inside and outside.
///
/// # Errors
/// If and only if these are no voxels, or memory does not suffice.
#[wasm_bindgen(js_name = voxelSurface)]
pub fn voxel_surface(voxels: &JsValue) -> Result<Object, JsValue> {
    let surface = match held_from(voxels)? {
        Held::Each(voxels) => voxels.surface(),
        Held::Bricks(bricks) => bricks.surface(),
    };
    Ok(mesh_to(&surface.map_err(Failure::from)?)?)
}

/// Which voxels differ: `{ lost, gained, count, intersectionOverUnion }`.
///
/// # Errors
/// If and only if these are no voxels, or not of one lattice.
#[wasm_bindgen(js_name = compareVoxels)]
pub fn compare_voxels(first: &JsValue, second: &JsValue) -> Result<Object, JsValue> {
    let (first, second) = (held_from(first)?, held_from(second)?);
    let found = difference(first.rows(), second.rows()).map_err(Failure::invalid)?;
    let count = match &first {
        Held::Each(voxels) => voxels.count(),
        Held::Bricks(bricks) => bricks.count(),
    };
    Ok(object([
        ("lost", Uint32Array::from(&found.lost[..]).into()),
        ("gained", Uint32Array::from(&found.gained[..]).into()),
        ("count", found.count().into()),
        ("intersectionOverUnion", found.intersection_over_union(count).into()),
    ]))
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
struct ExportOptions {
    #[serde(default)]
    solid: bool,
    #[serde(default)]
    raw: bool,
}

/// Voxels as a file, `vox` or `nrrd`.
///
/// # Errors
/// If and only if these are no voxels, the format is unknown, or the file would be larger than its format allows.
#[wasm_bindgen(js_name = exportVoxels)]
pub fn export_voxels(voxels: &JsValue, format: &str, options: JsValue) -> Result<Uint8Array, JsValue> {
    let options: ExportOptions = from_js(options)?;
    let held = held_from(voxels)?;
    let mut bytes = Vec::new();
    match format {
        "vox" => {
            let content = if options.solid { VoxContent::Solid } else { VoxContent::Shell };
            write_vox(held.rows(), content, &mut bytes).map_err(|error: VoxError| Failure::invalid(error))?;
        }
        "nrrd" => {
            let encoding = if options.raw { NrrdEncoding::Raw } else { NrrdEncoding::Gzip };
            write_nrrd(held.rows(), encoding, &mut bytes).expect("a vector takes any bytes");
        }
        _ => {
            let message = format!("unknown format '{format}': voxels can be 'vox' and 'nrrd'");
            return Err(Failure::invalid(message).into());
        }
    }
    Ok(bytes_to(&bytes)?)
}
