//! Points on a mesh with the mesh's own areas and normals, so that nothing has to be estimated.
use super::{OrientedCloud, TriangleSoup, Warning, WarningKind};
use crate::math::{Vec3, area_vector, barycentre};

impl TriangleSoup {
    /// The barycentre of each triangle with the triangle's area and normal, in the order of the triangles; those without
    /// area are left out and counted.
    pub fn barycentre_cloud(&self) -> (OrientedCloud, Vec<Warning>) {
        let mut cloud = Parts::default();
        for corners in (0..self.len()).map(|t| self.corners(t)) {
            let vector = area_vector(corners);
            cloud.add(barycentre(corners), vector, vector.length());
        }
        let degenerate = self.len() - cloud.points.len();
        (cloud.finish(), Warning::counted([(WarningKind::DegenerateFaces, degenerate)]))
    }

    /// The vertices in their order, each with a third of the area of the triangles around it and the direction of their
    /// summed area vectors. The areas add up to the soup's. Vertices of no triangle, and those whose triangles cancel each
    /// other, are left out and counted, as are the triangles without area. Vertices in the same place stay apart.
    pub fn vertex_cloud(&self) -> (OrientedCloud, Vec<Warning>) {
        let mut sums = vec![(Vec3::ZERO, 0.0); self.positions().len()];
        let mut degenerate = 0;
        for (t, corners) in self.triangles().iter().enumerate() {
            let vector = area_vector(self.corners(t));
            let area = vector.length();
            degenerate += usize::from(!is_usable(vector, area));
            for &corner in corners {
                let (vectors, areas) = &mut sums[corner as usize];
                *vectors += vector;
                *areas += area / 3.0;
            }
        }
        let mut cloud = Parts::default();
        self.positions().iter().zip(&sums).for_each(|(p, (vector, area))| cloud.add(*p, *vector, *area));
        let unused = sums.iter().filter(|sum| sum.1 == 0.0).count();
        let cancelled = sums.len() - unused - cloud.points.len();
        let warnings = Warning::counted([
            (WarningKind::DegenerateFaces, degenerate),
            (WarningKind::UnusedVertices, unused),
            (WarningKind::BadNormals, cancelled),
        ]);
        (cloud.finish(), warnings)
    }
}

/// Overflow of huge coordinates makes an area infinite.
fn is_usable(vector: Vec3, area: f64) -> bool {
    vector.try_normalize().is_some() && area.is_finite()
}

#[derive(Default)]
struct Parts {
    points: Vec<Vec3>,
    normals: Vec<Vec3>,
    areas: Vec<f64>,
}

impl Parts {
    fn add(&mut self, point: Vec3, direction: Vec3, area: f64) {
        if is_usable(direction, area) && point.is_finite() {
            self.points.push(point);
            self.normals.push(direction);
            self.areas.push(area);
        }
    }

    fn finish(self) -> OrientedCloud {
        OrientedCloud::new(self.points, self.normals, self.areas).expect("all of it was found usable")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(warnings: &[Warning]) -> Vec<(WarningKind, usize)> {
        warnings.iter().map(|w| (w.kind, w.count)).collect()
    }

    #[test]
    fn a_quarter_of_an_octahedron_keeps_its_areas_and_normals() {
        let positions = vec![Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, Vec3::splat(9.0)];
        let soup = TriangleSoup::new(positions, vec![[0, 1, 2], [3, 2, 1], [0, 1, 1]]).unwrap();
        let area = 0.75f64.sqrt();
        let (cloud, warnings) = soup.barycentre_cloud();
        assert_eq!(counts(&warnings), [(WarningKind::DegenerateFaces, 1)]);
        assert!(cloud.points()[0].distance(Vec3::splat(1.0 / 3.0)) < 1e-15);
        assert!(cloud.normals()[1].distance(Vec3::new(-1.0, 1.0, 1.0).normalize()) < 1e-15);
        assert!(cloud.areas().iter().all(|a| (a - area).abs() < 1e-15));
        let (cloud, warnings) = soup.vertex_cloud();
        let expected = [(WarningKind::DegenerateFaces, 1), (WarningKind::UnusedVertices, 1)];
        assert_eq!(counts(&warnings), expected);
        assert!(cloud.normals()[1].distance(Vec3::new(0.0, 1.0, 1.0).normalize()) < 1e-15);
        let shares = cloud.areas().iter().zip([1.0, 2.0, 2.0, 1.0]);
        assert!(shares.into_iter().all(|(a, n)| (a - n * area / 3.0).abs() < 1e-15));
    }

    #[test]
    fn triangles_that_cancel_leave_vertices_without_normals() {
        let soup = TriangleSoup::new(vec![Vec3::X, Vec3::Y, Vec3::Z], vec![[0, 1, 2], [0, 2, 1]]).unwrap();
        let (cloud, warnings) = soup.vertex_cloud();
        assert!(cloud.is_empty());
        assert_eq!(counts(&warnings), [(WarningKind::BadNormals, 3)]);
        assert_eq!(soup.barycentre_cloud().0.len(), 2);
        assert!(TriangleSoup::default().vertex_cloud().0.is_empty());
    }
}
