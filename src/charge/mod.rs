//! Triangles as a charged conductor, and the lines of its electrostatic field: Schier, Hartmann & Klein 2018, *Fast Texture
//! Mapping for Triangle Soups using Electrostatic Monopole Field Lines*, section 7.
//!
//! A charge on each triangle makes the potential the same at all of their barycentres ([`ElectricField::solve`]); the field
//! then leads from any point of the surface to any surface around it ([`trace`], [`first_hits`]), and no two lines cross.
//! Coulomb's constant is 1: a charge q at a distance r has the potential q/r.
mod cells;
mod clusters;
mod config;
mod elements;
mod field;
mod hits;
mod influence;
mod krylov;
mod lines;
mod moments;
mod multipole;
mod panel;
mod panel_lanes;
mod polynomial;
mod robin_hood;
mod rule;
mod sources;
mod sum;
mod system;
mod trace;
mod walk;

pub use config::{ChargeConfig, ChargeError, ChargeReport, Solver};
pub use elements::Refinement;
pub use field::ElectricField;
pub use hits::{Hit, first_hits, first_hits_with};
pub use influence::Integration;
pub use lines::{FieldLines, Integrator, LineConfig, LineError};
pub use rule::Rule;
pub use trace::{Stop, trace, trace_until};
pub use walk::Opening;
