//! Charts that face alike become one: fewer seams where growing has left more charts than it takes.
use super::faces::Faces;
use super::segments::Segments;
use crate::math::Vec3;
use rustc_hash::FxHashMap;

/// Joins neighbours, those with the longest common seam first, as long as all triangles of both face their common mean within an angle
/// with cosine `limit`.
pub fn merge(faces: &Faces, found: &mut Segments, limit: f64) {
    let mut of: Vec<Vec<u32>> = vec![Vec::new(); found.count as usize];
    (0..).zip(&found.charts).for_each(|(t, chart)| of[*chart as usize].push(t));
    let sum = |of: &Vec<u32>| of.iter().map(|t| faces.areas[*t as usize] * faces.normals[*t as usize]).sum();
    let mut normals: Vec<Vec3> = of.iter().map(sum).collect();
    loop {
        let mut is_changed = vec![false; of.len()];
        let mut any = false;
        for (one, other) in neighbours(faces, &found.charts) {
            let (i, j) = (one as usize, other as usize);
            if is_changed[i] || is_changed[j] {
                continue;
            }
            let axis = (normals[i] + normals[j]).normalize_or_zero();
            let faces_it = |t: &u32| faces.normals[*t as usize].dot(axis) >= limit;
            if of[i].iter().all(faces_it) && of[j].iter().all(faces_it) {
                let moved = std::mem::take(&mut of[j]);
                moved.iter().for_each(|t| found.charts[*t as usize] = one);
                of[i].extend(moved);
                let both = normals[i] + normals[j];
                normals[i] = both;
                (is_changed[i], is_changed[j], any) = (true, true, true);
            }
        }
        if !any {
            return;
        }
    }
}

/// Pairs of charts along a seam, the lower number first; the longest seam first, of equal ones the lower pair.
fn neighbours(faces: &Faces, charts: &[u32]) -> Vec<(u32, u32)> {
    let mut lengths: FxHashMap<(u32, u32), f64> = FxHashMap::default();
    for (side, other) in faces.joined.iter().enumerate().filter(|(_, other)| **other != Faces::NONE) {
        let (a, b) = (charts[side / 3], charts[*other as usize / 3]);
        if a < b {
            let t = faces.mesh.triangles[side / 3];
            let ends = [t[side % 3], t[(side + 1) % 3]].map(|v| faces.mesh.positions[v as usize]);
            *lengths.entry((a, b)).or_default() += ends[0].distance(ends[1]);
        }
    }
    let mut pairs: Vec<((u32, u32), f64)> = lengths.into_iter().collect();
    pairs.sort_unstable_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    pairs.into_iter().map(|(pair, _)| pair).collect()
}
