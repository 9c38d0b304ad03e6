//! What only clouds without normals or areas need is split off this WebAssembly after it is compiled, and loaded by the
//! package when it is first needed (`pkg-config/tools/split.mjs`).
use wasm_bindgen::prelude::*;

#[wasm_bindgen(raw_module = "../clouds.js")]
extern "C" {
    /// Puts the functions of that part in place, for the thread that calls; stubs of these functions call it too.
    #[wasm_bindgen(js_name = placeClouds)]
    fn place();
}

/// Puts what clouds need in place, for the thread that calls: done once, so that what is missing is missed before a call.
#[wasm_bindgen(js_name = placeClouds)]
pub fn place_clouds() {
    place();
}
