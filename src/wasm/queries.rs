//! The features: questions of JavaScript to the field of a handle.
use super::convert::{bytes_to, numbers_to, points_from};
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::options::{self, AccuracyOptions};
use crate::winding::Accuracy;
use js_sys::{Date, Float64Array, Object, Uint8Array};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Handle {
    /// Builds the tree: `{ milliseconds, bytes, method, … }`.
    ///
    /// # Errors
    /// If and only if a cloud has no normals, an option is out of range or the call is aborted.
    pub fn prepare(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: AccuracyOptions = options::from_js(options)?;
        let start = Date::now();
        let config = options.field_config()?;
        let field = self.field(config, job)?;
        options.accuracy(Accuracy::of_paper(field.shape()))?;
        let report = field.report();
        Ok(object([
            ("milliseconds", (Date::now() - start).into()),
            ("bytes", report.bytes.into()),
            ("method", report.method.into()),
        ]))
    }

    /// Winding numbers at points xyzxyz….
    ///
    /// # Errors
    /// If and only if a cloud has no normals, an argument is wrong, memory does not suffice or the call is aborted.
    #[wasm_bindgen(js_name = windingNumbers)]
    pub fn winding_numbers(
        &mut self,
        points: JsValue,
        options: JsValue,
        job: &Job,
    ) -> Result<Float64Array, JsValue> {
        let options: AccuracyOptions = options::from_js(options)?;
        let points = points_from("points", &points)?;
        let field = self.field(None, job)?;
        let accuracy = options.accuracy(Accuracy::of_paper(field.shape()))?;
        let values = field.evaluate(&points, accuracy, job).map_err(Failure::from)?;
        Ok(numbers_to(&values)?)
    }

    /// 1 for each of the points xyzxyz… that is inside, else 0.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    pub fn contains(&mut self, points: JsValue, _options: JsValue, job: &Job) -> Result<Uint8Array, JsValue> {
        let points = points_from("points", &points)?;
        let inside = self.field(None, job)?.contains(&points, job).map_err(Failure::from)?;
        let bytes: Vec<u8> = inside.into_iter().map(u8::from).collect();
        Ok(bytes_to(&bytes)?)
    }
}
