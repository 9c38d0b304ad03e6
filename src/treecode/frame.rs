use crate::math::{Aabb, Vec3};

/// Moves the sources into a unit cube about the origin. The winding number does not change with scale, but powers of
/// lengths in 32-bit floats would overflow.
#[derive(Clone, Copy)]
pub struct Frame {
    pub center: Vec3,
    pub scale: f64,
}

impl Frame {
    pub fn around(bounds: &Aabb) -> Frame {
        let longest = bounds.size().max_element();
        // A power of two: scaling is exact.
        let scale = if longest > 0.0 { (-longest.log2().ceil()).exp2() } else { 1.0 };
        Frame { center: bounds.center(), scale }
    }

    #[inline]
    pub fn local(&self, p: Vec3) -> Vec3 {
        (p - self.center) * self.scale
    }
}
