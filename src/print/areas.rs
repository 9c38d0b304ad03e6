//! Sets of polygons grown, shrunk and combined, kept to the vertices that a nozzle can follow.
use crate::data::Polygon;
use crate::polygon::{Boolean, Join, combined, offset, simplify};
use std::f64::consts::PI;

/// Offsets leave two vertices at each bend of a smooth outline, this far from where one would be, in millimetres, and so the next
/// offset four: without them it is three times as fast.
const SLACK: f64 = 0.002;

/// Square millimetres.
pub(super) fn area(polygons: &[Polygon]) -> f64 {
    polygons.iter().map(Polygon::area).sum()
}

/// Polygons grown by a distance, or shrunk where it is negative.
pub(super) fn grown(polygons: &[Polygon], distance: f64) -> Vec<Polygon> {
    simplify(&offset(polygons, distance, Join::Miter), SLACK)
}

/// Parts of `whole` that are in `parts` or nearer to them than a distance.
pub(super) fn grown_within(parts: &[Polygon], distance: f64, whole: &[Polygon]) -> Vec<Polygon> {
    intersected(&grown(parts, distance), whole)
}

/// Polygons without what is narrower than a width.
pub(super) fn wide_parts(mut polygons: Vec<Polygon>, width: f64) -> Vec<Polygon> {
    // Slivers, which differences of curved outlines have by the hundred, hold no circle so wide.
    polygons.retain(|p| p.area() >= 0.25 * PI * width * width);
    grown(&grown(&polygons, -0.5 * width), 0.5 * width)
}

pub(super) fn without(first: &[Polygon], second: &[Polygon]) -> Vec<Polygon> {
    if second.is_empty() { first.to_vec() } else { combined(first, second, Boolean::Difference) }
}

pub(super) fn intersected(first: &[Polygon], second: &[Polygon]) -> Vec<Polygon> {
    combined(first, second, Boolean::Intersection)
}
