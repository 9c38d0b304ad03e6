//! Edges of the mesh flipped where its triangles would turn over.
use super::creases::Creases;
use super::split::cut;
use crate::math::{Vec3, area_vector};
use rustc_hash::FxHashMap;

fn sides(t: &[u32; 3]) -> [(u32, u32); 3] {
    [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]
}

impl Creases<'_> {
    /// The triangles of the mesh, with edges flipped of those that turn over where that helps: triangles across a sharp edge may
    /// overlap once their parts lie in its two planes.
    pub fn flipped(&self, turned: &[usize]) -> Option<Vec<[u32; 3]>> {
        if turned.is_empty() {
            return None;
        }
        let mut triangles = self.mesh.triangles.clone();
        // All triangles around vertices that have planes.
        let mut of_edges = FxHashMap::default();
        for (t, corners) in triangles.iter().enumerate() {
            if corners.iter().any(|v| self.plane(*v).is_some()) {
                of_edges.extend(sides(corners).map(|side| (side, t)));
            }
        }
        let mut is_changed = false;
        for &t in turned {
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|i| triangles[t][(k + i) % 3]);
                let Some(&other) = of_edges.get(&(b, a)) else { continue };
                let d = triangles[other].iter().copied().find(|v| *v != a && *v != b).unwrap_or(c);
                let is_known = self.plane(c).is_some() || self.plane(d).is_some();
                let is_new = is_known && !of_edges.contains_key(&(c, d)) && !of_edges.contains_key(&(d, c));
                let pair = [[a, d, c], [d, b, c]];
                // Also as they are, should the data not confirm the edge.
                let normal = self.area_vector([a, b, c]) + self.area_vector([b, a, d]);
                let is_whole =
                    |t: [u32; 3]| self.area_vector(t).dot(normal) > 0.0 && self.would_face_outward(t);
                let helps = || !self.would_face_outward([a, b, c]) && pair.iter().all(|t| is_whole(*t));
                if c != d && is_new && helps() {
                    of_edges.remove(&(a, b));
                    of_edges.remove(&(b, a));
                    for (place, corners) in [(t, pair[0]), (other, pair[1])] {
                        triangles[place] = corners;
                        of_edges.extend(sides(&corners).map(|side| (side, place)));
                    }
                    is_changed = true;
                }
            }
        }
        is_changed.then_some(triangles)
    }

    /// Of a triangle of vertices as they were.
    fn area_vector(&self, corners: [u32; 3]) -> Vec3 {
        area_vector(corners.map(|v| self.mesh.positions[v as usize]))
    }

    /// Whether a triangle of moved vertices, cut where planes meet, faces outward in all its parts.
    fn would_face_outward(&self, corners: [u32; 3]) -> bool {
        let mut places = corners.map(|v| self.moved[v as usize]).to_vec();
        let sides = [0, 1, 2].map(|k| {
            let ends = [corners[k], corners[(k + 1) % 3]];
            let place = self.differ(ends).then(|| self.crossing(ends)).flatten();
            place.map(|place| {
                places.push(place);
                places.len() as u32 - 1
            })
        });
        let at = |v: u32| places[v as usize];
        let parts = cut([0, 1, 2], sides, None, at);
        !self.turns(corners, &parts, at)
    }
}
