//! The winding number by its definition, summed directly in f64: slow, and the oracle for everything else.
use crate::data::{OrientedCloud, Shape, TriangleSoup};
use crate::math::{Vec3, solid_angle};
use std::f64::consts::PI;

/// The generalized winding number of a soup at `q`: Barill et al. 2018, eq. 1; Jacobson et al. 2013.
///
/// Triangles that hold `q` in their plane contribute 0, which gives the principal value on the surface: 1/2 on a face
/// of a closed solid, 1/4 on an edge and 1/8 on a vertex of a cube. NaN where `q` is not finite.
pub fn winding_of_soup(soup: &TriangleSoup, q: Vec3) -> f64 {
    (0..soup.len()).map(|t| solid_angle(q, soup.corners(t))).sum::<f64>() / (4.0 * PI)
}

/// The winding number of an oriented cloud at `q`: area-weighted dipoles, Barill et al. 2018, eq. 5.
///
/// A point at `q` itself contributes 0. NaN where `q` is not finite.
pub fn winding_of_cloud(cloud: &OrientedCloud, q: Vec3) -> f64 {
    let dipole = |((p, n), a): ((&Vec3, &Vec3), &f64)| {
        let d = *p - q;
        let square = d.length_squared();
        if square == 0.0 { 0.0 } else { a * d.dot(*n) / (square * square.sqrt()) }
    };
    cloud.points().iter().zip(cloud.normals()).zip(cloud.areas()).map(dipole).sum::<f64>() / (4.0 * PI)
}

/// The winding number of a shape at `q`, summed directly.
pub fn winding(shape: &Shape, q: Vec3) -> f64 {
    match shape {
        Shape::Soup(soup) => winding_of_soup(soup, q),
        Shape::Cloud(cloud) => winding_of_cloud(cloud, q),
    }
}
