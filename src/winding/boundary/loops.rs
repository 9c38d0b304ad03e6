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
    /// Whether the caps contribute nothing anywhere, as those of T-junctions.
    pub is_flat: bool,
    /// Whether the points are all between the first and the last one, as they are on the side of a triangle.
    is_straight: bool,
    /// Of a triangle between two parts of a cycle, the loops on its other side along its first two edges; the first of a
    /// part stands for all of it. None where there is a boundary edge.
    parts: Option<[Option<u32>; 2]>,
    /// Behind the last loop of the part of the cycle that this is the first of.
    end: u32,
}

impl Loop {
    /// Boundary edges; chords do not count, as most of them are crossed back by a neighbour.
    pub fn edges(&self) -> usize {
        match self.parts {
            Some(parts) => parts.iter().filter(|part| part.is_none()).count(),
            None => self.points.len() - 1,
        }
    }
}

/// Cuts the boundary cycles of a closure, whose caps are in the order that [`crate::winding::closure::cap`] gives them.
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
    /// Cuts the polygon first … last, both included; answers its first loop.
    fn cut(&mut self, cycle: &[Vec3], ends: Range<usize>, first_cap: usize) -> Option<u32> {
        let (first, last) = (ends.start, ends.end);
        if last - first < 2 {
            return None;
        }
        let id = self.loops.len();
        let size = Aabb::around(cycle[first..=last].iter().copied()).size().max_element();
        if last - first == 2 || last - first < MOST_EDGES && size <= self.largest {
            self.add(cycle[first..=last].to_vec(), first_cap..first_cap + last - first - 1);
        } else {
            let middle = (first + last) / 2;
            self.add(vec![cycle[first], cycle[middle], cycle[last]], first_cap..first_cap + 1);
            let before = self.cut(cycle, first..middle, first_cap + 1);
            let behind = self.cut(cycle, middle..last, first_cap + middle - first);
            self.loops[id].parts = Some([before, behind]);
        }
        self.loops[id].end = self.loops.len() as u32;
        Some(id as u32)
    }

    fn add(&mut self, points: Vec<Vec3>, caps: Range<usize>) {
        let bounds = Aabb::around(points.iter().copied());
        let own = &self.caps[caps.clone()];
        let area = own.iter().map(|cap| area_vector(*cap).length()).sum();
        let has_area = own.iter().any(|cap| normal_signs(*cap) != [0; 3]);
        let is_flat = !has_area || bounds.size().max_element() <= self.least;
        let is_straight = is_flat && bounds == Aabb::around([points[0], points[points.len() - 1]]);
        self.loops.push(Loop { points, caps, bounds, area, is_flat, is_straight, parts: None, end: 0 });
    }
}

/// Closed polygons, one after the other, the last point of each once more before its first.
#[derive(Clone, Debug, Default)]
pub struct Polygons {
    pub points: Vec<Vec3>,
    /// Where each ends.
    pub ends: Vec<usize>,
}

impl Polygons {
    /// Puts loops, in rising order and none of them flat, together where they share chords, which are left out.
    pub fn set(&mut self, loops: &[Loop], wanted: &[u32]) {
        self.points.clear();
        self.ends.clear();
        let mut merger = Merger { loops, wanted, polygons: self };
        while !merger.wanted.is_empty() {
            merger.add_polygon();
        }
    }
}

struct Merger<'a> {
    loops: &'a [Loop],
    /// Those that are in no polygon yet.
    wanted: &'a [u32],
    polygons: &'a mut Polygons,
}

