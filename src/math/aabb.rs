use super::Vec3;

/// An axis-aligned box, `min` to `max` inclusive; empty when `min > max` on an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    pub min: Vec3,
    pub max: Vec3,
}

impl Aabb {
    /// The box that holds nothing: the neutral element of [`Aabb::union`].
    pub const EMPTY: Aabb = Aabb { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The smallest box around `points`; [`Aabb::EMPTY`] when there are none.
    #[inline]
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Aabb {
        points.into_iter().fold(Aabb::EMPTY, |all, p| all.including(p))
    }

    #[inline]
    pub fn including(self, p: Vec3) -> Aabb {
        Aabb { min: self.min.min(p), max: self.max.max(p) }
    }

    #[inline]
    pub fn union(self, other: Aabb) -> Aabb {
        Aabb { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    #[inline]
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Edge lengths; zero for an empty box.
    #[inline]
    pub fn size(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { self.max - self.min }
    }

    #[inline]
    pub fn center(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { self.min + 0.5 * (self.max - self.min) }
    }

    pub fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// The box grown by `margin` on every side.
    pub fn padded(self, margin: f64) -> Aabb {
        Aabb { min: self.min - Vec3::splat(margin), max: self.max + Vec3::splat(margin) }
    }

    /// What to subtract from coordinates in the box before they are narrowed to `f32`: zero unless the box lies so far
    /// from the origin, for its size, that more than 4 of an `f32`'s 24 bits would be lost.
    pub fn narrowing_origin(&self) -> Vec3 {
        const FAR: f64 = 16.0;
        let center = self.center();
        if center.length() > FAR * self.diagonal() { center } else { Vec3::ZERO }
    }

    /// Whether two boxes have a point in common.
    #[inline]
    pub fn overlaps(&self, other: &Aabb) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    #[inline]
    pub fn contains(&self, p: Vec3) -> bool {
        self.min.cmple(p).all() && p.cmple(self.max).all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_box_is_neutral_and_has_no_size() {
        let p = Vec3::new(1.0, -2.0, 3.0);
        assert_eq!(Aabb::EMPTY.including(p), Aabb { min: p, max: p });
        assert!(Aabb::EMPTY.is_empty());
        assert_eq!(Aabb::EMPTY.size(), Vec3::ZERO);
    }

    #[test]
    fn only_a_far_box_is_narrowed_about_its_center() {
        let near = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
        assert_eq!(near.narrowing_origin(), Vec3::ZERO);
        let far = Aabb { min: Vec3::splat(1e6), max: Vec3::splat(1e6 + 1.0) };
        assert_eq!(far.narrowing_origin(), far.center());
    }
}
