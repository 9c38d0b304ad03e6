//! Repair for JavaScript: a new shape, and what was changed.
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::options::from_js;
use super::printing::plain;
use crate::check::CheckConfig;
use crate::data::Parts;
use crate::repair::{ConserveConfig, RemeshConfig, RepairError, Repaired, conserve, remesh};
use js_sys::{Object, Uint32Array};
use serde::Deserialize;
use wasm_bindgen::prelude::*;

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum MethodName {
    #[default]
    Conserve,
    Remesh,
}

/// How a shape is to be repaired.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
struct RepairOptions {
    method: Option<MethodName>,
    resolution: Option<usize>,
    spacing: Option<f64>,
    /// 0 keeps no edge sharp.
    sharp: Option<f64>,
    min_component: Option<f64>,
    tolerance: Option<f64>,
    orient: Option<bool>,
    least_agreement: Option<f64>,
    fallback: Option<bool>,
    check: Option<bool>,
}

impl RepairOptions {
    fn remeshing(&self) -> RemeshConfig {
        let default = RemeshConfig::default();
        RemeshConfig {
            resolution: self.resolution,
            spacing: self.spacing,
            sharp: self.sharp.map_or(default.sharp, |degrees| Some(degrees).filter(|d| *d != 0.0)),
            min_component: self.min_component,
        }
    }

    fn conserving(&self) -> ConserveConfig {
        let default = ConserveConfig::default();
        ConserveConfig {
            tolerance: self.tolerance,
            orient: self.orient.unwrap_or(default.orient),
            least_agreement: self.least_agreement.unwrap_or(default.least_agreement),
            fallback: self.fallback.unwrap_or(true).then(|| self.remeshing()),
        }
    }
}

#[wasm_bindgen]
impl Handle {
    /// A closed manifold that bounds {w ≥ 1/2}: `{ handle, report, sources, before, after }`, the last two as [`Handle::check`] gives them,
    /// unless they are not wanted; nothing is before of a cloud.
    ///
    /// # Errors
    /// If and only if a cloud has no normals, an option is out of range, nothing is inside, memory does not suffice or the call is
    /// aborted.
    pub fn repair(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: RepairOptions = from_js(options)?;
        let is_cloud = self.soup().is_none();
        let method =
            options.method.unwrap_or(if is_cloud { MethodName::Remesh } else { MethodName::Conserve });
        let is_checked = options.check != Some(false);
        let monitor = &Parts::new(job);
        monitor.begin(0.0, if is_checked { 0.7 } else { 1.0 });
        let field = self.field(None, job)?;
        let made = match method {
            MethodName::Conserve => conserve(field, &options.conserving(), monitor),
            MethodName::Remesh => remesh(field, &options.remeshing(), monitor),
        };
        let Repaired { soup, sources, report } = made.map_err(Failure::from)?;
        let mut made = Handle::of_soup(soup, "repaired");
        let (mut before, mut after) = (JsValue::UNDEFINED, JsValue::UNDEFINED);
        if is_checked {
            if !is_cloud {
                monitor.begin(0.7, 0.85);
                before = self.checked(&CheckConfig::default(), job, monitor)?;
            }
            monitor.begin(0.85, 1.0);
            after = made.checked(&CheckConfig::default(), job, monitor)?;
        }
        Ok(object([
            ("handle", made.into()),
            ("report", plain(&report)?),
            ("sources", Uint32Array::from(&sources[..]).into()),
            ("before", before),
            ("after", after),
        ]))
    }
}

impl From<RepairError> for Failure {
    fn from(error: RepairError) -> Failure {
        match error {
            RepairError::Field(field) => field.into(),
            RepairError::Surface(surface) => surface.into(),
            RepairError::Empty => Failure::new("EmptyInput", error),
            RepairError::CloudConserved | RepairError::BadTolerance(_) | RepairError::BadAgreement(_) => {
                Failure::invalid(error)
            }
        }
    }
}