impl Merger<'_> {
    fn take_if(&mut self, is_next: impl FnOnce(u32) -> bool) -> Option<u32> {
        let (first, rest) = self.wanted.split_first()?;
        is_next(*first).then(|| {
            self.wanted = rest;
            *first
        })
    }

    /// Adds the polygon of the first loop.
    fn add_polygon(&mut self) {
        let Some(id) = self.take_if(|_| true) else { return };
        let mut path = Vec::new();
        self.follow(id, &mut path);
        path.extend(self.loops[id as usize].points.last());
        self.polygons.points.extend(path.last());
        self.polygons.points.extend(path);
        self.polygons.ends.push(self.polygons.points.len());
    }

    /// Adds the points of a loop and of all that is joined to it, from its first to before its last.
    fn follow(&mut self, id: u32, path: &mut Vec<Vec3>) {
        let one = &self.loops[id as usize];
        let Some(parts) = one.parts else {
            path.extend(&one.points[..one.points.len() - 1]);
            return;
        };
        for (part, corner) in parts.into_iter().zip(&one.points) {
            match part {
                None => path.push(*corner),
                Some(part) => self.cross(part, *corner, path),
            }
        }
    }

    /// Goes on behind the chord to a part, from a corner, if the loop there is wanted or lies on the chord: then it makes no
    /// difference, and is where the wanted loop before it is.
    fn cross(&mut self, part: u32, corner: Vec3, path: &mut Vec<Vec3>) {
        let one = &self.loops[part as usize];
        if self.take_if(|next| next == part).is_some() || one.is_straight && one.parts.is_some() {
            return self.follow(part, path);
        }
        path.push(corner);
        while self.wanted.first().is_some_and(|next| *next < one.end) {
            self.add_polygon();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::winding::closure::cap;

    /// Loops of an ellipse of so many edges, with a flat side if asked for.
    fn ellipse(count: usize, has_flat_side: bool) -> Vec<Loop> {
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            let y = 2.0 * angle.sin();
            Vec3::new(angle.cos(), if has_flat_side { y.max(0.0) } else { y }, 0.0)
        };
        let cycle: Vec<Vec3> = (0..count).map(at).collect();
        let mut caps = Vec::new();
        cap(&cycle, 0, count - 1, &mut caps);
        loops(&[cycle], &caps)
    }

    fn area(polygons: &Polygons) -> Vec3 {
        let mut start = 0;
        let mut sum = Vec3::ZERO;
        for end in &polygons.ends {
            let one = &polygons.points[start..*end];
            assert_eq!(one.first(), one.last());
            sum += one.windows(2).map(|ab| 0.5 * ab[0].cross(ab[1])).sum::<Vec3>();
            start = *end;
        }
        sum
    }

    #[test]
    fn all_loops_of_a_cycle_make_the_cycle() {
        for (count, flat) in [(3, false), (31, false), (32, false), (500, false), (500, true)] {
            let loops = ellipse(count, flat);
            let all: Vec<u32> = (0..loops.len() as u32).filter(|l| !loops[*l as usize].is_flat).collect();
            let mut polygons = Polygons::default();
            polygons.set(&loops, &all);
            assert_eq!(polygons.ends.len(), 1);
            assert!(flat || polygons.points.len() == count + 1, "{count}: {}", polygons.points.len());
            let edges: usize = loops.iter().map(Loop::edges).sum();
            assert!(edges >= count - 1, "{edges} of {count}");
        }
    }

    #[test]
    fn some_loops_enclose_together_what_each_does() {
        for flat in [false, true] {
            let loops = ellipse(700, flat);
            for step in 1..7 {
                let some = (0..loops.len() as u32).filter(|l| l % 7 < step && !loops[*l as usize].is_flat);
                let some: Vec<u32> = some.collect();
                let (mut together, mut one) = (Polygons::default(), Polygons::default());
                together.set(&loops, &some);
                let mut sum = Vec3::ZERO;
                for l in &some {
                    one.set(&loops, &[*l]);
                    sum += area(&one);
                }
                assert!((area(&together) - sum).length() < 1e-12);
                assert!(step == 1 || together.ends.len() < some.len());
            }
        }
    }
    /// A cycle with a spike: its boundary goes along a line, back, and on.
    #[test]
    fn polygons_go_nowhere_but_along_their_loops() {
        let mut cycle: Vec<Vec3> = (0..65).map(|k| Vec3::new(f64::from(k), 0.0, 0.0)).collect();
        cycle[32].x = 500.0;
        cycle.extend((0..65).map(|k| Vec3::new(64.0 - f64::from(k), 9.0 + f64::from(k % 2), 1.0)));
        let mut caps = Vec::new();
        cap(&cycle, 0, cycle.len() - 1, &mut caps);
        let loops = loops(&[cycle], &caps);
        let reaches_tip = |l: &u32| loops[*l as usize].bounds.max.x > 64.0;
        let all = 0..loops.len() as u32;
        let some: Vec<u32> = all.filter(|l| !loops[*l as usize].is_flat && !reaches_tip(l)).collect();
        let mut polygons = Polygons::default();
        polygons.set(&loops, &some);
        assert!(loops.iter().any(|l| l.is_flat && l.parts.is_some() && l.bounds.max.x == 500.0));
        assert!(some.len() > 2 && polygons.points.iter().all(|p| p.x <= 64.0));
    }
}
