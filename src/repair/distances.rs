//! How far a remeshed surface is from its input.
use super::report::Distances;
use crate::bvh::Bvh;
use crate::data::{Monitor, TriangleSoup, ascending, fill_in_blocks};
use crate::math::{Aabb, Vec3, distance_to_triangle};
use crate::metrics::sample_surface;
use crate::winding::{Accuracy, FieldError, THRESHOLD, WindingField};

/// Most triangles in a leaf of a tree.
const LEAF_SIZE: usize = 4;
/// Places on the input, and vertices of the result, that are looked at.
const SAMPLES: usize = 20_000;
/// Of a cell: as far aside of a triangle it is asked what is inside there, and as far from it a vertex lies on it.
const ASIDE: f64 = 1e-3;
/// Cells within which the nearest triangle is looked for.
const REACH: f64 = 8.0;
const TOLERANCE: f64 = 1e-4;

/// Distances between `result`, made of cells of size `spacing`, and the soup that it was made of.
pub fn distances(
    result: &TriangleSoup,
    input: &TriangleSoup,
    field: &WindingField,
    spacing: f64,
    monitor: &dyn Monitor,
) -> Result<Distances, FieldError> {
    let step = result.positions().len().div_ceil(SAMPLES);
    let vertices: Vec<Vec3> = result.positions().iter().copied().step_by(step.max(1)).collect();
    let to_input = nearest(input, &vertices, spacing, monitor)?;
    let on_input = to_input.iter().filter(|d| **d <= ASIDE * spacing).count();
    let near: Vec<f64> = to_input.iter().copied().filter(|d| *d <= spacing).collect();
    let places = bounding_places(input, field, ASIDE * spacing, monitor)?;
    let from_input = nearest(result, &places, spacing, monitor)?;
    Ok(Distances {
        spacing,
        on_input: on_input as f64 / vertices.len().max(1) as f64,
        mean_to_input: mean(&near),
        most_to_input: quantile(&near, 1.0),
        mean_from_input: mean(&from_input),
        p99_from_input: quantile(&from_input, 0.99),
        most_from_input: quantile(&from_input, 1.0),
    })
}

/// Places spread evenly over the triangles of a soup, where one side alone is inside.
fn bounding_places(
    soup: &TriangleSoup,
    field: &WindingField,
    aside: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<Vec3>, FieldError> {
    let Ok(samples) = sample_surface(soup, SAMPLES, 1) else { return Ok(Vec::new()) };
    let side = |sign: f64| -> Vec<Vec3> {
        samples.points.iter().zip(&samples.normals).map(|(p, n)| *p + sign * aside * *n).collect()
    };
    let inside = |points: Vec<Vec3>| field.evaluate(&points, Accuracy::Tolerance(TOLERANCE), monitor);
    let (front, back) = (inside(side(1.0))?, inside(side(-1.0))?);
    let differs = front.iter().zip(&back).map(|(a, b)| (*a >= THRESHOLD) != (*b >= THRESHOLD));
    Ok(samples.points.iter().zip(differs).filter(|(_, differs)| *differs).map(|(p, _)| *p).collect())
}

/// The distance of each place from a soup, as far as it is looked for.
fn nearest(
    soup: &TriangleSoup,
    places: &[Vec3],
    spacing: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, FieldError> {
    let boxes: Vec<Aabb> = (0..soup.len()).map(|t| Aabb::around(soup.corners(t))).collect();
    let bvh = Bvh::build(&boxes, LEAF_SIZE);
    let mut found = vec![0.0; places.len()];
    let one = |k: usize, (): &mut ()| {
        let mut reach = 0.125 * spacing;
        loop {
            let mut least = f64::INFINITY;
            let is_near = |bounds: &Aabb| bounds.padded(reach).contains(places[k]);
            bvh.for_each(is_near, |t| least = least.min(distance_to_triangle(places[k], soup.corners(t))));
            if least <= reach || reach >= REACH * spacing {
                return least.min(REACH * spacing);
            }
            reach *= 2.0;
        }
    };
    fill_in_blocks(&mut found, one, "distances", monitor)?;
    Ok(found)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn quantile(values: &[f64], share: f64) -> f64 {
    let order = ascending(values.iter().copied());
    let place = (share * order.len().saturating_sub(1) as f64).round() as usize;
    order.get(place).map_or(0.0, |place| values[*place as usize])
}
