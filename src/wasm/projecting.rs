//! Standard projections for JavaScript: what textures by field lines are compared with.
use super::convert::singles_to;
use super::failure::object;
use super::handle::Handle;
use super::options::from_js;
use super::printing::plain;
use super::texturing::coordinates;
use crate::texture::{Projected, Projection};
use js_sys::Object;
use serde::Deserialize;
use wasm_bindgen::prelude::*;

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ProjectionName {
    Planar,
    Triplanar,
    Cylindrical,
    Spherical,
}

#[derive(Default, Deserialize)]
struct ProjectOptions {
    method: Option<ProjectionName>,
}

#[wasm_bindgen]
impl Handle {
    /// Texture coordinates of a soup by a projection, tri-planar unless said otherwise: `{ uvs, scale, turn, distortion, seams }`.
    ///
    /// # Errors
    /// If and only if this is a cloud, the method is another, or memory does not suffice.
    pub fn project(&mut self, options: JsValue) -> Result<Object, JsValue> {
        let soup = self.soup_to_texture()?;
        let projection = match from_js::<ProjectOptions>(options)?.method {
            None | Some(ProjectionName::Triplanar) => Projection::Triplanar,
            Some(ProjectionName::Planar) => Projection::Planar,
            Some(ProjectionName::Cylindrical) => Projection::Cylindrical,
            Some(ProjectionName::Spherical) => Projection::Spherical,
        };
        let Projected { uv, scale, turn, distortion, seams } = Projected::new(&soup, projection);
        let uvs = singles_to(&coordinates(uv.into_iter()))?;
        Ok(object([
            ("uvs", uvs.into()),
            ("scale", scale.into()),
            ("turn", turn.into()),
            ("distortion", plain(&distortion)?),
            ("seams", plain(&seams)?),
        ]))
    }
}
