//! Toolpaths and G-code for JavaScript: layers in, flat arrays of a layer's lines out, and back in for a printer's program.
use super::convert::{bytes_to, numbers_from, numbers_to, triple_to};
use super::failure::{Failure, object};
use super::job::Job;
use super::options::{from_js, layer_from, warning_to};
use crate::data::{Layer, Warning};
use crate::math::{Aabb, Vec2, Vec3};
use crate::print::{
    Approach, LayerPaths, Path, PathKind, PrintError, PrinterProfile, ProfileError, ToolpathSettings,
    Toolpaths, gcode, toolpaths,
};
use js_sys::{Array, Object, Reflect, Uint8Array, Uint32Array};
use serde::{Serialize, de::DeserializeOwned};
use wasm_bindgen::prelude::*;

/// In the order of their numbers.
const KINDS: [PathKind; 10] = [
    PathKind::OuterWall,
    PathKind::InnerWall,
    PathKind::ThinWall,
    PathKind::Gap,
    PathKind::Overhang,
    PathKind::Bottom,
    PathKind::Top,
    PathKind::Solid,
    PathKind::Bridge,
    PathKind::Infill,
];

/// The lines that fill layers: `{ layers, kinds, report, warnings }`.
///
/// # Errors
/// If and only if a setting is out of range, the layers are none that can be printed, or the job is cancelled.
#[wasm_bindgen(js_name = toolpaths)]
pub fn toolpaths_of(layers: &Array, settings: JsValue, job: &Job) -> Result<Object, JsValue> {
    let settings: ToolpathSettings = known(settings)?;
    let layers = layers.iter().map(layer_from).collect::<Result<Vec<Layer>, _>>()?;
    let made = toolpaths(&layers, &settings, job).map_err(Failure::from)?;
    let layers = made.layers.iter().map(layer_to).collect::<Result<Array, _>>()?;
    let kinds = KINDS.iter().map(plain).collect::<Result<Array, _>>()?;
    Ok(object([
        ("layers", layers.into()),
        ("kinds", kinds.into()),
        ("report", plain(&made.report)?),
        ("warnings", warnings_to(&made.report.warnings()).into()),
    ]))
}

/// A program for a printer, and what it takes: `{ bytes, shift, estimate, warnings }`.
///
/// # Errors
/// If and only if the paths are none, a value of the profile is out of range, or the print does not fit the printer.
#[wasm_bindgen(js_name = gcode)]
pub fn gcode_of(paths: &JsValue, profile: JsValue) -> Result<Object, JsValue> {
    let profile: PrinterProfile = known(profile)?;
    let paths = paths_from(paths)?;
    let program = gcode(&paths, &profile).map_err(Failure::from)?;
    Ok(object([
        ("bytes", bytes_to(program.text.as_bytes())?.into()),
        ("shift", triple_to(program.shift)),
        ("estimate", plain(&paths.estimate(&profile).map_err(Failure::from)?)?),
        ("warnings", warnings_to(&program.warnings).into()),
    ]))
}

/// Settings and a printer's profile with all that is not given, as the defaults have it: `{ settings, profile }`; looks whether a
/// model of some size (x, y, z) fits the printer, if it is given.
///
/// # Errors
/// If and only if a value is out of range, or the model is too large.
#[wasm_bindgen(js_name = printSettings)]
pub fn print_settings(settings: JsValue, profile: JsValue, size: JsValue) -> Result<Object, JsValue> {
    let settings: ToolpathSettings = known(settings)?;
    let profile: PrinterProfile = known(profile)?;
    settings.check().map_err(Failure::from)?;
    profile.check().map_err(|error| Failure::from(PrintError::from(error)))?;
    if !size.is_undefined() {
        let size: [f64; 3] = serde_wasm_bindgen::from_value(size).map_err(Failure::invalid)?;
        let model = Aabb { min: Vec3::ZERO, max: Vec3::from_array(size) };
        profile.fits(model).map_err(|error| Failure::from(PrintError::from(error)))?;
    }
    Ok(object([("settings", plain(&settings)?), ("profile", plain(&profile)?)]))
}

/// What a JavaScript object says; an error where it has a name that the defaults do not have: it would be overlooked.
pub(super) fn known<T: Serialize + DeserializeOwned + Default>(given: JsValue) -> Result<T, Failure> {
    check_names(&given, &plain(&T::default())?, "")?;
    from_js(given)
}

/// `path` is what leads to the object, with a dot after it.
fn check_names(given: &JsValue, defaults: &JsValue, path: &str) -> Result<(), Failure> {
    let (Some(given), Some(defaults)) = (given.dyn_ref::<Object>(), defaults.dyn_ref::<Object>()) else {
        return Ok(());
    };
    let names = Object::keys(defaults);
    for name in Object::keys(given).iter() {
        let full = format!("{path}{}", name.as_string().unwrap_or_default());
        if !names.includes(&name, 0) {
            let known = names.join(", ");
            return Err(Failure::invalid(format!("bad options: '{full}' is not known; known are {known}")));
        }
        let of = |object: &Object| Reflect::get(object, &name).unwrap_or(JsValue::UNDEFINED);
        check_names(&of(given), &of(defaults), &format!("{full}."))?;
    }
    Ok(())
}

