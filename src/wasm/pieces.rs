//! All but fields, voxels and plain files is split off this WebAssembly after it is compiled, and
//! loaded by the package when it is first needed (`pkg-config/tools/split.mjs`).
use wasm_bindgen::prelude::*;

#[wasm_bindgen(raw_module = "../more.js")]
extern "C" {
    /// Puts the functions of that part in place, for the thread that calls; stubs of these functions call it too.
    #[wasm_bindgen(js_name = placeMore)]
    fn place();
}

/// Puts that part in place, for the thread that calls. What asks for it are the stubs, which are made after compiling: without this
/// the import would be gone by then.
#[wasm_bindgen(js_name = placeMore)]
pub fn place_more() {
    place();
}
