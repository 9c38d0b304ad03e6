//! Textures for triangle soups (Schier, Hartmann & Klein 2018, *Fast Texture Mapping for Triangle Soups using Electrostatic Monopole
//! Field Lines*): a closed mesh around a soup is cut into charts and flattened, and field lines carry its texture coordinates to the
//! soup.
//!
//! [`texture()`] does it all: soup → [`Proxy`] → [`Atlas`] → [`SoupLines`] → [`Anchors`] → [`Mapping`]. Each stage is there by itself.
//! The lines know nothing of the proxy: another one needs new anchors, and nothing else of the field.
mod anchors;
mod atlas;
mod baseline;
mod distortion;
mod jacobian;
mod lines;
mod mapping;
mod proxy;
mod refine;
mod run;
mod seams;
mod shown;
mod starts;

pub use anchors::{Anchor, Anchors};
pub use atlas::{Atlas, AtlasConfig, AtlasError, SeamCost, SeamError, seam_through};
pub use baseline::{Projected, Projection, projected};
pub use distortion::{Distortion, distortion};
pub use lines::{SoupLines, SoupLinesConfig, SoupLinesError};
pub use mapping::{Affected, Mapping, MappingReport, transferred};
pub use proxy::{Proxy, ProxyConfig, ProxyError, ProxySides, smallest_single_offset};
pub use refine::{Refined, refined};
pub use run::{Texture, TextureConfig, TextureError, TextureReport, texture};
pub use seams::{Seams, apart_by_chart, seams};
pub use starts::Starts;
