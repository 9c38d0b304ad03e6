//! Triangles across seams: put into one chart by its closest points, whichever keeps the area best (Schier et al. 2018, section 8).
//!
//! At a corner of three charts a triangle's lines may all miss the chart in front of it, which is tried too. What is flipped or squashed
//! in each of them, as it lies across a sharp edge, in a narrow place or inside of other parts, is laid flat.
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
    let mut all = vec![Placed::default(); soup.len()];
    monitor.begin(0.0, 0.2);
    let place = |t: usize, _: &mut ()| met(charts, soup.corners(t), of(t));
    fill_in_blocks(&mut all, place, "texture", monitor)?;
    let open: Vec<usize> = (0..all.len()).filter(|t| all[*t].outcome != Outcome::Met).collect();
    if open.is_empty() {
        return Ok(all);
    }
    monitor.begin(0.2, 0.4);
    let fronts = in_front(charts, soup, &open, monitor)?;
    monitor.begin(0.4, 0.6);
    let needed: Vec<u32> =
        open.iter().zip(&fronts).flat_map(|(t, front)| candidates(charts, &all[*t], of(*t), front)).collect();
    charts.prepare(needed.into_iter(), monitor)?;
    monitor.begin(0.6, 1.0);
    let mut moved = vec![Placed::default(); open.len()];
    let place = |k: usize, _: &mut ()| {
        corrected(charts, soup.corners(open[k]), of(open[k]), &fronts[k], all[open[k]])
    };
    fill_in_blocks(&mut moved, place, "texture", monitor)?;
    open.into_iter().zip(moved).for_each(|(t, placed)| all[t] = placed);
    Ok(all)
}

/// A triangle where its corners meet the proxy; what lies across charts or does not lie well is still to be corrected.
fn met(charts: &Charts, corners: [Vec3; 3], anchors: [Anchor; 3]) -> Placed {
    let scale = charts.atlas.scale;
    let of_corners = anchors.map(|anchor| charts.chart(&anchor));
    let mut placed =
        Placed { uv: anchors.map(|anchor| charts.uv(&anchor)), chart: of_corners[0], ..Placed::default() };
    placed.is_across = of_corners != [of_corners[0]; 3];
    if !placed.is_across {
        placed.is_folded = placed.is_flat(corners, scale);
        placed.is_squashed = !placed.is_folded && placed.is_distorted(corners, scale);
    }
    if placed.is_across || placed.is_folded || placed.is_squashed {
        placed.outcome = Outcome::Moved;
    }
    placed
}

/// The points of the proxy in front of some triangles: nearest to their middles, moved along their normals by the offset.
fn in_front(
    charts: &Charts,
    soup: &TriangleSoup,
    triangles: &[usize],
    monitor: &dyn Monitor,
) -> Result<Vec<Anchor>, Cancelled> {
    let proxy = charts.proxy;
    let whole = DistanceTree::new(&Shape::Soup(Arc::new(proxy.soup())));
    let mut fronts = vec![Anchor::default(); triangles.len()];
    let front = |k: usize, _: &mut ()| {
        let corners = soup.corners(triangles[k]);
        let ahead = barycentre(corners) + proxy.offset * area_vector(corners).normalize_or_zero();
        let nearest = whole.closest(ahead).unwrap_or_default();
        Anchor { face: nearest.element, barycentric: nearest.barycentric, point: nearest.point }
    };
    fill_in_blocks(&mut fronts, front, "texture", monitor)?;
    Ok(fronts)
}

/// The charts that a triangle may be put into: those of its corners, if they differ, and the one in front of it.
fn candidates(
    charts: &Charts,
    placed: &Placed,
    anchors: [Anchor; 3],
    front: &Anchor,
) -> impl Iterator<Item = u32> {
    let of_corners = anchors.map(|anchor| charts.chart(&anchor));
    let corners = if placed.is_across { 3 } else { 0 };
    of_corners.into_iter().take(corners).chain([charts.chart(front)])
}

/// A triangle with the closest points of the chart that keeps its area best, of those where it is not distorted; if there is none, laid
/// flat.
fn corrected(
    charts: &Charts,
    corners: [Vec3; 3],
    anchors: [Anchor; 3],
    front: &Anchor,
    before: Placed,
) -> Placed {
    let scale = charts.atlas.scale;
    let area = area_vector(corners).length() * scale * scale;
    let mut best: Option<(f64, Placed)> = None;
    for chart in candidates(charts, &before, anchors, front) {
        let uv = anchors.map(|anchor| charts.uv(&charts.closest(chart, &anchor)));
        let tried = Placed { uv, chart, ..before };
        let difference = (signed_area(uv) - area).abs();
        let is_good = !tried.is_flat(corners, scale) && !tried.is_distorted(corners, scale);
        if is_good && best.is_none_or(|(least, _)| difference < least) {
            best = Some((difference, tried));
        }
    }
    let unfolded = || Placed {
        uv: laid(charts, corners, front),
        chart: charts.chart(front),
        outcome: Outcome::Unfolded,
        ..before
    };
    best.map_or_else(unfolded, |(_, placed)| placed)
}
