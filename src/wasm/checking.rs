//! What is wrong with a soup, and faces turned outward, for JavaScript.
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::printing::{known, plain};
use crate::check::{CheckConfig, CheckError, check};
use crate::data::Monitor;
use crate::orient::{FaceConfig, orient_soup};
use js_sys::{Array, Object, Reflect, Uint32Array};
use wasm_bindgen::prelude::*;

/// Lists of a report that hold numbers or pairs of numbers: flat arrays for JavaScript.
const INDEX_LISTS: [&str; 12] = [
    "duplicateFaces",
    "degenerateFaces",
    "sliverFaces",
    "nonManifoldEdges",
    "nonManifoldVertices",
    "inconsistentEdges",
    "selfIntersections",
    "flippedFaces",
    "internalFaces",
    "outsideFaces",
    "thickness.thinFaces",
    "overhangs.faces",
];

impl Handle {
    /// What [`Handle::check`] gives, as a part of another call.
    pub(super) fn checked(
        &mut self,
        config: &CheckConfig,
        job: &Job,
        monitor: &dyn Monitor,
    ) -> Result<JsValue, JsValue> {
        if self.soup().is_none() {
            return Err(Failure::invalid("a cloud has no faces to check: only soups have").into());
        }
        let report = check(self.field(None, job)?, config, monitor).map_err(Failure::from)?;
        let result = plain(&report)?;
        for path in INDEX_LISTS {
            // What was not asked for is absent, and has no parts.
            let part = |at: JsValue, name: &str| {
                if at.is_object() { Reflect::get(&at, &name.into()) } else { Ok(at) }
            };
            let defects = path.split('.').try_fold(result.clone(), part)?;
            if defects.is_object() {
                flatten(&defects, "list")?;
            }
        }
        let loops = Reflect::get(&Reflect::get(&result, &"boundary".into())?, &"loops".into())?;
        for one in Reflect::get(&loops, &"list".into())?.unchecked_into::<Array>().iter() {
            flatten(&one, "vertices")?;
        }
        Ok(result)
    }
}

#[wasm_bindgen]
impl Handle {
    /// What is wrong with a soup: a [`crate::check::CheckReport`], lists of indices as arrays of numbers, two for each edge and pair.
    ///
    /// # Errors
    /// If and only if this is a cloud, an option is out of range, memory does not suffice or the call is aborted.
    pub fn check(&mut self, options: JsValue, job: &Job) -> Result<JsValue, JsValue> {
        self.checked(&known(options)?, job, job)
    }

    /// Turns the faces of a soup outward: `{ flipped, patches, closedPatches, oneSidedPatches, method }`. The field of before is gone.
    ///
    /// # Errors
    /// If and only if this is a cloud, an option is out of range or the call is aborted.
    #[wasm_bindgen(js_name = orientFaces)]
    pub fn orient_faces(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let config: FaceConfig = known(options)?;
        let soup =
            self.soup().ok_or_else(|| Failure::invalid("a cloud has no faces to turn: only soups have"))?;
        let (soup, report) = orient_soup(soup, &config, job).map_err(Failure::from)?;
        self.replace_soup(soup);
        Ok(object([
            ("flipped", Uint32Array::from(&report.flipped[..]).into()),
            ("patches", report.patches.into()),
            ("closedPatches", report.closed_patches.into()),
            ("oneSidedPatches", report.one_sided_patches.into()),
            ("method", report.method.into()),
        ]))
    }
}

/// Makes one array of numbers of a property that is an array of numbers, or of arrays of them.
fn flatten(holder: &JsValue, name: &str) -> Result<(), JsValue> {
    let list: Array = Reflect::get(holder, &name.into())?.unchecked_into();
    let flat = list.flat(1);
    Reflect::set(holder, &name.into(), &Uint32Array::new(&flat))?;
    Ok(())
}

impl From<CheckError> for Failure {
    fn from(error: CheckError) -> Failure {
        match error {
            CheckError::Field(error) => error.into(),
            CheckError::Cancelled(cancelled) => cancelled.into(),
            CheckError::Cloud { .. } | CheckError::Setting { .. } => Failure::invalid(error),
        }
    }
}
