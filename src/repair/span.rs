//! Triangles that span a closed polygon of space: of all triangulations without new vertices that with the least bend and, of those,
//! the least area (Barequet & Sharir 1995, *Filling Gaps in the Boundary of a Polyhedron*; weights of Liepa 2003, *Filling Holes in
//! Meshes*), by dynamic programming in time cubic in the vertices. Long polygons are cut in two first, where they are narrow.
use crate::math::{Vec3, area_vector};

/// Vertices of a polygon that is spanned at once.
const MOST: usize = 160;
/// The least share of the vertices on either side of a cut.
const LEAST_PART: f64 = 0.1;
/// Places that a cut may begin and end at.
const CUTS: usize = 512;
/// Bends that differ by less than this, as 1 − cos, are equal: the area decides.
const SAME_BEND: f64 = 1e-3;

/// Triangles of a closed polygon, by the places of its points, in its own direction of turning. `beside` are normals of the triangles
/// on the other side of each edge, from point k to the next; zero where there is none.
pub fn span(points: &[Vec3], beside: &[Vec3]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(points.len().saturating_sub(2));
    let all: Vec<u32> = (0..points.len() as u32).collect();
    let mut open = vec![(all, beside.to_vec())];
    while let Some((polygon, beside)) = open.pop() {
        if polygon.len() > MOST {
            open.extend(halves(points, &polygon, &beside));
        } else if polygon.len() > 2 {
            let table = Table::of(polygon.iter().map(|v| points[*v as usize]).collect(), &beside);
            table.collect(0, polygon.len() - 1, &mut |t| triangles.push(t.map(|k| polygon[k])));
        }
    }
    triangles
}

type Part = (Vec<u32>, Vec<Vec3>);

/// Cuts a polygon along the chord that is shortest for the part it cuts off, of those that leave both ends inward if there are any.
fn halves(points: &[Vec3], polygon: &[u32], beside: &[Vec3]) -> [Part; 2] {
    let count = polygon.len();
    let at = |k: usize| points[polygon[k] as usize];
    let mut along = vec![0.0];
    (0..count).for_each(|k| along.push(along[k] + at(k).distance(at((k + 1) % count))));
    let least = ((LEAST_PART * count as f64) as usize).max(2);
    let step = count.div_ceil(CUTS);
    let corners: Vec<Corner> = (0..count)
        .map(|k| {
            let before = (k + count - 1) % count;
            let normal = beside[before] + beside[k];
            Corner { next: at((k + 1) % count) - at(k), previous: at(before) - at(k), normal }
        })
        .collect();
    let mut best = (true, f64::INFINITY, 0, count / 2);
    for i in (0..count).step_by(step) {
        for j in (i + least..count.min(i + count - least + 1)).step_by(step) {
            let (arc, chord) = (along[j] - along[i], at(j) - at(i));
            let ratio = chord.length() / arc.min(along[count] - arc);
            if best.0 || ratio < best.1 {
                let leaves = !(corners[i].holds(chord) && corners[j].holds(-chord));
                if (leaves, ratio) < (best.0, best.1) {
                    best = (leaves, ratio, i, j);
                }
            }
        }
    }
    let (.., i, j) = best;
    let inner = (polygon[i..=j].to_vec(), [&beside[i..j], &[Vec3::ZERO]].concat());
    let outer =
        ([&polygon[j..], &polygon[..=i]].concat(), [&beside[j..], &beside[..i], &[Vec3::ZERO]].concat());
    [inner, outer]
}

/// A corner of a polygon: the ways to its neighbours, and the normal of what lies around.
struct Corner {
    next: Vec3,
    previous: Vec3,
    normal: Vec3,
}

impl Corner {
    /// Whether a way leads between both edges, to the polygon's inside as the normal has it; true where there is none.
    fn holds(&self, way: Vec3) -> bool {
        let turn = |a: Vec3, b: Vec3| a.cross(b).dot(self.normal);
        let (from_next, to_previous) = (turn(self.next, way), turn(way, self.previous));
        if self.normal == Vec3::ZERO {
            true
        } else if turn(self.next, self.previous) > 0.0 {
            from_next > 0.0 && to_previous > 0.0
        } else {
            from_next > 0.0 || to_previous > 0.0
        }
    }
}

/// The best triangulation of each stretch of a polygon, and where its triangle on the chord has its top.
struct Table {
    points: Vec<Vec3>,
    costs: Vec<(f64, f64)>,
    tops: Vec<u32>,
}

