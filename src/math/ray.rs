use super::{Aabb, Vec3};

/// A ray, ready to meet triangles: Woop, Benthin & Wald 2013, *Watertight ray/triangle intersection*.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: Vec3,
    pub direction: Vec3,
    inverse: Vec3,
    axes: [usize; 3],
    shear: Vec3,
}

impl Ray {
    /// `direction` need not be a unit vector: distances are in its lengths.
    pub fn new(origin: Vec3, direction: Vec3) -> Ray {
        let size = direction.abs();
        let z = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            (x, y) = (y, x);
        }
        let shear = Vec3::new(direction[x], direction[y], 1.0) / direction[z];
        Ray { origin, direction, inverse: direction.recip(), axes: [x, y, z], shear }
    }

    pub fn at(&self, distance: f64) -> Vec3 {
        self.origin + distance * self.direction
    }

    /// Where the ray meets a triangle, and whether it leaves the side to which the normal points. A ray through an edge meets a
    /// triangle on either side of it or both, never none; one in the plane of a triangle meets nothing.
    #[inline]
    pub fn meet(&self, corners: [Vec3; 3]) -> Option<(f64, bool)> {
        let [x, y, z] = self.axes;
        let [a, b, c] = corners.map(|p| {
            let p = p - self.origin;
            Vec3::new(p[x] - self.shear.x * p[z], p[y] - self.shear.y * p[z], p[z])
        });
        let (u, v, w) = (c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let determinant = u + v + w;
        if determinant == 0.0 {
            return None;
        }
        let distance = (u * a.z + v * b.z + w * c.z) * self.shear.z / determinant;
        (distance >= 0.0).then_some((distance, determinant < 0.0))
    }

    /// Where the ray enters a box, if it does not begin inside; infinity where it misses it.
    #[inline]
    pub fn enters(&self, bounds: &Aabb) -> f64 {
        let (low, high) =
            ((bounds.min - self.origin) * self.inverse, (bounds.max - self.origin) * self.inverse);
        // NaN, in a side of the box and along it, counts for nothing.
        let (first, last) = (low.min(high), low.max(high));
        let first = first.x.max(first.y).max(first.z).max(0.0);
        let last = last.x.min(last.y).min(last.z);
        // Rounding must not lose a flat box.
        if first <= last * (1.0 + 8.0 * f64::EPSILON) { first } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_a_fan_of_triangles_through_each_edge_and_leaves_it_on_the_right_side() {
        let rim = [(1.0, 0.0), (0.3, 2.0), (-1.0, 0.4), (-1.0, -1.0), (0.0, -2.0)]
            .map(|(x, y)| Vec3::new(x, y, 0.1 * x));
        for direction in [Vec3::Z, Vec3::new(0.3, -0.2, 1.0), Vec3::new(0.1, 0.7, 0.5)] {
            for target in [Vec3::ZERO, 0.5 * rim[1], 0.3 * (rim[2] + rim[3])] {
                for sign in [1.0, -1.0] {
                    let ray = Ray::new(target - sign * 2.0 * direction, sign * direction);
                    let hits: Vec<_> =
                        (0..5).filter_map(|k| ray.meet([Vec3::ZERO, rim[k], rim[(k + 1) % 5]])).collect();
                    assert!(!hits.is_empty(), "{direction} {target}");
                    assert!(
                        hits.iter().all(|(t, leaves)| (t - 2.0).abs() < 1e-12 && *leaves == (sign > 0.0))
                    );
                }
            }
            let beside = Ray::new(Vec3::new(5.0, 0.0, -2.0), direction);
            assert!((0..5).all(|k| beside.meet([Vec3::ZERO, rim[k], rim[(k + 1) % 5]]).is_none()));
        }
    }

    #[test]
    fn boxes_are_entered_where_they_begin() {
        let unit = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
        let at = |x: f64, y: f64, direction: Vec3| Ray::new(Vec3::new(x, y, 0.5), direction).enters(&unit);
        assert_eq!(at(-2.0, 0.5, Vec3::X), 2.0);
        assert_eq!(at(0.5, 0.5, Vec3::X), 0.0);
        assert_eq!(at(3.0, 0.5, Vec3::X), f64::INFINITY);
        assert_eq!(at(-2.0, 1.5, Vec3::X), f64::INFINITY);
        let flat = Aabb { min: Vec3::ZERO, max: Vec3::new(1.0, 1.0, 0.0) };
        assert_eq!(Ray::new(Vec3::new(0.5, 0.5, 3.0), -Vec3::Z).enters(&flat), 3.0);
    }
}
