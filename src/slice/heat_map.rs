use crate::data::{Grid, Lattice, Monitor};
use crate::math::{Aabb, Vec3};
use crate::winding::{Accuracy, FieldError, WindingField};

/// How much larger than the bounds the map is, on each side, in parts of the longest side: the field in openings bulges
/// out.
const MARGIN: f64 = 0.1;

/// The winding number on the plane at `z`, as a grid of square cells around the bounds: `resolution` along the longer
/// of x and y, one along z; values at the cells' centres.
///
/// # Errors
/// If and only if the shape is empty, `resolution` is 0 or too large, or the monitor cancels.
pub fn heat_map(
    field: &WindingField,
    z: f64,
    resolution: usize,
    monitor: &dyn Monitor,
) -> Result<Grid<f64>, FieldError> {
    let bounds = field.bounds();
    let flat = Aabb { min: bounds.min.with_z(z), max: bounds.max.with_z(z) };
    let margin = MARGIN * flat.size().max_element();
    let framed = Aabb {
        min: flat.min - Vec3::new(margin, margin, 0.0),
        max: flat.max + Vec3::new(margin, margin, 0.0),
    };
    let lattice = Lattice::with_resolution(if bounds.is_empty() { bounds } else { framed }, resolution)?;
    field.evaluate_lattice(&lattice, Accuracy::default(), monitor)
}
