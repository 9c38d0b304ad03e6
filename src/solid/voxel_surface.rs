use crate::data::{OutOfMemory, SurfaceMesh, VoxelBricks, VoxelRows, Voxels, zeroed};
use crate::math::Vec3;

/// The other two axes after each axis, in the order that makes a right-handed frame.
const ACROSS: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];
/// Nodes of a plane that are no vertices.
const NONE: u32 = u32::MAX;

impl Voxels {
    /// The faces between inside and outside as a mesh: each vertex once, two triangles for each face, none inside.
    ///
    /// # Errors
    /// If and only if some planes of the lattice do not fit in memory.
    pub fn surface(&self) -> Result<SurfaceMesh, OutOfMemory> {
        exposed_faces(self)
    }
}

impl VoxelBricks {
    /// As [`Voxels::surface`].
    ///
    /// # Errors
    /// If and only if some planes of the lattice do not fit in memory.
    pub fn surface(&self) -> Result<SurfaceMesh, OutOfMemory> {
        exposed_faces(self)
    }
}

/// The faces between an inside and an outside voxel, the lattice's border counting as outside. Planes are taken one after the other:
/// what is held at a time are the voxels of three of them, and the numbers of the vertices on either side of the middle one.
fn exposed_faces(voxels: &dyn VoxelRows) -> Result<SurfaceMesh, OutOfMemory> {
    let lattice = voxels.lattice();
    let [nx, ny, nz] = lattice.counts;
    let nodes = (nx + 1).saturating_mul(ny + 1);
    // Below, at and above the plane; outside beyond the lattice.
    let mut planes: [Vec<u8>; 3] = [zeroed(nx * ny)?, zeroed(nx * ny)?, zeroed(nx * ny)?];
    let mut vertices: [Vec<u32>; 2] = [zeroed(nodes)?, zeroed(nodes)?];
    vertices.iter_mut().for_each(|side| side.fill(NONE));
    let read = |k: usize, plane: &mut [u8]| match k < nz {
        true => plane.chunks_mut(nx.max(1)).enumerate().for_each(|(j, row)| voxels.row([0, j, k], row)),
        false => plane.fill(0),
    };
    read(0, &mut planes[2]);
    let corner = lattice.origin - 0.5 * lattice.spacing;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for k in 0..nz {
        planes.rotate_left(1);
        read(k + 1, &mut planes[2]);
        vertices.swap(0, 1);
        vertices[1].fill(NONE);
        let inside = |[x, y, z]: [usize; 3]| x < nx && y < ny && planes[z][y * nx + x] == 1;
        for (j, row) in planes[1].chunks(nx.max(1)).enumerate() {
            for i in (0..nx).filter(|i| row[*i] == 1) {
                // In this frame the plane is the second of three.
                let sample = [i, j, 1];
                for (axis, (u, v)) in ACROSS.into_iter().enumerate() {
                    for up in [false, true] {
                        let mut other = sample;
                        other[axis] = if up { sample[axis] + 1 } else { sample[axis].wrapping_sub(1) };
                        if inside(other) {
                            continue;
                        }
                        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| {
                            let mut node = [i, j, 0];
                            node[axis] += usize::from(up);
                            node[u] += a;
                            node[v] += b;
                            let vertex = &mut vertices[node[2]][node[1] * (nx + 1) + node[0]];
                            if *vertex == NONE {
                                *vertex = positions.len() as u32;
                                let at = [node[0], node[1], k + node[2]].map(|n| n as f64);
                                positions.push(corner + lattice.spacing * Vec3::from_array(at));
                            }
                            *vertex
                        });
                        let [a, b, c, d] =
                            if up { corners } else { [corners[0], corners[3], corners[2], corners[1]] };
                        triangles.extend([[a, b, c], [a, c, d]]);
                    }
                }
            }
        }
    }
    Ok(SurfaceMesh::with_face_normals(positions, triangles))
}
