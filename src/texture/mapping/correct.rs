//! Triangles across seams: put into one chart by its closest points, whichever keeps the area best (Schier et al. 2018, section 8).
//!
//! At a corner of three charts a triangle's lines may all miss the chart in front of it: what is flipped or squashed is put into that
//! one; and what is so there too, as it lies across a sharp edge, in a narrow place or inside of other parts, is laid flat.
use super::charts::Charts;
use super::lay::laid;
use crate::data::{Cancelled, Monitor, Parts, Shape, TriangleSoup, fill_in_blocks};
use crate::distance::DistanceTree;
use crate::math::{Vec2, Vec3, area_vector, barycentre};
use crate::texture::jacobian::{Rest, polar};
use crate::texture::{Anchor, Anchors, SoupLines};
use std::sync::Arc;

/// How a triangle got its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outcome {
    /// All corners where their lines meet the proxy.
    #[default]
    Met,
    /// Some at the closest point of a chart.
    Moved,
    /// As it is in space, laid into a chart.
    Unfolded,
}

/// The place of a triangle in the texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placed {
    pub uv: [Vec2; 3],
    pub chart: u32,
    pub outcome: Outcome,
    /// Whether its corners met different charts.
    pub is_across: bool,
    /// Whether it was flipped or flat where its corners met one chart, and whether it was squashed there.
    pub is_folded: bool,
    pub is_squashed: bool,
}

/// A triangle with less than this share of the area that it should have counts as flat.
const FLAT: f64 = 1e-6;
/// A triangle that is this many times as long as wide in the texture, against what it is in space, or as large or small, is better laid
/// into a chart as it is.
const SQUASHED: f64 = 8.0;

impl Placed {
    /// Its area over that in space, at the scale of the atlas; nothing if it has none in space.
    pub fn area_ratio(&self, corners: [Vec3; 3], scale: f64) -> Option<f64> {
        let area = area_vector(corners).length() * scale * scale;
        (area > 0.0).then(|| signed_area(self.uv) / area)
    }

    /// Whether it is flipped, or flat.
    pub fn is_flat(&self, corners: [Vec3; 3], scale: f64) -> bool {
        self.area_ratio(corners, scale).is_some_and(|ratio| ratio <= FLAT)
    }

    /// Whether lines or closest points have left little of it, or torn it apart.
    fn is_distorted(&self, corners: [Vec3; 3], scale: f64) -> bool {
        let Some(rest) = Rest::new(corners) else { return false };
        let [large, small] = polar(rest.jacobian(self.uv)).0.map(|s| s / scale);
        large > SQUASHED * small || !(1.0 / SQUASHED..=SQUASHED).contains(&(large * small))
    }
}

fn signed_area([a, b, c]: [Vec2; 3]) -> f64 {
    0.5 * (b - a).perp_dot(c - a)
}

/// Where the triangles of a soup come to lie.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn all_placed(
    charts: &mut Charts,
    soup: &TriangleSoup,
    lines: &SoupLines,
    anchors: &Anchors,
    monitor: &dyn Monitor,
) -> Result<Vec<Placed>, Cancelled> {
    let monitor = &Parts::new(monitor);
    let of = |t: usize| lines.starts.corners[t].map(|s| anchors.of_starts[s as usize]);
    monitor.begin(0.0, 0.2);
    let met = |t: usize| of(t).map(|anchor| charts.chart(&anchor));
    let across = (0..soup.len()).map(met).filter(|charts| *charts != [charts[0]; 3]);
    let needed: Vec<u32> = across.flatten().collect();
    charts.prepare(needed.into_iter(), monitor)?;
    monitor.begin(0.2, 0.6);
    let mut all = vec![Placed::default(); soup.len()];
    let place = |t: usize, _: &mut ()| placed(charts, soup.corners(t), of(t));
    fill_in_blocks(&mut all, place, "texture", monitor)?;

    let bad: Vec<usize> = (0..all.len()).filter(|t| all[*t].outcome == Outcome::Unfolded).collect();
    if bad.is_empty() {
        return Ok(all);
    }
    monitor.begin(0.6, 0.7);
    let proxy = charts.proxy;
    let whole = DistanceTree::new(&Shape::Soup(Arc::new(proxy.soup())));
    let mut fronts = vec![Anchor::default(); bad.len()];
    let front = |k: usize, _: &mut ()| {
        let corners = soup.corners(bad[k]);
        let ahead = barycentre(corners) + proxy.offset * area_vector(corners).normalize_or_zero();
        let nearest = whole.closest(ahead).unwrap_or_default();
        Anchor { face: nearest.element, barycentric: nearest.barycentric, point: nearest.point }
    };
    fill_in_blocks(&mut fronts, front, "texture", monitor)?;
    monitor.begin(0.7, 0.8);
    let needed: Vec<u32> = fronts.iter().map(|front| charts.chart(front)).collect();
    charts.prepare(needed.into_iter(), monitor)?;
    monitor.begin(0.8, 1.0);
    let mut again = vec![Placed::default(); bad.len()];
    let place =
        |k: usize, _: &mut ()| in_front(charts, soup.corners(bad[k]), of(bad[k]), &fronts[k], all[bad[k]]);
    fill_in_blocks(&mut again, place, "texture", monitor)?;
    bad.into_iter().zip(again).for_each(|(t, placed)| all[t] = placed);
    Ok(all)
}

/// Where a triangle comes to lie whose corners correspond to `anchors`; what does not lie well there is still to be laid.
fn placed(charts: &Charts, corners: [Vec3; 3], anchors: [Anchor; 3]) -> Placed {
    let scale = charts.atlas.scale;
    let met = anchors.map(|anchor| charts.chart(&anchor));
    let is_across = met != [met[0]; 3];
    let area = area_vector(corners).length() * scale * scale;
    let candidate = |chart: u32| {
        let uv = anchors.map(|anchor| charts.uv(&charts.closest(chart, &anchor)));
        let outcome = if is_across { Outcome::Moved } else { Outcome::Met };
        Placed { uv, chart, outcome, is_across, is_folded: false, is_squashed: false }
    };
    let difference = |placed: &Placed| (signed_area(placed.uv) - area).abs();
    let nearer = |a: Placed, b: Placed| if difference(&b) < difference(&a) { b } else { a };
    let mut best = candidate(met[0]);
    if is_across {
        best = nearer(nearer(best, candidate(met[1])), candidate(met[2]));
    }
    let is_flat = best.is_flat(corners, scale);
    let is_bad = is_flat || best.is_distorted(corners, scale);
    best.is_folded = is_flat && !is_across;
    best.is_squashed = is_bad && !is_flat && !is_across;
    if is_bad {
        best.outcome = Outcome::Unfolded;
    }
    best
}

/// Where a triangle comes to lie in the chart in front of its middle.
fn in_front(
    charts: &Charts,
    corners: [Vec3; 3],
    anchors: [Anchor; 3],
    front: &Anchor,
    before: Placed,
) -> Placed {
    let (chart, scale) = (charts.chart(front), charts.atlas.scale);
    let uv = anchors.map(|anchor| charts.uv(&charts.closest(chart, &anchor)));
    let moved = Placed { uv, chart, outcome: Outcome::Moved, ..before };
    if moved.is_flat(corners, scale) || moved.is_distorted(corners, scale) {
        Placed { uv: laid(charts, corners, front), chart, ..before }
    } else {
        moved
    }
}
