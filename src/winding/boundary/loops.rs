use crate::math::{Aabb, Vec3, area_vector, normal_signs};
use std::ops::Range;

/// Cycles of more edges are cut into loops of up to this many: each has its own place, from where it looks small.
const MOST_EDGES: usize = 32;
/// And so are those that are larger than this share of the whole boundary.
const LARGEST: f64 = 0.3;
/// Loops smaller than this share of it are seen from nowhere, and their squares may be no numbers.
const LEAST: f64 = 1e-30;

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
    let size = Aabb::around(cycles.iter().flatten().copied()).size().max_element();
    let mut cutter = Cutter { caps, largest: LARGEST * size, least: LEAST * size, loops: Vec::new() };
    let mut first_cap = 0;
    for cycle in cycles {
        cutter.cut(cycle, 0..cycle.len() - 1, first_cap);
        first_cap += cycle.len() - 2;
    }
    cutter.loops
}

struct Cutter<'a> {
    caps: &'a [[Vec3; 3]],
    largest: f64,
    least: f64,
    loops: Vec<Loop>,
}

impl Cutter<'_> {
    /// Cuts the polygon first … last, both included.
    fn cut(&mut self, cycle: &[Vec3], ends: Range<usize>, first_cap: usize) {
        let (first, last) = (ends.start, ends.end);
        if last - first < 2 {
            return;
        }
        let size = Aabb::around(cycle[first..=last].iter().copied()).size().max_element();
        if last - first == 2 || last - first < MOST_EDGES && size <= self.largest {
            return self.add(cycle[first..=last].to_vec(), first_cap..first_cap + last - first - 1);
        }
        let middle = (first + last) / 2;
        self.add(vec![cycle[first], cycle[middle], cycle[last]], first_cap..first_cap + 1);
        self.cut(cycle, first..middle, first_cap + 1);
        self.cut(cycle, middle..last, first_cap + middle - first);
    }

    fn add(&mut self, points: Vec<Vec3>, caps: Range<usize>) {
        let bounds = Aabb::around(points.iter().copied());
        let own = &self.caps[caps.clone()];
        let area = own.iter().map(|cap| area_vector(*cap).length()).sum();
        let has_area = own.iter().any(|cap| normal_signs(*cap) != [0; 3]);
        if has_area && bounds.size().max_element() > self.least {
            self.loops.push(Loop { points, caps, bounds, area });
        }
    }
}