impl Table {
    fn of(points: Vec<Vec3>, beside: &[Vec3]) -> Table {
        let count = points.len();
        let mut table =
            Table { costs: vec![(0.0, 0.0); count * count], tops: vec![0; count * count], points };
        let mut normals = vec![Vec3::ZERO; count * count];
        (0..count - 1).for_each(|k| normals[k * count + k + 1] = beside[k]);
        for length in 2..count {
            for first in 0..count - length {
                let last = first + length;
                let mut best = (f64::INFINITY, f64::INFINITY);
                for top in first + 1..last {
                    let normal = table.normal([first, top, last]);
                    let unit = normal.normalize_or_zero();
                    let (left, right) = (first * count + top, top * count + last);
                    let mut bend = bend(unit, normals[left]).max(self::bend(unit, normals[right]));
                    if length == count - 1 {
                        bend = bend.max(self::bend(unit, beside[count - 1]));
                    }
                    let (before, behind) = (table.costs[left], table.costs[right]);
                    let cost = (bend.max(before.0).max(behind.0), normal.length() + before.1 + behind.1);
                    if is_better(cost, best) {
                        best = cost;
                        let place = first * count + last;
                        (table.costs[place], table.tops[place], normals[place]) = (cost, top as u32, unit);
                    }
                }
            }
        }
        table
    }

    fn normal(&self, [a, b, c]: [usize; 3]) -> Vec3 {
        area_vector([self.points[a], self.points[b], self.points[c]])
    }

    fn collect(&self, first: usize, last: usize, put: &mut dyn FnMut([usize; 3])) {
        let mut open = vec![(first, last)];
        while let Some((first, last)) = open.pop() {
            if last - first >= 2 {
                let top = self.tops[first * self.points.len() + last] as usize;
                put([first, top, last]);
                open.extend([(first, top), (top, last)]);
            }
        }
    }
}

/// 1 − cos of the angle between two unit normals; 0 if one of them is none.
fn bend(a: Vec3, b: Vec3) -> f64 {
    if a == Vec3::ZERO || b == Vec3::ZERO { 0.0 } else { 1.0 - a.dot(b) }
}

fn is_better(one: (f64, f64), other: (f64, f64)) -> bool {
    one.0 < other.0 - SAME_BEND || one.0 < other.0 + SAME_BEND && one.1 < other.1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
        triangles.iter().map(|t| area_vector(t.map(|v| points[v as usize])).length()).sum()
    }

    #[test]
    fn a_flat_polygon_with_a_bay_is_covered_once() {
        let outline =
            [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (3.0, 4.0), (3.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)];
        let points = outline.map(|(x, y)| Vec3::new(x, y, 0.0));
        let triangles = span(&points, &[Vec3::Z; 8]);
        assert_eq!(triangles.len(), 6);
        assert!((area(&points, &triangles) - 10.0).abs() < 1e-12);
        assert!(triangles.iter().all(|t| area_vector(t.map(|v| points[v as usize])).z > 0.0));
    }

    #[test]
    fn a_long_polygon_is_cut_and_still_covered_once() {
        // A comb of 100 teeth: it is narrow at each of them.
        let mut points = vec![Vec3::new(100.0, -1.0, 0.0), Vec3::new(100.0, 0.0, 0.0)];
        for tooth in (0..100).rev() {
            let x = f64::from(tooth);
            points.extend(
                [(x + 0.8, 0.0), (x + 0.7, 3.0), (x + 0.3, 3.0), (x + 0.2, 0.0)]
                    .map(|(x, y)| Vec3::new(x, y, 0.0)),
            );
        }
        points.extend([Vec3::ZERO, Vec3::new(0.0, -1.0, 0.0)]);
        let triangles = span(&points, &vec![Vec3::Z; points.len()]);
        assert_eq!(triangles.len(), points.len() - 2);
        assert!((area(&points, &triangles) - (100.0 + 100.0 * 1.5)).abs() < 1e-9);
    }

    #[test]
    fn a_hole_in_a_dome_follows_its_bend() {
        // Around an edge of a cube: bent once, not flat across.
        let points = [
            (0.0, 0.0, 0.0),
            (1.0, 0.0, 0.0),
            (1.0, 1.0, 0.0),
            (1.0, 1.0, -1.0),
            (0.0, 1.0, -1.0),
            (0.0, 1.0, 0.0),
        ];
        let points = points.map(|(x, y, z)| Vec3::new(x, y, z));
        let beside = [Vec3::Z, Vec3::Z, Vec3::Y, Vec3::Y, Vec3::Y, Vec3::Z];
        let triangles = span(&points, &beside);
        assert!((area(&points, &triangles) - 2.0).abs() < 1e-12, "{triangles:?}");
    }
}
