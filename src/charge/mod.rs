//! Triangles as a charged conductor, and the lines of its electrostatic field: Schier, Hartmann & Klein 2018, *Fast Texture
//! Mapping for Triangle Soups using Electrostatic Monopole Field Lines*, section 7.
//!
//! A charge on each triangle makes the potential the same at all of their barycentres ([`ElectricField::solve`]); the field
//! then leads from any point of the surface to any surface around it ([`trace`], [`first_hits`]), and no two lines cross.
//! Coulomb's constant is 1: a charge q at a distance r has the potential q/r.
mod field;
mod hits;
mod lines;

pub use field::{ChargeConfig, ChargeError, ChargeReport, ElectricField, Solver};
pub use hits::{Hit, first_hits};
pub use lines::{FieldLines, Integrator, LineConfig, trace};
