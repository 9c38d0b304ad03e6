use crate::data::{Cancelled, Monitor, SurfaceMesh};
use crate::math::Vec3;

/// How far a vertex goes toward the mean of its neighbours.
const STEP: f64 = 0.5;

/// A closed mesh after rounds of Laplacian smoothing (Field 1988), which takes off noise and evens out triangles; it shrinks what is
/// curved, by less than a cell in a few rounds.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn smoothed(
    mut mesh: SurfaceMesh,
    rounds: usize,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, Cancelled> {
    if rounds == 0 {
        return Ok(mesh);
    }
    for round in 0..rounds {
        monitor.report(round as f64 / rounds as f64, "smoothing")?;
        let mut sums = vec![(Vec3::ZERO, 0u32); mesh.positions.len()];
        for t in &mesh.triangles {
            for k in 0..3 {
                // Closed: each neighbour is next in just one of the triangles around.
                let sum = &mut sums[t[k] as usize];
                *sum = (sum.0 + mesh.positions[t[(k + 1) % 3] as usize], sum.1 + 1);
            }
        }
        for (position, (sum, count)) in mesh.positions.iter_mut().zip(sums) {
            *position = position.lerp(sum / f64::from(count), STEP);
        }
    }
    Ok(SurfaceMesh::with_face_normals(mesh.positions, mesh.triangles))
}
