//! A soup or a cloud that JavaScript holds: made of bytes or arrays, with its field built when first asked.
use super::convert::{
    bounds_to, bytes_from, bytes_to, numbers_from, numbers_to, points_from, triangles_from, triangles_to,
    vectors_to,
};
use super::failure::{Failure, object};
use super::job::Job;
use super::options::{self, CloudOptions, ReadOptions};
use super::saving::{SAVED, is_saved_field};
use crate::data::{OrientedCloud, Parts, PointCloud, Shape, TriangleSoup, Warning};
use crate::distance::DistanceTree;
use crate::estimate::{self, EstimateConfig};
use crate::io::{self, Geometry};
use crate::math::Aabb;
use crate::orient::{OrientMethod, orient_watched};
use crate::solid::SignedDistance;
use crate::winding::{Accuracy, FieldConfig, WindingField};
use js_sys::{Object, Reflect, Uint8Array, Uint32Array};
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// What a handle was made of.
enum Source {
    Soup(Arc<TriangleSoup>),
    /// The points as they came, and with normals and areas once these were needed.
    Cloud {
        given: PointCloud,
        oriented: Option<Arc<OrientedCloud>>,
    },
}

/// The part of a call's progress that the areas of a cloud tell, the first time.
const PREPARATION: f64 = 0.3;

/// A soup or a cloud.
#[wasm_bindgen]
pub struct Handle {
    source: Source,
    format: &'static str,
    warnings: Vec<Warning>,
    field: Option<(FieldConfig, WindingField)>,
    distances: Option<Arc<DistanceTree>>,
}

#[wasm_bindgen]
impl Handle {
    /// Reads a file, or a saved field; `kind` is `soup`, `cloud` or `field` where only that will do.
    ///
    /// # Errors
    /// If and only if the file gives no geometry, or not of that kind, or normals cannot be estimated as asked.
    pub fn parse(
        bytes: &Uint8Array,
        kind: Option<String>,
        options: JsValue,
        job: &Job,
    ) -> Result<Handle, JsValue> {
        let options: ReadOptions = options::from_js(options)?;
        if is_saved_field(bytes) || kind.as_deref() == Some(SAVED) {
            return Ok(Handle::load(bytes, kind)?);
        }
        let imported = io::read_with(&bytes_from(bytes)?, &options.for_io()?).map_err(Failure::from)?;
        let (source, found) = match imported.geometry {
            Geometry::Soup(soup) => (Source::Soup(Arc::new(soup)), "soup"),
            Geometry::Cloud(given) => (Source::Cloud { given, oriented: None }, "cloud"),
        };
        if let Some(wanted) = kind.filter(|wanted| wanted != found) {
            let message = format!("the file holds a {found}: a {wanted} is needed");
            return Err(Failure::invalid(message).into());
        }
        let format = imported.format.name();
        let mut handle = Handle::of(source, format, imported.warnings);
        handle.orient_where_asked(options.orient, job)?;
        Ok(handle)
    }

    /// A soup of arrays: positions xyzxyz… and three indices for each triangle, or none.
    ///
    /// # Errors
    /// If and only if the arrays are no soup.
    #[wasm_bindgen(js_name = soup)]
    pub fn from_triangles(positions: JsValue, indices: Option<Uint32Array>) -> Result<Handle, JsValue> {
        let positions = points_from("positions", &positions)?;
        let triangles = triangles_from(indices.as_ref(), positions.len())?;
        let (soup, warnings) = TriangleSoup::usable(positions, triangles).map_err(Failure::from)?;
        if soup.is_empty() {
            return Err(Failure::new("EmptyInput", "there are no triangles: at least one is needed").into());
        }
        Ok(Handle::of(Source::Soup(Arc::new(soup)), "arrays", warnings))
    }

