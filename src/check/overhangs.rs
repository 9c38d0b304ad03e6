use super::faces::Face;
use super::report::{List, Overhangs};
use super::sides::Sample;
use crate::data::TriangleSoup;

/// Heights above the lowest point, as a share of the model's, at which a face lies on the bed.
const ON_BED: f64 = 1e-6;
const STEP: f64 = 5.0;
/// Degrees that rounding may take from the lean of a face: one at 45° does not lean out by more than that.
const ROUNDING: f64 = 1e-6;

/// Areas by how far faces lean out over what is below them; by the field, so that a flipped face counts as it should and one
/// inside of the solid does not.
pub fn overhangs(
    soup: &TriangleSoup,
    faces: &[Face],
    samples: &[Sample],
    angle: f64,
    limit: usize,
) -> Overhangs {
    let bounds = soup.bounds();
    let bed = bounds.min.z + ON_BED * bounds.size().z;
    let lean = |sample: &Sample| {
        let normal = faces[sample.face as usize].area_vector.normalize_or_zero();
        let down = -sample.outward(normal)?.z;
        let lies_on_bed = soup.corners(sample.face as usize).iter().all(|p| p.z <= bed);
        (down > 0.0 && !lies_on_bed).then(|| libm::asin(down.min(1.0)).to_degrees() + ROUNDING)
    };
    let mut found: Vec<(f64, f64, u32)> =
        samples.iter().filter_map(|s| Some((lean(s)?, s.area, s.face))).collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.2.cmp(&b.2)));
    let beyond = |angle: f64| found.iter().take_while(move |f| f.0 > angle + 2.0 * ROUNDING);
    let area = |angle: f64| beyond(angle).map(|f| f.1).sum::<f64>();
    let steps = (90.0 / STEP) as usize;
    let mut beyond_it: Vec<u32> = beyond(angle).map(|f| f.2).collect();
    beyond_it.sort_unstable();
    beyond_it.dedup();
    Overhangs {
        angle,
        area: area(angle),
        faces: List::new(beyond_it, limit),
        by_angle: (0..steps).map(|k| [STEP * k as f64, area(STEP * k as f64)]).collect(),
    }
}
