//! Clusters of sources with their multipole moments, bottom-up over a [`Bvh`].
use super::factors::factors;
use super::moments::{COEFFICIENTS, Member, Moments};
use super::{SourceKind, Sources};
use crate::bvh::{Bvh, morton_code};
use crate::data::{map_items, map_parts, set_each};
use crate::math::{Aabb, Vec3, area_vector};
use crate::treecode::expansion::sum_of_lanes;
use crate::treecode::frame::Frame;
use crate::treecode::links::{Link, link, spans};
use std::f64::consts::PI;
use std::ops::Range;
use wide::f32x4;

/// Where a cluster is, in the tree's unit frame: x, y, z of the centre, and the distance of the farthest corner of a
/// source from it, rounded up.
pub type Ball = [f32; 4];

/// The far field of a cluster.
#[derive(Clone, Copy)]
pub struct Series {
    /// Σ |area vector|, rounded up.
    pub area: f32,
    /// Upper bounds of the means over the area of (|y|/radius)^k, k = 2 and 4, y relative to the centre.
    pub spread: [f32; 2],
    /// Of the moments / (4π · area · radius^(n−1)), n = |γ|, which are of the order of 1.
    pub factors: [f32; COEFFICIENTS],
}

/// All clusters; those below one are contiguous.
pub struct Clusters {
    pub balls: Vec<Ball>,
    pub links: Vec<Link>,
    pub series: Vec<Series>,
    /// The largest extents of their sources, if these are bounded; none else.
    pub extents: Vec<f32>,
    /// The clusters at the top.
    pub roots: Range<usize>,
    /// Sources in the order of the Morton curve.
    pub items: Vec<u32>,
    pub frame: Frame,
}

/// What rounds 32-bit results of a few operations up: 8 units in the last place.
const ROUND_UP: f64 = 1.0 + 5e-7;
/// The same for sums of many positive numbers, four at a time, each no longer than a cluster.
const ROUND_SUM_UP: f32 = 1.01;

/// How far a corner can be from what 32-bit floats make of it: √3 · 2⁻²⁵, as coordinates are up to 1/2; and a little more.
const CORNER_ROUNDING: f64 = 6e-8;

/// Sources whose corners are one task.
const SOURCES_PER_TASK: usize = 1024;
/// Clusters whose moments are one task.
const PARTS_PER_TASK: usize = 256;

/// A cluster while the tree is being built.
#[derive(Clone, Copy)]
struct Part {
    area: f64,
    center: Vec3,
    moments: Moments,
}

impl Clusters {
    pub fn build(sources: &dyn Sources, leaf_size: usize) -> Clusters {
        let kind = sources.kind();
        let bounds = Aabb::around((0..sources.len()).flat_map(|i| sources.corners(i)));
        let code = |i: usize| morton_code(Aabb::around(sources.corners(i)).center(), &bounds);
        let bvh = Bvh::along_curve(map_items(sources.len(), code), leaf_size);
        let frame = Frame::around(&bounds);
        let (links, levels) = link(&bvh);
        let member = |place: usize| Member::new(sources, bvh.items()[place] as usize, &frame);
        let empty = Part { area: 0.0, center: Vec3::ZERO, moments: Moments::ZERO };
        let mut parts = vec![empty; links.len()];
        for level in levels.iter().rev() {
            let (upper, lower) = parts.split_at_mut(level.end);
            set_each(&mut upper[level.clone()], PARTS_PER_TASK, |k, part| {
                let link = &links[level.start + k];
                let range = link.range();
                *part = if link.is_leaf() {
                    Part::of_sources(&range.map(member).collect::<Vec<_>>(), kind)
                } else {
                    Part::of_parts(&lower[range.start - level.end..range.end - level.end])
                };
            });
        }
        let corners = Corners::new(sources.len(), kind, &member);
        let spans = spans(&links);
        let (balls, series) =
            map_items(parts.len(), |k| parts[k].pack(&corners, &spans[k])).into_iter().unzip();
        let roots = levels.first().cloned().unwrap_or(0..0);
        let items = bvh.items().to_vec();
        let extents = extents(sources, &spans, &items, frame.scale);
        Clusters { balls, links, series, extents, roots, items, frame }
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.balls[..])
            + size_of_val(&self.links[..])
            + size_of_val(&self.series[..])
            + size_of_val(&self.extents[..])
            + size_of_val(&self.items[..])
    }
}

/// The largest extent of a source of each cluster, in the unit frame; nothing where no source is bounded.
pub(super) fn extents(sources: &dyn Sources, spans: &[Range<usize>], items: &[u32], scale: f64) -> Vec<f32> {
    if sources.is_empty() || sources.extent(0).is_none() {
        return vec![];
    }
    let of_cluster = |k: usize| {
        let all = items[spans[k].clone()].iter().filter_map(|i| sources.extent(*i as usize));
        (scale * all.fold(0.0, f64::max) * ROUND_UP) as f32
    };
    map_items(spans.len(), of_cluster)
}

impl Part {
    fn of_sources(members: &[Member], kind: SourceKind) -> Part {
        let (mut area, mut weighted, mut middle) = (0.0, Vec3::ZERO, Aabb::EMPTY);
        for Member { corners: [a, b, c], area_vector } in members {
            let own = area_vector.length();
            area += own;
            weighted += own / 3.0 * (*a + *b + *c);
            middle = middle.including(*a).including(*b).including(*c);
        }
        let center = narrowed(area, weighted, middle.center());
        Part { area, center, moments: Moments::of(members, kind, center) }
    }

