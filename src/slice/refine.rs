//! Rings of smooth contours with more vertices where they turn.
use super::chains::key;
use crate::data::Ring;
use crate::math::Vec2;

/// A chord is split if the ring turns by more than this at either end, in radians.
const TURN: f64 = 0.1;
/// Halvings of a chord at most.
const DEPTH: u32 = 3;
/// How far off a chord its curve is looked for, in its length.
const REACH: f64 = 0.25;
/// Steps of bisection.
const BISECTIONS: usize = 22;

/// A ring with roots of the contour put in between vertices at which it turns.
pub(super) fn refined(ring: &Ring, inside: &mut dyn FnMut(Vec2) -> bool) -> Ring {
    let mut ring = ring.clone();
    for _ in 0..DEPTH {
        let count = ring.len();
        let turns: Vec<bool> = (0..count)
            .map(|k| {
                let (before, after) = (ring[(k + count - 1) % count], ring[(k + 1) % count]);
                (ring[k] - before).angle_to(after - ring[k]).abs() > TURN
            })
            .collect();
        if !turns.contains(&true) {
            break;
        }
        let mut finer = Vec::with_capacity(2 * count);
        for k in 0..count {
            let next = (k + 1) % count;
            finer.push(ring[k]);
            if turns[k] || turns[next] {
                finer.extend(root_beside(ring[k], ring[next], inside));
            }
        }
        ring = finer;
    }
    ring.dedup_by_key(|p| key(*p));
    ring
}

/// Where the contour passes the middle of a chord that has the inside on its left.
fn root_beside(from: Vec2, to: Vec2, inside: &mut dyn FnMut(Vec2) -> bool) -> Option<Vec2> {
    let (middle, left) = (0.5 * (from + to), REACH * (to - from).perp());
    if !inside(middle + left) || inside(middle - left) {
        return None;
    }
    let (mut outer, mut inner) = (-1.0, 1.0);
    for _ in 0..BISECTIONS {
        let share = 0.5 * (outer + inner);
        *(if inside(middle + share * left) { &mut inner } else { &mut outer }) = share;
    }
    Some(middle + inner * left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coarse_circle_becomes_round_and_a_square_stays() {
        let hexagon: Ring =
            (0..6).map(|k| Vec2::from_angle(std::f64::consts::TAU * f64::from(k) / 6.0)).collect();
        let round = refined(&hexagon, &mut |p| p.length() <= 1.0);
        assert_eq!(round.len(), 48);
        assert!(round.iter().all(|p| (p.length() - 1.0).abs() < 1e-6));
        let square: Ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(Vec2::from).to_vec();
        let same = refined(&square, &mut |p| p.abs().max_element() <= 1.0);
        assert!(same.iter().all(|p| (p.abs().max_element() - 1.0).abs() < 1e-6));
    }
}
