//! Level sets by continuation: from cells that hold geometry to their neighbours, as long as the level set goes on
//! (Wyvill et al. 1986). Knows grids and functions of space, nothing of where they come from.
//!
//! In space (`cubes`), nodes lie in `bricks` where the level set passes, get their values from the function (`sampling`), perhaps
//! smoothed (`blur`); where a smooth one crosses edges, all of them are asked for together (`roots`). In a plane, `squares`.
mod blur;
mod bricks;
mod cube_cases;
mod cubes;
mod roots;
mod sampling;
mod seeds;
mod squares;

pub use blur::Blur;
pub use cubes::{Edge, LevelSet, SurfaceGrid, TraceError, trace_surface};
pub use roots::find_roots;
pub use seeds::{
    Cell, cells_of_point, cells_of_points, cells_of_shape, cells_of_triangle, for_each_cell_of_shape,
    places_of_shape,
};
pub use squares::{PlaneGrid, trace_contours};

/// Where an inside test is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    /// At a node of the grid or amid a cell: the answer decides how the level set hangs together.
    Node,
    /// Between two nodes of which one is inside: the answer only moves the vertex there.
    Edge,
}

/// Steps of bisection on a crossed edge: to a millionth of it.
const BISECTIONS: u32 = 20;

/// Vertices keep this share of an edge away from its ends, so that no two of them coincide and outlines stay simple.
const CLEARANCE: f64 = 1e-6;

/// Where between 0 and 1 an inside test changes, given that it is `at_zero` at 0 and the opposite at 1.
///
/// Bisection, never interpolation: a winding number jumps at its surface, and between two samples of a cloud's field
/// lie singularities (Barill et al. 2018, Fig. 9).
pub fn crossing(at_zero: bool, mut inside: impl FnMut(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if inside(middle) == at_zero {
            low = middle;
        } else {
            high = middle;
        }
    }
    (0.5 * (low + high)).clamp(CLEARANCE, 1.0 - CLEARANCE)
}