    fn of_parts(parts: &[Part]) -> Part {
        let area = parts.iter().map(|p| p.area).sum();
        let weighted = parts.iter().map(|p| p.area * p.center).sum();
        let middle = Aabb::around(parts.iter().map(|p| p.center)).center();
        let center = narrowed(area, weighted, middle);
        let mut moments = Moments::ZERO;
        parts.iter().for_each(|p| moments.add_cluster(&p.moments, p.center - center));
        Part { area, center, moments }
    }

    fn pack(&self, corners: &Corners, span: &Range<usize>) -> (Ball, Series) {
        let (radius, squares, fourths) = corners.spread(span, self.center);
        let area = (self.area * ROUND_UP) as f32;
        let safe = |x: f32| if x > 0.0 { 1.0 / f64::from(x) } else { 0.0 };
        let (per_area, per_radius) = (safe(area), safe(radius));
        let mut scale = per_area / (4.0 * PI);
        let mut coefficients = [0.0; COEFFICIENTS];
        for n in 1..5 {
            let degree = n * n - 1..n * n + 2 * n;
            let terms = &self.moments.coefficients[degree.clone()];
            coefficients[degree].iter_mut().zip(terms).for_each(|(c, term)| *c = scale * term);
            scale *= per_radius;
        }
        // By Minkowski's inequality, corners that were moved by CORNER_ROUNDING move the power mean by no more.
        let mean = |sum: f32, power: i32| {
            let square = (f64::from(sum * ROUND_SUM_UP) * per_area).sqrt();
            let seen = if power == 2 { square } else { square.sqrt() };
            let bound = ((seen + CORNER_ROUNDING) * per_radius).powi(power) * ROUND_UP;
            bound.min(1.0) as f32
        };
        let spread = [mean(squares, 2), mean(fourths, 4)];
        let [x, y, z] = self.center.to_array().map(|c| c as f32);
        ([x, y, z, radius], Series { area, spread, factors: factors(&coefficients).map(|f| f as f32) })
    }
}

impl Member {
    /// A source in the unit frame.
    fn new(sources: &dyn Sources, item: usize, frame: &Frame) -> Member {
        let corners = sources.corners(item).map(|corner| frame.local(corner));
        let area_vector = match sources.kind() {
            SourceKind::Triangles => area_vector(corners),
            SourceKind::Points => frame.scale * frame.scale * sources.area_vector(item),
        };
        Member { corners, area_vector }
    }
}

/// A centre that is exact in 32-bit floats, so that storing it rounds nothing.
fn narrowed(area: f64, weighted: Vec3, otherwise: Vec3) -> Vec3 {
    let center = if area > 0.0 { weighted / area } else { otherwise };
    Vec3::from_array(center.to_array().map(|x| f64::from(x as f32)))
}

/// Corners of all sources in tree order, and areas, in 32-bit floats: for the extents of clusters only.
struct Corners {
    /// x, y, z of the corners of each source, and a share of its area.
    corners: Vec<[f32; 4]>,
    for_each: usize,
}

impl Corners {
    fn new(sources: usize, kind: SourceKind, member: &(dyn Fn(usize) -> Member + Sync)) -> Corners {
        let for_each = if kind == SourceKind::Points { 1 } else { 3 };
        let mut all = vec![[0.0; 4]; for_each * sources];
        map_parts(&mut all, for_each * SOURCES_PER_TASK, |part, corners| {
            for (k, corners) in corners.chunks_mut(for_each).enumerate() {
                let member = member(part * SOURCES_PER_TASK + k);
                let share = (member.area_vector.length() / for_each as f64 * ROUND_UP) as f32;
                for (to, corner) in corners.iter_mut().zip(member.corners) {
                    *to = [corner.x as f32, corner.y as f32, corner.z as f32, share];
                }
            }
        });
        Corners { corners: all, for_each }
    }

    /// The largest distance of a corner in `span` from `center`, rounded up, and the sums of area times the square and the
    /// fourth power of the distance. A power is convex, so that the mean over the corners is no less than that over the
    /// triangle.
    fn spread(&self, span: &Range<usize>, center: Vec3) -> (f32, f32, f32) {
        let [x, y, z] = center.to_array().map(|c| f32x4::splat(c as f32));
        let corners = &self.corners[span.start * self.for_each..span.end * self.for_each];
        let (mut largest, mut squares, mut fourths) = (f32x4::ZERO, f32x4::ZERO, f32x4::ZERO);
        for group in corners.chunks(4) {
            // Repeating a corner without its area changes nothing.
            let at = |k: usize| {
                let [x, y, z, share] = *group.get(k).unwrap_or(&group[0]);
                f32x4::from([x, y, z, if k < group.len() { share } else { 0.0 }])
            };
            let [xs, ys, zs, shares] = f32x4::transpose([at(0), at(1), at(2), at(3)]);
            let (dx, dy, dz) = (xs - x, ys - y, zs - z);
            let square = dx * dx + dy * dy + dz * dz;
            largest = largest.fast_max(square);
            squares += shares * square;
            fourths += shares * (square * square);
        }
        let farthest = largest.to_array().into_iter().fold(0.0, f32::max).sqrt();
        let radius = farthest * ROUND_UP as f32 + CORNER_ROUNDING as f32;
        (radius, sum_of_lanes(squares) as f32, sum_of_lanes(fourths) as f32)
    }
}
