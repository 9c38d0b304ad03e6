//! The core as JavaScript calls it: convert, call, convert. Nothing here knows geometry.
//!
//! What is exported is the interface between the WebAssembly and the package's own TypeScript, which users see.
mod boolean;
mod checking;
mod convert;
mod distance;
mod failure;
#[cfg(feature = "faults")]
mod faults;
mod handle;
mod job;
mod layers;
mod options;
#[cfg(feature = "pieces")]
mod pieces;
mod printing;
mod projecting;
mod queries;
mod repairing;
mod results;
mod saving;
mod texture_failure;
mod texture_options;
mod texturing;
mod voxels;

pub use boolean::Operand;
pub use handle::Handle;
pub use job::Job;
pub use texturing::TextureHandle;
#[cfg(target_feature = "atomics")]
pub use wasm_bindgen_rayon::init_thread_pool;

use wasm_bindgen::prelude::*;

/// The version of this crate.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}
