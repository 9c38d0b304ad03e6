//! Triangles cut along each other, checked by brute force: nothing crosses any more, and nothing is lost.
mod common;

use common::*;
use fast_winding::arrangement::{Arrangement, Pairs, arrange};
use fast_winding::data::{Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3, area_vector};
use std::collections::HashMap;

struct Random(u64);

impl Random {
    /// A sequence of its own for each round of a test.
    fn of_round(test: u64, round: usize) -> Random {
        let mut random = Random(1000 + 7919 * round as u64 + 31 * test);
        (0..5).for_each(|_| _ = random.below(2));
        random
    }

    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) % n
    }

    fn on_grid(&mut self, n: u64) -> Vec3 {
        Vec3::from_array([0; 3].map(|_| self.below(n) as f64))
    }
}

/// Positions welded by value.
fn welded(faces: &[[Vec3; 3]]) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut numbers = HashMap::new();
    let mut positions = Vec::new();
    let mut number = |p: Vec3| {
        *numbers.entry((p + Vec3::ZERO).to_array().map(f64::to_bits)).or_insert_with(|| {
            positions.push(p);
            positions.len() as u32 - 1
        })
    };
    let triangles = faces.iter().map(|face| face.map(&mut number)).collect();
    (positions, triangles)
}

fn faces_of(soup: &TriangleSoup) -> Vec<[Vec3; 3]> {
    (0..soup.len()).map(|t| soup.corners(t)).collect()
}

