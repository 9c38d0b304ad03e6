//! What is open above or below gets skins and solid layers; what lies over nothing gets bridges.
use super::areas::{area, grown_within, intersected, wide_parts, without};
use super::hatch::{Hatch, hatch};
use super::path::{Regions, Report, length_of};
use super::settings::ToolpathSettings;
use crate::data::{Polygon, sides};
use crate::math::Vec2;
use crate::polygon::EdgeGrid;
use std::f64::consts::PI;

/// Infill in pockets smaller than this many squares of a line's width is not worth its travels: they are made solid.
const LEAST_POCKET: f64 = 60.0;
/// Solid parts narrower than this many widths are left to infill: walls hold them already.
const NARROWEST: f64 = 0.7;
/// How far skins reach into the infill, and bridges onto their supports, in widths.
const ANCHOR: f64 = 1.0;
const BRIDGE_ANCHOR: f64 = 2.0;
/// Directions that are tried for a bridge, beside those of its own longest edge.
const DIRECTIONS: usize = 12;
/// A skin over nothing is a bridge if this share of its lines ends on supports.
const ANCHORED: f64 = 0.6;

/// What fills the inside of a layer.
#[derive(Clone, Debug, Default)]
pub(super) struct Fills {
    pub sparse: Vec<Polygon>,
    pub solid: Vec<Polygon>,
    pub bottom: Vec<Polygon>,
    pub top: Vec<Polygon>,
    /// Each with the direction of its lines in radians.
    pub bridges: Vec<(Polygon, f64)>,
    pub overhangs: Vec<Polygon>,
    pub report: Report,
}

/// Whole layers, to look up and down from one of them.
pub(super) struct Stack<'a> {
    pub shapes: &'a [Vec<Polygon>],
    pub insides: &'a [Vec<Polygon>],
    /// What the `bottom_layers` layers that begin with each have in common; empty where there are not as many.
    pub common_below: &'a [Vec<Polygon>],
    /// The same for `top_layers`.
    pub common_above: &'a [Vec<Polygon>],
}

impl Stack<'_> {
    /// Sorts the inside of one layer by what is above and below.
    pub(super) fn fills(&self, layer: usize, settings: &ToolpathSettings) -> Fills {
        let width = settings.line_width;
        let inside = &self.insides[layer];
        let mut fills = Fills::default();
        if inside.is_empty() {
            return fills;
        }
        let exposed = wide_parts(self.exposed(layer, settings), NARROWEST * width);
        let is_solid = settings.density >= 1.0;
        if !is_solid && !exposed.is_empty() {
            let sparse = without(inside, &grown_within(&exposed, ANCHOR * width, inside));
            fills.sparse = wide_parts(sparse, width);
        } else if !is_solid {
            fills.sparse.clone_from(inside);
        }
        let is_pocket = |p: &Polygon| p.area() < LEAST_POCKET * width * width;
        // What is exposed nowhere stays infill, however small: else thin columns would be solid throughout.
        if !exposed.is_empty() {
            fills.sparse.retain(|p| !is_pocket(p));
        }
        let mut solid =
            if exposed.is_empty() && !is_solid { Vec::new() } else { without(inside, &fills.sparse) };
        if layer == 0 && settings.bottom_layers > 0 {
            fills.bottom = solid;
            return fills;
        }
        if layer > 0 && settings.bottom_layers > 0 {
            solid = self.lay_over_nothing(layer, settings, &mut fills, solid);
        }
        if settings.top_layers > 0 && !solid.is_empty() {
            let open = match self.shapes.get(layer + 1) {
                Some(above) => wide_parts(without(&self.insides[layer], above), NARROWEST * width),
                None => inside.clone(),
            };
            fills.top = intersected(&open, &solid);
        }
        fills.solid = without(&solid, &fills.top);
        fills
    }

    /// The inside of a layer where one of the layers next to it has nothing.
    fn exposed(&self, layer: usize, settings: &ToolpathSettings) -> Vec<Polygon> {
        let inside = &self.insides[layer];
        let mut closed = inside.clone();
        if settings.bottom_layers > 0 {
            let first = layer.checked_sub(settings.bottom_layers);
            closed = first.map_or(Vec::new(), |first| intersected(&closed, &self.common_below[first]));
        }
        if settings.top_layers > 0 {
            let above = self.common_above.get(layer + 1).map_or([].as_slice(), Vec::as_slice);
            closed = intersected(&closed, above);
        }
        // Not even one part as wide as it takes.
        if area(inside) - area(&closed) < 0.5 * (NARROWEST * settings.line_width).powi(2) {
            return Vec::new();
        }
        without(inside, &closed)
    }

    /// Takes what lies over nothing out of the solid parts: bridges, overhangs and bottoms.
    fn lay_over_nothing(
        &self,
        layer: usize,
        settings: &ToolpathSettings,
        fills: &mut Fills,
        solid: Vec<Polygon>,
    ) -> Vec<Polygon> {
        let width = settings.line_width;
        let inside = &self.insides[layer];
        let open = wide_parts(without(inside, &self.shapes[layer - 1]), NARROWEST * width);
        if open.is_empty() {
            return solid;
        }
        let skins = grown_within(&open, BRIDGE_ANCHOR * width, inside);
        let supports = EdgeGrid::new(&self.shapes[layer - 1]);
        for skin in &skins {
            let (direction, anchored) = bridge_direction(skin, width, &supports);
            let over_nothing = intersected(std::slice::from_ref(skin), &open);
            let region = Regions { count: 1, area: area(&over_nothing) };
            if anchored < ANCHORED {
                fills.report.overhangs.add(region);
                fills.overhangs.push(skin.clone());
            } else {
                fills.report.bridges.add(region);
                if settings.bridges {
                    fills.bridges.push((skin.clone(), direction));
                } else {
                    fills.bottom.push(skin.clone());
                }
            }
        }
        // What infill would lie on is bridged all the same.
        fills.sparse = without(&fills.sparse, &skins);
        without(&solid, &skins)
    }
}

