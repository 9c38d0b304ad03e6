//! Layers as files.
use super::convert::{bytes_to, points_from, triangles_from};
use super::failure::Failure;
use super::options::layer_from;
use crate::data::{Layer, TriangleSoup};
use crate::io::{
    MeshResolution, SliceStackError, write_layer_svg, write_layers_3mf, write_layers_dxf, write_layers_json,
    write_layers_svg,
};
use crate::math::Vec3;
use js_sys::{Array, Reflect, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

/// One layer as a file.
///
/// # Errors
/// If and only if `layer` is no layer or `format` is not `svg`.
#[wasm_bindgen(js_name = exportLayer)]
pub fn export_layer(layer: JsValue, format: &str) -> Result<Uint8Array, JsValue> {
    if format != "svg" {
        return Err(Failure::invalid(format!("unknown format '{format}': layers can be 'svg'")).into());
    }
    let mut bytes = Vec::new();
    write_layer_svg(&layer_from(layer)?, &mut bytes).map_err(Failure::invalid)?;
    Ok(bytes_to(&bytes)?)
}

/// Layers as one file. As 3MF they need a mesh beside them: `{ positions, indices, origin }`.
///
/// # Errors
/// If and only if `layers` are none, `format` is unknown, or as 3MF layers do not rise or there is no mesh.
#[wasm_bindgen(js_name = exportLayers)]
pub fn export_layers(layers: &Array, format: &str, mesh: &JsValue) -> Result<Uint8Array, JsValue> {
    let layers = layers.iter().map(layer_from).collect::<Result<Vec<Layer>, _>>()?;
    let mut bytes = Vec::new();
    let written = match format {
        "svg" => write_layers_svg(&layers, &mut bytes).map_err(SliceStackError::from),
        "dxf" => write_layers_dxf(&layers, &mut bytes).map_err(SliceStackError::from),
        "json" => write_layers_json(&layers, &mut bytes).map_err(SliceStackError::from),
        "3mf" => write_layers_3mf(&layers, &mesh_from(mesh)?, MeshResolution::Full, &mut bytes),
        _ => {
            let known = "layers can be 'svg', 'dxf', 'json' and '3mf'";
            return Err(Failure::invalid(format!("unknown format '{format}': {known}")).into());
        }
    };
    written.map_err(Failure::invalid)?;
    Ok(bytes_to(&bytes)?)
}

fn mesh_from(mesh: &JsValue) -> Result<TriangleSoup, Failure> {
    if !mesh.is_object() {
        return Err(Failure::invalid("3MF requires a mesh beside the layers: { positions, indices }"));
    }
    let get = |name: &str| Reflect::get(mesh, &name.into()).unwrap_or(JsValue::UNDEFINED);
    let mut positions = points_from("positions", &get("positions"))?;
    if !get("origin").is_undefined() {
        let origin = points_from("origin", &get("origin"))?.first().copied().unwrap_or(Vec3::ZERO);
        positions.iter_mut().for_each(|p| *p += origin);
    }
    let indices = get("indices").dyn_into::<Uint32Array>().ok();
    let triangles = triangles_from(indices.as_ref(), positions.len())?;
    TriangleSoup::new(positions, triangles).map_err(Failure::from)
}
