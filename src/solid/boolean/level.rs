//! Cuts along the level set of a field beside its triangles: decided edge by edge, so that neighbours agree.
//!
//! Edges that change sides are halved until they are as short as asked for, large triangles near openings too; what still changes
//! sides is cut where it does. Seams stay as they are: the field jumps there.
use super::BooleanError;
use super::operands::Pieces;
use crate::data::{Monitor, edge_between, edges, fill_in_blocks, sorted};
use crate::levelset::crossing;
use crate::math::{Aabb, Vec3};
use crate::winding::{Accuracy, Scratch, THRESHOLD, WindingField};
use rustc_hash::{FxHashMap, FxHashSet};

/// Largest error of w where sides are told.
const TOLERANCE: f64 = 1e-4;
/// Rounds of halving: an edge becomes a 4,000th of what it was.
const ROUNDS: usize = 12;
/// Triangles near an opening are no larger than this share of it.
const OF_OPENING: f64 = 0.125;
/// Where an edge that begins on the other surface is looked at, in its length.
const BESIDE: f64 = 1e-3;
/// Halving stops at this many pieces for each that was there, and some.
const GROWTH: usize = 8;
const SPARE: usize = 200_000;

/// What is known of an edge, lower vertex first.
#[derive(Clone, Copy)]
struct Known {
    /// w less 1/2 near both ends.
    ends: [f64; 2],
    /// And in the middle, for edges that are long enough to be halved.
    middle: Option<f64>,
}

impl Known {
    fn changes(&self) -> bool {
        (self.ends[0] >= 0.0) != (self.ends[1] >= 0.0)
    }

    /// Whether the level set may cross it.
    fn is_doubtful(&self) -> bool {
        self.changes() || self.middle.is_some_and(|w| (w >= 0.0) != (self.ends[0] >= 0.0))
    }
}

struct Cutter<'a> {
    pieces: &'a mut Pieces,
    field: &'a WindingField,
    /// The pieces of the operand that is cut.
    own: Vec<u32>,
    is_cut: Vec<bool>,
    /// Edges that must stay whole.
    frozen: FxHashSet<[u32; 2]>,
    known: FxHashMap<[u32; 2], Known>,
    at_vertices: FxHashMap<u32, f64>,
    step: f64,
}

/// Cuts the pieces of one operand along the level set of the other's field.
pub fn cut(
    pieces: &mut Pieces,
    of: usize,
    field: &WindingField,
    step: f64,
    monitor: &dyn Monitor,
) -> Result<(), BooleanError> {
    let own: Vec<u32> =
        (0..pieces.corners.len()).filter(|p| pieces.operand(*p) == of).map(|p| p as u32).collect();
    if own.is_empty() || field.shape().is_empty() {
        return Ok(());
    }
    field.prepare_single_points();
    let is_cut = pieces.is_cut();
    let mut frozen = pieces.seams.clone();
    let mut places: FxHashMap<[u32; 3], u8> = FxHashMap::default();
    for (piece, corners) in pieces.corners.iter().enumerate() {
        if corners.iter().all(|v| is_cut[*v as usize]) {
            *places.entry(sorted(*corners)).or_default() |= 1 << pieces.operand(piece);
        }
    }
    // Pieces that both have stay equal.
    places.iter().filter(|(_, of)| **of == 3).for_each(|(corners, _)| frozen.extend(edges(*corners)));
    let mut cutter = Cutter {
        pieces,
        field,
        own,
        is_cut,
        frozen,
        known: FxHashMap::default(),
        at_vertices: FxHashMap::default(),
        step,
    };
    cutter.refine(monitor)?;
    cutter.cross(monitor)
}

