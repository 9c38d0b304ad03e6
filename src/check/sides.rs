//! The field on both sides of the faces.
//!
//! At a point of a face w jumps by the faces that the point lies on. Rounding moves the point to one side of each of them,
//! which exact predicates tell; w there, which is exact to its tolerance, and the jumps give w on both sides.
use super::faces::Face;
use crate::bvh::Bvh;
use crate::data::{Monitor, TriangleSoup, map_items};
use crate::math::{Aabb, Vec3, barycentre, distance_to_triangle, side_of_plane};
use crate::winding::{Accuracy, FieldError, WindingField};

/// Roundings of the largest coordinate that a point may lie beside a face it is on.
const ROUNDINGS: f64 = 8.0;
/// Cosine of the largest angle between faces that count as one sheet.
const PARALLEL: f64 = 1.0 - 1e-9;
/// Errors of w at first, and where that does not decide what is inside.
const ERRORS: [f64; 2] = [1e-3, 1e-5];
/// By how much w has to be above 1/2: next to a flat sheet it is not, though it comes as near to it as one likes.
const TIE: f64 = 2e-5;

/// A point of a face, and w on both of its sides.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub face: u32,
    pub point: Vec3,
    /// Of the face, for which the point stands.
    pub area: f64,
    /// On the side to which the normal points, and on the other.
    pub w: [f64; 2],
}

impl Sample {
    /// Whether there is solid on the side to which the normal points, and on the other.
    pub fn inside(&self) -> [bool; 2] {
        self.w.map(|w| w > 0.5 + TIE)
    }

    /// The direction out of the solid, for the normal of the face; none unless it is on one side.
    pub fn outward(&self, normal: Vec3) -> Option<Vec3> {
        match self.inside() {
            [false, true] => Some(normal),
            [true, false] => Some(-normal),
            _ => None,
        }
    }
}

/// About `count` points on the faces with area by their area, one of each at least; the first is its barycentre. They are moved
/// out of the face's plane by roundings of the size `step`, as principal values take longer than others.
fn places(soup: &TriangleSoup, faces: &[Face], count: usize, step: f64) -> Vec<Sample> {
    let total: f64 = faces.iter().map(|face| face.area).sum();
    // A share of the area may be anything where that overflows.
    let per_area = if total > 0.0 && total.is_finite() { count as f64 / total } else { 0.0 };
    let mut samples = Vec::with_capacity(faces.len());
    for (t, face) in faces.iter().enumerate().filter(|(_, face)| !face.is_degenerate) {
        let corners = soup.corners(t);
        let [a, b, c] = corners;
        let n = (face.area * per_area).ceil().clamp(1.0, count.max(1) as f64) as usize;
        samples.extend((0..n).map(|k| {
            let point = match k {
                0 => barycentre(corners),
                _ => {
                    // The additive recurrence R2 (Roberts 2018) in the triangle.
                    let [u, v] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2]
                        .map(|g: f64| (g * k as f64).fract());
                    let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
                    a + u * (b - a) + v * (c - a)
                }
            };
            let point = beside_plane(point, corners, face.area_vector, step);
            Sample { face: t as u32, point, area: face.area / n as f64, w: [0.0; 2] }
        }));
    }
    samples
}

fn beside_plane(mut point: Vec3, corners: [Vec3; 3], normal: Vec3, step: f64) -> Vec3 {
    let axis = normal.abs().max_position();
    for _ in 0..2 {
        if side_of_plane(point, corners) != 0 {
            break;
        }
        point[axis] += step;
    }
    point
}

