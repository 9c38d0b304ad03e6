use super::Atlas;
use crate::data::SurfaceMesh;
use crate::texture::seams::{ends, sides_by_edge};

impl Atlas {
    /// Where the mesh of this atlas is cut: edges, the lower vertex first, in ascending order, whose two triangles have texture
    /// coordinates of their own there.
    pub fn seams(&self, mesh: &SurfaceMesh) -> Vec<[u32; 2]> {
        let sides = sides_by_edge(&mesh.triangles);
        let places = |side: u32| ends(side, &self.corners, &mesh.triangles);
        let is_cut =
            |same: &&[(u64, u32)]| same.windows(2).any(|pair| places(pair[0].1) != places(pair[1].1));
        let edge = |same: &[(u64, u32)]| [(same[0].0 >> 32) as u32, same[0].0 as u32];
        sides.chunk_by(|a, b| a.0 == b.0).filter(is_cut).map(edge).collect()
    }
}