    /// A cloud of arrays: points and perhaps normals xyzxyz…, areas one for each.
    ///
    /// # Errors
    /// If and only if the arrays are no cloud.
    #[wasm_bindgen(js_name = cloud)]
    pub fn from_points(
        points: JsValue,
        normals: JsValue,
        areas: JsValue,
        options: JsValue,
        job: &Job,
    ) -> Result<Handle, JsValue> {
        let options: CloudOptions = options::from_js(options)?;
        let given = |array: &JsValue| !array.is_undefined() && !array.is_null();
        let points = points_from("points", &points)?;
        if points.is_empty() {
            return Err(Failure::new("EmptyInput", "there are no points: at least one is needed").into());
        }
        let normals = given(&normals).then(|| points_from("normals", &normals)).transpose()?;
        let areas = given(&areas).then(|| numbers_from("areas", &areas)).transpose()?;
        let (given, warnings) = PointCloud::cleaned(points, normals, areas).map_err(Failure::from)?;
        if given.is_empty() {
            return Err(Failure::new("EmptyInput", "none of the points is usable").into());
        }
        let source = Source::Cloud { given, oriented: None };
        let mut handle = Handle::of(source, "arrays", warnings);
        handle.orient_where_asked(options.orient, job)?;
        Ok(handle)
    }

    /// `{ kind, format, warnings, bounds, count, hasNormals, hasAreas }`.
    pub fn describe(&self) -> Result<Object, JsValue> {
        let (kind, bounds, count) = match &self.source {
            Source::Soup(soup) => ("soup", soup.bounds(), soup.len()),
            Source::Cloud { given, .. } => ("cloud", given.bounds(), given.len()),
        };
        let warnings: js_sys::Array = self.warnings.iter().map(options::warning_to).collect();
        let (has_normals, has_areas) = match &self.source {
            Source::Soup(_) => (false, false),
            Source::Cloud { given, oriented } => (
                given.normals().is_some() || oriented.is_some(),
                given.areas().is_some() || oriented.is_some(),
            ),
        };
        Ok(object([
            ("kind", kind.into()),
            ("format", self.format.into()),
            ("warnings", warnings.into()),
            ("bounds", bounds_to(bounds)),
            ("count", count.into()),
            ("hasNormals", has_normals.into()),
            ("hasAreas", has_areas.into()),
        ]))
    }

    /// Whether a call about this shape first estimates normals or areas.
    #[wasm_bindgen(js_name = isRaw)]
    pub fn is_raw(&self) -> bool {
        matches!(self.source, Source::Cloud { oriented: None, .. })
    }

    /// Gives a cloud normals that it lacks, and areas; describes it anew.
    ///
    /// # Errors
    /// If and only if this is no cloud or the call is aborted.
    pub fn orient(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: options::OrientOptions = options::from_js(options)?;
        self.estimate_normals(&options.method()?, job)?;
        self.describe()
    }

    /// Noise around each point of a cloud, in millimetres.
    ///
    /// # Errors
    /// If and only if this is a soup or the call is aborted.
    pub fn noise(&self, job: &Job) -> Result<js_sys::Float64Array, JsValue> {
        let Source::Cloud { given, .. } = &self.source else {
            return Err(Failure::invalid("a soup has no noise: only clouds have").into());
        };
        let found = estimate::deviations(given.points(), job).map_err(Failure::from)?;
        Ok(numbers_to(&found)?)
    }

