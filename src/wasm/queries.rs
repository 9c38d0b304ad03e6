//! The features: questions of JavaScript to the field of a handle.
use super::convert::{bytes_to, numbers_to, points_from};
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::options::{self, AccuracyOptions, HeatMapOptions, SliceOptions, SurfaceOptions, VoxelOptions};
use super::results;
use crate::data::Layer;
use crate::solid::VoxelMethod;
use crate::winding::Accuracy;
use crate::{check, slice, solid, surface};
use js_sys::{Array, Date, Float64Array, Object, Uint8Array};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Handle {
    /// Builds the tree: `{ milliseconds, bytes, method, components, boundaryEdges, caps }`.
    ///
    /// # Errors
    /// If and only if a cloud has no normals, an option is out of range or the call is aborted.
    pub fn prepare(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: AccuracyOptions = options::from_js(options)?;
        let start = Date::now();
        let config = options.field_config()?;
        let field = self.field(config, job)?;
        options.accuracy(Accuracy::of_paper(field.shape()))?;
        field.prepare_points();
        let (report, bytes) = (field.report().clone(), field.bytes());
        let milliseconds = Date::now() - start;
        let components = self.soup().map_or(0, |soup| check::components(soup));
        Ok(object([
            ("milliseconds", milliseconds.into()),
            ("bytes", bytes.into()),
            ("method", report.method.into()),
            ("components", components.into()),
            ("boundaryEdges", report.boundary_edges.into()),
            ("caps", report.caps.into()),
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

    /// Which cells of a lattice are inside.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    pub fn voxelize(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: VoxelOptions = options::from_js(options)?;
        let lattice = options.lattice(self.bounds())?;
        let config = options.config(self.of_paper())?;
        let voxels = match (config.method, self.soup()) {
            (VoxelMethod::Rays(stabbing), Some(soup)) => {
                solid::voxelize_by_rays(soup, &lattice, stabbing, config.threshold, job)
            }
            _ => solid::voxelize(self.field(None, job)?, &lattice, &config, job),
        };
        let voxels = voxels.map_err(Failure::from)?;
        Ok(results::voxels_to(&voxels, options.format, options.surface)?)
    }

    /// Layers of closed polygons.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    pub fn slice(&mut self, options: JsValue, job: &Job) -> Result<Array, JsValue> {
        let options: SliceOptions = options::from_js(options)?;
        let config = options.config();
        let field = self.field(None, job)?;
        let layers = match &options.spans {
            None => slice::slice(field, &options.plan(), &config, job).map_err(Failure::from)?,
            Some(numbers) => {
                let span = |&[bottom, top, sample]: &[f64; 3]| slice::Span { bottom, top, sample };
                let spans: Vec<slice::Span> = numbers.as_chunks().0.iter().map(span).collect();
                let mut layers = vec![Layer::default(); spans.len()];
                slice::slice_spans(field, &spans, &config, job, &mut |place, layer| layers[place] = layer)
                    .map_err(Failure::from)?;
                layers
            }
        };
        Ok(results::layers_to(&layers)?)
    }

    /// Bottom, top and sample of each layer that `slice` would make.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    #[wasm_bindgen(js_name = layerSpans)]
    pub fn layer_spans(&mut self, options: JsValue, job: &Job) -> Result<Float64Array, JsValue> {
        let options: SliceOptions = options::from_js(options)?;
        let spans = options.plan().spans_of(self.field(None, job)?.shape());
        let spans = spans.map_err(|e| Failure::from(slice::SliceError::from(e)))?;
        let numbers: Vec<f64> = spans.iter().flat_map(|s| [s.bottom, s.top, s.sample]).collect();
        Ok(numbers_to(&numbers)?)
    }

    /// The closed surface where w equals a level.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    pub fn surface(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: SurfaceOptions = options::from_js(options)?;
        let field = self.field(None, job)?;
        let mesh = surface::extract(field, &options.config(), job).map_err(Failure::from)?;
        Ok(results::mesh_to(&mesh)?)
    }

    /// Winding numbers over a plane.
    ///
    /// # Errors
    /// As [`Handle::winding_numbers`].
    #[wasm_bindgen(js_name = heatMap)]
    pub fn heat_map(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let options: HeatMapOptions = options::from_js(options)?;
        let z = options.z()?;
        let map =
            slice::heat_map(self.field(None, job)?, z, options.resolution(), job).map_err(Failure::from)?;
        Ok(results::heat_map_to(&map)?)
    }

    /// The edges along which a soup is open.
    ///
    /// # Errors
    /// If and only if this is a cloud.
    #[wasm_bindgen(js_name = boundaryEdges)]
    pub fn boundary_edges(&self) -> Result<Object, JsValue> {
        let soup = self.soup().ok_or_else(|| Failure::invalid("a cloud has no edges: only soups have"))?;
        Ok(results::segments_to(&check::boundary_edges(soup))?)
    }
}
