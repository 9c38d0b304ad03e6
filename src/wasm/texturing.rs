//! Textures for JavaScript: a handle of their own, which lives on when the soup's is freed.
use super::convert::{bytes_to, indices_to, numbers_to, points_from, singles_to, triangles_to};
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::options::{from_js, warning_to};
use super::printing::plain;
use super::texture_options::{
    AtlasOptions, ExportOptions, LinesOptions, ProxyOptions, RefineOptions, ShownOptions,
};
use crate::data::TriangleSoup;
use crate::io::{write_material_library, write_textured_obj};
use crate::math::{Vec2, Vec3};
use crate::texture::{
    Affected, AtlasConfig, ProxyConfig, SeamCost, Texture, TextureConfig, seam_through,
    smallest_single_offset, texture, transferred,
};
use js_sys::{Array, Float64Array, Object, Reflect, Uint32Array};
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// A textured soup, and how its proxy and atlas were made.
#[wasm_bindgen]
pub struct TextureHandle {
    texture: Texture,
    proxy: ProxyConfig,
    atlas: AtlasConfig,
}

#[wasm_bindgen]
impl Handle {
    /// Textures a soup: `{ handle }`.
    ///
    /// # Errors
    /// If and only if this is a cloud, no triangle has an area, an option is out of range, charts do not fit, memory does not suffice or
    /// the call is aborted.
    pub fn texture(&mut self, options: JsValue, job: &Job) -> Result<Object, JsValue> {
        let soup = self.soup_to_texture()?;
        let config = TextureConfig {
            proxy: from_js::<ProxyOptions>(options.clone())?.over(ProxyConfig::default()),
            atlas: from_js::<AtlasOptions>(options.clone())?.over(AtlasConfig::default()),
            lines: from_js::<LinesOptions>(options.clone())?.config(),
            refine: from_js::<RefineOptions>(options)?.refine,
        };
        let texture = texture(soup, &config, job).map_err(Failure::from)?;
        let made = TextureHandle { texture, proxy: config.proxy, atlas: config.atlas };
        Ok(object([("handle", made.into())]))
    }

    /// The smallest offset at which the proxy is in one piece, in millimetres.
    ///
    /// # Errors
    /// If and only if this is a cloud, the soup has no size or the call is aborted.
    #[wasm_bindgen(js_name = suggestOffset)]
    pub fn suggest_offset(&mut self, options: JsValue, job: &Job) -> Result<f64, JsValue> {
        self.soup_to_texture()?;
        let sides = from_js::<ProxyOptions>(options)?.sides().unwrap_or_default();
        Ok(smallest_single_offset(self.field(None, job)?, sides, job).map_err(Failure::from)?)
    }
}

impl Handle {
    pub(super) fn soup_to_texture(&self) -> Result<Arc<TriangleSoup>, Failure> {
        let refused = || Failure::invalid("a cloud has no triangles to texture: only soups have");
        self.soup().cloned().ok_or_else(refused)
    }
}

#[wasm_bindgen]
impl TextureHandle {
    /// What came of all stages: a [`crate::texture::TextureReport`].
    ///
    /// # Errors
    /// None.
    pub fn describe(&self) -> Result<JsValue, JsValue> {
        let report = self.texture.report();
        let result = plain(&report)?;
        let warnings: Array = report.warnings.iter().map(warning_to).collect();
        Reflect::set(&result, &"warnings".into(), &warnings)?;
        let mapping: Object = Reflect::get(&result, &"mapping".into())?.unchecked_into();
        Reflect::delete_property(&mapping, &"warnings".into())?;
        Ok(result)
    }

    /// The soup with its texture coordinates: `{ positions, indices, uvs, charts, sources }`, positions as doubles, six coordinates for
    /// each triangle.
    ///
    /// # Errors
    /// If and only if memory does not suffice.
    pub fn geometry(&self) -> Result<Object, JsValue> {
        let Texture { soup, sources, mapping, .. } = &self.texture;
        Ok(object([
            ("positions", flat(soup.positions())?.into()),
            ("indices", triangles_to(soup.triangles())?.into()),
            ("uvs", singles_to(&coordinates(mapping.uv.iter().copied()))?.into()),
            ("charts", indices_to(&mapping.charts)?.into()),
            ("sources", indices_to(sources)?.into()),
        ]))
    }

    /// The proxy with its texture coordinates: `{ positions, indices, uvs, charts, seams }`, seams as pairs of vertices.
    ///
    /// # Errors
    /// If and only if memory does not suffice.
    pub fn proxy(&self) -> Result<Object, JsValue> {
        let Texture { proxy, atlas, .. } = &self.texture;
        let mesh = &proxy.mesh;
        let corners = (0..mesh.triangles.len() as u32).map(|t| atlas.corners_of(t));
        Ok(object([
            ("positions", flat(&mesh.positions)?.into()),
            ("indices", triangles_to(&mesh.triangles)?.into()),
            ("uvs", singles_to(&coordinates(corners))?.into()),
            ("charts", indices_to(&atlas.charts)?.into()),
            ("seams", indices_to(atlas.seams(mesh).as_flattened())?.into()),
        ]))
    }

