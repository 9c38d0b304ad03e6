use super::neighbours::Neighbourhoods;
use crate::data::{Cancelled, Monitor, fill_in_blocks};
use crate::math::{Vec3, fit_plane};

/// Unit normals, up to sign, of the planes fitted to each point and its neighbours.
pub(super) fn plane_normals(
    points: &[Vec3],
    neighbourhoods: &Neighbourhoods,
    monitor: &dyn Monitor,
) -> Result<Vec<Vec3>, Cancelled> {
    let mut normals = vec![Vec3::ZERO; points.len()];
    let normal = |i: usize, _: &mut Vec<u32>| {
        let mut patch = vec![points[i]];
        patch.extend(neighbourhoods.of(i).iter().map(|&j| points[j as usize]));
        fit_plane(&patch).normal
    };
    fill_in_blocks(&mut normals, normal, "normals", monitor)?;
    Ok(normals)
}
