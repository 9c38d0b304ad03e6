//! What one point adds to the field of a plane: x = m·r / |r|², where r = p − q and m = l n / 2π (*Leaps and Bounds*,
//! eq. 28), or bounded (1/π) arctan(πx) (eq. 35): the angle, over 2π, of a straight piece of length l seen along its axis.
use crate::math::Vec2;
use std::f64::consts::PI;

#[derive(Clone, Copy, Default)]
pub struct Dipole {
    pub point: Vec2,
    /// Length times normal, over 2π.
    pub moment: Vec2,
}

impl Dipole {
    #[inline]
    pub fn value(&self, q: Vec2, is_bounded: bool) -> f64 {
        let r = self.point - q;
        let (across, square) = (self.moment.dot(r), r.length_squared());
        match (is_bounded, square > 0.0) {
            // Where the square underflows, atan2 still gives the limit, ±½; at the point itself 0.
            (true, _) => libm::atan2(PI * across, square) / PI,
            (false, true) => across / square,
            (false, false) => 0.0,
        }
    }

    /// ∇x = (2 (m·u) u − m) / |r|², where u = r / |r|; of a bounded point over 1 + π²x² too. Both divisors at once are
    /// |r|² + π²(m·u)², which does not vanish at the point unless seen across its normal.
    #[inline]
    pub fn gradient(&self, q: Vec2, is_bounded: bool) -> Vec2 {
        let r = self.point - q;
        let square = r.length_squared();
        if square == 0.0 {
            return Vec2::ZERO;
        }
        let direction = r / square.sqrt();
        let across = self.moment.dot(direction);
        let bounding = if is_bounded { (PI * across).powi(2) } else { 0.0 };
        (2.0 * across * direction - self.moment) / (square + bounding)
    }
}
