//! Where closed walls start.
use super::path::Loop;
use super::places::Places;
use super::settings::Seam;
use crate::data::sides;
use crate::math::{Vec2, fraction, mixed};
use crate::polygon::nearest_on_segment;

/// A turn sharper than this hides a seam: 30°.
const CORNER_COSINE: f64 = 0.866;
/// A seam goes on above another that is at most this many widths away, and moves to a corner that near.
const REACH: f64 = 10.0;
const SNAP: f64 = 2.0;

/// Turns the loops of all layers, bottom to top, so that they start at their seams.
pub(super) fn place_seams(layers: &mut [&mut Vec<Loop>], seam: Seam, width: f64) {
    let mut below = Places::new(Vec::new());
    let mut below_at: Vec<Vec2> = Vec::new();
    for (layer, loops) in layers.iter_mut().enumerate() {
        for (number, wall) in loops.iter_mut().enumerate() {
            match seam {
                Seam::Nearest => {}
                Seam::Rear => start_at(&mut wall.ring, |ring| rear(ring, |_| true)),
                Seam::Random => start_along(&mut wall.ring, hashed(layer as u64, number as u64)),
                Seam::Aligned => align(&mut wall.ring, &below, &below_at, width),
            }
        }
        if seam == Seam::Aligned {
            below_at = loops.iter().filter_map(|wall| wall.ring.first().copied()).collect();
            below = Places::new(below_at.clone());
        }
    }
}

fn start_at(ring: &mut [Vec2], vertex: impl Fn(&[Vec2]) -> Option<usize>) {
    if let Some(vertex) = vertex(ring) {
        ring.rotate_left(vertex);
    }
}

/// The vertex with the largest y, of several the leftmost, among those that are `wanted`.
fn rear(ring: &[Vec2], wanted: impl Fn(usize) -> bool) -> Option<usize> {
    let order =
        |a: &usize, b: &usize| ring[*a].y.total_cmp(&ring[*b].y).then(ring[*b].x.total_cmp(&ring[*a].x));
    (0..ring.len()).filter(|k| wanted(*k)).max_by(order)
}

fn is_corner(ring: &[Vec2], vertex: usize) -> bool {
    let count = ring.len();
    let before = (ring[vertex] - ring[(vertex + count - 1) % count]).normalize_or_zero();
    let after = (ring[(vertex + 1) % count] - ring[vertex]).normalize_or_zero();
    before.dot(after) < CORNER_COSINE
}

/// Starts above the nearest seam below; without one at the rear, at a corner if there is any.
fn align(ring: &mut Vec<Vec2>, below: &Places, below_at: &[Vec2], width: f64) {
    let nearest = (0..ring.len()).filter_map(|vertex| {
        let seam = below_at[below.nearest(ring[vertex])?];
        Some((seam.distance_squared(ring[vertex]), seam))
    });
    let Some((_, seam)) = nearest.min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return start_anew(ring);
    };
    let (edge, place) = nearest_on_ring(ring, seam);
    if place.distance(seam) > REACH * width {
        return start_anew(ring);
    }
    let corners = (0..ring.len()).filter(|k| is_corner(ring, *k) && ring[*k].distance(seam) < SNAP * width);
    let corner = corners.min_by(|a, b| ring[*a].distance(seam).total_cmp(&ring[*b].distance(seam)));
    match corner {
        Some(corner) => ring.rotate_left(corner),
        None => start_on_edge(ring, edge, place),
    }
}

fn start_anew(ring: &mut [Vec2]) {
    start_at(ring, |ring| rear(ring, |k| is_corner(ring, k)).or_else(|| rear(ring, |_| true)));
}

/// The edge with the point nearest to `p`, and the point.
fn nearest_on_ring(ring: &[Vec2], p: Vec2) -> (usize, Vec2) {
    let mut best = (f64::INFINITY, 0, p);
    for (edge, (a, b)) in sides(ring).enumerate() {
        let place = nearest_on_segment(p, a, b);
        if place.distance_squared(p) < best.0 {
            best = (place.distance_squared(p), edge, place);
        }
    }
    (best.1, best.2)
}

/// Starts at a point of an edge, a new vertex unless one is there.
fn start_on_edge(ring: &mut Vec<Vec2>, edge: usize, place: Vec2) {
    let next = (edge + 1) % ring.len();
    // A micrometre.
    if place.distance(ring[edge]) < 1e-3 {
        ring.rotate_left(edge);
    } else if place.distance(ring[next]) < 1e-3 {
        ring.rotate_left(next);
    } else {
        ring.insert(edge + 1, place);
        ring.rotate_left(edge + 1);
    }
}

/// Starts at a share of the way around.
fn start_along(ring: &mut Vec<Vec2>, share: f64) {
    let mut rest = share * super::path::length_of(ring, true);
    for edge in 0..ring.len() {
        let (a, b) = (ring[edge], ring[(edge + 1) % ring.len()]);
        let length = a.distance(b);
        if rest < length {
            return start_on_edge(ring, edge, a.lerp(b, rest / length));
        }
        rest -= length;
    }
}

/// A number in [0, 1) for a pair of numbers.
fn hashed(layer: u64, number: u64) -> f64 {
    fraction(mixed(layer.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number.wrapping_mul(0xd1b5_4a32_d192_ed03)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn circle(turned: f64) -> Loop {
        let ring = (0..90).map(|k| 10.0 * Vec2::from_angle(TAU * f64::from(k) / 90.0 + turned)).collect();
        Loop { ring, depth: 0 }
    }

    fn starts(seam: Seam, mut layers: Vec<Vec<Loop>>) -> Vec<Vec2> {
        place_seams(&mut layers.iter_mut().collect::<Vec<_>>(), seam, 0.4);
        layers.iter().map(|loops| loops[0].ring[0]).collect()
    }

    #[test]
    fn aligned_seams_lie_above_each_other_though_vertices_do_not() {
        let found = starts(Seam::Aligned, (0..50).map(|k| vec![circle(0.011 * f64::from(k))]).collect());
        assert!(found.windows(2).all(|w| w[0].distance(w[1]) < 0.02), "{found:?}");
    }

    #[test]
    fn rear_seams_are_at_the_rear_and_random_ones_everywhere() {
        let layers = |turned: f64| (0..40).map(|_| vec![circle(turned)]).collect();
        assert!(starts(Seam::Rear, layers(0.3)).iter().all(|p| p.y > 9.98));
        let random = starts(Seam::Random, layers(0.3));
        let mean = random.iter().sum::<Vec2>() / 40.0;
        assert!(mean.length() < 4.0, "{mean}");
        assert_eq!(random, starts(Seam::Random, layers(0.3)));
    }
}
