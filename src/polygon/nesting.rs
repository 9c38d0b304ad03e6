use crate::data::{Polygon, Ring, ascending, sides, signed_area};
use crate::math::Vec2;

/// Sorts rings that do not cross into polygons: counter-clockwise ones are outer, each clockwise one is a hole of the
/// smallest outer ring around it.
pub fn nest(rings: Vec<Ring>) -> Vec<Polygon> {
    let (mut outer, holes): (Vec<_>, Vec<_>) =
        rings.into_iter().map(|ring| (signed_area(&ring), ring)).partition(|(area, _)| *area > 0.0);
    // Smallest first: the first one around a hole is the right one. Ties keep the order of tracing.
    let order = ascending(outer.iter().map(|(area, _)| *area));
    let mut polygons: Vec<Polygon> = (order.into_iter())
        .map(|place| Polygon { outer: std::mem::take(&mut outer[place as usize].1), holes: Vec::new() })
        .collect();
    for (area, hole) in holes {
        if let Some(around) =
            polygons.iter_mut().find(|p| signed_area(&p.outer) > -area && surrounds(&p.outer, hole[0]))
        {
            around.holes.push(hole);
        }
    }
    polygons.reverse();
    polygons
}

/// Whether `p` lies inside a ring: the parity of its crossings with the ray towards +x.
pub fn surrounds(ring: &[Vec2], p: Vec2) -> bool {
    let crosses = |(a, b): &(Vec2, Vec2)| {
        (a.y <= p.y) != (b.y <= p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x
    };
    sides(ring).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(center: Vec2, half: f64, clockwise: bool) -> Ring {
        let mut ring: Ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| center + half * Vec2::new(x, y))
            .to_vec();
        if clockwise {
            ring.reverse();
        }
        ring
    }

    #[test]
    fn an_island_in_a_hole_is_a_polygon_of_its_own() {
        let o = Vec2::ZERO;
        let rings = vec![
            square(o, 1.0, false),
            square(o, 9.0, false),
            square(o, 5.0, true),
            square(Vec2::new(20.0, 0.0), 2.0, false),
            square(o, 0.5, true),
        ];
        let polygons = nest(rings);
        let summary: Vec<(f64, usize)> = polygons.iter().map(|p| (p.area(), p.holes.len())).collect();
        assert_eq!(summary, [(324.0 - 100.0, 1), (16.0, 0), (4.0 - 1.0, 1)]);
    }
}
