//! Which parts of a section bound what is inside: those that the threshold separates the field on the two sides of.
use super::arrangement::Piece;
use super::chains::key;
use super::plane::Plane;
use crate::math::{Aabb, Vec2, Vec3};
use rustc_hash::FxHashMap;

/// A part of the boundary, the inside on its left.
pub(super) type Directed = [Vec2; 2];

/// Pieces longer than this share of the section's size are looked at in more than one place.
const LONGEST: f64 = 1.0 / 128.0;
/// Places looked at on a piece at most.
const MOST_PLACES: usize = 256;
/// From the ends of a piece, places at which its state there is looked at.
const AT_END: f64 = 1e-4;
/// Places along a chain are as near to each other as this share of the distance to the nearest opening.
const NEARNESS: f64 = 0.5;
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

/// The directed parts of pieces that bound the inside. `openings` are boxes around what bounds those of the shape.
pub(super) fn kept(pieces: &[Piece], plane: &Plane, openings: &[Aabb]) -> Vec<Directed> {
    let mut places: Vec<Vec<f64>> = pieces.iter().map(|piece| places(piece, plane.size)).collect();
    let mut states = look_along(pieces, &places, plane, openings);
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

/// What lies left and right of each piece at its places. Along a chain of pieces the field changes no faster than with the distance
/// from the openings: between two places with equal sides, as near to each other as that allows, all have the same.
fn look_along(pieces: &[Piece], places: &[Vec<f64>], plane: &Plane, openings: &[Aabb]) -> Vec<Vec<Sides>> {
    let mut states: Vec<Vec<Sides>> = vec![Vec::new(); pieces.len()];
    // Runs between two pieces that are looked at, of those between them.
    let mut runs: Vec<(u32, Vec<u32>, u32)> = Vec::new();
    let mut wanted: Vec<u32> = Vec::new();
    for chain in chains_of(pieces) {
        let mut since = f64::INFINITY;
        let mut run: Vec<u32> = Vec::new();
        let mut last = chain[0];
        for (k, &number) in chain.iter().enumerate() {
            let piece = &pieces[number as usize];
            since += piece.from.distance(piece.to);
            let is_end = k == 0 || k + 1 == chain.len() || places[number as usize].len() > 1;
            if is_end || since > NEARNESS * distance_to(openings, piece.at(0.5), plane.z) {
                wanted.push(number);
                runs.push((last, std::mem::take(&mut run), number));
                (last, since) = (number, 0.0);
            } else {
                run.push(number);
            }
        }
    }
    loop {
        let some: Vec<Piece> = wanted.iter().map(|k| pieces[*k as usize]).collect();
        let at: Vec<Vec<f64>> = wanted.iter().map(|k| places[*k as usize].clone()).collect();
        for (k, sides) in wanted.drain(..).zip(look(&some, &at, plane)) {
            states[k as usize] = sides;
        }
        for (first, run, last) in std::mem::take(&mut runs) {
            let sides = (states[first as usize].last().copied(), states[last as usize].first().copied());
            match (sides, run.len()) {
                (_, 0) => {}
                ((Some(left), Some(right)), _) if left == right => {
                    run.iter().for_each(|k| states[*k as usize] = vec![left]);
                }
                (_, count) => {
                    let middle = run[count / 2];
                    wanted.push(middle);
                    runs.push((first, run[..count / 2].to_vec(), middle));
                    runs.push((middle, run[count / 2 + 1..].to_vec(), last));
                }
            }
        }
        if wanted.is_empty() {
            return states;
        }
    }
}

/// How far a place in a plane is from the nearest of some boxes.
fn distance_to(boxes: &[Aabb], p: Vec2, z: f64) -> f64 {
    let p = p.extend(z);
    let square = |b: &Aabb| (b.min - p).max(p - b.max).max(Vec3::ZERO).length_squared();
    boxes.iter().map(square).fold(f64::INFINITY, f64::min).sqrt()
}

/// Pieces by number, in chains: each goes on where the one before ends, no other piece is there, and the jump is the same.
fn chains_of(pieces: &[Piece]) -> Vec<Vec<u32>> {
    #[derive(Default)]
    struct Node {
        starts: u32,
        ends: u32,
        next: u32,
    }
    let mut nodes: FxHashMap<u128, Node> = FxHashMap::default();
    for (k, piece) in pieces.iter().enumerate() {
        let node = nodes.entry(key(piece.from)).or_default();
        (node.starts, node.next) = (node.starts + 1, k as u32);
        nodes.entry(key(piece.to)).or_default().ends += 1;
    }
    let after = |k: u32| {
        let node = &nodes[&key(pieces[k as usize].to)];
        let is_simple = node.starts == 1 && node.ends == 1;
        (is_simple && pieces[node.next as usize].turns == pieces[k as usize].turns).then_some(node.next)
    };
    let next: Vec<Option<u32>> = (0..pieces.len() as u32).map(after).collect();
    let mut is_first = vec![true; pieces.len()];
    next.iter().flatten().for_each(|k| is_first[*k as usize] = false);
    let mut is_taken = vec![false; pieces.len()];
    let mut chains = Vec::new();
    // From their first pieces, then loops from anywhere.
    for only_first in [true, false] {
        for (start, is_first) in is_first.iter().enumerate() {
            let mut chain = Vec::new();
            let mut at = (!only_first || *is_first).then_some(start as u32);
            while let Some(k) = at.filter(|k| !is_taken[*k as usize]) {
                is_taken[k as usize] = true;
                chain.push(k);
                at = next[k as usize];
            }
            if !chain.is_empty() {
                chains.push(chain);
            }
        }
    }
    chains
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
