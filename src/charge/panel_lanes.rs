//! [`super::panel`] for eight points at once, in 32-bit floats.
use crate::math::{Vec3, area_vector};
use wide::f32x8;

/// Eight vectors.
pub type Lanes = [f32x8; 3];

/// Lower than this above the plane, in longest edges, 32 bits do not tell the side.
const LOW: f64 = 0.005;
/// An edge counts as no nearer than this, in its lengths.
const LEAST_DISTANCE: f32 = 1e-6;

/// What is the same for all points, relative to the barycentre.
pub struct Panel {
    corners: [[f32; 3]; 3],
    normal: [f32; 3],
    lengths: [f32; 3],
    outward: [[f32; 3]; 3],
    /// Twice the area.
    area: f32,
    low: f32,
}

fn single(v: Vec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

impl Panel {
    pub fn new(corners: [Vec3; 3], center: Vec3, size: f64) -> Panel {
        let relative = corners.map(|corner| corner - center);
        let normal = area_vector(relative).normalize_or_zero();
        let edges = [0, 1, 2].map(|k| relative[(k + 1) % 3] - relative[k]);
        Panel {
            corners: relative.map(single),
            normal: single(normal),
            lengths: edges.map(|edge| edge.length() as f32),
            outward: edges.map(|edge| single(edge.normalize_or_zero().cross(normal))),
            area: 2.0 * area_vector(relative).length() as f32,
            low: (LOW * size) as f32,
        }
    }

    /// Potentials and fields at points relative to the barycentre, of a charge of 1 per area; and which of the points are too
    /// low above the plane, as bits: there they are not to be used.
    pub fn at(&self, points: &Lanes) -> (f32x8, Lanes, u32) {
        let splat = |v: [f32; 3]| v.map(f32x8::splat);
        let normal = splat(self.normal);
        let from = self.corners.map(|corner| {
            let corner = splat(corner);
            [0, 1, 2].map(|i| corner[i] - points[i])
        });
        let lengths = from.map(|r| dot(&r, &r).sqrt());
        let height = f32x8::ZERO - dot(&from[0], &normal);
        let cosines = [0, 1, 2].map(|k| dot(&from[k], &from[(k + 1) % 3]));
        // Half the solid angle: van Oosterom & Strackee 1983.
        let volume = height * f32x8::splat(self.area);
        let [a, b, c] = lengths;
        let below = a * b * c + cosines[0] * c + cosines[1] * a + cosines[2] * b;
        let angle = volume.atan2(below) * f32x8::splat(2.0);
        let mut potential = f32x8::ZERO - height * angle;
        let mut field = normal.map(|n| n * angle);
        for k in 0..3 {
            let length = f32x8::splat(self.lengths[k]);
            let product = lengths[k] * lengths[(k + 1) % 3];
            let cross = cross(&from[k], &from[(k + 1) % 3]);
            // Whichever does not cancel.
            let wide_gap = product + cosines[k];
            let narrow_gap =
                dot(&cross, &cross) / (product - cosines[k]).fast_max(f32x8::splat(f32::MIN_POSITIVE));
            let is_narrow = cosines[k].simd_le(f32x8::ZERO);
            let least = LEAST_DISTANCE * self.lengths[k];
            let gap = is_narrow.select(narrow_gap, wide_gap).fast_max(f32x8::splat(least * least));
            let sum = lengths[k] + lengths[(k + 1) % 3] + length;
            let integral = (f32x8::splat(0.5) * sum * sum / gap).ln();
            let outward = splat(self.outward[k]);
            potential += dot(&from[k], &outward) * integral;
            (0..3).for_each(|i| field[i] += outward[i] * integral);
        }
        let low = height.abs().simd_le(f32x8::splat(self.low)).to_bitmask();
        (potential, field, low)
    }
}

#[inline(always)]
fn dot(a: &Lanes, b: &Lanes) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: &Lanes, b: &Lanes) -> Lanes {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::charge::panel::potential_and_field;

    #[test]
    fn lanes_give_the_closed_form() {
        let corners = [Vec3::new(0.1, -0.2, 0.3), Vec3::new(1.3, 0.1, 0.2), Vec3::new(0.4, 0.9, -0.3)];
        let center = (corners[0] + corners[1] + corners[2]) / 3.0;
        let panel = Panel::new(corners, center, 1.3);
        let mut compared = 0;
        for k in 0..100 {
            let offsets: [Vec3; 8] = std::array::from_fn(|i| {
                let t = f64::from(8 * k + i as i32);
                Vec3::new((1.1 * t).sin(), (2.3 * t).cos(), (0.7 * t + 0.4).sin())
            });
            let lanes = [0, 1, 2].map(|axis| f32x8::from(offsets.map(|o| o[axis] as f32)));
            let (potential, field, low) = panel.at(&lanes);
            for (i, offset) in offsets.into_iter().enumerate().filter(|(i, _)| low >> i & 1 == 0) {
                let expected = potential_and_field(center + offset, corners);
                let found = Vec3::from_array(field.map(|f| f64::from(f.to_array()[i])));
                assert!((f64::from(potential.to_array()[i]) - expected.0).abs() < 2e-6 * expected.0.max(1.0));
                assert!(
                    found.distance(expected.1) < 2e-5 * expected.1.length(),
                    "{offset}: {found}, {}",
                    expected.1
                );
                compared += 1;
            }
        }
        assert!(compared > 700, "{compared}");
    }
}
