//! The winding field of a soup or a cloud: one question, *how many times is this point inside?*
//!
//! `exact` is the definition and the oracle, `bounded` that of points that are bounded, `planar` the field of points of a
//! plane. `field` is the front: a soup's field (`soup_field`) is an integer by crossings
//! (`scan` on lattices, `locate` over `columns` at scattered points) and a fraction of what closes it (`chain`, `closure`,
//! `curtain`), summed on lattices by `boundary` and spared most inside tests of scattered points. Clouds (`cloud_field`) and
//! triangles that are not worth closing are summed by a dual tree where many points are asked for at once (`many`), and by the
//! tree of Barill et al. 2018 at few. `baselines` are the methods that papers compare theirs with. `saved` has fields as bytes.
mod angle_product;
mod baselines;
mod boundary;
mod bounded;
mod buckets;
mod chain;
mod closure;
mod cloud_field;
mod columns;
mod config;
mod curtain;
mod dipoles;
mod error_model;
mod exact;
mod facets;
mod field;
mod gradient;
mod half_angle;
mod locate;
mod many;
mod near;
mod planar;
mod saved;
mod scan;
mod soup_field;
mod surface_rule;
mod triangles;
mod variation;

pub use crate::treecode::{Order, Scratch};
pub use baselines::{ExactHierarchy, RayParity, Rays, StabCount, Stabbing, stab_lattice};
pub use bounded::{
    bounded, bounded_gradient_of_cloud, bounded_slope, bounded_winding_in_plane, bounded_winding_of_cloud,
};
pub(crate) use chain::{components, cycles, net_edges, weld};
pub use config::{Accuracy, FieldConfig, FieldError, FieldReport, THRESHOLD};
pub use dipoles::Dipoles;
pub use exact::{winding, winding_of_cloud, winding_of_soup};
pub use field::WindingField;
pub use gradient::{edge_gradient, winding_gradient, winding_gradient_of_cloud, winding_gradient_of_soup};
pub use planar::{PlanarCloud, PlanarConfig, PlanarCost, PlanarError, PlanarField};
pub use saved::{LoadError, is_saved_field};
pub use triangles::Triangles;
