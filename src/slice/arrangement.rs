//! Segments split where they cross or touch, equal pieces made one.
use super::chains::key;
use super::section::Segment;
use crate::data::ascending;
use crate::math::{Vec2, orient};
use rustc_hash::FxHashMap;

/// A piece of a section that meets others at its ends only. The field is higher on its left by `turns` > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub from: Vec2,
    pub to: Vec2,
    pub turns: i32,
}

impl Piece {
    pub fn at(&self, share: f64) -> Vec2 {
        self.from.lerp(self.to, share)
    }

    /// Unit vector to the left.
    pub fn left(&self) -> Vec2 {
        (self.to - self.from).normalize_or_zero().perp()
    }
}

/// The pieces of segments; where as many run one way as the other, there is none.
pub(super) fn pieces(segments: &[Segment]) -> Vec<Piece> {
    let cuts = cuts(segments);
    let mut number: FxHashMap<(u128, u128), usize> = FxHashMap::default();
    let mut pieces: Vec<Piece> = Vec::new();
    for (segment, cuts) in segments.iter().zip(cuts) {
        let [from, to] = *segment;
        let along = to - from;
        let mut points = cuts;
        points.sort_by(|a, b| (*a - from).dot(along).total_cmp(&(*b - from).dot(along)));
        points.insert(0, from);
        points.push(to);
        points.dedup();
        for ends in points.windows(2) {
            let (a, b) = (ends[0], ends[1]);
            let is_up = (a.y, a.x) < (b.y, b.x);
            let (low, high) = if is_up { (a, b) } else { (b, a) };
            let place = *number.entry((key(low), key(high))).or_insert_with(|| {
                pieces.push(Piece { from: low, to: high, turns: 0 });
                pieces.len() - 1
            });
            pieces[place].turns += if is_up { 1 } else { -1 };
        }
    }
    pieces.retain(|piece| piece.turns != 0);
    for piece in pieces.iter_mut().filter(|piece| piece.turns < 0) {
        *piece = Piece { from: piece.to, to: piece.from, turns: -piece.turns };
    }
    pieces
}

/// Points inside each segment where others meet it: a sweep upwards.
fn cuts(segments: &[Segment]) -> Vec<Vec<Vec2>> {
    let mut cuts = vec![Vec::new(); segments.len()];
    let mut active: Vec<u32> = Vec::new();
    let low = |s: &Segment| s[0].min(s[1]);
    let high = |s: &Segment| s[0].max(s[1]);
    for index in ascending(segments.iter().map(|s| low(s).y)) {
        let segment = &segments[index as usize];
        let (below, above) = (low(segment), high(segment));
        active.retain(|k| high(&segments[*k as usize]).y >= below.y);
        for &k in &active {
            let other = &segments[k as usize];
            if low(other).x <= above.x && below.x <= high(other).x {
                let [mine, theirs] = meeting(segment, other);
                cuts[index as usize].extend(mine);
                cuts[k as usize].extend(theirs);
            }
        }
        active.push(index);
    }
    cuts
}

/// Where two segments meet, inside the one and inside the other.
fn meeting(a: &Segment, b: &Segment) -> [Vec<Vec2>; 2] {
    let of_b = [orient(a[0], a[1], b[0]), orient(a[0], a[1], b[1])];
    let of_a = [orient(b[0], b[1], a[0]), orient(b[0], b[1], a[1])];
    if of_b[0] * of_b[1] > 0 || of_a[0] * of_a[1] > 0 {
        return [vec![], vec![]];
    }
    if of_b[0] * of_b[1] < 0 && of_a[0] * of_a[1] < 0 {
        let (along, across) = (a[1] - a[0], b[1] - b[0]);
        let share = (b[0] - a[0]).perp_dot(across) / along.perp_dot(across);
        let point = a[0] + share.clamp(0.0, 1.0) * along + Vec2::ZERO;
        return [vec![point], vec![point]];
    }
    // Ends of the one on the other, but not on its ends.
    let inside = |ends: &Segment, turns: [i32; 2], of: &Segment| -> Vec<Vec2> {
        let is_between = |p: Vec2| {
            p != of[0] && p != of[1] && (of[0].min(of[1])).cmple(p).all() && p.cmple(of[0].max(of[1])).all()
        };
        (0..2).filter(|k| turns[*k] == 0 && is_between(ends[*k])).map(|k| ends[k]).collect()
    };
    [inside(b, of_b, a), inside(a, of_a, b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Vec2 {
        Vec2::new(x, y)
    }

    #[test]
    fn crossing_segments_become_four() {
        let found = pieces(&[[p(0.0, 0.0), p(2.0, 2.0)], [p(2.0, 0.0), p(0.0, 2.0)]]);
        assert_eq!(found.len(), 4);
        assert!(found.iter().all(|piece| piece.from == p(1.0, 1.0) || piece.to == p(1.0, 1.0)));
    }

    #[test]
    fn what_runs_both_ways_vanishes_and_what_runs_twice_counts_twice() {
        let (a, b) = (p(0.0, 0.0), p(3.0, 0.0));
        assert!(pieces(&[[a, b], [b, a]]).is_empty());
        assert_eq!(pieces(&[[b, a], [b, a]]), [Piece { from: b, to: a, turns: 2 }]);
        // Overlapping by a part: three pieces, the middle one twice.
        let mut turns: Vec<(f64, i32)> = pieces(&[[a, p(2.0, 0.0)], [p(1.0, 0.0), b]])
            .iter()
            .map(|piece| (piece.from.x, piece.turns))
            .collect();
        turns.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(turns, [(0.0, 1), (1.0, 2), (2.0, 1)]);
    }

    #[test]
    fn an_end_on_another_segment_splits_it() {
        let found = pieces(&[[p(0.0, 0.0), p(4.0, 0.0)], [p(1.0, 0.0), p(1.0, 5.0)]]);
        assert_eq!(found.len(), 3);
    }
}