    /// The shape as it is: positions, and indices or normals and areas.
    ///
    /// # Errors
    /// If and only if memory does not suffice.
    pub fn geometry(&self) -> Result<Object, JsValue> {
        let (positions, bounds) = match &self.source {
            Source::Soup(soup) => (soup.positions(), soup.bounds()),
            Source::Cloud { given, .. } => (given.points(), given.bounds()),
        };
        let origin = bounds.narrowing_origin();
        let result = object([
            ("positions", vectors_to(positions, origin)?.into()),
            ("origin", numbers_to(&origin.to_array())?.into()),
        ]);
        let set = |key: &str, value: JsValue| Reflect::set(&result, &key.into(), &value).map(|_| ());
        match &self.source {
            Source::Soup(soup) => set("indices", triangles_to(soup.triangles())?.into())?,
            Source::Cloud { given, oriented } => {
                let oriented = oriented.as_deref();
                if let Some(normals) = oriented.map(OrientedCloud::normals).or(given.normals()) {
                    set("normals", vectors_to(normals, crate::math::Vec3::ZERO)?.into())?;
                }
                if let Some(areas) = oriented.map(OrientedCloud::areas).or(given.areas()) {
                    set("areas", numbers_to(areas)?.into())?;
                }
            }
        }
        Ok(result)
    }

    /// A soup as points with its own normals and areas: `{ points, normals, areas, warnings }`, of its `vertices` or of the
    /// `barycentres` of its triangles.
    ///
    /// # Errors
    /// If and only if this is a cloud, `at` is neither, or memory does not suffice.
    #[wasm_bindgen(js_name = asCloud)]
    pub fn as_cloud(&self, at: &str) -> Result<Object, JsValue> {
        let Source::Soup(soup) = &self.source else {
            return Err(Failure::invalid("this is a cloud already: only soups become clouds").into());
        };
        let (cloud, warnings) = match at {
            "vertices" => soup.vertex_cloud(),
            "barycentres" => soup.barycentre_cloud(),
            _ => {
                let message = format!("at: '{at}': 'vertices' and 'barycentres' are known");
                return Err(Failure::invalid(message).into());
            }
        };
        if cloud.is_empty() {
            return Err(Failure::new(
                "EmptyInput",
                "no triangle has an area: there is nothing to make points of",
            )
            .into());
        }
        let flat = |vectors: &[crate::math::Vec3]| {
            let numbers: Vec<f64> = vectors.iter().flat_map(|v| v.to_array()).collect();
            numbers_to(&numbers)
        };
        let warnings: js_sys::Array = warnings.iter().map(options::warning_to).collect();
        Ok(object([
            ("points", flat(cloud.points())?.into()),
            ("normals", flat(cloud.normals())?.into()),
            ("areas", numbers_to(cloud.areas())?.into()),
            ("warnings", warnings.into()),
        ]))
    }

    /// The shape as a file.
    ///
    /// # Errors
    /// If and only if the shape has no such format.
    pub fn export(&self, format: &str) -> Result<Uint8Array, JsValue> {
        let mut bytes = Vec::new();
        let written = match &self.source {
            Source::Soup(soup) => io::write_soup(soup, options::mesh_format(format)?, &mut bytes),
            Source::Cloud { given, oriented } => {
                let normals = oriented.as_deref().map(OrientedCloud::normals).or(given.normals());
                io::write_cloud(given.points(), normals, options::cloud_format(format)?, &mut bytes)
            }
        };
        written.expect("a vector takes any bytes");
        Ok(bytes_to(&bytes)?)
    }
}

impl Handle {
    /// A soup that the engine has made.
    pub(super) fn of_soup(soup: TriangleSoup, format: &'static str) -> Handle {
        Handle::of(Source::Soup(Arc::new(soup)), format, vec![])
    }

    fn of(source: Source, format: &'static str, warnings: Vec<Warning>) -> Handle {
        Handle { source, format, warnings, field: None, distances: None }
    }

    fn orient_where_asked(&mut self, orient: Option<options::Orient>, job: &Job) -> Result<(), Failure> {
        match (&self.source, orient) {
            (Source::Cloud { given, .. }, Some(options::Orient::Auto)) if given.normals().is_none() => {
                self.estimate_normals(&OrientMethod::default(), job)
            }
            _ => Ok(()),
        }
    }

