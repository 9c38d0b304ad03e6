//! Distances, offset surfaces and hollow shapes for JavaScript.
use super::convert::{bytes_to, indices_to, numbers_to, points_from, singles_to};
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::options::{from_js, lattice_of};
use super::results::{lattice_to, mesh_to};
use crate::data::{Lattice, LatticeError};
use crate::math::{Aabb, Vec3};
use crate::solid::{DistanceConfig, DistanceError, DistanceSign, SignedClosest};
use crate::surface::{self, Drain, HollowConfig, OffsetConfig, OffsetError};
use js_sys::{Float64Array, Object};
use serde::Deserialize;
use wasm_bindgen::prelude::*;

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SignName {
    #[default]
    Hard,
    Smooth,
    None,
}

/// How distances are measured, and at which samples.
#[derive(Default, Deserialize)]
struct DistanceOptions {
    #[serde(default)]
    sign: SignName,
    band: Option<f64>,
    padding: Option<f64>,
    resolution: Option<usize>,
    spacing: Option<f64>,
    counts: Option<[usize; 3]>,
}

impl DistanceOptions {
    fn config(&self) -> DistanceConfig {
        let sign = match self.sign {
            SignName::Hard => DistanceSign::Hard,
            SignName::Smooth => DistanceSign::Smooth,
            SignName::None => DistanceSign::None,
        };
        DistanceConfig { sign, band: self.band }
    }

    fn lattice(&self, bounds: Aabb) -> Result<Lattice, Failure> {
        let padding = self.padding.unwrap_or(0.0);
        if !(padding.is_finite() && padding >= 0.0) {
            return Err(Failure::invalid(format!("padding {padding}: a finite number from 0 is needed")));
        }
        let bounds = if bounds.is_empty() { bounds } else { bounds.padded(padding) };
        lattice_of(bounds, self.resolution, self.spacing, self.counts)
    }
}

#[derive(Default, Deserialize)]
struct OffsetOptions {
    #[serde(default)]
    distance: f64,
    resolution: Option<usize>,
    spacing: Option<f64>,
    sharp: Option<f64>,
}

#[derive(Deserialize)]
struct DrainOptions {
    at: [f64; 3],
    direction: [f64; 3],
    radius: f64,
}

#[derive(Default, Deserialize)]
struct HollowOptions {
    #[serde(default)]
    thickness: f64,
    #[serde(default)]
    drains: Vec<DrainOptions>,
    resolution: Option<usize>,
    spacing: Option<f64>,
    sharp: Option<f64>,
}

#[wasm_bindgen]
impl Handle {
    /// Signed distances at points xyzxyz….
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    #[wasm_bindgen(js_name = signedDistance)]
    pub fn signed_distances(
        &mut self,
        points: JsValue,
        options: JsValue,
        job: &Job,
    ) -> Result<Float64Array, JsValue> {
        let options: DistanceOptions = from_js(options)?;
        let points = points_from("points", &points)?;
        let distance = self.signed_distance(job)?;
        let found = distance.distances(&points, &options.config(), job).map_err(Failure::from)?;
        Ok(numbers_to(&found)?)
    }

    /// Signed distances at the samples of a lattice: `{ counts, origin, spacing, values }`.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    #[wasm_bindgen(js_name = distanceLattice)]
    pub fn distance_lattice(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: DistanceOptions = from_js(options)?;
        let lattice = options.lattice(self.bounds())?;
        let distance = self.signed_distance(job)?;
        let grid = distance.lattice(&lattice, &options.config(), job).map_err(Failure::from)?;
        let [counts, origin, spacing] = lattice_to(&lattice);
        Ok(object([counts, origin, spacing, ("values", singles_to(&grid.values)?.into())]))
    }

    /// The nearest point for each of the points xyzxyz…: `{ distances, points, faces, barycentric, features, gradients }`.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    #[wasm_bindgen(js_name = closestPoints)]
    pub fn closest_points(
        &mut self,
        points: JsValue,
        _options: JsValue,
        job: &Job,
    ) -> Result<Object, JsValue> {
        let points = points_from("points", &points)?;
        let found = self.signed_distance(job)?.closest(&points, job).map_err(Failure::from)?;
        let triples = |triple: &dyn Fn(&SignedClosest) -> [f64; 3]| {
            let numbers: Vec<f64> = found.iter().flat_map(triple).collect();
            numbers_to(&numbers)
        };
        let distances: Vec<f64> = found.iter().map(|f| f.signed).collect();
        let faces: Vec<u32> = found.iter().map(|f| f.closest.element).collect();
        let features: Vec<u8> = found.iter().map(|f| f.closest.feature.code()).collect();
        Ok(object([
            ("distances", numbers_to(&distances)?.into()),
            ("points", triples(&|f| f.closest.point.to_array())?.into()),
            ("faces", indices_to(&faces)?.into()),
            ("barycentric", triples(&|f| f.closest.barycentric)?.into()),
            ("features", bytes_to(&features)?.into()),
            ("gradients", triples(&|f| f.gradient.to_array())?.into()),
        ]))
    }

    /// The surface at a signed distance.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    pub fn offset(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let OffsetOptions { distance, resolution, spacing, sharp } = from_js(options)?;
        let config = OffsetConfig { distance, resolution, spacing, sharp };
        let mesh = surface::offset(self.field(None, job)?, &config, job).map_err(Failure::from)?;
        Ok(mesh_to(&mesh)?)
    }

    /// The walls of a soup.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`], and if this is a cloud.
    pub fn hollow(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let HollowOptions { thickness, drains, resolution, spacing, sharp } = from_js(options)?;
        if self.soup().is_none() {
            return Err(Failure::invalid("a cloud has no walls: only soups are hollowed").into());
        }
        let drain = |d: DrainOptions| Drain {
            at: Vec3::from_array(d.at),
            direction: Vec3::from_array(d.direction),
            radius: d.radius,
        };
        let drains = drains.into_iter().map(drain).collect();
        let config = HollowConfig { thickness, drains, resolution, spacing, sharp };
        let mesh = surface::hollow(self.field(None, job)?, &config, job).map_err(Failure::from)?;
        Ok(mesh_to(&mesh)?)
    }
}

impl From<DistanceError> for Failure {
    fn from(error: DistanceError) -> Failure {
        match error {
            DistanceError::Field(field) => field.into(),
            DistanceError::EmptyShape => Failure::new("EmptyInput", &error),
            DistanceError::BadBand(_) => Failure::invalid(&error),
        }
    }
}

impl From<OffsetError> for Failure {
    fn from(error: OffsetError) -> Failure {
        match error {
            OffsetError::Surface(surface::SurfaceError::Lattice(LatticeError::EmptyBounds)) => {
                Failure::new("EmptyInput", &error)
            }
            OffsetError::Surface(surface) => surface.into(),
            OffsetError::NothingLeft(_) | OffsetError::NoCavity(_) => Failure::new("EmptyResult", &error),
            _ => Failure::invalid(&error),
        }
    }
}
