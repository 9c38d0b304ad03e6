use super::Atlas;
use crate::data::{SurfaceMesh, by_edge, edge_of_key, sides_by_edge};
use crate::texture::seams::ends;

impl Atlas {
    /// Where the mesh of this atlas is cut: edges, the lower vertex first, in ascending order, whose two triangles have texture
    /// coordinates of their own there.
    pub fn seams(&self, mesh: &SurfaceMesh) -> Vec<[u32; 2]> {
        let sides = sides_by_edge(&mesh.triangles, |_, _| true);
        let places = |side: u32| ends(side, &self.corners, &mesh.triangles);
        let is_cut =
            |same: &&[(u64, u32)]| same.windows(2).any(|pair| places(pair[0].1) != places(pair[1].1));
        by_edge(&sides).filter(is_cut).map(|same| edge_of_key(same[0].0)).collect()
    }
}
