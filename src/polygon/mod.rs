//! Polygons of a plane: unions, differences and offsets (by the crate i_overlay, on a grid of 2⁻⁶¹ of the extent), nesting of
//! rings, simplification that keeps topology, lines clipped to polygons or cut by them, edges in a grid.
//!
//! What is returned is simple and nested: rings that do not cross themselves or each other, outer ones counter-clockwise, holes
//! clockwise and inside the outer ring they belong to.
mod edges;
mod nesting;
mod offset;
mod simplify;

pub use edges::{EdgeGrid, Stretch, nearest_on_segment};
pub use nesting::{nest, surrounds};
pub use offset::{Join, offset, opened};
pub use simplify::{simplify, straightened};

use crate::data::{Polygon, Ring};
use crate::math::Vec2;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::core::solver::Solver;
use i_overlay::float::clip::FloatClip;
use i_overlay::float::overlay::{FloatOverlay, OverlayOptions};
use i_overlay::string::clip::ClipRule;

/// Which parts of a plane rings that may cross are taken to enclose, by how often they wind around them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fill {
    /// 1 or more times: that is w ≥ 1/2 where the rings are the section of closed surfaces.
    #[default]
    Positive,
    /// An odd number of times.
    EvenOdd,
}

/// How two sets of polygons are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boolean {
    Union,
    Intersection,
    /// What the first have and the second do not.
    Difference,
    /// What only one of them has.
    Xor,
}

type Flat = Vec<Vec<[f64; 2]>>;

/// The polygons that rings enclose, which may cross themselves and each other, overlap, and run either way.
pub fn enclosed(rings: &[Ring], fill: Fill) -> Vec<Polygon> {
    let rings: Flat = rings.iter().map(|ring| flat(ring)).collect();
    let rule = match fill {
        Fill::Positive => FillRule::Positive,
        Fill::EvenOdd => FillRule::EvenOdd,
    };
    let mut overlay = FloatOverlay::<[f64; 2], i64>::from_subj_custom(&rings, strict(), Solver::default());
    polygons(overlay.overlay(OverlayRule::Subject, rule))
}

/// Two sets of polygons combined.
pub fn combined(first: &[Polygon], second: &[Polygon], how: Boolean) -> Vec<Polygon> {
    let rule = match how {
        Boolean::Union => OverlayRule::Union,
        Boolean::Intersection => OverlayRule::Intersect,
        Boolean::Difference => OverlayRule::Difference,
        Boolean::Xor => OverlayRule::Xor,
    };
    match (first.is_empty(), second.is_empty(), how) {
        (_, true, Boolean::Intersection) | (true, _, Boolean::Intersection | Boolean::Difference) => {
            Vec::new()
        }
        _ => {
            let (first, second) = (flat_rings(first), flat_rings(second));
            let solver = Solver::default();
            let mut overlay =
                FloatOverlay::<[f64; 2], i64>::from_subj_and_clip_custom(&first, &second, strict(), solver);
            polygons(overlay.overlay(rule, FillRule::Positive))
        }
    }
}

/// The parts of lines that lie in polygons, in their direction.
pub fn clipped(lines: &[Vec<Vec2>], polygons: &[Polygon]) -> Vec<Vec<Vec2>> {
    if lines.is_empty() || polygons.is_empty() {
        return Vec::new();
    }
    let lines: Flat = lines.iter().map(|line| flat(line)).collect();
    let rule = ClipRule { invert: false, boundary_included: false };
    let parts = lines.clip_by_as::<i64>(&flat_rings(polygons), FillRule::Positive, rule);
    parts.into_iter().map(rounded).collect()
}

/// Rings touch at single points at most, and enclose what is connected.
fn strict() -> OverlayOptions<f64, i64> {
    OverlayOptions::ogc()
}

fn flat(ring: &[Vec2]) -> Vec<[f64; 2]> {
    ring.iter().map(|p| p.to_array()).collect()
}

fn flat_rings(polygons: &[Polygon]) -> Flat {
    polygons.iter().flat_map(Polygon::rings).map(|ring| flat(ring)).collect()
}

fn rounded(points: Vec<[f64; 2]>) -> Vec<Vec2> {
    points.into_iter().map(Vec2::from_array).collect()
}

fn polygons(shapes: Vec<Flat>) -> Vec<Polygon> {
    let polygon = |shape: Flat| {
        let mut rings = shape.into_iter().map(rounded);
        rings.next().map(|outer| Polygon { outer, holes: rings.collect() })
    };
    shapes.into_iter().filter_map(polygon).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn square(x: f64, y: f64, side: f64) -> Ring {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(u, v)| Vec2::new(x + side * u, y + side * v))
            .to_vec()
    }

    fn area(polygons: &[Polygon]) -> f64 {
        polygons.iter().map(Polygon::area).sum()
    }

    #[test]
    fn rings_that_overlap_are_united_or_cancel() {
        let rings = [square(0.0, 0.0, 2.0), square(1.0, 1.0, 2.0)];
        let united = enclosed(&rings, Fill::Positive);
        assert_eq!((united.len(), area(&united)), (1, 7.0));
        assert_eq!(area(&enclosed(&rings, Fill::EvenOdd)), 6.0);
        let turned: Ring = rings[1].iter().rev().copied().collect();
        assert_eq!(area(&enclosed(&[rings[0].clone(), turned.clone()], Fill::Positive)), 3.0);
        assert!(enclosed(&[turned], Fill::Positive).is_empty(), "clockwise rings enclose nothing");
    }

    #[test]
    fn coordinates_come_back() {
        let ring = vec![Vec2::new(0.1, 0.7), Vec2::new(123.456, 0.3), Vec2::new(77.7, 91.1)];
        let found = &enclosed(std::slice::from_ref(&ring), Fill::Positive)[0].outer;
        for p in &ring {
            let nearest = found.iter().map(|q| q.distance(*p)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-13, "{nearest}");
        }
    }

    #[test]
    fn sets_are_combined() {
        let (a, b) = (
            enclosed(&[square(0.0, 0.0, 2.0)], Fill::Positive),
            enclosed(&[square(1.0, 0.0, 2.0)], Fill::Positive),
        );
        for (how, expected) in [
            (Boolean::Union, 6.0),
            (Boolean::Intersection, 2.0),
            (Boolean::Difference, 2.0),
            (Boolean::Xor, 4.0),
        ] {
            assert_eq!(area(&combined(&a, &b, how)), expected, "{how:?}");
            let alone = if how == Boolean::Intersection { 0.0 } else { 4.0 };
            assert_eq!(area(&combined(&a, &[], how)), alone, "{how:?} with nothing");
        }
    }

    #[test]
    fn lines_end_at_polygons() {
        let mut frame = enclosed(&[square(0.0, 0.0, 10.0)], Fill::Positive);
        frame = combined(&frame, &enclosed(&[square(4.0, 4.0, 2.0)], Fill::Positive), Boolean::Difference);
        let parts = clipped(&[vec![Vec2::new(-1.0, 5.0), Vec2::new(11.0, 5.0)]], &frame);
        let ends: Vec<[f64; 2]> = parts.iter().map(|p| [p[0].x, p[p.len() - 1].x]).collect();
        assert_eq!(ends, [[0.0, 4.0], [6.0, 10.0]]);
    }
}
