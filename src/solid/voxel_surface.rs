use super::Voxels;
use crate::data::SurfaceMesh;
use crate::math::Vec3;
use rustc_hash::FxHashMap;

/// The other two axes after each axis, in the order that makes a right-handed frame.
const ACROSS: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

/// The faces between an inside and an outside voxel, the lattice's border counting as outside.
pub(super) fn exposed_faces(voxels: &Voxels) -> SurfaceMesh {
    let lattice = voxels.lattice();
    let counts = lattice.counts;
    // By the number of a node; keys of one type for all maps of the crate make one instance of their code.
    let [nx, ny, _] = counts.map(|n| n as u64 + 1);
    let number = |node: [usize; 3]| {
        let [i, j, k] = node.map(|n| n as u64);
        i + nx * (j + ny * k)
    };
    let mut vertices: FxHashMap<u64, u32> = FxHashMap::default();
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    let corner = lattice.origin - 0.5 * lattice.spacing;
    let mut vertex = |node: [usize; 3]| {
        *vertices.entry(number(node)).or_insert_with(|| {
            positions.push(corner + lattice.spacing * Vec3::from_array(node.map(|n| n as f64)));
            positions.len() as u32 - 1
        })
    };
    for index in 0..lattice.len() {
        let sample = lattice.sample(index);
        if !voxels.get(sample) {
            continue;
        }
        for (axis, (u, v)) in ACROSS.into_iter().enumerate() {
            for up in [false, true] {
                let at_border = if up { sample[axis] + 1 == counts[axis] } else { sample[axis] == 0 };
                let mut other = sample;
                if !at_border {
                    other[axis] = if up { sample[axis] + 1 } else { sample[axis] - 1 };
                }
                if at_border || !voxels.get(other) {
                    let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| {
                        let mut node = sample;
                        node[axis] += usize::from(up);
                        node[u] += a;
                        node[v] += b;
                        vertex(node)
                    });
                    let [a, b, c, d] =
                        if up { corners } else { [corners[0], corners[3], corners[2], corners[1]] };
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    SurfaceMesh::with_face_normals(positions, triangles)
}
