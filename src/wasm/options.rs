//! Options as JavaScript gives them, to what the core takes.
use super::failure::{Failure, object};
use crate::data::{Lattice, Layer, Polygon, Ring, Warning};
use crate::io::{self, CloudFormat, MeshFormat};
use crate::math::{Aabb, Vec2};
use crate::orient::{ConsistencyConfig, OrientMethod, StochasticConfig, Widths};
use crate::slice::{AdaptiveHeights, LayerPlan, SampleAt, SliceConfig, SliceMode};
use crate::solid::{PointsOf, VoxelConfig, VoxelMethod};
use crate::surface::SurfaceConfig;
use crate::winding::{Accuracy, FieldConfig, Order, StabCount, Stabbing};
use serde::{Deserialize, de::DeserializeOwned};
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

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum VoxelFormat {
    #[default]
    Bytes,
    Bits,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum VoxelMethodName {
    Lattice,
    /// The same.
    Exact,
    Continuation,
    Rays,
    Fast,
    Cloud,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum StabCountName {
    Parity,
    Signed,
}

#[derive(Clone, Copy, Default, Deserialize)]
struct RayOptions {
    count: Option<StabCountName>,
    #[serde(default)]
    majority: bool,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum PointsOfName {
    Vertices,
    Barycentres,
}

/// Which voxels are wanted, and how.
#[derive(Default, Deserialize)]
pub struct VoxelOptions {
    resolution: Option<usize>,
    spacing: Option<f64>,
    counts: Option<[usize; 3]>,
    threshold: Option<f64>,
    method: Option<VoxelMethodName>,
    rays: Option<RayOptions>,
    order: Option<u8>,
    beta: Option<f64>,
    points: Option<PointsOfName>,
    #[serde(default)]
    pub format: VoxelFormat,
    #[serde(default)]
    pub surface: bool,
}

/// Cells along the longest side where nothing is said of them.
const RESOLUTION: usize = 64;

/// The cells over a box: by one of the three, or by none.
pub fn lattice_of(
    bounds: Aabb,
    resolution: Option<usize>,
    spacing: Option<f64>,
    counts: Option<[usize; 3]>,
) -> Result<Lattice, Failure> {
    let lattice = match (resolution, spacing, counts) {
        (resolution, None, None) => Lattice::with_resolution(bounds, resolution.unwrap_or(RESOLUTION)),
        (None, Some(spacing), None) => Lattice::with_spacing(bounds, spacing),
        (None, None, Some(counts)) => Lattice::with_counts(bounds, counts),
        _ => return Err(Failure::invalid("give only one of resolution, spacing and counts")),
    };
    Ok(lattice?)
}

impl VoxelOptions {
    pub fn lattice(&self, bounds: Aabb) -> Result<Lattice, Failure> {
        lattice_of(bounds, self.resolution, self.spacing, self.counts)
    }

    /// `of_paper` completes an order or a β that is not given.
    pub fn config(&self, of_paper: Accuracy) -> Result<VoxelConfig, Failure> {
        let method = match self.method {
            None | Some(VoxelMethodName::Lattice | VoxelMethodName::Exact) => VoxelMethod::Lattice,
            Some(VoxelMethodName::Continuation) => VoxelMethod::Continuation,
            Some(VoxelMethodName::Rays) => {
                let rays = self.rays.unwrap_or_default();
                let count = match rays.count {
                    None | Some(StabCountName::Parity) => StabCount::Parity,
                    Some(StabCountName::Signed) => StabCount::Signed,
                };
                VoxelMethod::Rays(Stabbing { count, majority: rays.majority })
            }
            Some(VoxelMethodName::Fast) => {
                let options =
                    AccuracyOptions { order: self.order, beta: self.beta, ..AccuracyOptions::default() };
                let given = options.accuracy(of_paper)?;
                let explicit = if let Accuracy::Explicit { .. } = given { given } else { of_paper };
                let Accuracy::Explicit { order, beta } = explicit else {
                    return Err(Failure::invalid("the method 'fast' takes an order and a beta"));
                };
                VoxelMethod::Fast { order, beta }
            }
            Some(VoxelMethodName::Cloud) => VoxelMethod::Points(match self.points {
                None | Some(PointsOfName::Vertices) => PointsOf::Vertices,
                Some(PointsOfName::Barycentres) => PointsOf::Barycentres,
            }),
        };
        Ok(VoxelConfig { threshold: self.threshold.unwrap_or(VoxelConfig::default().threshold), method })
    }
}

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