    fn estimate_normals(&mut self, method: &OrientMethod, job: &Job) -> Result<(), Failure> {
        let Source::Cloud { given, oriented } = &mut self.source else {
            return Err(Failure::invalid(
                "a soup has its orientation from its triangles: only clouds are oriented",
            ));
        };
        if oriented.is_none() {
            let (cloud, warnings) = orient_watched(given, method, job, &|vectors| job.show(vectors))?;
            *oriented = Some(Arc::new(cloud));
            self.warnings.extend(warnings);
        }
        Ok(())
    }

    /// What has a winding field; estimates the areas of a cloud the first time.
    pub(super) fn shape(&mut self, job: &Job) -> Result<Shape, Failure> {
        match &mut self.source {
            Source::Soup(soup) => Ok(Shape::Soup(soup.clone())),
            Source::Cloud { oriented: Some(cloud), .. } => Ok(Shape::Cloud(cloud.clone())),
            Source::Cloud { given, oriented } => {
                let monitor = Parts::new(job);
                monitor.begin(0.0, PREPARATION);
                let cloud = estimate::complete(given, &EstimateConfig::default(), &monitor)?;
                Ok(Shape::Cloud(oriented.insert(Arc::new(cloud)).clone()))
            }
        }
    }

    /// The field, built the first time and when another configuration is asked for.
    pub(super) fn field(&mut self, config: Option<FieldConfig>, job: &Job) -> Result<&WindingField, Failure> {
        let kept = self.field.take().filter(|(built, _)| config.is_none_or(|config| config == *built));
        let config = config.unwrap_or_default();
        let field = match kept {
            Some(kept) => kept,
            None => (config, WindingField::new(self.shape(job)?, config)),
        };
        Ok(&self.field.insert(field).1)
    }

    /// Of the shape whose field was saved.
    pub(super) fn of_field(field: WindingField, kind: Option<String>) -> Result<Handle, Failure> {
        let (source, found) = match field.shape() {
            Shape::Soup(soup) => (Source::Soup(soup.clone()), "soup"),
            Shape::Cloud(cloud) => {
                let normals = Some(cloud.normals().to_vec());
                let (given, _) =
                    PointCloud::cleaned(cloud.points().to_vec(), normals, Some(cloud.areas().to_vec()))?;
                (Source::Cloud { given, oriented: Some(cloud.clone()) }, "cloud")
            }
        };
        if let Some(wanted) = kind.filter(|wanted| wanted != found && wanted != SAVED) {
            return Err(Failure::invalid(format!(
                "the file holds the field of a {found}: a {wanted} is needed"
            )));
        }
        Ok(Handle { field: Some((field.config(), field)), ..Handle::of(source, SAVED, vec![]) })
    }

    /// How the evaluator of Barill et al. 2018 has this shape's field.
    pub(super) fn of_paper(&self) -> Accuracy {
        match self.source {
            Source::Soup(_) => Accuracy::OF_PAPER_FOR_SOUPS,
            Source::Cloud { .. } => Accuracy::OF_PAPER_FOR_CLOUDS,
        }
    }

    /// The field and the tree of distances, each built the first time.
    pub(super) fn signed_distance(&mut self, job: &Job) -> Result<SignedDistance<'_>, Failure> {
        let shape = self.shape(job)?;
        let tree = self.distances.get_or_insert_with(|| Arc::new(DistanceTree::new(&shape))).clone();
        Ok(SignedDistance::with_tree(self.field(None, job)?, tree))
    }

    pub(super) fn soup(&self) -> Option<&Arc<TriangleSoup>> {
        match &self.source {
            Source::Soup(soup) => Some(soup),
            Source::Cloud { .. } => None,
        }
    }

    /// Puts another soup in the place of this shape; its field is gone.
    pub(super) fn replace_soup(&mut self, soup: TriangleSoup) {
        self.source = Source::Soup(Arc::new(soup));
        self.field = None;
        self.distances = None;
    }

    pub(super) fn bounds(&self) -> Aabb {
        match &self.source {
            Source::Soup(soup) => soup.bounds(),
            Source::Cloud { given, .. } => given.bounds(),
        }
    }
}
