//! The core as JavaScript calls it: convert, call, convert. Nothing here knows geometry.
#[cfg(target_feature = "atomics")]
pub use wasm_bindgen_rayon::init_thread_pool;
use wasm_bindgen::prelude::*;

/// The version of this crate.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}
