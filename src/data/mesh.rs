use super::TriangleSoup;
use crate::math::{Vec3, area_vector, signed_volume};

/// An indexed triangle mesh made by this crate, with a unit normal for each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceMesh {
    pub positions: Vec<Vec3>,
    /// Unit, outward; zero where a vertex has no face of positive area.
    pub normals: Vec<Vec3>,
    /// Counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl SurfaceMesh {
    /// A mesh with normals averaged from the faces around each vertex, weighted by area.
    pub fn with_face_normals(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> SurfaceMesh {
        let mut normals = vec![Vec3::ZERO; positions.len()];
        for corners in &triangles {
            let n = area_vector(corners.map(|i| positions[i as usize]));
            corners.iter().for_each(|&i| normals[i as usize] += n);
        }
        normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
        SurfaceMesh { positions, normals, triangles }
    }

    /// The enclosed volume, by the divergence theorem: meaningful for a closed mesh.
    pub fn volume(&self) -> f64 {
        let anchor = self.positions.first().copied().unwrap_or_default();
        let corners = |t: &[u32; 3]| t.map(|i| self.positions[i as usize]);
        self.triangles.iter().map(|t| signed_volume(corners(t), anchor)).sum()
    }
}

impl From<SurfaceMesh> for TriangleSoup {
    fn from(mesh: SurfaceMesh) -> TriangleSoup {
        TriangleSoup::derived(mesh.positions, mesh.triangles)
            .expect("meshes of this crate are finite and indexed")
    }
}