impl Cutter<'_> {
    fn at(&self, vertex: u32) -> Vec3 {
        self.pieces.positions[vertex as usize]
    }

    fn length(&self, [a, b]: [u32; 2]) -> f64 {
        self.at(a).distance(self.at(b))
    }

    fn add(&mut self, place: Vec3) -> u32 {
        self.pieces.positions.push(place);
        self.is_cut.push(false);
        self.pieces.positions.len() as u32 - 1
    }

    /// Learns of all edges of the pieces that are not known yet.
    fn learn(&mut self, monitor: &dyn Monitor) -> Result<(), BooleanError> {
        let mut new: Vec<[u32; 2]> = Vec::new();
        for piece in &self.own {
            let of_piece = edges(self.pieces.corners[*piece as usize]);
            new.extend(of_piece.iter().filter(|e| !self.frozen.contains(*e) && !self.known.contains_key(*e)));
        }
        new.sort_unstable();
        new.dedup();
        let mut vertices: Vec<u32> = new.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices.retain(|v| !self.is_cut[*v as usize] && !self.at_vertices.contains_key(v));
        let mut points: Vec<Vec3> = vertices.iter().map(|v| self.at(*v)).collect();
        for [a, b] in &new {
            let (from, to) = (self.at(*a), self.at(*b));
            for (vertex, share) in [(*a, BESIDE), (*b, 1.0 - BESIDE)] {
                if self.is_cut[vertex as usize] {
                    points.push(from.lerp(to, share));
                }
            }
            if from.distance(to) > self.step {
                points.push(from.midpoint(to));
            }
        }
        let values = self.field.evaluate(&points, Accuracy::Tolerance(TOLERANCE), monitor)?;
        let mut values = values.into_iter().map(|w| w - THRESHOLD);
        let mut next = || values.next().unwrap_or_default();
        for vertex in vertices {
            let value = next();
            self.at_vertices.insert(vertex, value);
        }
        for ends in new {
            let of_ends = ends.map(|v| match self.is_cut[v as usize] {
                true => next(),
                false => self.at_vertices.get(&v).copied().unwrap_or_default(),
            });
            let middle = (self.length(ends) > self.step).then(&mut next);
            self.known.insert(ends, Known { ends: of_ends, middle });
        }
        Ok(())
    }

    /// Halves edges until none that changes sides is long.
    fn refine(&mut self, monitor: &dyn Monitor) -> Result<(), BooleanError> {
        let most = GROWTH * self.own.len() + SPARE;
        let openings: Vec<(Aabb, f64)> = self
            .field
            .openings()
            .into_iter()
            .map(|opening| {
                let size = opening.diagonal();
                (opening.padded(0.5 * size), (OF_OPENING * size).max(self.step))
            })
            .collect();
        for round in 0..ROUNDS {
            monitor.report(round as f64 / ROUNDS as f64, "cutting along the level set")?;
            self.learn(monitor)?;
            let mut halved: FxHashSet<[u32; 2]> = FxHashSet::default();
            for piece in &self.own {
                let corners = self.pieces.corners[*piece as usize];
                let of_piece = edges(corners);
                let long = |e: &&[u32; 2]| self.length(**e) > self.step && self.known.contains_key(*e);
                halved.extend(of_piece.iter().filter(long).filter(|e| self.known[*e].is_doubtful()));
                let bounds = Aabb::around(corners.map(|v| self.at(v)));
                let limit = openings
                    .iter()
                    .filter(|(opening, _)| bounds.overlaps(opening))
                    .map(|(_, limit)| *limit)
                    .fold(f64::INFINITY, f64::min);
                let longest = of_piece
                    .into_iter()
                    .filter(|e| self.known.contains_key(e))
                    .max_by(|a, b| self.length(*a).total_cmp(&self.length(*b)).then(b.cmp(a)));
                halved.extend(longest.filter(|e| self.length(*e) > limit));
            }
            if halved.is_empty() || self.own.len() + 2 * halved.len() > most {
                break;
            }
            self.halve(halved);
        }
        self.learn(monitor)
    }

    fn halve(&mut self, halved: FxHashSet<[u32; 2]>) {
        let mut halved: Vec<[u32; 2]> = halved.into_iter().collect();
        halved.sort_unstable();
        let mut middles: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        for ends in halved {
            let place = self.at(ends[0]).midpoint(self.at(ends[1]));
            let middle = self.add(place);
            if let Some(value) = self.known.get(&ends).and_then(|known| known.middle) {
                self.at_vertices.insert(middle, value);
            }
            middles.insert(ends, middle);
        }
        for k in 0..self.own.len() {
            let piece = self.own[k];
            let corners = self.pieces.corners[piece as usize];
            let between = edges(corners).map(|e| middles.get(&e).copied());
            if between != [None; 3] {
                self.replace(piece, halves(corners, between));
            }
        }
    }

    /// Puts parts in the place of a piece.
    fn replace(&mut self, piece: u32, parts: Vec<[u32; 3]>) {
        let source = self.pieces.sources[piece as usize];
        for (k, part) in parts.into_iter().enumerate() {
            if k == 0 {
                self.pieces.corners[piece as usize] = part;
                continue;
            }
            self.own.push(self.pieces.corners.len() as u32);
            self.pieces.corners.push(part);
            self.pieces.sources.push(source);
        }
    }

    /// Cuts pieces where their edges change sides.
    fn cross(&mut self, monitor: &dyn Monitor) -> Result<(), BooleanError> {
        let mut crossed: Vec<[u32; 2]> = Vec::new();
        for piece in &self.own {
            let of_piece = edges(self.pieces.corners[*piece as usize]);
            crossed.extend(of_piece.iter().filter(|e| self.known.get(*e).is_some_and(Known::changes)));
        }
        crossed.sort_unstable();
        crossed.dedup();
        let mut shares = vec![0.0; crossed.len()];
        let find = |i: usize, scratch: &mut Scratch| {
            let [from, to] = crossed[i].map(|v| self.at(v));
            let at_zero = self.known[&crossed[i]].ends[0] >= 0.0;
            crossing(at_zero, |t| self.field.is_nearly_above(from.lerp(to, t), THRESHOLD, scratch))
        };
        fill_in_blocks(&mut shares, find, "cutting along the level set", monitor)?;
        let mut cuts: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        for (ends, share) in crossed.iter().zip(shares) {
            let place = self.at(ends[0]).lerp(self.at(ends[1]), share);
            let cut = self.add(place);
            cuts.insert(*ends, cut);
        }
        for k in 0..self.own.len() {
            let piece = self.own[k];
            let corners = self.pieces.corners[piece as usize];
            let at = edges(corners).map(|e| cuts.get(&e).copied());
            let chords: Vec<[u32; 2]> = match at.iter().flatten().copied().collect::<Vec<u32>>()[..] {
                [] => continue,
                [x] => {
                    let opposite = (0..3).find(|k| at[*k].is_some()).map_or(0, |k| corners[(k + 2) % 3]);
                    vec![edge_between(x, opposite)]
                }
                [x, y] => vec![edge_between(x, y)],
                [x, y, z] => edges([x, y, z]).to_vec(),
                _ => unreachable!("a triangle has three edges"),
            };
            self.pieces.seams.extend(chords);
            self.replace(piece, halves(corners, at));
        }
        Ok(())
    }
}

/// The parts of a triangle with points on some of its edges; edge k leads from corner k to the next.
fn halves(corners: [u32; 3], between: [Option<u32>; 3]) -> Vec<[u32; 3]> {
    let turned = |k: usize| {
        let c = [0, 1, 2].map(|i| corners[(i + k) % 3]);
        let b = [0, 1, 2].map(|i| between[(i + k) % 3]);
        (c, b)
    };
    for k in 0..3 {
        let ([a, b, c], middles) = turned(k);
        match middles {
            [Some(x), Some(y), Some(z)] => return vec![[a, x, z], [x, b, y], [z, y, c], [x, y, z]],
            [Some(x), None, Some(z)] => {
                // The corner a is cut off; of the rest, the diagonal from the lower of its corners.
                let rest = if b < c { [[x, b, z], [b, c, z]] } else { [[x, b, c], [x, c, z]] };
                return vec![[a, x, z], rest[0], rest[1]];
            }
            [Some(x), None, None] => return vec![[a, x, c], [x, b, c]],
            _ => {}
        }
    }
    vec![corners]
}
