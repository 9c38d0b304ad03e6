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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::SurfaceMesh;

    /// A roof of 2 × 4 squares of two triangles each, whose sides fall by 40° from the ridge x = 0.
    fn roof() -> SurfaceMesh {
        let slope = 40f64.to_radians();
        let place = |k: u32| {
            let (x, y) = (f64::from(k % 3) - 1.0, f64::from(k / 3));
            (Vec3::new(libm::cos(slope) * x, y, -libm::sin(slope) * x.abs()), x)
        };
        let quad = |k: u32| {
            let v = k / 2 * 3 + k % 2;
            [[v, v + 1, v + 4], [v, v + 4, v + 3]]
        };
        let normal = |x: f64| Vec3::new(libm::sin(slope) * x, 0.0, libm::cos(slope)).normalize();
        SurfaceMesh {
            positions: (0..15).map(|k| place(k).0).collect(),
            normals: (0..15).map(|k| normal(place(k).1)).collect(),
            triangles: (0..8).flat_map(quad).collect(),
        }
    }

    #[test]
    fn charts_of_a_roof_are_joined_as_far_as_they_face_alike() {
        let mesh = roof();
        let faces = Faces::new(&mesh, &[]);
        // Each triangle has its own chart at first.
        let joined = |degrees: f64| {
            let mut found = Segments { charts: (0..16).collect(), count: 16 };
            merge(&faces, &mut found, libm::cos(f64::to_radians(degrees)));
            found.charts
        };
        let count = |charts: &[u32]| charts.iter().collect::<std::collections::HashSet<_>>().len();
        // Normals are those of corners averaged, next to the ridge those of both sides: 13° and 27° from the vertical.
        assert_eq!(count(&joined(28.0)), 1);
        let two = joined(10.0);
        assert_eq!(count(&two), 2);
        // Squares come in pairs, one for each side.
        assert!(
            (0..16).all(|t| two[t] == two[t % 4]) && two[0] == two[1] && two[2] == two[3] && two[0] != two[2]
        );
        // Neighbours differ by 14° or more.
        assert_eq!(count(&joined(6.0)), 16);
    }
}