/// Points on the faces with w on both of their sides.
pub fn sample(
    field: &WindingField,
    soup: &TriangleSoup,
    faces: &[Face],
    bvh: &Bvh,
    count: usize,
    monitor: &dyn Monitor,
) -> Result<Vec<Sample>, FieldError> {
    let bounds = field.bounds();
    let rounding = f64::EPSILON * bounds.min.abs().max(bounds.max.abs()).max_element();
    let reach = ROUNDINGS * rounding;
    let mut samples = places(soup, faces, count, rounding);
    // What to add to w at the point for w on either side.
    let jumps = map_items(samples.len(), |i| jumps_at(&samples[i], soup, faces, bvh, reach));
    let points: Vec<Vec3> = samples.iter().map(|sample| sample.point).collect();
    let values = field.evaluate(&points, Accuracy::Tolerance(ERRORS[0]), monitor)?;
    for ((sample, jump), w) in samples.iter_mut().zip(&jumps).zip(values) {
        sample.w = jump.map(|jump| w + jump);
    }
    if field.is_closed() {
        return Ok(samples);
    }
    let is_open = |sample: &Sample| sample.w.iter().any(|w| (w - 0.5).abs() <= 2.0 * ERRORS[0]);
    let open: Vec<usize> = (0..samples.len()).filter(|i| is_open(&samples[*i])).collect();
    let points: Vec<Vec3> = open.iter().map(|i| points[*i]).collect();
    let values = field.evaluate(&points, Accuracy::Tolerance(ERRORS[1]), monitor)?;
    open.iter().zip(values).for_each(|(i, w)| samples[*i].w = jumps[*i].map(|jump| w + jump));
    Ok(samples)
}

fn jumps_at(sample: &Sample, soup: &TriangleSoup, faces: &[Face], bvh: &Bvh, reach: f64) -> [f64; 2] {
    let (q, normal) = (sample.point, faces[sample.face as usize].area_vector.normalize_or_zero());
    let near = Aabb { min: q, max: q }.padded(reach);
    let mut jumps = [0.0; 2];
    bvh.for_each(
        |bounds| bounds.overlaps(&near),
        |t| {
            let cosine = faces[t].area_vector.normalize_or_zero().dot(normal);
            let is_itself = t == sample.face as usize;
            if !is_itself && (cosine.abs() < PARALLEL || distance_to_triangle(q, soup.corners(t)) > reach) {
                return;
            }
            // Where q lies, along the normal of the sample's face; against the normal, w rises by the face's turn.
            let turn = if is_itself { 1.0 } else { cosine.signum() };
            let place = turn * f64::from(side_of_plane(q, soup.corners(t)));
            jumps[0] -= turn * (0.5 - 0.5 * place);
            jumps[1] += turn * (0.5 + 0.5 * place);
        },
    );
    jumps
}

/// The two answers of most of the area of each face: solid on the side to which its normal points, and on the other; both
/// `false` for faces without samples.
pub struct FaceSides {
    /// Area for which `inside` is [false, false], [true, false], [false, true], [true, true].
    areas: Vec<[f64; 4]>,
    /// Sum of area times the mean of w on both sides.
    means: Vec<f64>,
}

impl FaceSides {
    pub fn new(samples: &[Sample], faces: usize) -> FaceSides {
        let (mut areas, mut means) = (vec![[0.0; 4]; faces], vec![0.0; faces]);
        for sample in samples {
            let [plus, minus] = sample.inside();
            areas[sample.face as usize][usize::from(plus) + 2 * usize::from(minus)] += sample.area;
            means[sample.face as usize] += 0.5 * (sample.w[0] + sample.w[1]) * sample.area;
        }
        FaceSides { areas, means }
    }

    pub fn areas(&self, face: usize) -> [f64; 4] {
        self.areas[face]
    }

    /// The area of a face times the mean of w on both of its sides.
    pub fn mean(&self, face: usize) -> f64 {
        self.means[face]
    }

    fn is_all(&self, face: usize, kind: usize) -> bool {
        let areas = self.areas[face];
        areas[kind] > 0.0 && areas.iter().enumerate().all(|(k, area)| k == kind || *area == 0.0)
    }

    /// Whether both sides are inside at all samples of a face.
    pub fn is_internal(&self, face: usize) -> bool {
        self.is_all(face, 3)
    }

    pub fn is_outside(&self, face: usize) -> bool {
        self.is_all(face, 0)
    }
}