/// What each `count` layers have in common, by the first of them.
pub(super) fn common(
    shapes: &[Vec<Polygon>],
    count: usize,
    mut for_each: impl FnMut(usize, &(dyn Fn(usize) -> Vec<Polygon> + Sync)) -> Vec<Vec<Polygon>>,
) -> Vec<Vec<Polygon>> {
    if count == 0 || count > shapes.len() {
        return Vec::new();
    }
    // Windows of 1, 2, 4 … layers, then two of those that overlap: a handful of intersections in place of `count`.
    let mut size = 1;
    let mut windows = shapes.to_vec();
    while size < count {
        let step = size.min(count - size);
        let total = windows.len() - step;
        windows = for_each(total, &|k| intersected(&windows[k], &windows[k + step]));
        size += step;
    }
    windows
}

/// The direction in which most lines end on supports, of several the one with the shortest lines; and that share.
fn bridge_direction(skin: &Polygon, width: f64, supports: &EdgeGrid) -> (f64, f64) {
    let edge = longest_edge(skin);
    let tried = (0..DIRECTIONS).map(|k| PI * k as f64 / DIRECTIONS as f64);
    // Few lines tell as much as all of them: about forty across a large skin.
    let extent = skin.outer.iter().map(|p| p.distance(skin.outer[0])).fold(0.0, f64::max);
    let spacing = width.max(extent / 40.0);
    let mut best = (edge, 0.0, f64::INFINITY);
    for angle in [edge, edge + 0.5 * PI].into_iter().chain(tried) {
        let lines = hatch(std::slice::from_ref(skin), Hatch { angle, spacing, linked: false });
        let mut lengths = (0.0, 0.0);
        for line in &lines {
            // Just inside of where the skin ends.
            let inwards = 0.1 * width * (line[1] - line[0]).normalize_or_zero();
            let length = length_of(line, false);
            lengths.0 += length;
            if supports.contains(line[0] + inwards) && supports.contains(line[1] - inwards) {
                lengths.1 += length;
            }
        }
        if lines.is_empty() {
            continue;
        }
        // In twentieths: lines at an edge do not decide.
        let (share, mean) = ((20.0 * lengths.1 / lengths.0).round() / 20.0, lengths.0 / lines.len() as f64);
        if share > best.1 || share == best.1 && mean < best.2 * (1.0 - 1e-9) {
            best = (angle, share, mean);
        }
    }
    (best.0, best.1)
}

fn longest_edge(polygon: &Polygon) -> f64 {
    let ring = &polygon.outer;
    let edges = sides(ring).map(|(a, b)| b - a);
    let longest =
        edges.fold(
            Vec2::ZERO,
            |longest, edge| {
                if edge.length_squared() > longest.length_squared() { edge } else { longest }
            },
        );
    libm::atan2(longest.y, longest.x)
}
