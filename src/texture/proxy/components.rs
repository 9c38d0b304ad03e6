//! The connected components of an isosurface, and which of them lie inside others.
use crate::data::{Cancelled, Monitor, Sets, SurfaceMesh, TriangleSoup};
use crate::math::{Aabb, signed_volume};
use crate::winding::{FieldConfig, WindingField};

/// A surface taken apart.
pub struct Pieces {
    /// The outer components.
    pub mesh: SurfaceMesh,
    /// Of each of its triangles.
    pub component: Vec<u32>,
    pub components: usize,
    /// The components inside others, and those around cavities, which are inside out.
    pub inner: SurfaceMesh,
}

struct Component {
    triangles: Vec<u32>,
    bounds: Aabb,
    /// Negative for one that faces a cavity.
    volume: f64,
}

/// The components of a closed surface, those outside of all others and those that are not.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn keep_outer(mesh: SurfaceMesh, monitor: &dyn Monitor) -> Result<Pieces, Cancelled> {
    let all = components(&mesh);
    let mut is_outer: Vec<bool> = all.iter().map(|component| component.volume > 0.0).collect();
    for (k, outer) in all.iter().enumerate().filter(|(_, component)| component.volume > 0.0) {
        monitor.report(k as f64 / all.len() as f64, "proxy components")?;
        // Boxes tell nearly all apart; a field is only built around those that may hold another.
        let within = |inner: &Component| {
            outer.bounds.min.cmplt(inner.bounds.min).all() && inner.bounds.max.cmplt(outer.bounds.max).all()
        };
        let maybe: Vec<usize> = (0..all.len()).filter(|i| is_outer[*i] && within(&all[*i])).collect();
        if maybe.is_empty() {
            continue;
        }
        let (around, _) = part(&mesh, std::iter::once((0, outer)));
        let field = WindingField::new(TriangleSoup::from(around), FieldConfig::default());
        for i in maybe {
            let vertex = mesh.triangles[all[i].triangles[0] as usize][0];
            is_outer[i] &= !field.contains_point(mesh.positions[vertex as usize]);
        }
    }
    let outer = all.iter().zip(&is_outer).filter(|(_, is_outer)| **is_outer).map(|(component, _)| component);
    let inner = all.iter().zip(&is_outer).filter(|(_, is_outer)| !**is_outer).map(|(component, _)| component);
    let (kept, component) = part(&mesh, (0..).zip(outer));
    let components = component.last().map_or(0, |last| *last as usize + 1);
    Ok(Pieces { mesh: kept, component, components, inner: part(&mesh, (0..).zip(inner)).0 })
}

fn components(mesh: &SurfaceMesh) -> Vec<Component> {
    let mut sets = Sets::new(mesh.positions.len());
    mesh.triangles.iter().for_each(|corners| sets.join_all(*corners));
    let mut numbers = vec![u32::MAX; mesh.positions.len()];
    let mut found: Vec<Component> = Vec::new();
    for (t, corners) in (0..).zip(&mesh.triangles) {
        let root = sets.find(corners[0]) as usize;
        if numbers[root] == u32::MAX {
            numbers[root] = found.len() as u32;
            found.push(Component { triangles: Vec::new(), bounds: Aabb::EMPTY, volume: 0.0 });
        }
        let component = &mut found[numbers[root] as usize];
        let places = corners.map(|v| mesh.positions[v as usize]);
        component.volume += signed_volume(places, mesh.positions[root]);
        component.bounds = component.bounds.union(Aabb::around(places));
        component.triangles.push(t);
    }
    found
}

/// A mesh of some components alone, and the number given with each, of its triangles.
fn part<'a>(
    mesh: &SurfaceMesh,
    components: impl Iterator<Item = (u32, &'a Component)>,
) -> (SurfaceMesh, Vec<u32>) {
    let mut numbers = vec![u32::MAX; mesh.positions.len()];
    let mut kept = SurfaceMesh::default();
    let mut component = Vec::new();
    for (number, of) in components {
        for t in &of.triangles {
            let corners = mesh.triangles[*t as usize].map(|v| {
                let place = &mut numbers[v as usize];
                if *place == u32::MAX {
                    *place = kept.positions.len() as u32;
                    kept.positions.push(mesh.positions[v as usize]);
                    kept.normals.push(mesh.normals[v as usize]);
                }
                *place
            });
            kept.triangles.push(corners);
            component.push(number);
        }
    }
    (kept, component)
}

/// Number of outer components.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn count_outer(mesh: SurfaceMesh, monitor: &dyn Monitor) -> Result<usize, Cancelled> {
    Ok(keep_outer(mesh, monitor)?.components)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;
    use crate::math::Vec3;

    /// A box as a surface; inside out where `turned`.
    fn cube(center: Vec3, half: f64, turned: bool) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let corner = |c: u32| {
            let sign = |bit: u32| if c >> bit & 1 == 1 { half } else { -half };
            center + Vec3::new(sign(0), sign(1), sign(2))
        };
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let turn = |[a, b, c]: [u32; 3]| if turned { [a, c, b] } else { [a, b, c] };
        let triangles =
            quads.iter().flat_map(|q| [turn([q[0], q[1], q[2]]), turn([q[0], q[2], q[3]])]).collect();
        ((0..8).map(corner).collect(), triangles)
    }

    #[test]
    fn what_is_inside_or_inside_out_is_not_outer() {
        let cubes = [
            cube(Vec3::ZERO, 4.0, false),
            cube(Vec3::ZERO, 3.0, true),
            cube(Vec3::ONE, 0.5, false),
            cube(10.0 * Vec3::X, 1.0, false),
        ];
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for (corners, faces) in cubes {
            let first = positions.len() as u32;
            positions.extend(corners);
            triangles.extend(faces.iter().map(|f| f.map(|v| v + first)));
        }
        let pieces = keep_outer(SurfaceMesh::with_face_normals(positions, triangles), &Silent).unwrap();
        assert_eq!((pieces.components, pieces.mesh.triangles.len()), (2, 24));
        assert_eq!(pieces.component, [[0; 12], [1; 12]].concat());
        assert_eq!(pieces.inner.triangles.len(), 24);
        assert!((pieces.mesh.volume() - (512.0 + 8.0)).abs() < 1e-12);
    }
}
