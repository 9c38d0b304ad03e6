//! Triangles across seams: put into one chart by its closest points, whichever keeps the area best (Schier et al. 2018, section 8).
//! What is flipped or squashed then, or was within one chart, is laid flat.
use crate::data::{Cancelled, Monitor, Shape, SurfaceMesh, TriangleSoup};
use crate::distance::DistanceTree;
use crate::math::{Vec2, Vec3, area_vector};
use crate::texture::jacobian::{Rest, polar};
use crate::texture::{Anchor, Anchors, Atlas, Proxy, SoupLines};
use glam::DQuat;
use rustc_hash::FxHashMap;
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

impl Placed {
    /// Its area over that in space, at the scale of the atlas; nothing if it has none in space.
    pub fn area_ratio(&self, corners: [Vec3; 3], scale: f64) -> Option<f64> {
        let area = area_vector(corners).length() * scale * scale;
        (area > 0.0).then(|| signed_area(self.uv) / area)
    }

    /// Whether a triangle with that ratio of areas is flipped or flat.
    pub fn is_flat(area_ratio: f64) -> bool {
        area_ratio <= FLAT
    }
}

/// A triangle with less than this share of the area that it should have counts as flat.
const FLAT: f64 = 1e-6;

/// A triangle that is this many times as long as wide in the texture, against what it is in space, or as large or small, is better laid
/// into a chart as it is.
const SQUASHED: f64 = 8.0;

fn signed_area([a, b, c]: [Vec2; 3]) -> f64 {
    0.5 * (b - a).perp_dot(c - a)
}

/// The charts of a proxy, each with a search for its closest point where triangles lie across its seams.
pub struct Charts<'a> {
    proxy: &'a Proxy,
    atlas: &'a Atlas,
    /// The box of each chart in the texture.
    boxes: Vec<[Vec2; 2]>,
    /// With the triangles of the mesh, in the order of the tree's.
    trees: Vec<Option<(DistanceTree, Vec<u32>)>>,
}

