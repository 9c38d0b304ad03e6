//! Pieces of a mesh: which triangles hang together, and meshes of some of them.
use crate::data::{Sets, SurfaceMesh, next_side, sides_by_edge};
use crate::math::{Vec3, area_vector};

/// Leaves out the pieces, triangles that share vertices, with less area than `least(the largest one's)`.
pub fn keep_large(mesh: &mut SurfaceMesh, least: impl Fn(f64) -> f64) {
    let mut sets = Sets::new(mesh.positions.len());
    mesh.triangles.iter().for_each(|corners| sets.join_all(*corners));
    let mut areas = vec![0.0; mesh.positions.len()];
    for t in &mesh.triangles {
        let area = area_vector(t.map(|v| mesh.positions[v as usize])).length();
        areas[sets.find(t[0]) as usize] += area;
    }
    let least = least(areas.iter().copied().fold(0.0, f64::max));
    keep_triangles(mesh, |t| areas[sets.find(t[0]) as usize] >= least);
}

/// Leaves out triangles, and vertices that have none then; the others keep their order.
pub fn keep_triangles(mesh: &mut SurfaceMesh, mut wanted: impl FnMut(&[u32; 3]) -> bool) {
    mesh.triangles.retain(|t| wanted(t));
    let mut numbers = vec![u32::MAX; mesh.positions.len()];
    mesh.triangles.iter().flatten().for_each(|v| numbers[*v as usize] = 0);
    let mut kept = 0;
    for (vertex, number) in numbers.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
        *number = kept as u32;
        mesh.positions[kept] = mesh.positions[vertex];
        mesh.normals[kept] = mesh.normals[vertex];
        kept += 1;
    }
    mesh.positions.truncate(kept);
    mesh.normals.truncate(kept);
    mesh.triangles.iter_mut().flatten().for_each(|v| *v = numbers[*v as usize]);
}

/// Gives each fan of triangles around a vertex, joined by edges, a vertex of its own: a mesh whose edges have two triangles at
/// most is then manifold.
pub fn split_fans(mesh: &mut SurfaceMesh) {
    let corner = |k: u32| mesh.triangles[k as usize / 3][k as usize % 3];
    let corners = 3 * mesh.triangles.len() as u32;
    let mut sets = Sets::new(corners as usize);
    let sides = sides_by_edge(&mesh.triangles, |_, _| true);
    for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let [(_, one), (_, other)] = [pair[0], pair[1]];
        // The two run along their edge in opposite directions.
        sets.join(one, next_side(other));
        sets.join(next_side(one), other);
    }
    let mut of_fans = vec![u32::MAX; corners as usize];
    let (mut positions, mut normals): (Vec<Vec3>, Vec<Vec3>) = Default::default();
    let triangles = (0..corners).map(|k| {
        let fan = sets.find(k) as usize;
        if of_fans[fan] == u32::MAX {
            of_fans[fan] = positions.len() as u32;
            positions.push(mesh.positions[corner(k) as usize]);
            normals.push(mesh.normals[corner(k) as usize]);
        }
        of_fans[fan]
    });
    let triangles: Vec<u32> = triangles.collect();
    mesh.triangles = triangles.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    (mesh.positions, mesh.normals) = (positions, normals);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[[f64; 2]], triangles: &[[u32; 3]]) -> SurfaceMesh {
        let positions = positions.iter().map(|[x, y]| Vec3::new(*x, *y, 0.0)).collect();
        SurfaceMesh::with_face_normals(positions, triangles.to_vec())
    }

    #[test]
    fn small_pieces_go_and_the_rest_is_numbered_anew() {
        let positions = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [5.0, 5.0], [9.0, 5.0], [5.0, 9.0], [9.0, 9.0]];
        let all = mesh(&positions, &[[0, 1, 2], [3, 4, 5], [4, 6, 5]]);
        let mut few = all.clone();
        keep_large(&mut few, |largest| 1e-3 * largest);
        assert_eq!(few.triangles, [[0, 1, 2], [1, 3, 2]]);
        assert_eq!((few.positions[3], few.normals.len()), (Vec3::new(9.0, 9.0, 0.0), 4));
        let mut same = all.clone();
        keep_large(&mut same, |largest| 1e-4 * largest);
        assert_eq!(same, all);
    }

    #[test]
    fn two_fans_at_a_vertex_get_one_each() {
        // Two squares that touch in vertex 0.
        let positions =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0]];
        let mut mesh = mesh(&positions, &[[0, 1, 2], [0, 2, 3], [0, 4, 5], [0, 5, 6]]);
        split_fans(&mut mesh);
        assert_eq!(mesh.positions.len(), 8);
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]);
    }
}
