//! Textures for triangle soups (Schier, Hartmann & Klein 2018, *Fast Texture Mapping for Triangle Soups using Electrostatic Monopole
//! Field Lines*): a closed mesh around a soup is cut into charts and flattened, and field lines carry its texture coordinates to the
//! soup.
mod atlas;
mod distortion;
mod jacobian;
mod proxy;

pub use atlas::{Atlas, AtlasConfig, AtlasError, SeamCost, SeamError, seam_through};
pub use distortion::{Distortion, distortion};
pub use proxy::{Proxy, ProxyConfig, ProxyError, ProxySides, smallest_single_offset};
