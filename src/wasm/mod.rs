//! The core as JavaScript calls it: convert, call, convert. Nothing here knows geometry.
//!
//! What is exported is the interface between the WebAssembly and the package's own TypeScript, which users see.
mod convert;
mod failure;
#[cfg(feature = "faults")]
mod faults;
mod handle;
mod job;
mod options;
#[cfg(feature = "pieces")]
mod pieces;
mod printing;
mod queries;
mod results;

pub use handle::Handle;
pub use job::Job;
#[cfg(target_feature = "atomics")]
pub use wasm_bindgen_rayon::init_thread_pool;

use wasm_bindgen::prelude::*;

/// The version of this crate.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// One layer as a file.
///
/// # Errors
/// If and only if `layer` is no layer or `format` is not `svg`.
#[wasm_bindgen(js_name = exportLayer)]
pub fn export_layer(layer: JsValue, format: &str) -> Result<js_sys::Uint8Array, JsValue> {
    if format != "svg" {
        return Err(
            failure::Failure::invalid(format!("unknown format '{format}': layers can be 'svg'")).into()
        );
    }
    let layer = options::layer_from(layer)?;
    let mut bytes = Vec::new();
    crate::io::write_layer_svg(&layer, &mut bytes).expect("a vector takes any bytes");
    Ok(convert::bytes_to(&bytes)?)
}
