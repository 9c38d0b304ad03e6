//! What is open above or below gets skins and solid layers; what lies over nothing gets bridges.
use super::hatch::{Hatch, hatch};
use super::path::{Regions, Report, length_of};
use super::perimeters::area;
use super::settings::ToolpathSettings;
use crate::data::Polygon;
use crate::math::Vec2;
use crate::polygon::{Boolean, EdgeGrid, Join, combined, offset, opened};
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
        let open_below = self.open(layer, false, settings.bottom_layers);
        let open_above = self.open(layer, true, settings.top_layers);
        let mut exposed = match (open_below.is_empty(), open_above.is_empty()) {
            (false, false) => combined(&open_below, &open_above, Boolean::Union),
            (true, false) => open_above,
            (_, true) => open_below,
        };
        exposed = opened(&exposed, 0.5 * NARROWEST * width);
        let mut solid = grown(&exposed, ANCHOR * width, inside);
        fills.sparse = without(inside, &solid);
        fills.sparse = opened(&fills.sparse, 0.5 * width);
        fills.sparse.retain(|pocket| pocket.area() >= LEAST_POCKET * width * width);
        if settings.density >= 1.0 {
            fills.sparse.clear();
        }
        if settings.density >= 1.0 || area(&solid) + area(&fills.sparse) < area(inside) - 0.5 * width * width
        {
            solid = without(inside, &fills.sparse);
        }
        if layer == 0 && settings.bottom_layers > 0 {
            fills.bottom = solid;
            return fills;
        }
        let solid = if layer > 0 && settings.bottom_layers > 0 {
            self.lay_over_nothing(layer, settings, &mut fills, solid)
        } else {
            solid
        };
        if settings.top_layers > 0 {
            let open = self.directly_open(layer, true);
            fills.top = intersected(&opened(&open, 0.5 * NARROWEST * width), &solid);
        }
        fills.solid = without(&solid, &fills.top);
        fills
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
        let open = opened(&self.directly_open(layer, false), 0.5 * NARROWEST * width);
        if open.is_empty() {
            return solid;
        }
        let skins = grown(&open, BRIDGE_ANCHOR * width, inside);
        let supports = EdgeGrid::new(&self.shapes[layer - 1]);
        for skin in &skins {
            let (direction, anchored) = bridge_direction(skin, width, &supports);
            let over_nothing = intersected(std::slice::from_ref(skin), &open);
            let region = Regions { count: 1, area: area(&over_nothing) };
            if anchored >= ANCHORED {
                fills.report.bridges.add(region);
                if settings.bridges {
                    fills.bridges.push((skin.clone(), direction));
                } else {
                    fills.bottom.push(skin.clone());
                }
            } else {
                fills.report.overhangs.add(region);
                fills.overhangs.push(skin.clone());
            }
        }
        // What infill would lie on is bridged all the same.
        fills.sparse = without(&fills.sparse, &skins);
        without(&solid, &skins)
    }

    /// The inside of a layer where one of the next `count` layers has nothing.
    fn open(&self, layer: usize, above: bool, count: usize) -> Vec<Polygon> {
        let inside = &self.insides[layer];
        let beyond = if above { self.shapes.len() - 1 - layer } else { layer };
        if count > beyond {
            return inside.clone();
        }
        let mut closed = inside.clone();
        for k in 1..=count {
            let neighbour = &self.shapes[if above { layer + k } else { layer - k }];
            closed = intersected(&closed, neighbour);
        }
        if area(inside) - area(&closed) < 1e-6 * area(inside) {
            return Vec::new();
        }
        without(inside, &closed)
    }

    /// The inside of a layer where the next one has nothing.
    fn directly_open(&self, layer: usize, above: bool) -> Vec<Polygon> {
        self.open(layer, above, 1)
    }
}

fn without(first: &[Polygon], second: &[Polygon]) -> Vec<Polygon> {
    if second.is_empty() { first.to_vec() } else { combined(first, second, Boolean::Difference) }
}

fn intersected(first: &[Polygon], second: &[Polygon]) -> Vec<Polygon> {
    combined(first, second, Boolean::Intersection)
}

/// Parts of `whole` near to `parts`.
fn grown(parts: &[Polygon], by: f64, whole: &[Polygon]) -> Vec<Polygon> {
    intersected(&offset(parts, by, Join::Miter), whole)
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
    let edges = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| *b - *a);
    let longest =
        edges.fold(
            Vec2::ZERO,
            |longest, edge| {
                if edge.length_squared() > longest.length_squared() { edge } else { longest }
            },
        );
    libm::atan2(longest.y, longest.x)
}