/// As a plain object.
pub(super) fn plain(value: &impl Serialize) -> Result<JsValue, Failure> {
    serde_wasm_bindgen::to_value(value).map_err(Failure::invalid)
}

fn warnings_to(warnings: &[Warning]) -> Array {
    warnings.iter().map(warning_to).collect()
}

/// `{ z, height, points, starts, kinds, widths, flags }`: of path k the points from starts[k] to starts[k + 1].
fn layer_to(layer: &LayerPaths) -> Result<JsValue, Failure> {
    let points: Vec<f64> = layer.paths.iter().flat_map(|p| &p.points).flat_map(|p| p.to_array()).collect();
    let mut starts = vec![0u32];
    starts.extend(layer.paths.iter().scan(0, |end, path| {
        *end += path.points.len() as u32;
        Some(*end)
    }));
    let kind = |path: &Path| KINDS.iter().position(|kind| *kind == path.kind).unwrap_or(0) as u8;
    let kinds: Vec<u8> = layer.paths.iter().map(kind).collect();
    let widths: Vec<f64> = layer.paths.iter().map(|path| path.width).collect();
    let flag = |path: &Path| u8::from(path.closed) | u8::from(path.approach == Approach::Inside) << 1;
    let flags: Vec<u8> = layer.paths.iter().map(flag).collect();
    Ok(object([
        ("z", layer.z.into()),
        ("height", layer.height.into()),
        ("points", numbers_to(&points)?.into()),
        ("starts", Uint32Array::from(&starts[..]).into()),
        ("kinds", bytes_to(&kinds)?.into()),
        ("widths", numbers_to(&widths)?.into()),
        ("flags", bytes_to(&flags)?.into()),
    ])
    .into())
}

fn paths_from(paths: &JsValue) -> Result<Toolpaths, Failure> {
    let layers = get(paths, "layers")?;
    let layers: &Array = layers.dyn_ref().ok_or_else(|| Failure::invalid("paths have an array of layers"))?;
    let layers = layers.iter().map(|layer| layer_paths_from(&layer)).collect::<Result<_, _>>()?;
    Ok(Toolpaths { layers, report: Default::default() })
}

fn layer_paths_from(layer: &JsValue) -> Result<LayerPaths, Failure> {
    let numbers = numbers_from("points", &get(layer, "points")?)?;
    let points: Vec<Vec2> = numbers.as_chunks().0.iter().map(|&[x, y]| Vec2::new(x, y)).collect();
    let widths = numbers_from("widths", &get(layer, "widths")?)?;
    let starts = get(layer, "starts")?.dyn_into::<Uint32Array>().map(|starts| starts.to_vec());
    let bytes =
        |name: &str| get(layer, name)?.dyn_into::<Uint8Array>().map_err(|_| broken()).map(|b| b.to_vec());
    let (starts, kinds, flags) = (starts.map_err(|_| broken())?, bytes("kinds")?, bytes("flags")?);
    let count = widths.len();
    if starts.len() != count + 1 || kinds.len() != count || flags.len() != count {
        return Err(broken());
    }
    let path = |k: usize| -> Result<Path, Failure> {
        let range = starts[k] as usize..starts[k + 1] as usize;
        Ok(Path {
            kind: *KINDS.get(usize::from(kinds[k])).ok_or_else(broken)?,
            points: points.get(range).ok_or_else(broken)?.to_vec(),
            closed: flags[k] & 1 != 0,
            width: widths[k],
            approach: if flags[k] & 2 != 0 { Approach::Inside } else { Approach::Across },
        })
    };
    let number = |name: &str| get(layer, name)?.as_f64().ok_or_else(broken);
    Ok(LayerPaths {
        z: number("z")?,
        height: number("height")?,
        paths: (0..count).map(path).collect::<Result<_, _>>()?,
    })
}

fn get(object: &JsValue, name: &str) -> Result<JsValue, Failure> {
    Reflect::get(object, &name.into()).map_err(|_| broken())
}

fn broken() -> Failure {
    Failure::invalid("these are no toolpaths as `toolpaths` makes them")
}

impl From<PrintError> for Failure {
    fn from(error: PrintError) -> Failure {
        match error {
            PrintError::Cancelled(cancelled) => cancelled.into(),
            PrintError::OffBed { .. } => Failure::new("DoesNotFit", error),
            PrintError::Profile(ProfileError::TooLarge { .. }) => Failure::new("DoesNotFit", error),
            PrintError::Empty => Failure::new("EmptyInput", error),
            _ => Failure::invalid(error),
        }
    }
}
