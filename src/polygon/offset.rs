use super::{flat_rings, polygons, strict};
use crate::data::Polygon;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

/// What fills the corners of an offset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Join {
    /// Sharp corners, cut off where they are sharper than 30°.
    #[default]
    Miter,
    /// Arcs of chords of 10°.
    Round,
}

/// Polygons grown by a distance, or shrunk where it is negative; what meets is united, what vanishes is left out.
pub fn offset(shapes: &[Polygon], distance: f64, join: Join) -> Vec<Polygon> {
    if shapes.is_empty() {
        return Vec::new();
    }
    let join = match join {
        Join::Miter => LineJoin::Miter(30_f64.to_radians()),
        Join::Round => LineJoin::Round(10_f64.to_radians()),
    };
    let style = OutlineStyle::new(distance).line_join(join);
    polygons(flat_rings(shapes).outline_custom_as::<i64>(&style, strict()))
}

/// Polygons without what is narrower than twice a distance: shrunk, then grown again.
pub fn opened(shapes: &[Polygon], distance: f64) -> Vec<Polygon> {
    offset(&offset(shapes, -distance, Join::Miter), distance, Join::Miter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec2;

    fn rectangle(width: f64, height: f64) -> Polygon {
        let outer = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        Polygon { outer: outer.map(Vec2::from).to_vec(), holes: Vec::new() }
    }

    fn area(shapes: &[Polygon]) -> f64 {
        shapes.iter().map(Polygon::area).sum()
    }

    #[test]
    fn squares_grow_and_shrink() {
        let square = [rectangle(10.0, 10.0)];
        assert!((area(&offset(&square, -1.0, Join::Miter)) - 64.0).abs() < 1e-9);
        assert!((area(&offset(&square, 1.0, Join::Miter)) - 144.0).abs() < 1e-9);
        let round = area(&offset(&square, 1.0, Join::Round));
        assert!((round - (140.0 + std::f64::consts::PI)).abs() < 0.03, "{round}");
        assert!(offset(&square, -5.1, Join::Miter).is_empty());
    }

    #[test]
    fn holes_shrink_as_their_polygon_grows() {
        let mut frame = rectangle(10.0, 10.0);
        frame.holes.push(rectangle(4.0, 4.0).outer.iter().rev().map(|p| *p + Vec2::splat(3.0)).collect());
        assert!((area(&offset(&[frame], 1.0, Join::Miter)) - (144.0 - 4.0)).abs() < 1e-9);
    }

    #[test]
    fn what_is_narrow_goes() {
        assert!(opened(&[rectangle(10.0, 0.3)], 0.2).is_empty());
        assert!((area(&opened(&[rectangle(10.0, 0.5)], 0.2)) - 5.0).abs() < 1e-9);
    }
}
