//! Triangles as a charged conductor, and the lines of its electrostatic field: Schier, Hartmann & Klein 2018, *Fast Texture
//! Mapping for Triangle Soups using Electrostatic Monopole Field Lines*, section 7.
//!
//! A charge on each triangle makes the potential the same at all of their barycentres ([`ElectricField::solve`]); the field
//! then leads from any point of the surface to any surface around it ([`trace`], [`first_hits`]), and no two lines cross.
//! Coulomb's constant is 1: a charge q at a distance r has the potential q/r.
//!
//! The tree is not that of [`crate::treecode`], of which only the lanes and the frame are used. Charges are on triangles, evenly, so
//! that what is near is not summed but given by closed forms of whole panels, point by point (`panel`), and the series begin with the
//! monopole, which dipoles do not have (`moments`). And the same sources are asked again and again, by other charges while these are
//! solved for (`system`) and by points that move on little by little (`cells`): what acts on a block of points is listed apart
//! from what it adds (`walk`, `sum`), so that the lists can be kept.
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
