//! Options as JavaScript gives them, to what the core takes.
mod slices;
mod voxels;

use super::failure::{Failure, object};
use crate::data::Warning;
use crate::io::{self, CloudFormat, MeshFormat};
use crate::orient::{ConsistencyConfig, OrientMethod, StochasticConfig, Widths};
use crate::surface::SurfaceConfig;
use crate::winding::{Accuracy, FieldConfig, Order};
use serde::{Deserialize, de::DeserializeOwned};
pub use slices::{SliceOptions, layer_from};
pub use voxels::{VoxelFormat, VoxelOptions, lattice_of};
use wasm_bindgen::JsValue;

/// Options from a JavaScript object; `undefined` gives the defaults.
pub fn from_js<T: DeserializeOwned + Default>(options: JsValue) -> Result<T, Failure> {
    if options.is_undefined() || options.is_null() {
        return Ok(T::default());
    }
    serde_wasm_bindgen::from_value(options).map_err(|error| Failure::invalid(format!("bad options: {error}")))
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Orient {
    Auto,
}

#[derive(Default, Deserialize)]
pub struct CloudOptions {
    pub orient: Option<Orient>,
}

#[derive(Default, Deserialize)]
pub struct ReadOptions {
    unit: Option<String>,
    pub orient: Option<Orient>,
}

impl ReadOptions {
    pub fn for_io(&self) -> Result<io::ReadOptions, Failure> {
        let unit =
            self.unit.as_deref().map_or(Ok(io::Unit::default()), str::parse).map_err(Failure::invalid)?;
        Ok(io::ReadOptions { unit })
    }
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct OrientOptions {
    method: Option<String>,
    noise_level: Option<f64>,
}

impl OrientOptions {
    pub fn method(&self) -> Result<OrientMethod, Failure> {
        match self.method.as_deref() {
            None | Some("consistency") => {
                let widths = self.noise_level.map(widths_of).transpose()?;
                Ok(OrientMethod::Consistency(ConsistencyConfig { widths, ..Default::default() }))
            }
            Some("stochastic") => Ok(OrientMethod::Stochastic(StochasticConfig::default())),
            Some("propagation") => Ok(OrientMethod::Propagation),
            Some(other) => Err(Failure::invalid(format!(
                "unknown method '{other}': 'consistency', 'stochastic' and 'propagation' are known"
            ))),
        }
    }
}

fn widths_of(level: f64) -> Result<Widths, Failure> {
    let known = Widths::ALL.into_iter().enumerate().find(|(k, _)| *k as f64 == level);
    known
        .map(|(_, widths)| widths)
        .ok_or_else(|| Failure::invalid(format!("noiseLevel is {level}: 0, 1, 2, 3, 4 and 5 are known")))
}

/// How winding numbers are to be computed.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct AccuracyOptions {
    tolerance: Option<f64>,
    order: Option<u8>,
    beta: Option<f64>,
    leaf_size: Option<usize>,
    bounded: Option<bool>,
}

impl AccuracyOptions {
    /// `of_paper` completes an order or a β that comes alone.
    pub fn accuracy(&self, of_paper: Accuracy) -> Result<Accuracy, Failure> {
        let Accuracy::Explicit { order, beta } = of_paper else { return Ok(of_paper) };
        let order = match self.order {
            None => order,
            Some(0) => Order::Zero,
            Some(1) => Order::One,
            Some(2) => Order::Two,
            Some(other) => return Err(Failure::invalid(format!("order {other}: 0, 1 or 2 is needed"))),
        };
        let beta = self.beta.unwrap_or(beta);
        if !(beta.is_finite() && beta > 0.0) {
            return Err(Failure::invalid(format!("beta {beta}: a finite number above 0 is needed")));
        }
        match self.tolerance {
            Some(t) if !(t.is_finite() && t >= 0.0) => {
                Err(Failure::invalid(format!("tolerance {t}: a finite number from 0 is needed")))
            }
            Some(t) => Ok(Accuracy::Tolerance(t)),
            None if self.order.is_none() && self.beta.is_none() => Ok(Accuracy::default()),
            None => Ok(Accuracy::Explicit { order, beta }),
        }
    }

    pub fn field_config(&self) -> Result<Option<FieldConfig>, Failure> {
        if self.leaf_size == Some(0) {
            return Err(Failure::invalid("leafSize 0: 1 or more is needed"));
        }
        let default = FieldConfig::default();
        let config = FieldConfig {
            leaf_size: self.leaf_size.unwrap_or(default.leaf_size),
            bounded: self.bounded.unwrap_or(default.bounded),
        };
        Ok((self.leaf_size.is_some() || self.bounded.is_some()).then_some(config))
    }
}

/// How fine a surface is wanted, and at which winding number.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SurfaceOptions {
    resolution: Option<usize>,
    spacing: Option<f64>,
    level: Option<f64>,
    min_component: Option<f64>,
    smoothing: Option<f64>,
    trim: Option<f64>,
    sharp: Option<f64>,
}

impl SurfaceOptions {
    pub fn config(&self) -> SurfaceConfig {
        SurfaceConfig {
            resolution: self.resolution,
            spacing: self.spacing,
            level: self.level,
            min_component: self.min_component,
            smoothing: self.smoothing,
            trim: self.trim,
            sharp: self.sharp,
        }
    }
}

/// Which plane is wanted, and how fine.
#[derive(Default, Deserialize)]
pub struct HeatMapOptions {
    z: Option<f64>,
    resolution: Option<usize>,
}

impl HeatMapOptions {
    const RESOLUTION: usize = 128;

    pub fn z(&self) -> Result<f64, Failure> {
        self.z.filter(|z| z.is_finite()).ok_or_else(|| Failure::invalid("z must be given, and finite"))
    }

    pub fn resolution(&self) -> usize {
        self.resolution.unwrap_or(HeatMapOptions::RESOLUTION)
    }
}

pub fn mesh_format(name: &str) -> Result<MeshFormat, Failure> {
    match name {
        "stl" => Ok(MeshFormat::Stl),
        "obj" => Ok(MeshFormat::Obj),
        "ply" => Ok(MeshFormat::Ply),
        "off" => Ok(MeshFormat::Off),
        "3mf" => Ok(MeshFormat::ThreeMf),
        _ => Err(Failure::invalid(format!(
            "unknown format '{name}': soups can be 'stl', 'obj', 'ply', 'off' or '3mf'"
        ))),
    }
}

pub fn cloud_format(name: &str) -> Result<CloudFormat, Failure> {
    match name {
        "ply" => Ok(CloudFormat::Ply),
        "xyz" => Ok(CloudFormat::Xyz),
        _ => Err(Failure::invalid(format!("unknown format '{name}': clouds can be 'ply' or 'xyz'"))),
    }
}

/// `{ code, count, message }`.
pub fn warning_to(warning: &Warning) -> JsValue {
    let code = serde_wasm_bindgen::to_value(&warning.kind).expect("a kind is a name");
    object([("code", code), ("count", warning.count.into()), ("message", warning.to_string().into())]).into()
}