    /// Triangles that did not simply go where their lines meet the proxy, as lists of their numbers: see [`Affected`].
    ///
    /// # Errors
    /// If and only if memory does not suffice.
    pub fn affected(&self) -> Result<Object, JsValue> {
        let Affected { across, moved, folded, squashed, unfolded, flipped, torn, lost, tangential, weak } =
            &self.texture.mapping.affected;
        Ok(object([
            ("across", indices_to(across)?.into()),
            ("moved", indices_to(moved)?.into()),
            ("folded", indices_to(folded)?.into()),
            ("squashed", indices_to(squashed)?.into()),
            ("unfolded", indices_to(unfolded)?.into()),
            ("flipped", indices_to(flipped)?.into()),
            ("torn", indices_to(torn)?.into()),
            ("lost", indices_to(lost)?.into()),
            ("tangential", indices_to(tangential)?.into()),
            ("weak", indices_to(weak)?.into()),
        ]))
    }

    /// Field lines as far as the proxy: `{ points, offsets }`, line i from point offsets[i] to offsets[i + 1].
    ///
    /// # Errors
    /// If and only if an option is wrong or memory does not suffice.
    pub fn lines(&self, options: JsValue) -> Result<Object, JsValue> {
        let ShownOptions { count } = from_js(options)?;
        let lines = self.texture.lines_to_proxy(count);
        Ok(object([("points", flat(&lines.points)?.into()), ("offsets", indices_to(&lines.offsets)?.into())]))
    }

    /// The cheapest way through vertices of the proxy, as a chain of them.
    ///
    /// # Errors
    /// If and only if a vertex does not exist, or there is no way to it.
    pub fn seam(&self, picks: JsValue) -> Result<Uint32Array, JsValue> {
        let picks: Vec<u32> = from_js(picks)?;
        let edges = seam_through(&self.texture.proxy.mesh, &picks, &SeamCost::default());
        let ends = edges.map_err(Failure::from)?.into_iter().map(|[_, end]| end);
        let chain: Vec<u32> = picks.iter().copied().take(1).chain(ends).collect();
        Ok(indices_to(&chain)?)
    }

    /// Values at the vertices of the proxy, three each, as the corners of the soup's triangles have them.
    ///
    /// # Errors
    /// If and only if there are not as many as vertices, or memory does not suffice.
    pub fn transfer(&self, values: JsValue) -> Result<Float64Array, JsValue> {
        let values = points_from("values", &values)?;
        let Texture { lines, anchors, proxy, .. } = &self.texture;
        let vertices = proxy.mesh.positions.len();
        if values.len() != vertices {
            let message = format!("there are values for {} vertices: the proxy has {vertices}", values.len());
            return Err(Failure::invalid(message).into());
        }
        Ok(flat(transferred(&values, lines, anchors, proxy).as_flattened())?)
    }

    /// Another proxy, or another atlas of the same; describes it anew. What is not given stays, but for seams of another proxy.
    ///
    /// # Errors
    /// As [`Handle::texture`]; the texture then stays as it is.
    pub fn remap(&mut self, options: JsValue, job: &Job) -> Result<JsValue, JsValue> {
        let proxy = from_js::<ProxyOptions>(options.clone())?.over(self.proxy);
        let is_same = proxy == self.proxy;
        let seams = if is_same { self.atlas.seams.clone() } else { Vec::new() };
        let atlas = from_js::<AtlasOptions>(options)?.over(AtlasConfig { seams, ..self.atlas.clone() });
        let made = match is_same {
            true => self.texture.with_atlas(&atlas, job),
            false => self.texture.with_proxy(&proxy, &atlas, job),
        };
        *self = TextureHandle { texture: made.map_err(Failure::from)?, proxy, atlas };
        self.describe()
    }

    /// The soup as a file with texture coordinates, and its material: `{ obj, mtl }`.
    ///
    /// # Errors
    /// If and only if the format is another than `obj`, or a name has a line break.
    pub fn export(&self, format: &str, options: JsValue) -> Result<Object, JsValue> {
        if format != "obj" {
            let message = format!("unknown format '{format}': textures can be 'obj'");
            return Err(Failure::invalid(message).into());
        }
        let ExportOptions { name, image } = from_js(options)?;
        let name = name.unwrap_or_else(|| "texture".to_owned());
        let image = image.unwrap_or_else(|| format!("{name}.png"));
        let (mut obj, mut mtl) = (Vec::new(), Vec::new());
        let Texture { soup, mapping, .. } = &self.texture;
        write_textured_obj(soup, &mapping.uv, &format!("{name}.mtl"), &mut obj).map_err(Failure::invalid)?;
        write_material_library(&image, &mut mtl).map_err(Failure::invalid)?;
        Ok(object([("obj", bytes_to(&obj)?.into()), ("mtl", bytes_to(&mtl)?.into())]))
    }
}

/// xyzxyz…
fn flat(vectors: &[Vec3]) -> Result<Float64Array, Failure> {
    let numbers: Vec<f64> = vectors.iter().flat_map(|v| v.to_array()).collect();
    numbers_to(&numbers)
}

/// uvuvuv of each triangle.
pub(super) fn coordinates(corners: impl Iterator<Item = [Vec2; 3]>) -> Vec<f32> {
    corners.flatten().flat_map(|uv| uv.as_vec2().to_array()).collect()
}
