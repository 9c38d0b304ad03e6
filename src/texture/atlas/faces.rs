//! A closed mesh as its triangles see it: neighbours across sides, normals, areas.
use crate::data::{LeftOut, SurfaceMesh, Topology, edge_between, ends, map_items};
use crate::math::{Vec3, area_vector, barycentre};

/// What segmentation looks at. Side 3t + k of triangle t runs from its corner k to the next.
pub struct Faces<'a> {
    pub mesh: &'a SurfaceMesh,
    /// Of each side, the one that it is joined to; [`Faces::NONE`] where charts may not reach across.
    pub joined: Vec<u32>,
    pub centers: Vec<Vec3>,
    pub areas: Vec<f64>,
    /// Unit, averaged over the corners: noise of the size of a triangle does not show.
    pub normals: Vec<Vec3>,
}

impl<'a> Faces<'a> {
    pub const NONE: u32 = Topology::NONE;

    /// `seams` are edges, the lower vertex first, sorted: no chart reaches across them.
    pub fn new(mesh: &'a SurfaceMesh, seams: &[[u32; 2]]) -> Faces<'a> {
        let welded: Vec<u32> = (0..mesh.positions.len() as u32).collect();
        let mut joined = Topology::new(&mesh.triangles, &welded, LeftOut::Repeated).joined;
        for (side, other) in joined.iter_mut().enumerate() {
            let [a, b] = ends(&mesh.triangles, side as u32);
            if seams.binary_search(&edge_between(a, b)).is_ok() {
                *other = Faces::NONE;
            }
        }
        let corners = |t: usize| mesh.triangles[t].map(|v| mesh.positions[v as usize]);
        let normal = |t: usize| {
            let sum: Vec3 = mesh.triangles[t].iter().map(|v| mesh.normals[*v as usize]).sum();
            sum.normalize_or_zero()
        };
        let count = mesh.triangles.len();
        Faces {
            mesh,
            joined,
            centers: map_items(count, |t| barycentre(corners(t))),
            areas: map_items(count, |t| area_vector(corners(t)).length()),
            normals: map_items(count, normal),
        }
    }

    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// The triangles next to `t`, by the sides that lead to them.
    pub fn neighbours(&self, t: u32) -> impl Iterator<Item = u32> + '_ {
        let sides = 3 * t..3 * t + 3;
        sides.map(|side| self.joined[side as usize]).filter(|o| *o != Faces::NONE).map(|o| o / 3)
    }
}
