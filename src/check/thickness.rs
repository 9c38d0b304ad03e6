//! How thick the solid is, by rays from points of its surface straight into it.
use super::faces::Face;
use super::report::{List, Thickness};
use super::sides::Sample;
use crate::bvh::{Bvh, FirstHit};
use crate::data::{Cancelled, Monitor, TriangleSoup, fill_in_blocks};
use crate::math::Ray;

/// Roundings of the largest coordinate that a hit has to be away to be another place.
const ROUNDINGS: f64 = 64.0;
/// Surfaces in the solid that a ray goes through at most.
const MOST_HITS: usize = 1000;
const PERCENTS: [f64; 7] = [1.0, 5.0, 10.0, 25.0, 50.0, 75.0, 95.0];

/// Rays begin with w on the side of the solid; each face that they meet changes it by one, and where it falls below 1/2 the
/// solid ends. So they go through faces inside of it. None if no ray ends.
pub fn thickness(
    soup: &TriangleSoup,
    faces: &[Face],
    bvh: &Bvh,
    samples: &[Sample],
    (threshold, limit): (f64, usize),
    monitor: &dyn Monitor,
) -> Result<Option<Thickness>, Cancelled> {
    let bounds = soup.bounds();
    let least = ROUNDINGS * f64::EPSILON * bounds.min.abs().max(bounds.max.abs()).max_element();
    let farthest = 2.0 * bounds.diagonal();
    let far = |i: usize, search: &mut FirstHit| -> f64 {
        let sample = &samples[i];
        let Some(out) = sample.outward(faces[sample.face as usize].area_vector.normalize_or_zero()) else {
            return f64::NAN;
        };
        let ray = Ray::new(sample.point, -out);
        let mut w = sample.w[0].max(sample.w[1]);
        // Faces met at `past` and counted already.
        let (mut past, mut there) = (least, Vec::new());
        for _ in 0..MOST_HITS {
            let meet = |t: usize| {
                let (distance, _) = ray.meet(soup.corners(t))?;
                (distance > past || distance == past && !there.contains(&t)).then_some(distance)
            };
            let Some((distance, t)) = search.find(bvh, &ray, farthest, meet) else { return f64::INFINITY };
            if distance > past {
                there.clear();
            }
            past = distance;
            there.push(t);
            let is_leaving = ray.direction.dot(faces[t].area_vector) > 0.0;
            w += if is_leaving { -1.0 } else { 1.0 };
            if w < 0.5 {
                return distance;
            }
        }
        f64::INFINITY
    };
    let mut found = vec![0.0; samples.len()];
    fill_in_blocks(&mut found, far, "thickness", monitor)?;
    let mut measured: Vec<(f64, f64, usize)> = (0..samples.len())
        .filter(|i| found[*i].is_finite())
        .map(|i| (found[i], samples[i].area, i))
        .collect();
    measured.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let Some(&(minimum, _, thinnest)) = measured.first() else { return Ok(None) };
    let total: f64 = measured.iter().map(|m| m.1).sum();
    let mut at = measured.iter();
    let (mut sum, mut reached) = (0.0, minimum);
    let percentiles = PERCENTS.map(|percent| {
        while sum < percent / 100.0 * total {
            let Some((thickness, area, _)) = at.next() else { break };
            (sum, reached) = (sum + area, *thickness);
        }
        [percent, reached]
    });
    let thin = || measured.iter().take_while(|m| m.0 < threshold);
    let mut thin_faces: Vec<u32> = thin().map(|m| samples[m.2].face).collect();
    thin_faces.sort_unstable();
    thin_faces.dedup();
    Ok(Some(Thickness {
        samples: measured.len(),
        unbounded: found.iter().filter(|f| **f == f64::INFINITY).count(),
        minimum,
        thinnest_face: samples[thinnest].face,
        thinnest_point: samples[thinnest].point.to_array(),
        percentiles: percentiles.to_vec(),
        threshold,
        thin_area: thin().map(|m| m.1).sum(),
        thin_faces: List::new(thin_faces, limit),
    }))
}
