//! Flat cylinders around parts of a surface: much tighter than boxes where it is seen from afar.
use super::WIDTH;
use crate::math::Vec3;
use wide::f32x4;

/// Four cylinders, by axis: bounds of what lies below a node's children.
#[derive(Clone, Copy, Debug)]
pub(super) struct Discs {
    center: [[f32; WIDTH]; 3],
    /// Their axes: unit, or zero for a ball.
    normal: [[f32; WIDTH]; 3],
    radius: [f32; WIDTH],
    /// Half of their heights.
    height: [f32; WIDTH],
}

impl Discs {
    /// No bound.
    pub const ENDLESS: Discs = Discs {
        center: [[0.0; WIDTH]; 3],
        normal: [[0.0; WIDTH]; 3],
        radius: [f32::INFINITY; WIDTH],
        height: [f32::INFINITY; WIDTH],
    };

    /// Makes one of them hold some points; a center and an axis, as they are narrowed, may be any.
    pub fn set(&mut self, k: usize, center: Vec3, normal: Vec3, points: impl Iterator<Item = Vec3>) {
        let (center, normal) = (center.as_vec3(), normal.as_vec3());
        for axis in 0..3 {
            self.center[axis][k] = center[axis];
            self.normal[axis][k] = normal[axis];
        }
        let (center, normal) = (center.as_dvec3(), normal.as_dvec3());
        let (mut radius, mut height) = (0.0f64, 0.0f64);
        for point in points {
            let offset = point - center;
            let along = offset.dot(normal);
            height = height.max(along.abs());
            radius = radius.max((offset - along * normal).length());
        }
        (self.radius[k], self.height[k]) = (radius as f32, height as f32);
    }

    /// Least squared distances of a place to what they hold.
    #[inline(always)]
    pub fn squared_distances(&self, place: &[f32x4; 3]) -> f32x4 {
        // Written out: calls of `map` are not inlined here.
        let [cx, cy, cz] = self.center;
        let [nx, ny, nz] = self.normal;
        let (nx, ny, nz) = (f32x4::new(nx), f32x4::new(ny), f32x4::new(nz));
        let x = place[0] - f32x4::new(cx);
        let y = place[1] - f32x4::new(cy);
        let z = place[2] - f32x4::new(cz);
        let along = x * nx + y * ny + z * nz;
        // Component by component: a difference of squares would lose half of the digits.
        let (x, y, z) = (x - along * nx, y - along * ny, z - along * nz);
        let across = (x * x + y * y + z * z).sqrt() - f32x4::new(self.radius);
        let (across, beyond) = (across.fast_max(f32x4::ZERO), along.abs() - f32x4::new(self.height));
        let beyond = beyond.fast_max(f32x4::ZERO);
        across * across + beyond * beyond
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_is_nearer_than_its_disc() {
        let place = |i: u32| Vec3::from_array([0.37, 1.73, 2.91].map(|s| (f64::from(i) * s).sin()));
        let points: Vec<Vec3> = (0..20).map(|i| 0.3 * place(i) * Vec3::new(1.0, 1.0, 0.02)).collect();
        let mut discs = Discs::ENDLESS;
        discs.set(1, Vec3::ZERO, Vec3::Z, points.iter().copied());
        discs.set(2, 0.1 * Vec3::ONE, Vec3::ZERO, points.iter().copied());
        for i in 0..500 {
            let q = 2.0 * place(3 * i + 1);
            let nearest = points.iter().map(|p| p.distance(q)).fold(f64::INFINITY, f64::min);
            let found = discs.squared_distances(&q.as_vec3().to_array().map(f32x4::splat)).to_array();
            assert!(found.iter().all(|squared| f64::from(squared.sqrt()) <= nearest + 1e-6));
            assert_eq!((found[0], found[3]), (0.0, 0.0));
        }
        let above = discs.squared_distances(&[0.0, 0.0, 2.0].map(f32x4::splat)).to_array();
        assert!(above[1] > 1.98 * 1.98);
    }
}
