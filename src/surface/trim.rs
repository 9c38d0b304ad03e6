//! Which places are near enough to a cloud's points to believe in the surface there.
use super::components::{keep_triangles, split_fans};
use crate::bvh::{Nearest, PointTree};
use crate::data::{Cancelled, Monitor, OrientedCloud, SurfaceMesh, fill_in_blocks};
use crate::math::Vec3;

/// Points whose areas together tell how far apart points are: one cell alone varies by half its size.
const AROUND: usize = 9;

/// Balls around the points of a cloud.
pub struct Reach {
    points: PointTree,
    /// By the points' own numbers.
    radii: Vec<f64>,
}

impl Reach {
    /// Balls of `trim` times the edge of the square that a point and those around have to themselves.
    pub fn new(cloud: &OrientedCloud, trim: f64, monitor: &dyn Monitor) -> Result<Reach, Cancelled> {
        let points = PointTree::new(cloud.points());
        let radius = |place: usize, nearest: &mut Nearest| {
            let near = nearest.find(&points, place, AROUND);
            let area: f64 = near.iter().map(|(_, point)| cloud.areas()[*point as usize]).sum();
            trim * (area / near.len() as f64).sqrt()
        };
        let mut in_order = vec![0.0; cloud.len()];
        fill_in_blocks(&mut in_order, radius, "distances", monitor)?;
        let mut radii = vec![0.0; cloud.len()];
        points.items().iter().zip(in_order).for_each(|(point, radius)| radii[*point as usize] = radius);
        Ok(Reach { points, radii })
    }

    /// Whether a place is in the ball of the point nearest to it, or no farther from it than `slack`.
    pub fn holds(&self, place: Vec3, slack: f64, nearest: &mut Nearest) -> bool {
        let found = nearest.nearest_to(&self.points, place);
        found.is_some_and(|(squared, point)| squared.sqrt() <= self.radii[point as usize] + slack)
    }

    /// The triangles of a mesh whose corners are all held; manifold if the mesh is.
    pub fn trim(&self, mesh: &mut SurfaceMesh, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let mut held = vec![false; mesh.positions.len()];
        let positions = &mesh.positions;
        let is_held = |v: usize, nearest: &mut Nearest| self.holds(positions[v], 0.0, nearest);
        fill_in_blocks(&mut held, is_held, "trimming", monitor)?;
        keep_triangles(mesh, |t| t.iter().all(|v| held[*v as usize]));
        split_fans(mesh);
        Ok(())
    }
}
