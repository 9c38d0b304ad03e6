use super::sorted_codes;
use crate::data::map_items;
use crate::math::{Aabb, Vec3};

const BITS: u32 = 21;

/// Place of `p` on the Morton (Z-order) curve through `bounds`, 21 bits for each axis.
#[inline]
pub fn morton_code(p: Vec3, bounds: &Aabb) -> u64 {
    let steps = f64::from(1u32 << BITS);
    let size = bounds.size().max(Vec3::splat(f64::MIN_POSITIVE));
    let cell = ((p - bounds.min) / size.max_element() * steps).clamp(Vec3::ZERO, Vec3::splat(steps - 1.0));
    spread(cell.x as u64) | spread(cell.y as u64) << 1 | spread(cell.z as u64) << 2
}

/// Moves bit i of a 21-bit number to bit 3i.
#[inline]
fn spread(x: u64) -> u64 {
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

/// The numbers of points in the order of a curve through their box, on which neighbours are mostly near each other; where points
/// that are not finite come does not matter.
pub fn along_curve(points: &[Vec3]) -> Vec<u32> {
    let bounds = Aabb::around(points.iter().copied().filter(|p| p.is_finite()));
    sorted_codes(map_items(points.len(), |k| morton_code(points[k], &bounds))).1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_interleave() {
        assert_eq!(spread(0b1011), 0b001_000_001_001);
        assert_eq!(spread((1 << 21) - 1), 0x1249_2492_4924_9249);
        let cube = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
        assert_eq!(morton_code(Vec3::ONE, &cube), (1 << 63) - 1);
        assert!(morton_code(Vec3::new(0.9, 0.1, 0.1), &cube) < morton_code(Vec3::new(0.1, 0.9, 0.1), &cube));
    }
}
