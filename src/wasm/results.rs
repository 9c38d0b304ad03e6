//! What the features return, as JavaScript objects of typed arrays.
use super::convert::{bytes_to, numbers_to, triangles_to, triple_to, vectors_to};
use super::failure::{Failure, object};
use super::options::VoxelFormat;
use crate::data::{Grid, Lattice, Layer, Polygon, Ring, SurfaceMesh};
use crate::math::{Aabb, Vec3};
use crate::solid::Voxels;
use js_sys::{Array, Float64Array, Object};
use wasm_bindgen::JsValue;

/// `{ positions, normals, indices, origin }`.
pub fn mesh_to(mesh: &SurfaceMesh) -> Result<Object, Failure> {
    let origin = Aabb::around(mesh.positions.iter().copied()).narrowing_origin();
    Ok(object([
        ("positions", vectors_to(&mesh.positions, origin)?.into()),
        ("normals", vectors_to(&mesh.normals, Vec3::ZERO)?.into()),
        ("indices", triangles_to(&mesh.triangles)?.into()),
        ("origin", numbers_to(&origin.to_array())?.into()),
    ]))
}

/// `{ positions, origin, count }` of line segments.
pub fn segments_to(segments: &[[Vec3; 2]]) -> Result<Object, Failure> {
    let ends = segments.as_flattened();
    let origin = Aabb::around(ends.iter().copied()).narrowing_origin();
    Ok(object([
        ("positions", vectors_to(ends, origin)?.into()),
        ("origin", numbers_to(&origin.to_array())?.into()),
        ("count", segments.len().into()),
    ]))
}

fn counts_to(counts: &[usize]) -> JsValue {
    counts.iter().map(|&count| JsValue::from(count)).collect::<Array>().into()
}

/// The entries `counts`, `origin` and `spacing`.
pub fn lattice_to(lattice: &Lattice) -> [(&'static str, JsValue); 3] {
    [
        ("counts", counts_to(&lattice.counts)),
        ("origin", triple_to(lattice.origin)),
        ("spacing", triple_to(lattice.spacing)),
    ]
}

/// `{ counts, origin, spacing, inside, count, volume, surface? }`.
pub fn voxels_to(voxels: &Voxels, format: VoxelFormat, surface: bool) -> Result<Object, Failure> {
    let inside = match format {
        VoxelFormat::Bytes => bytes_to(&voxels.to_bytes()?)?,
        VoxelFormat::Bits => bytes_to(voxels.bits())?,
    };
    let [counts, origin, spacing] = lattice_to(voxels.lattice());
    let surface = surface.then(|| voxels.surface()).transpose()?.as_ref().map(mesh_to).transpose()?;
    Ok(object([
        counts,
        origin,
        spacing,
        ("inside", inside.into()),
        ("count", voxels.count().into()),
        ("volume", voxels.volume().into()),
        ("surface", surface.map_or(JsValue::UNDEFINED, JsValue::from)),
    ]))
}

fn ring_to(ring: &Ring) -> Result<Float64Array, Failure> {
    let numbers: Vec<f64> = ring.iter().flat_map(|p| p.to_array()).collect();
    numbers_to(&numbers)
}

fn polygon_to(polygon: &Polygon) -> Result<JsValue, Failure> {
    let holes = polygon.holes.iter().map(ring_to).collect::<Result<Array, _>>()?;
    Ok(object([("outer", ring_to(&polygon.outer)?.into()), ("holes", holes.into())]).into())
}

fn layer_to(layer: &Layer) -> Result<JsValue, Failure> {
    let polygons = layer.polygons.iter().map(polygon_to).collect::<Result<Array, _>>()?;
    Ok(object([
        ("zBottom", layer.z_bottom.into()),
        ("zTop", layer.z_top.into()),
        ("zSample", layer.z_sample.into()),
        ("polygons", polygons.into()),
    ])
    .into())
}

/// An array of `{ zBottom, zTop, zSample, polygons: [{ outer, holes }] }`.
pub fn layers_to(layers: &[Layer]) -> Result<Array, Failure> {
    layers.iter().map(layer_to).collect()
}

/// `{ counts, origin, spacing, z, values }` of a grid of one layer.
pub fn heat_map_to(map: &Grid<f64>) -> Result<Object, Failure> {
    let lattice = &map.lattice;
    let pair = |v: Vec3| JsValue::from([v.x, v.y].map(JsValue::from).iter().collect::<Array>());
    Ok(object([
        ("counts", counts_to(&lattice.counts[..2])),
        ("origin", pair(lattice.origin)),
        ("spacing", pair(lattice.spacing)),
        ("z", lattice.origin.z.into()),
        ("values", numbers_to(&map.values)?.into()),
    ]))
}