impl<'a> Charts<'a> {
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn new(
        proxy: &'a Proxy,
        atlas: &'a Atlas,
        lines: &SoupLines,
        anchors: &Anchors,
        monitor: &dyn Monitor,
    ) -> Result<Charts<'a>, Cancelled> {
        let chart = |start: &u32| atlas.charts[anchors.of_starts[*start as usize].face as usize];
        let mut is_needed = vec![false; atlas.chart_count];
        for corners in &lines.starts.corners {
            let all = [chart(&corners[0]), chart(&corners[1]), chart(&corners[2])];
            if all != [all[0]; 3] {
                all.iter().for_each(|c| is_needed[*c as usize] = true);
            }
        }
        let mut of = vec![Vec::new(); atlas.chart_count];
        (0..).zip(&atlas.charts).for_each(|(t, c)| of[*c as usize].push(t));
        let mut boxes = vec![[Vec2::INFINITY, Vec2::NEG_INFINITY]; atlas.chart_count];
        for (corners, chart) in atlas.corners.iter().zip(&atlas.charts) {
            let [low, high] = &mut boxes[*chart as usize];
            corners
                .iter()
                .map(|c| atlas.uv[*c as usize])
                .for_each(|p| (*low, *high) = (low.min(p), high.max(p)));
        }
        let mut trees = Vec::with_capacity(of.len());
        for (k, (faces, is_needed)) in of.into_iter().zip(is_needed).enumerate() {
            monitor.report(k as f64 / atlas.chart_count as f64, "texture")?;
            trees.push(is_needed.then(|| {
                let soup = part(&proxy.mesh, &faces);
                (DistanceTree::new(&Shape::Soup(Arc::new(soup))), faces)
            }));
        }
        Ok(Charts { proxy, atlas, boxes, trees })
    }

    /// The point of a chart that is closest to an anchor: itself, if it lies there.
    fn closest(&self, chart: u32, anchor: &Anchor) -> Anchor {
        if self.atlas.charts[anchor.face as usize] == chart {
            return *anchor;
        }
        let found = self.trees[chart as usize].as_ref().and_then(|(tree, faces)| {
            let nearest = tree.closest(anchor.point)?;
            let face = faces[nearest.element as usize];
            Some(Anchor { face, barycentric: nearest.barycentric, point: nearest.point })
        });
        found.unwrap_or(*anchor)
    }

    fn uv(&self, anchors: &[Anchor; 3]) -> [Vec2; 3] {
        anchors.map(|anchor| self.atlas.at(anchor.face, anchor.barycentric))
    }

    /// Where a triangle comes to lie whose corners correspond to `anchors`.
    pub fn placed(&self, corners: [Vec3; 3], anchors: [Anchor; 3]) -> Placed {
        let charts = anchors.map(|anchor| self.atlas.charts[anchor.face as usize]);
        let is_across = charts != [charts[0]; 3];
        let area = area_vector(corners).length() * self.atlas.scale * self.atlas.scale;
        let candidate = |chart: u32| {
            let moved = anchors.map(|anchor| self.closest(chart, &anchor));
            let uv = self.uv(&moved);
            (chart, moved, uv, (signed_area(uv) - area).abs())
        };
        let nearer = |best: (u32, [Anchor; 3], [Vec2; 3], f64), other: (u32, [Anchor; 3], [Vec2; 3], f64)| {
            if other.3 < best.3 { other } else { best }
        };
        let best = match is_across {
            false => (charts[0], anchors, self.uv(&anchors), 0.0),
            true => nearer(nearer(candidate(charts[0]), candidate(charts[1])), candidate(charts[2])),
        };
        let (chart, moved, uv, _) = best;
        let is_flat = area > 0.0 && Placed::is_flat(signed_area(uv) / area);
        let is_bad = is_flat || self.is_squashed(corners, uv);
        let outcome = match (is_bad, is_across) {
            (true, _) => Outcome::Unfolded,
            (false, true) => Outcome::Moved,
            (false, false) => Outcome::Met,
        };
        let uv = if is_bad { self.kept(self.unfolded(corners, &moved), chart) } else { uv };
        let [is_folded, is_squashed] = [is_flat, is_bad && !is_flat].map(|is| is && !is_across);
        Placed { uv, chart, outcome, is_across, is_folded, is_squashed }
    }

    /// A triangle moved as little as it takes to lie in the box of a chart, where it is no larger than that, and in the texture: one that is
    /// larger than that is made smaller.
    fn kept(&self, uv: [Vec2; 3], chart: u32) -> [Vec2; 3] {
        let within = |uv: [Vec2; 3], [low, high]: [Vec2; 2]| {
            let (least, most) = extent(uv);
            // Where it is larger than the box, middle on middle.
            let too_large = (most - least).cmpgt(high - low);
            let centred = 0.5 * (low + high - least - most);
            let shift = Vec2::select(
                too_large,
                centred,
                (low - least).max(Vec2::ZERO) + (high - most).min(Vec2::ZERO),
            );
            uv.map(|p| p + shift)
        };
        let (least, most) = extent(uv);
        let shrunk = (most - least).max_element().max(1.0).recip();
        let middle = 0.5 * (least + most);
        let uv = within(uv.map(|p| middle + shrunk * (p - middle)), self.boxes[chart as usize]);
        within(uv, [Vec2::ZERO, Vec2::ONE]).map(|p| p.clamp(Vec2::ZERO, Vec2::ONE))
    }

    /// Whether the lines or the closest points have left little of a triangle, or torn it apart.
    fn is_squashed(&self, corners: [Vec3; 3], uv: [Vec2; 3]) -> bool {
        let Some(rest) = Rest::new(corners) else { return false };
        let [large, small] = polar(rest.jacobian(uv)).0.map(|s| s / self.atlas.scale);
        let area = large * small;
        large > SQUASHED * small || !(1.0 / SQUASHED..=SQUASHED).contains(&area)
    }

    /// The triangle as it is in space, turned by the least angle into the plane of the face that its first corner corresponds to, and
    /// laid into the texture as that is: with its middle where the middle of its corners is.
    fn unfolded(&self, corners: [Vec3; 3], anchors: &[Anchor; 3]) -> [Vec2; 3] {
        let face = anchors[0].face;
        let mesh = &self.proxy.mesh;
        let places = mesh.triangles[face as usize].map(|v| mesh.positions[v as usize]);
        let (normal, own) =
            (area_vector(places).normalize_or_zero(), area_vector(corners).normalize_or_zero());
        let Some(rest) = Rest::new(places) else { return self.uv(anchors) };
        let [dx, dy] = rest.jacobian(self.atlas.corners_of(face));
        let x = (places[1] - places[0]).normalize_or_zero();
        let y = normal.cross(x);
        let turn = DQuat::from_rotation_arc(own, normal);
        let middle = corners.iter().sum::<Vec3>() / 3.0;
        let of_uv = self.uv(anchors).into_iter().sum::<Vec2>() / 3.0;
        corners.map(|p| {
            let p = turn * (p - middle);
            of_uv + p.dot(x) * dx + p.dot(y) * dy
        })
    }
}

fn extent([a, b, c]: [Vec2; 3]) -> (Vec2, Vec2) {
    (a.min(b).min(c), a.max(b).max(c))
}

/// The soup of some triangles of a mesh.
fn part(mesh: &SurfaceMesh, faces: &[u32]) -> TriangleSoup {
    let mut numbers = FxHashMap::default();
    let mut positions = Vec::new();
    let mut number = |v: u32| {
        *numbers.entry(v).or_insert_with(|| {
            positions.push(mesh.positions[v as usize]);
            positions.len() as u32 - 1
        })
    };
    let triangles = faces.iter().map(|t| mesh.triangles[*t as usize].map(&mut number)).collect();
    TriangleSoup::new(positions, triangles).expect("meshes of this crate are finite and indexed")
}
