//! Numbers of twice the precision: unevaluated sums of two `f64` (Dekker 1971), some 106 bits. No fused multiply-add, so
//! that every machine gives the same bits.
use super::Vec3;
use std::ops::{Add, Div, Mul, Sub};

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twofold {
    pub high: f64,
    pub low: f64,
}

/// 2^27 + 1, which cuts a factor into halves of 26 bits.
const SPLITTER: f64 = 134_217_729.0;

#[inline]
fn two_sum(a: f64, b: f64) -> Twofold {
    let high = a + b;
    let part = high - a;
    Twofold { high, low: (a - (high - part)) + (b - part) }
}

#[inline]
fn quick_two_sum(a: f64, b: f64) -> Twofold {
    let high = a + b;
    Twofold { high, low: b - (high - a) }
}

#[inline]
fn split(a: f64) -> (f64, f64) {
    let t = SPLITTER * a;
    let high = t - (t - a);
    (high, a - high)
}

#[inline]
fn two_product(a: f64, b: f64) -> Twofold {
    let high = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    Twofold { high, low: ((ah * bh - high) + ah * bl + al * bh) + al * bl }
}

impl From<f64> for Twofold {
    fn from(high: f64) -> Twofold {
        Twofold { high, low: 0.0 }
    }
}

impl Add for Twofold {
    type Output = Twofold;
    #[inline]
    fn add(self, other: Twofold) -> Twofold {
        let (s, t) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let s = quick_two_sum(s.high, s.low + t.high);
        quick_two_sum(s.high, s.low + t.low)
    }
}

impl Sub for Twofold {
    type Output = Twofold;
    #[inline]
    fn sub(self, other: Twofold) -> Twofold {
        self + Twofold { high: -other.high, low: -other.low }
    }
}

impl Mul for Twofold {
    type Output = Twofold;
    #[inline]
    fn mul(self, other: Twofold) -> Twofold {
        let p = two_product(self.high, other.high);
        quick_two_sum(p.high, p.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Twofold {
    type Output = Twofold;
    fn div(self, other: Twofold) -> Twofold {
        let first = self.high / other.high;
        let rest = self - other * first.into();
        let second = rest.high / other.high;
        let rest = rest - other * second.into();
        quick_two_sum(first, second) + (rest.high / other.high).into()
    }
}

impl Twofold {
    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }
}

/// A place in space of twice the precision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place(pub [Twofold; 3]);

impl From<Vec3> for Place {
    fn from(p: Vec3) -> Place {
        Place(p.to_array().map(Twofold::from))
    }
}

impl Place {
    /// The nearest place of single precision; −0 is 0.
    pub fn rounded(self) -> Vec3 {
        Vec3::from_array(self.0.map(|x| x.high)) + Vec3::ZERO
    }

    #[inline]
    pub fn minus(self, other: Place) -> Place {
        Place([0, 1, 2].map(|k| self.0[k] - other.0[k]))
    }

    #[inline]
    pub fn plus_scaled(self, share: Twofold, along: Place) -> Place {
        Place([0, 1, 2].map(|k| self.0[k] + share * along.0[k]))
    }

    /// Component `k` of the cross product.
    #[inline]
    pub fn cross_component(self, other: Place, k: usize) -> Twofold {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        self.0[i] * other.0[j] - self.0[j] * other.0[i]
    }

    pub fn cross(self, other: Place) -> Place {
        Place([0, 1, 2].map(|k| self.cross_component(other, k)))
    }

    pub fn dot(self, other: Place) -> Twofold {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }

    /// The component of largest absolute value.
    pub fn dominant(self) -> usize {
        let size = self.0.map(|x| x.high.abs());
        if size[0] >= size[1] && size[0] >= size[2] {
            0
        } else if size[1] >= size[2] {
            1
        } else {
            2
        }
    }

    pub fn is_finite(self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirds_come_back_beyond_single_precision() {
        let third = Twofold::from(1.0) / 3.0.into();
        let one = third * 3.0.into() - 1.0.into();
        assert!(third.low != 0.0 && one.high.abs() < 1e-31, "{one:?}");
        let square = (third + 2.0.into()) * (third + 2.0.into()) - Twofold::from(49.0) / 9.0.into();
        assert!(square.high.abs() < 1e-30, "{square:?}");
    }

    #[test]
    fn crossings_round_alike_however_they_are_computed() {
        // The point (1, 1, 1)/3 on a line, from either of its ends.
        let [a, b] = [Vec3::ZERO, Vec3::ONE].map(Place::from);
        let third = Twofold::from(1.0) / 3.0.into();
        let from_a = a.plus_scaled(third, b.minus(a));
        let from_b = b.plus_scaled(Twofold::from(2.0) / 3.0.into(), a.minus(b));
        assert_eq!(from_a.rounded(), from_b.rounded());
        assert_eq!(from_a.rounded(), Vec3::splat(1.0 / 3.0));
    }
}
