//! Sharp edges and corners of a traced surface, where its data has them.
//!
//! The vertices of a traced surface lie on the edges of cells: they cut what is sharp. Here each vertex near such a place gets the
//! plane that the data has there. An edge of the mesh between two planes is cut where they meet, a triangle between three in their
//! corner (features as in Kobbelt et al. 2001, *Feature Sensitive Surface Extraction from Volume Data*; the planes are the data's and
//! not the field's, and edges of the mesh are cut rather than cells filled anew: no cut makes a closed mesh open or non-manifold).
//! What the data does not confirm there, or what would turn a triangle over, is left as it was.
mod cloud;
mod creases;
mod flips;
mod plane;
mod soup;
mod split;

pub use cloud::OfCloud;
pub use plane::{Plane, meeting_of};
pub use soup::{OfSoup, tree_of};

use crate::bvh::Nearest;
use crate::data::{Cancelled, Monitor, SurfaceMesh, fill_in_blocks};
use crate::math::Vec3;
use crate::winding::Scratch;
use creases::Creases;

/// Scratch space of a search.
#[derive(Default)]
pub struct Search {
    nearest: Nearest,
    scratch: Scratch,
    pub(super) distances: crate::distance::Search,
}

/// What the data says of the surface.
pub trait Evidence: Sync {
    /// A normal that the data has next to a vertex of the surface: the cheap question, asked of all.
    fn normal(&self, place: Vec3, search: &mut Search) -> Option<Vec3>;

    /// The plane in which a vertex belongs, if the data is clear there; `outward` is the normal of the mesh.
    fn plane(&self, place: Vec3, outward: Vec3, search: &mut Search) -> Option<Plane>;

    /// Where two or three planes meet near a place, as the data there says; nothing if it does not show them.
    fn meeting(&self, place: Vec3, planes: &[Plane], search: &mut Search) -> Option<Vec3>;
}

/// Cosines of angles between normals.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Less than this is a sharp edge.
    pub sharp: f64,
    /// Normals of one smooth part of the surface differ by less than this from one point to the next.
    pub same: f64,
}

impl Limits {
    pub fn new(degrees: f64) -> Limits {
        let cosine = |degrees: f64| libm::cos(degrees.to_radians());
        Limits { sharp: cosine(degrees), same: cosine(0.5 * degrees) }
    }
}

/// Times that edges are flipped: nearly all that helps is in the first.
const FLIPPED: usize = 3;

/// Gives a surface traced in cells of size `spacing` the sharp edges and corners of its data. It stays manifold, closed if it was,
/// and oriented.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn sharpen(
    mesh: &mut SurfaceMesh,
    evidence: &dyn Evidence,
    spacing: f64,
    limits: Limits,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let planes = planes_near_edges(mesh, evidence, limits, monitor)?;
    for _ in 0..FLIPPED {
        let mut creases = Creases::between(mesh, &planes, spacing, limits);
        creases.place(evidence, monitor)?;
        match creases.flipped(&creases.turned()) {
            Some(triangles) => mesh.triangles = triangles,
            None => break,
        }
    }
    let mut creases = Creases::between(mesh, &planes, spacing, limits);
    creases.place(evidence, monitor)?;
    while creases.leave_out(&creases.turned()) {}
    let (positions, triangles) = creases.cut();
    *mesh = SurfaceMesh::with_face_normals(positions, triangles);
    Ok(())
}

/// Planes for the vertices next to edges of the mesh across which the data's normals differ, and for those around them.
fn planes_near_edges(
    mesh: &SurfaceMesh,
    evidence: &dyn Evidence,
    limits: Limits,
    monitor: &dyn Monitor,
) -> Result<Vec<Option<Plane>>, Cancelled> {
    let count = mesh.positions.len();
    let mut normals = vec![None; count];
    let normal = |v: usize, search: &mut Search| evidence.normal(mesh.positions[v], search);
    fill_in_blocks(&mut normals, normal, "sharp edges", monitor)?;
    let differ = |a: u32, b: u32| match (normals[a as usize], normals[b as usize]) {
        (Some(a), Some(b)) => a.dot(b) < limits.sharp,
        _ => false,
    };
    let is_mixed = |t: &[u32; 3]| (0..3).any(|k| differ(t[k], t[(k + 1) % 3]));
    let mut is_near = vec![false; count];
    mesh.triangles.iter().filter(|t| is_mixed(t)).flatten().for_each(|v| is_near[*v as usize] = true);
    let is_near = ring(mesh, &is_near);
    let near: Vec<usize> = (0..count).filter(|v| is_near[*v]).collect();
    let mut found = vec![None; near.len()];
    let plane = |k: usize, search: &mut Search| {
        evidence.plane(mesh.positions[near[k]], mesh.normals[near[k]], search)
    };
    fill_in_blocks(&mut found, plane, "sharp edges", monitor)?;
    let mut planes = vec![None; count];
    near.iter().zip(found).for_each(|(v, plane)| planes[*v] = plane);
    Ok(planes)
}

/// The vertices that are marked, and those next to them.
fn ring(mesh: &SurfaceMesh, marked: &[bool]) -> Vec<bool> {
    let mut all = marked.to_vec();
    let touches = |t: &&[u32; 3]| t.iter().any(|v| marked[*v as usize]);
    mesh.triangles.iter().filter(touches).flatten().for_each(|v| all[*v as usize] = true);
    all
}
