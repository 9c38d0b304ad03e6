//! Rings that do not meet, as the sections of most solids are, sorted into polygons without an arrangement.
use super::chains::Chains;
use crate::data::{Polygon, Ring, ascending, sides, signed_area};
use crate::math::{Vec2, orient};
use crate::polygon::{Fill, enclosed, nest};

/// A side of a ring, from its lower end to its upper one.
struct Side {
    low: Vec2,
    high: Vec2,
    ring: u32,
    /// Place of its first end in the ring.
    place: u32,
    /// Whether the ring runs up through it.
    is_up: bool,
}

impl Side {
    fn span(&self) -> (f64, f64) {
        (self.low.x.min(self.high.x), self.low.x.max(self.high.x))
    }
}

/// The polygons that the loops of chains wind around at least once.
pub(super) fn polygons_of(chains: &Chains) -> Vec<Polygon> {
    let disjoint = if chains.branches { None } else { polygons_of_disjoint(&chains.loops) };
    disjoint.unwrap_or_else(|| enclosed(&chains.loops, Fill::Positive))
}

/// The polygons that rings wind around at least once; none if rings meet or cross, themselves or each other.
///
/// A sweep upwards: each side is compared with those that are still there, and what lies to the left of a ring's lowest point tells
/// how often the others wind around it.
pub(super) fn polygons_of_disjoint(rings: &[Ring]) -> Option<Vec<Polygon>> {
    let sides: Vec<Side> =
        rings.iter().enumerate().flat_map(|(ring, points)| sides_of(ring, points)).collect();
    let mut outside: Vec<Option<i32>> = vec![None; rings.len()];
    let mut active: Vec<u32> = Vec::new();
    for index in ascending(sides.iter().map(|side| side.low.y)) {
        let side = &sides[index as usize];
        active.retain(|k| sides[*k as usize].high.y >= side.low.y);
        let (left, right) = side.span();
        for &k in &active {
            let other = &sides[k as usize];
            let (from, to) = other.span();
            if from <= right && left <= to && meet(side, other, rings) {
                return None;
            }
        }
        if outside[side.ring as usize].is_none() {
            // Just below the ring's lowest point: sides that start at its height are not there yet.
            let is_left =
                |other: &&Side| other.low.y < side.low.y && orient(other.low, other.high, side.low) < 0;
            let windings = active.iter().map(|k| &sides[*k as usize]).filter(is_left);
            outside[side.ring as usize] = Some(windings.map(|s| if s.is_up { -1 } else { 1 }).sum());
        }
        active.push(index);
    }
    // Counter-clockwise rings add one turn inside, clockwise ones take one.
    let bounds = |ring: &Ring, outside: i32| outside == i32::from(signed_area(ring) < 0.0);
    let kept = rings.iter().zip(outside).filter(|(ring, outside)| bounds(ring, outside.unwrap_or(0)));
    Some(nest(kept.map(|(ring, _)| ring.clone()).collect()))
}

fn sides_of(ring: usize, points: &Ring) -> impl Iterator<Item = Side> {
    sides(points).enumerate().map(move |(place, (a, b))| {
        let is_up = (a.y, a.x) < (b.y, b.x);
        let (low, high) = if is_up { (a, b) } else { (b, a) };
        Side { low, high, ring: ring as u32, place: place as u32, is_up }
    })
}

/// Whether two sides touch, but for the point that neighbours share.
fn meet(a: &Side, b: &Side, rings: &[Ring]) -> bool {
    let turns = [
        orient(a.low, a.high, b.low),
        orient(a.low, a.high, b.high),
        orient(b.low, b.high, a.low),
        orient(b.low, b.high, a.high),
    ];
    if turns[0] * turns[1] > 0 || turns[2] * turns[3] > 0 {
        return false;
    }
    if turns == [0; 4] {
        // On one line: they meet in a point that both end in at most if they are neighbours.
        let (first, last) = (later(a.low, b.low), earlier(a.high, b.high));
        let is_apart = order(first, last).is_gt();
        let in_a_point = first == last && neighbours(a, b, rings);
        return !is_apart && !in_a_point;
    }
    !neighbours(a, b, rings)
}

fn order(p: Vec2, q: Vec2) -> std::cmp::Ordering {
    p.y.total_cmp(&q.y).then(p.x.total_cmp(&q.x))
}

fn later(p: Vec2, q: Vec2) -> Vec2 {
    if order(p, q).is_lt() { q } else { p }
}

fn earlier(p: Vec2, q: Vec2) -> Vec2 {
    if order(p, q).is_lt() { p } else { q }
}

fn neighbours(a: &Side, b: &Side, rings: &[Ring]) -> bool {
    let count = rings[a.ring as usize].len() as u32;
    a.ring == b.ring && ((a.place + 1) % count == b.place || (b.place + 1) % count == a.place)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, half: f64, clockwise: bool) -> Ring {
        let mut ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(u, v)| Vec2::new(x + half * u, y + half * v))
            .to_vec();
        if clockwise {
            ring.reverse();
        }
        ring
    }

    fn areas(rings: &[Ring]) -> Option<Vec<f64>> {
        polygons_of_disjoint(rings).map(|polygons| polygons.iter().map(Polygon::area).collect())
    }

    #[test]
    fn only_the_rim_of_what_is_inside_is_kept() {
        // A solid within another, its outline twice inside; a hollow with an island; something turned inside out.
        let rings = [
            square(0.0, 0.0, 10.0, false),
            square(-5.0, 0.0, 2.0, false),
            square(5.0, 0.0, 3.0, true),
            square(5.0, 0.0, 1.0, false),
            square(30.0, 0.0, 1.0, true),
        ];
        assert_eq!(areas(&rings), Some(vec![400.0 - 36.0, 4.0]));
    }

    #[test]
    fn what_meets_is_left_to_others() {
        let o = square(0.0, 0.0, 1.0, false);
        assert_eq!(areas(&[o.clone(), square(1.5, 0.5, 1.0, false)]), None, "crossing");
        assert_eq!(areas(&[o.clone(), square(2.0, 0.0, 1.0, false)]), None, "a common side");
        assert_eq!(areas(&[o.clone(), square(2.0, 2.0, 1.0, false)]), None, "a common corner");
        assert_eq!(areas(&[o.clone(), o.clone()]), None, "twice the same");
        let bow = vec![Vec2::ZERO, Vec2::ONE, Vec2::X, Vec2::Y];
        assert_eq!(areas(&[bow]), None, "a ring that crosses itself");
        let spike = vec![Vec2::ZERO, Vec2::X, Vec2::new(2.0, 0.0), Vec2::new(1.5, 0.0), Vec2::ONE];
        assert_eq!(areas(&[spike]), None, "a side that folds back");
        assert_eq!(areas(&[o]), Some(vec![4.0]));
    }

    #[test]
    fn equal_heights_are_told_apart() {
        // Bottom sides in one line, side by side and one inside the other's range of x.
        let rings =
            [square(0.0, 0.0, 1.0, false), square(3.0, 0.0, 1.0, false), square(9.0, 0.0, 1.0, false)];
        assert_eq!(areas(&rings).unwrap().len(), 3);
    }
}