fn net_edges(pieces: &[[u32; 3]]) -> usize {
    let mut net: HashMap<(u32, u32), i32> = HashMap::new();
    for [a, b, c] in pieces {
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            *net.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    net.values().filter(|n| **n != 0).count()
}

/// Each triangle's pieces have its area and its area vector.
fn check_areas(positions: &[Vec3], triangles: &[[u32; 3]], result: &Arrangement) {
    assert_eq!(result.positions[..positions.len()], *positions);
    let mut sums = vec![(Vec3::ZERO, 0.0); triangles.len()];
    for (piece, source) in result.pieces.iter().zip(&result.sources) {
        let vector = area_vector(piece.map(|v| result.positions[v as usize]));
        sums[*source as usize].0 += vector;
        sums[*source as usize].1 += vector.length();
    }
    for (t, (vector, area)) in sums.into_iter().enumerate() {
        let whole = area_vector(triangles[t].map(|v| positions[v as usize]));
        assert!(vector.distance(whole) < 1e-9, "triangle {t}: {vector} of {whole}");
        assert!((area - whole.length()).abs() < 1e-9, "triangle {t}: {area} of {}", whole.length());
    }
}

/// Farther than this from everything counts as beside it.
const MARGIN: f64 = 1e-7;

fn distance_to_segment(q: Vec3, [a, b]: [Vec3; 2]) -> f64 {
    let along = b - a;
    q.distance(a + ((q - a).dot(along) / along.length_squared()).clamp(0.0, 1.0) * along)
}

/// Whether a point lies inside a triangle, away from its rim.
fn is_well_inside(q: Vec3, [a, b, c]: [Vec3; 3]) -> bool {
    let n = (b - a).cross(c - a).normalize();
    (q - a).dot(n).abs() < MARGIN
        && [[a, b], [b, c], [c, a]].iter().all(|[s, t]| n.cross((*t - *s).normalize()).dot(q - *s) > MARGIN)
}

/// What two pieces have in common that they should not: a vertex of one in an edge or in the inside of the other, or an edge
/// that goes through.
fn conflict(p: [Vec3; 3], q: [Vec3; 3]) -> Option<String> {
    let edges = |t: [Vec3; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    for v in p {
        if is_well_inside(v, q) {
            return Some(format!("vertex {v} in {q:?}"));
        }
        for e in edges(q) {
            if distance_to_segment(v, e) < MARGIN && e.iter().all(|end| end.distance(v) > MARGIN) {
                return Some(format!("vertex {v} in edge {e:?}"));
            }
        }
    }
    let n = (q[1] - q[0]).cross(q[2] - q[0]).normalize();
    for [a, b] in edges(p) {
        let (s, t) = ((a - q[0]).dot(n), (b - q[0]).dot(n));
        if s.min(t) < -MARGIN && s.max(t) > MARGIN {
            let x = a.lerp(b, s / (s - t));
            if is_well_inside(x, q) {
                return Some(format!("edge {a} {b} through {q:?}"));
            }
        }
        for [c, d] in edges(q) {
            let (u, v, w) = (b - a, d - c, c - a);
            let m = u.cross(v);
            if m.length() < MARGIN || w.dot(m.normalize()).abs() > MARGIN {
                continue;
            }
            let k = m.length_squared();
            let (s, t) = (w.cross(v).dot(m) / k, w.cross(u).dot(m) / k);
            let clear = |x: f64, length: f64| x * length > MARGIN && (1.0 - x) * length > MARGIN;
            if clear(s, u.length()) && clear(t, v.length()) {
                return Some(format!("edges {a} {b} and {c} {d} cross"));
            }
        }
    }
    None
}

fn check_crossings(result: &Arrangement, is_to_be_met: impl Fn(u32, u32) -> bool) {
    let faces: Vec<[Vec3; 3]> =
        result.pieces.iter().map(|piece| piece.map(|v| result.positions[v as usize])).collect();
    let boxes: Vec<Aabb> = faces.iter().map(|f| Aabb::around(*f).padded(MARGIN)).collect();
    let is_fat = |f: &[Vec3; 3]| area_vector(*f).length() > 1e-6;
    for i in (0..faces.len()).filter(|i| is_fat(&faces[*i])) {
        for j in (0..faces.len()).filter(|j| *j != i && is_fat(&faces[*j])) {
            let apart = boxes[i].min.cmpgt(boxes[j].max).any() || boxes[j].min.cmpgt(boxes[i].max).any();
            if apart || !is_to_be_met(result.sources[i], result.sources[j]) {
                continue;
            }
            let found = conflict(faces[i], faces[j]);
            assert!(found.is_none(), "pieces {:?} and {:?}: {found:?}", result.pieces[i], result.pieces[j]);
            let centre = (faces[i][0] + faces[i][1] + faces[i][2]) / 3.0;
            if is_well_inside(centre, faces[j]) {
                let sorted = |mut t: [u32; 3]| {
                    t.sort();
                    t
                };
                assert_eq!(sorted(result.pieces[i]), sorted(result.pieces[j]), "they overlap");
            }
        }
    }
}

fn arranged(faces: &[[Vec3; 3]], pairs: Pairs) -> (Vec<Vec3>, Vec<[u32; 3]>, Arrangement) {
    let (positions, triangles) = welded(faces);
    let result = arrange(positions.clone(), &triangles, pairs, &Silent).unwrap();
    assert_eq!(result.unresolved, 0);
    (positions, triangles, result)
}

#[test]
fn soups_on_small_grids_are_cut_along_each_other() {
    // In the last ones a crossing falls on a vertex that only touches other triangles.
    for round in (0..300).chain([649, 1196, 1541, 1736]) {
        let mut random = Random::of_round(0, round);
        let (size, count) = [(3, 8), (4, 14), (6, 20), (9, 24)][round % 4];
        let faces: Vec<[Vec3; 3]> =
            (0..count).map(|_| [random.on_grid(size), random.on_grid(size), random.on_grid(size)]).collect();
        let (positions, triangles, result) = arranged(&faces, Pairs::All);
        check_areas(&positions, &triangles, &result);
        check_crossings(&result, |_, _| true);
    }
}

#[test]
fn flat_soups_become_one_picture() {
    for round in (0..200).chain([991, 1699]) {
        let mut random = Random::of_round(1, round);
        let tilt = |p: Vec3| if round % 2 == 0 { p.with_z(0.0) } else { p.with_z(p.x + 2.0 * p.y) };
        let faces: Vec<[Vec3; 3]> = (0..8).map(|_| [0; 3].map(|_| tilt(random.on_grid(5)))).collect();
        let (positions, triangles, result) = arranged(&faces, Pairs::All);
        check_areas(&positions, &triangles, &result);
        check_crossings(&result, |_, _| true);
    }
}

#[test]
fn two_soups_are_cut_along_each_other_only() {
    // In some of the last ones triangles of one soup overlap each other in a plane, and one of the other.
    for round in (0..200).chain([220, 306, 385, 477, 552, 693, 732]) {
        let mut random = Random::of_round(2, round);
        let size = [3, 4, 7][round % 3];
        let faces: Vec<[Vec3; 3]> =
            (0..20).map(|_| [random.on_grid(size), random.on_grid(size), random.on_grid(size)]).collect();
        let (positions, triangles, result) = arranged(&faces, Pairs::Between(10));
        check_areas(&positions, &triangles, &result);
        check_crossings(&result, |s, t| (s < 10) != (t < 10));
    }
}

#[test]
fn closed_meshes_stay_closed() {
    let mut random = Random(5);
    for round in 0..60 {
        let mut faces = Vec::new();
        for _ in 0..4 {
            let min = random.on_grid(4);
            let max = min + Vec3::ONE + random.on_grid(3);
            faces.extend(faces_of(&cuboid(Aabb { min, max })));
        }
        if round % 2 == 1 {
            let turn =
                |p: Vec3| Vec3::new(0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z) + random_shift(round);
            faces[12..24].iter_mut().for_each(|face| *face = face.map(turn));
        }
        let (positions, triangles, result) = arranged(&faces, Pairs::All);
        check_areas(&positions, &triangles, &result);
        check_crossings(&result, |_, _| true);
        assert_eq!(net_edges(&result.pieces), 0);
    }
}

fn random_shift(round: usize) -> Vec3 {
    Vec3::splat(round as f64).map(|x| (1.7 * x).sin())
}

#[test]
fn curved_meshes_cut_each_other_along_closed_curves() {
    let mut faces = faces_of(&torus(2.0, 0.7, 40, 24));
    let count = faces.len();
    faces.extend(faces_of(&sphere(12)).into_iter().map(|f| f.map(|p| 1.3 * p + Vec3::new(1.7, 0.2, 0.3))));
    for pairs in [Pairs::Between(count), Pairs::All] {
        let (positions, triangles, result) = arranged(&faces, pairs);
        check_areas(&positions, &triangles, &result);
        check_crossings(&result, |_, _| true);
        assert_eq!(net_edges(&result.pieces), 0);
        // Every vertex of the seam has two edges of it: the curves are closed.
        let mut ends: HashMap<u32, usize> = HashMap::new();
        result.seams.iter().flatten().for_each(|v| *ends.entry(*v).or_default() += 1);
        assert!(!ends.is_empty() && ends.values().all(|n| *n == 2));
    }
}

#[test]
fn equal_and_degenerate_triangles_are_no_trouble() {
    let o = Vec3::ZERO;
    let flat = [o, 4.0 * Vec3::X, 4.0 * Vec3::Y];
    let upright = [Vec3::new(1.0, 1.0, -1.0), Vec3::new(1.0, 1.0, 1.0), Vec3::new(2.0, -1.0, 0.0)];
    let needle = [o, 2.0 * Vec3::X, 4.0 * Vec3::X];
    let faces = [flat, flat, [flat[0], flat[2], flat[1]], upright, needle, [o, o, o], [o, Vec3::X, Vec3::X]];
    let (positions, triangles, result) = arranged(&faces, Pairs::All);
    check_areas(&positions, &triangles, &result);
    assert_eq!(result.degenerate, 3);
    let count = |source| result.sources.iter().filter(|s| **s == source).count();
    assert!(count(0) > 1 && count(0) == count(1) && count(1) == count(2));
    // The upright one meets the flat edge at (5/3… , 0, 0): the needle along it is cut there too.
    assert!(count(4) > 1, "{:?}", result.pieces);
    check_crossings(&result, |s, t| s < 4 && t < 4);
    let none = arrange(vec![], &[], Pairs::All, &Silent).unwrap();
    assert!(none.pieces.is_empty());
    let huge = [1e300, 1e-300].map(|s| flat.map(|p| s * p));
    let (positions, triangles) = welded(&[huge[0], huge[1], upright, upright.map(|p| 1e300 * p)]);
    arrange(positions, &triangles, Pairs::All, &Silent).unwrap();
}

/// Products of three lengths are 0 at that scale; a power of two changes no other digit.
#[test]
fn tiny_triangles_are_cut_as_large_ones_are() {
    let mut random = Random::of_round(9, 0);
    let faces: Vec<[Vec3; 3]> = (0..20).map(|_| [(); 3].map(|()| random.on_grid(4) + 1e7)).collect();
    let (_, _, expected) = arranged(&faces, Pairs::All);
    assert!(expected.unresolved == 0 && expected.pieces.len() > 100);
    let scale = 2f64.powi(-531);
    let tiny: Vec<[Vec3; 3]> = faces.iter().map(|face| face.map(|p| scale * p)).collect();
    let (_, _, found) = arranged(&tiny, Pairs::All);
    let positions = expected.positions.iter().map(|p| scale * *p).collect();
    assert_eq!(found, Arrangement { positions, ..expected });
}

#[test]
fn a_monitor_can_cancel() {
    let (positions, triangles) = welded(&faces_of(&sphere(4)));
    assert!(arrange(positions, &triangles, Pairs::All, &|_: f64, _: &str| false).is_err());
}
