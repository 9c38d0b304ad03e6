use super::Atlas;
use crate::data::{SurfaceMesh, sort_keyed};

impl Atlas {
    /// Where the mesh of this atlas is cut: edges, the lower vertex first, in ascending order, whose two triangles have texture
    /// coordinates of their own there.
    pub fn seams(&self, mesh: &SurfaceMesh) -> Vec<[u32; 2]> {
        let mut sides: Vec<(u64, u32)> = Vec::with_capacity(3 * mesh.triangles.len());
        for (t, corners) in mesh.triangles.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (u64::from(corners[k]), u64::from(corners[(k + 1) % 3]));
                sides.push((a.min(b) << 32 | a.max(b), (3 * t + k) as u32));
            }
        }
        sort_keyed(&mut sides);
        let places = |side: u32| {
            let (t, k) = (side as usize / 3, side as usize % 3);
            let ends = [self.corners[t][k], self.corners[t][(k + 1) % 3]];
            if mesh.triangles[t][k] < mesh.triangles[t][(k + 1) % 3] { ends } else { [ends[1], ends[0]] }
        };
        let is_cut =
            |same: &&[(u64, u32)]| same.windows(2).any(|pair| places(pair[0].1) != places(pair[1].1));
        let edge = |same: &[(u64, u32)]| [(same[0].0 >> 32) as u32, same[0].0 as u32];
        sides.chunk_by(|a, b| a.0 == b.0).filter(is_cut).map(edge).collect()
    }
}
