//! From layers to a printer: lines for the nozzle ([`toolpaths`]), G-code of them ([`gcode`](gcode())), what a print takes
//! ([`Toolpaths::estimate`]).
//!
//! A line's cross-section is a rectangle: its volume is width × layer height × length, and so much filament is pushed. Walls lie
//! half a line's width inside the outline, neighbours one width apart; what is left inside is infill, or solid where a layer nearby
//! is open.
//!
//! ```
//! use fast_winding::data::{Layer, Polygon, Silent};
//! use fast_winding::math::Vec2;
//! use fast_winding::print::{PrinterProfile, ToolpathSettings, gcode, toolpaths};
//!
//! let outer = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)].map(Vec2::from).to_vec();
//! let polygons = vec![Polygon { outer, holes: vec![] }]; // of each layer, as `slice::slice` gives them
//! let layer = Layer { z_bottom: 0.0, z_top: 0.2, z_sample: 0.1, polygons };
//! let paths = toolpaths(&[layer], &ToolpathSettings::default(), &Silent)?;
//! assert!((paths.volume() - 20.0 * 20.0 * 0.2).abs() < 2.0);
//! let program = gcode(&paths, &PrinterProfile::default())?;
//! assert!(program.text.contains(";TYPE:WALL-OUTER"));
//! # Ok::<(), fast_winding::print::PrintError>(())
//! ```
mod areas;
mod estimate;
mod gcode;
mod gyroid;
mod hatch;
mod motion;
mod order;
mod path;
mod perimeters;
mod places;
mod profile;
mod seams;
mod settings;
mod solid;
mod thin;
mod toolpaths;

pub use estimate::Estimate;
pub use gcode::{GCode, gcode};
pub use path::{Approach, LayerPaths, Path, PathKind, Regions, Report, Toolpaths};
pub use profile::{Origin, Placement, PrinterProfile, ProfileError, Retraction, Speeds};
pub use settings::{Infill, Seam, ThinWalls, ToolpathSettings};
pub use toolpaths::toolpaths;

use crate::data::Cancelled;

/// Why something cannot be printed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrintError {
    #[error("{setting} cannot be {value}: {accepted} is wanted")]
    Setting { setting: &'static str, value: f64, accepted: &'static str },
    #[error("layer {layer} is {height} mm high: layers need a finite height above 0")]
    BadHeight { layer: usize, height: f64 },
    #[error("layer {layer} lies at z = {z} mm, not above the one before it")]
    NotAscending { layer: usize, z: f64 },
    #[error("layer {layer} has a coordinate that is not finite")]
    NonFinite { layer: usize },
    #[error("layer {layer} is {extent} mm wide, more than {max} lines of {width} mm", max = toolpaths::MAX_LINES)]
    TooFine { layer: usize, extent: f64, width: f64 },
    #[error("there is nothing to print: no layer has a line")]
    Empty,
    #[error(transparent)]
    Profile(#[from] ProfileError),
    #[error("the print reaches {axis} = {value:.2} mm, the bed goes from {least} to {most} mm")]
    OffBed { axis: char, value: f64, least: f64, most: f64 },
    #[error("{{{name}}} is not known in the {template} template; known are {known}", known = gcode::NAMES.join(", "))]
    Placeholder { template: &'static str, name: String },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
