//! Textures for triangle soups (Schier, Hartmann & Klein 2018, *Fast Texture Mapping for Triangle Soups using Electrostatic Monopole
//! Field Lines*): a closed mesh around a soup is cut into charts and flattened, and field lines carry its texture coordinates to the
//! soup.
mod proxy;

pub use proxy::{Proxy, ProxyConfig, ProxyError, ProxySides, smallest_single_offset};
