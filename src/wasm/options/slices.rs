//! Options of layers, and layers as JavaScript holds them.
use super::from_js;
use crate::data::{Layer, Polygon, Ring};
use crate::math::Vec2;
use crate::slice::{AdaptiveHeights, LayerPlan, SampleAt, SliceConfig, SliceMode};
use crate::wasm::failure::Failure;
use serde::Deserialize;
use wasm_bindgen::JsValue;

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SampleAtName {
    Bottom,
    Middle,
    Top,
}

/// Which layers are wanted, and how fine.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SliceOptions {
    layer_height: Option<f64>,
    first_layer_height: Option<f64>,
    sample_at: Option<SampleAtName>,
    heights: Option<Vec<f64>>,
    tolerance: Option<f64>,
    resolution: Option<usize>,
    mode: Option<SliceModeName>,
    simplify: Option<f64>,
    adaptive: Option<AdaptiveOptions>,
    /// Bottom, top and sample of each layer of a plan that was made before.
    pub spans: Option<Vec<f64>>,
}

#[derive(Clone, Copy, Deserialize)]
struct AdaptiveOptions {
    least: f64,
    most: f64,
    deviation: f64,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SliceModeName {
    Winding,
    EvenOdd,
    Largest,
}

impl SliceOptions {
    pub fn config(&self) -> SliceConfig {
        let default = SliceConfig::default();
        let mode = self.mode.map(|mode| match mode {
            SliceModeName::Winding => SliceMode::Winding,
            SliceModeName::EvenOdd => SliceMode::EvenOdd,
            SliceModeName::Largest => SliceMode::Largest,
        });
        SliceConfig {
            resolution: self.resolution.unwrap_or(default.resolution),
            spacing: self.tolerance,
            mode: mode.unwrap_or_default(),
            simplify: self.simplify.unwrap_or(default.simplify),
        }
    }

    pub fn plan(self) -> LayerPlan {
        let default = LayerPlan::default();
        let sample_at = self.sample_at.map(|sample_at| match sample_at {
            SampleAtName::Bottom => SampleAt::Bottom,
            SampleAtName::Middle => SampleAt::Middle,
            SampleAtName::Top => SampleAt::Top,
        });
        LayerPlan {
            layer_height: self.layer_height.unwrap_or(default.layer_height),
            first_layer_height: self.first_layer_height,
            sample_at: sample_at.unwrap_or_default(),
            adaptive: self.adaptive.map(|a| AdaptiveHeights {
                least: a.least,
                most: a.most,
                deviation: a.deviation,
            }),
            heights: self.heights,
        }
    }
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
struct LayerObject {
    z_bottom: f64,
    z_top: f64,
    z_sample: f64,
    polygons: Vec<PolygonObject>,
}

#[derive(Deserialize)]
struct PolygonObject {
    outer: Vec<f64>,
    holes: Vec<Vec<f64>>,
}

/// A ring from xyxy….
fn ring_from(numbers: &[f64]) -> Ring {
    numbers.as_chunks().0.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
}

/// A layer as JavaScript holds it.
pub fn layer_from(layer: JsValue) -> Result<Layer, Failure> {
    let layer: LayerObject = from_js(layer)?;
    let polygon = |polygon: PolygonObject| Polygon {
        outer: ring_from(&polygon.outer),
        holes: polygon.holes.iter().map(|hole| ring_from(hole)).collect(),
    };
    Ok(Layer {
        z_bottom: layer.z_bottom,
        z_top: layer.z_top,
        z_sample: layer.z_sample,
        polygons: layer.polygons.into_iter().map(polygon).collect(),
    })
}
