//! Segments joined to loops and paths.
use super::section::Segment;
use crate::data::Ring;
use crate::math::Vec2;
use rustc_hash::FxHashMap;

/// What segments join to.
#[derive(Default)]
pub(super) struct Chains {
    /// Without their first point repeated.
    pub loops: Vec<Ring>,
    /// Paths that do not close, from their first point to their last.
    pub paths: Vec<Vec<Vec2>>,
    /// Whether more than one segment starts at some point.
    pub branches: bool,
}

const NONE: u32 = u32::MAX;

pub(super) fn key(p: Vec2) -> u128 {
    u128::from(p.x.to_bits()) << 64 | u128::from(p.y.to_bits())
}

/// Joins segments that end where others start, bit by bit. At points where several start, the first that was given goes on.
pub(super) fn join(segments: &[Segment]) -> Chains {
    let mut first: FxHashMap<u128, u32> = FxHashMap::default();
    first.reserve(segments.len());
    // The next segment that starts where this one does; those given first come first.
    let mut other = vec![NONE; segments.len()];
    let mut chains = Chains::default();
    for (k, segment) in segments.iter().enumerate().rev() {
        if let Some(later) = first.insert(key(segment[0]), k as u32) {
            other[k] = later;
            chains.branches = true;
        }
    }
    let mut take = |p: Vec2| -> Option<usize> {
        let slot = first.get_mut(&key(p)).filter(|slot| **slot != NONE)?;
        let found = *slot as usize;
        *slot = other[found];
        Some(found)
    };
    for start in starts_of_paths(segments).into_iter().chain(segments.iter().map(|s| s[0])) {
        let Some(k) = take(start) else { continue };
        let mut points = vec![segments[k][0]];
        let mut end = segments[k][1];
        while end != start {
            points.push(end);
            match take(end) {
                Some(next) => end = segments[next][1],
                None => break,
            }
        }
        if end == start { chains.loops.push(points) } else { chains.paths.push(points) }
    }
    chains
}

/// Points where more segments start than end, as often as that: from there paths are followed whole.
fn starts_of_paths(segments: &[Segment]) -> Vec<Vec2> {
    let mut balance: FxHashMap<u128, i32> = FxHashMap::default();
    balance.reserve(segments.len());
    for segment in segments {
        *balance.entry(key(segment[1])).or_default() -= 1;
    }
    let mut starts = Vec::new();
    for segment in segments {
        let excess = balance.entry(key(segment[0])).or_default();
        *excess += 1;
        if *excess > 0 {
            starts.push(segment[0]);
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Vec2 {
        Vec2::new(x, y)
    }

    #[test]
    fn loops_and_paths_are_told_apart() {
        let (a, b, c, d, e) = (p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(5.0, 5.0), p(6.0, 5.0));
        let chains = join(&[[c, a], [e, p(7.0, 7.0)], [a, b], [d, e], [b, c]]);
        assert_eq!(chains.loops, [vec![c, a, b]]);
        assert_eq!(chains.paths, [vec![d, e, p(7.0, 7.0)]]);
        assert!(!chains.branches);
    }

    #[test]
    fn loops_that_meet_use_every_segment_once() {
        let (o, a, b, c, d) = (p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(-1.0, 0.0), p(-1.0, -1.0));
        let chains = join(&[[o, a], [a, b], [b, o], [o, c], [c, d], [d, o]]);
        assert!(chains.branches && chains.paths.is_empty());
        assert_eq!(chains.loops.iter().map(Vec::len).sum::<usize>(), 6);
    }
}
