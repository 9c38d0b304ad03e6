//! Shapes moved by affine maps.
use super::{OrientedCloud, Shape, TriangleSoup};
use crate::math::{Affine, Mat3, Vec3};
use std::sync::Arc;

/// Why a map moves no shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TransformError {
    #[error("a transform needs finite numbers")]
    NonFinite,
    #[error("a transform must not flatten space: its determinant is 0")]
    Flat,
    #[error("the transform moves points beyond the largest number")]
    TooLarge,
}

impl Shape {
    /// The shape moved; where the map mirrors, triangles and normals still point outward.
    ///
    /// # Errors
    /// If and only if the map is not finite or flattens space, or what it gives is not finite.
    pub fn moved(&self, by: &Affine) -> Result<Shape, TransformError> {
        if !by.is_finite() {
            return Err(TransformError::NonFinite);
        }
        let determinant = by.matrix3.determinant();
        if determinant == 0.0 || !determinant.is_finite() {
            return Err(TransformError::Flat);
        }
        let place = |p: &Vec3| by.transform_point3(*p);
        match self {
            Shape::Soup(soup) => {
                let turned = |t: &[u32; 3]| if determinant < 0.0 { [t[0], t[2], t[1]] } else { *t };
                let positions = soup.positions().iter().map(place).collect();
                let moved = TriangleSoup::new(positions, soup.triangles().iter().map(turned).collect());
                Ok(Shape::Soup(Arc::new(moved.map_err(|_| TransformError::TooLarge)?)))
            }
            Shape::Cloud(cloud) => {
                // Area vectors go by the cofactors.
                let [x, y, z] = [by.matrix3.x_axis, by.matrix3.y_axis, by.matrix3.z_axis];
                let sign = determinant.signum();
                let cofactors = Mat3::from_cols(sign * y.cross(z), sign * z.cross(x), sign * x.cross(y));
                let vectors: Vec<Vec3> =
                    cloud.normals().iter().zip(cloud.areas()).map(|(n, a)| *a * (cofactors * *n)).collect();
                let areas = vectors.iter().map(|v| v.length()).collect();
                // The direction of a point without area is kept.
                let direction =
                    |(v, n): (&Vec3, &Vec3)| v.try_normalize().unwrap_or((cofactors * *n).normalize_or(*n));
                let normals = vectors.iter().zip(cloud.normals()).map(direction).collect();
                let moved = OrientedCloud::new(cloud.points().iter().map(place).collect(), normals, areas);
                Ok(Shape::Cloud(Arc::new(moved.map_err(|_| TransformError::TooLarge)?)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_vectors_of_both_kinds_move_alike() {
        let soup = TriangleSoup::new(vec![Vec3::X, Vec3::Y, Vec3::Z], vec![[0, 1, 2]]).unwrap();
        let (cloud, _) = soup.barycentre_cloud();
        let stretched = Mat3::from_diagonal(Vec3::new(2.0, -3.0, 0.5)) * Mat3::from_rotation_x(0.4);
        for matrix3 in [stretched, -stretched, Mat3::IDENTITY] {
            let by = Affine { matrix3, translation: Vec3::new(1.0, 2.0, 3.0) };
            let Shape::Soup(soup) = Shape::from(soup.clone()).moved(&by).unwrap() else { panic!() };
            let Shape::Cloud(cloud) = Shape::from(cloud.clone()).moved(&by).unwrap() else { panic!() };
            let (expected, _) = soup.barycentre_cloud();
            assert!(cloud.points()[0].distance(expected.points()[0]) < 1e-12);
            assert!(cloud.normals()[0].distance(expected.normals()[0]) < 1e-12);
            assert!((cloud.areas()[0] - expected.areas()[0]).abs() < 1e-12);
        }
        let flat = Affine { matrix3: Mat3::ZERO, translation: Vec3::ZERO };
        assert_eq!(Shape::from(soup.clone()).moved(&flat).unwrap_err(), TransformError::Flat);
        let far = Affine { matrix3: 1e200 * Mat3::IDENTITY, translation: Vec3::NAN };
        assert_eq!(Shape::from(soup).moved(&far).unwrap_err(), TransformError::NonFinite);
    }
}
