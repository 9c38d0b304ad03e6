use crate::math::{Aabb, Vec3, area_vector, normal_signs};
use std::ops::Range;

/// Cycles of more edges are cut into loops of up to this many: each has its own place, from where it looks small.
const MOST_EDGES: usize = 32;

/// A closed polygon of boundary edges and chords, and the caps that span it.
#[derive(Clone, Debug)]
pub struct Loop {
    pub points: Vec<Vec3>,
    /// Its caps among those of the closure.
    pub caps: Range<usize>,
    /// Around the caps.
    pub bounds: Aabb,
    /// Of the caps.
    pub area: f64,
}

/// Cuts the boundary cycles of a closure, whose caps are in the order that [`crate::winding::closure::cap`] gives them. Caps
/// without area, as T-junctions have, contribute nothing anywhere and are left out.
pub fn loops(cycles: &[Vec<Vec3>], caps: &[[Vec3; 3]]) -> Vec<Loop> {
    let mut loops = Vec::new();
    let mut first_cap = 0;
    for cycle in cycles {
        cut(cycle, 0..cycle.len() - 1, first_cap, caps, &mut loops);
        first_cap += cycle.len() - 2;
    }
    loops
}

/// Cuts the polygon first … last, both included.
fn cut(cycle: &[Vec3], ends: Range<usize>, first_cap: usize, caps: &[[Vec3; 3]], loops: &mut Vec<Loop>) {
    let (first, last) = (ends.start, ends.end);
    if last - first < 2 {
        return;
    }
    if last - first < MOST_EDGES {
        loops.extend(make(cycle[first..=last].to_vec(), first_cap..first_cap + last - first - 1, caps));
        return;
    }
    let middle = (first + last) / 2;
    loops.extend(make(vec![cycle[first], cycle[middle], cycle[last]], first_cap..first_cap + 1, caps));
    cut(cycle, first..middle, first_cap + 1, caps, loops);
    cut(cycle, middle..last, first_cap + middle - first, caps, loops);
}

fn make(points: Vec<Vec3>, caps: Range<usize>, all: &[[Vec3; 3]]) -> Option<Loop> {
    let own = &all[caps.clone()];
    let has_area = own.iter().any(|cap| normal_signs(*cap) != [0; 3]);
    let area = own.iter().map(|cap| area_vector(*cap).length()).sum();
    has_area.then(|| Loop { bounds: Aabb::around(points.iter().copied()), points, caps, area })
}
