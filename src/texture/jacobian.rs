//! How triangles are mapped to the plane: Jacobians and their singular values.
use crate::math::{Vec2, Vec3};

/// A 2 × 2 matrix by columns.
pub type Jacobian = [Vec2; 2];

/// A triangle at rest in its own plane: gradients of its three hat functions, and its area.
#[derive(Clone, Copy, Debug)]
pub struct Rest {
    pub gradients: [Vec2; 3],
    pub area: f64,
}

impl Rest {
    /// None for a triangle without area.
    pub fn new([a, b, c]: [Vec3; 3]) -> Option<Rest> {
        let (u, v) = (b - a, c - a);
        let length = u.length();
        let x = u / length;
        let along = v.dot(x);
        let height = (v - along * x).length();
        let area = 0.5 * length * height;
        if !(area > 0.0 && area.is_finite()) {
            return None;
        }
        let of_b = Vec2::new(height, -along) / (2.0 * area);
        let of_c = Vec2::new(0.0, length) / (2.0 * area);
        Some(Rest { gradients: [-of_b - of_c, of_b, of_c], area })
    }

    /// How the triangle is mapped to its corners' places.
    pub fn jacobian(&self, corners: [Vec2; 3]) -> Jacobian {
        let sum = |axis: usize| (0..3).map(|k| self.gradients[k][axis] * corners[k]).sum();
        [sum(0), sum(1)]
    }
}

/// Singular values, the larger first, the smaller negative where the triangle is flipped; the rotation nearest to the matrix, as
/// cosine and sine, and the direction of the larger value in the image, as unit vector.
pub fn polar([x, y]: Jacobian) -> ([f64; 2], Vec2, Vec2) {
    // Of a + b with a turned and stretched, b mirrored (Blinn 1996).
    let (e, f) = (0.5 * (x.x + y.y), 0.5 * (x.x - y.y));
    let (g, h) = (0.5 * (x.y + y.x), 0.5 * (x.y - y.x));
    let (turned, mirrored) = (libm::hypot(e, h), libm::hypot(f, g));
    let rotation = if turned > 0.0 { Vec2::new(e, h) / turned } else { Vec2::X };
    let angle = 0.5 * (libm::atan2(g, f) + libm::atan2(h, e));
    ([turned + mirrored, turned - mirrored], rotation, Vec2::new(libm::cos(angle), libm::sin(angle)))
}

/// A triangle laid into the plane as it is, counter-clockwise, its first corner at 0 and the second on the first axis.
pub fn laid_flat([a, b, c]: [Vec3; 3]) -> [Vec2; 3] {
    let x = (b - a).normalize_or_zero();
    let along = (c - a).dot(x);
    [Vec2::ZERO, Vec2::new(a.distance(b), 0.0), Vec2::new(along, (c - a - along * x).length())]
}

pub fn determinant([x, y]: Jacobian) -> f64 {
    x.perp_dot(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_are_taken_apart() {
        for k in 0..200 {
            let t = f64::from(k);
            let j = [Vec2::new((1.3 * t).sin(), t.cos()), Vec2::new((0.7 * t).cos(), (2.1 * t).sin())];
            let ([s1, s2], r, u) = polar(j);
            assert!((s1 * s2 - determinant(j)).abs() < 1e-12);
            assert!((s1 * s1 + s2 * s2 - j[0].length_squared() - j[1].length_squared()).abs() < 1e-12);
            // J = (s1 u uᵀ + s2 u⊥ u⊥ᵀ) R.
            let columns = [r, r.perp()];
            for (column, expected) in columns.iter().zip(j) {
                let got = s1 * u.dot(*column) * u + s2 * u.perp().dot(*column) * u.perp();
                assert!(got.distance(expected) < 1e-12, "{k}");
            }
        }
    }
}
