//! Which parts of a section bound what is inside: those that the threshold separates the field on the two sides of.
use super::arrangement::Piece;
use super::chains::key;
use super::plane::Plane;
use crate::math::Vec2;
use rustc_hash::FxHashMap;

/// A part of the boundary, the inside on its left.
pub(super) type Directed = [Vec2; 2];

/// Pieces longer than this share of the section's size are looked at in more than one place.
const LONGEST: f64 = 1.0 / 128.0;
/// Places looked at on a piece at most.
const MOST_PLACES: usize = 256;
/// From the ends of a piece, places at which its state there is looked at.
const AT_END: f64 = 1e-4;
/// Steps of bisection, to rounding.
const BISECTIONS: usize = 50;

/// Whether the threshold lies between the sides of a piece at a place on it.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Sides {
    left: bool,
    right: bool,
}

impl Sides {
    fn bounds(self) -> bool {
        self.left != self.right
    }
}

/// The directed parts of pieces that bound the inside.
pub(super) fn kept(pieces: &[Piece], plane: &Plane) -> Vec<Directed> {
    let mut places: Vec<Vec<f64>> = pieces.iter().map(|piece| places(piece, plane.size)).collect();
    let mut states = look(pieces, &places, plane);
    // Where the boundary ends at a point for what is known so far, the field may have changed along the pieces there.
    let mut excess: FxHashMap<u128, i32> = FxHashMap::default();
    for (piece, states) in pieces.iter().zip(&states) {
        let mut add = |point: Vec2, sides: Sides, at_start: i32| {
            if sides.bounds() {
                *excess.entry(key(point)).or_default() += if sides.left { at_start } else { -at_start };
            }
        };
        add(piece.from, states[0], 1);
        add(piece.to, states[states.len() - 1], -1);
    }
    let is_open = |p: Vec2| excess.get(&key(p)).is_some_and(|e| *e != 0);
    let open: Vec<usize> =
        (0..pieces.len()).filter(|k| is_open(pieces[*k].from) || is_open(pieces[*k].to)).collect();
    let ends: Vec<Vec<f64>> = open.iter().map(|_| vec![AT_END, 1.0 - AT_END]).collect();
    let open_pieces: Vec<Piece> = open.iter().map(|k| pieces[*k]).collect();
    for (k, at_ends) in open.iter().zip(look(&open_pieces, &ends, plane)) {
        places[*k].insert(0, AT_END);
        places[*k].push(1.0 - AT_END);
        states[*k].insert(0, at_ends[0]);
        states[*k].push(at_ends[1]);
    }
    let mut kept = Vec::new();
    for ((piece, places), states) in pieces.iter().zip(&places).zip(&states) {
        parts_of(piece, places, states, plane, &mut kept);
    }
    kept
}

fn places(piece: &Piece, size: f64) -> Vec<f64> {
    let count = (piece.from.distance(piece.to) / (LONGEST * size)).ceil() as usize;
    let count = count.clamp(1, MOST_PLACES);
    (0..count).map(|k| (k as f64 + 0.5) / count as f64).collect()
}

/// What lies left and right of each piece at its places, all looked at together.
fn look(pieces: &[Piece], places: &[Vec<f64>], plane: &Plane) -> Vec<Vec<Sides>> {
    let points: Vec<Vec2> = pieces
        .iter()
        .zip(places)
        .flat_map(|(piece, places)| {
            let aside = plane.aside * piece.left();
            places.iter().flat_map(move |t| [piece.at(*t) + aside, piece.at(*t) - aside])
        })
        .collect();
    let inside = plane.all_inside(&points);
    let mut sides = inside.chunks_exact(2).map(|pair| Sides { left: pair[0], right: pair[1] });
    places.iter().map(|places| sides.by_ref().take(places.len()).collect()).collect()
}

/// The parts of a piece between changes of its state, found by bisection.
fn parts_of(piece: &Piece, places: &[f64], states: &[Sides], plane: &Plane, kept: &mut Vec<Directed>) {
    let mut add = |from: Vec2, to: Vec2, sides: Sides| {
        if sides.bounds() && from != to {
            kept.push(if sides.left { [from, to] } else { [to, from] });
        }
    };
    let mut start = piece.from;
    for (k, pair) in states.windows(2).enumerate() {
        if pair[0] == pair[1] {
            continue;
        }
        let aside = plane.aside * piece.left();
        let (mut low, mut high) = (places[k], places[k + 1]);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let p = piece.at(middle);
            let sides = Sides { left: plane.is_inside(p + aside), right: plane.is_inside(p - aside) };
            *(if sides == pair[0] { &mut low } else { &mut high }) = middle;
        }
        let change = piece.at(low);
        add(start, change, pair[0]);
        start = change;
    }
    add(start, piece.to, states[states.len() - 1]);
}
