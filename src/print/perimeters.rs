//! Walls: lines at half a line's width, one and a half and so on inside the outline.
use super::areas::{area, grown, wide_parts, without};
use super::path::{Loop, Regions};
use super::settings::{ThinWalls, ToolpathSettings};
use crate::data::{Polygon, Ring};

/// Both sides of a wall are at least this part of a line's width apart; below, the overlap of the lines would bulge.
const LEAST_SEPARATION: f64 = 0.7;
/// What is narrower than this part of a line's width no nozzle lays.
const NARROWEST: f64 = 0.3;

/// The walls of one layer, and what they leave.
#[derive(Clone, Debug, Default)]
pub(super) struct Walls {
    pub loops: Vec<Loop>,
    /// What is left for infill and skins.
    pub inside: Vec<Polygon>,
    /// Parts of the outline that walls leave out, too narrow for a line on either side.
    pub thin: Vec<Polygon>,
    /// The same between walls, and inside the last.
    pub gaps: Vec<Polygon>,
    pub thin_walls: Regions,
}

/// Walls of a shape.
pub(super) fn walls(shape: &[Polygon], settings: &ToolpathSettings) -> Walls {
    let width = settings.line_width;
    let mut walls = Walls::default();
    let mut within = shape.to_vec();
    for depth in 0..settings.perimeters {
        if within.is_empty() {
            return walls;
        }
        let wants_both_lines = depth == 0 && settings.thin_walls == ThinWalls::Report;
        let margin = if wants_both_lines { 0.0 } else { 0.5 * LEAST_SEPARATION * width };
        let core = grown(&within, -(0.5 * width + margin));
        let middle = if margin > 0.0 { grown(&core, margin) } else { core.clone() };
        let narrow = narrow_rest(&within, &grown(&core, 0.5 * width + margin), width);
        if depth == 0 {
            walls.thin_walls = Regions { count: narrow.len(), area: area(&narrow) };
            walls.thin = narrow;
        } else {
            walls.gaps.extend(narrow);
        }
        let rings = middle.iter().flat_map(Polygon::rings);
        walls.loops.extend(rings.map(|ring| Loop { ring: cleaned(ring, width), depth }));
        let is_last = depth + 1 == settings.perimeters;
        let overlap = if is_last { 0.0 } else { settings.wall_overlap };
        within = grown(&core, margin - (0.5 - overlap) * width);
    }
    walls.loops.retain(|l| l.ring.len() > 2);
    // Infill wants room for more than a line, too.
    let reach = 0.5 * (1.0 + LEAST_SEPARATION) * width;
    walls.inside = grown(&grown(&within, -reach), reach);
    if settings.perimeters > 0 {
        walls.gaps.extend(narrow_rest(&within, &walls.inside, width));
    }
    walls
}

/// Parts of a shape beyond what is covered, without slivers too narrow to print.
fn narrow_rest(shape: &[Polygon], covered: &[Polygon], width: f64) -> Vec<Polygon> {
    // The least piece worth a look: a boolean is dear.
    if area(shape) - area(covered) < 0.5 * (NARROWEST * width).powi(2) {
        return Vec::new();
    }
    let mut rest = wide_parts(without(shape, covered), NARROWEST * width);
    rest.retain(|piece| piece.area() > NARROWEST * width * width);
    rest
}

/// A ring without edges far shorter than a line is wide, which offsets leave behind at tight corners.
fn cleaned(ring: &Ring, width: f64) -> Ring {
    let shortest = 0.01 * width;
    let mut kept: Ring = Vec::with_capacity(ring.len());
    for &p in ring {
        if kept.last().is_none_or(|last| last.distance(p) > shortest) {
            kept.push(p);
        }
    }
    while kept.len() > 1 && kept[0].distance(kept[kept.len() - 1]) <= shortest {
        kept.pop();
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec2;
    use crate::print::path::length_of;

    fn rectangle(width: f64, height: f64) -> Polygon {
        let outer = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        Polygon { outer: outer.map(Vec2::from).to_vec(), holes: Vec::new() }
    }

    #[test]
    fn walls_of_a_square_are_as_long_as_they_should() {
        let walls = walls(&[rectangle(20.0, 20.0)], &ToolpathSettings::default());
        let lengths: Vec<f64> = walls.loops.iter().map(|l| length_of(&l.ring, true)).collect();
        assert_eq!(lengths.len(), 2);
        assert!((lengths[0] - 4.0 * 19.6).abs() < 1e-9 && (lengths[1] - 4.0 * 18.8).abs() < 1e-9);
        assert!((area(&walls.inside) - 18.4 * 18.4).abs() < 1e-9);
        assert!(walls.thin.is_empty() && walls.gaps.is_empty());
    }

    #[test]
    fn overlapping_walls_lie_closer() {
        let settings = ToolpathSettings { wall_overlap: 0.25, ..Default::default() };
        let walls = walls(&[rectangle(20.0, 20.0)], &settings);
        assert!((length_of(&walls.loops[1].ring, true) - 4.0 * (19.6 - 2.0 * 0.3)).abs() < 1e-9);
    }

    #[test]
    fn narrow_parts_are_thin_walls_or_gaps() {
        let of = |width: f64, thin_walls: ThinWalls| {
            let settings = ToolpathSettings { thin_walls, ..Default::default() };
            let walls = walls(&[rectangle(width, 20.0)], &settings);
            (walls.loops.len(), walls.thin.len(), walls.gaps.len(), walls.inside.len())
        };
        assert_eq!(of(0.05, ThinWalls::SingleLine), (0, 0, 0, 0));
        assert_eq!(of(0.3, ThinWalls::SingleLine), (0, 1, 0, 0));
        assert_eq!(of(0.5, ThinWalls::SingleLine), (0, 1, 0, 0));
        assert_eq!(of(0.5, ThinWalls::Report), (1, 0, 0, 0));
        assert_eq!(of(0.3, ThinWalls::Report), (0, 1, 0, 0));
        assert_eq!(of(0.8, ThinWalls::SingleLine), (1, 0, 0, 0));
        assert_eq!(of(1.2, ThinWalls::SingleLine), (1, 0, 1, 0));
        assert_eq!(of(1.6, ThinWalls::SingleLine), (2, 0, 0, 0));
        assert_eq!(of(2.0, ThinWalls::SingleLine), (2, 0, 1, 0));
        assert_eq!(of(4.0, ThinWalls::SingleLine), (2, 0, 0, 1));
    }
}
