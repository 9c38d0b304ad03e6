//! Fields as bytes and back.
use super::convert::{bytes_from, bytes_to};
use super::failure::Failure;
use super::handle::Handle;
use super::job::Job;
use crate::winding::{WindingField, is_saved_field as begins_as_saved};
use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;

/// What shapes say their format is that were made of a saved field.
pub const SAVED: &str = "field";

/// Whether bytes begin as those of a saved field do.
pub fn is_saved_field(bytes: &Uint8Array) -> bool {
    let mut first = [0; 8];
    let enough = bytes.length() >= 8;
    if enough {
        bytes.subarray(0, 8).copy_to(&mut first);
    }
    enough && begins_as_saved(&first)
}

#[wasm_bindgen]
impl Handle {
    /// The shape and its field as bytes, of which [`Handle::parse`] makes it again.
    ///
    /// # Errors
    /// If and only if a cloud has no normals, memory does not suffice or the call is aborted.
    pub fn save(&mut self, job: &Job) -> Result<Uint8Array, JsValue> {
        let mut bytes = Vec::new();
        self.field(None, job)?.save(&mut bytes).expect("a vector takes any bytes");
        Ok(bytes_to(&bytes)?)
    }
}

impl Handle {
    pub(super) fn load(bytes: &Uint8Array, kind: Option<String>) -> Result<Handle, Failure> {
        Handle::of_field(WindingField::load(&bytes_from(bytes)?)?, kind)
    }
}
