//! From where on the series of a cluster are good enough, and how many of their terms.
use super::DualAccuracy;
use super::bounds::spread_of_order;
use super::clusters::Clusters;
use crate::data::map_items;
use crate::math::Floats;
use std::f64::consts::PI;
use wide::f32x4;

/// Classes of series by their length.
pub const CLASSES: usize = 4;
/// Orders of multipole series and degrees of Taylor polynomials of the classes but the last, which is what is asked for: what
/// is far beyond its reach needs fewer terms.
const SHORTER: [(usize, usize); CLASSES - 1] = [(1, 2), (2, 3), (2, 4)];
/// The last of them, with the most terms.
pub const LONGEST: usize = CLASSES - 1;

/// The reach of a cluster at an accuracy, for each class.
#[derive(Clone, Copy)]
pub struct Reach {
    /// Distance from its centre beyond which its multipole series serves.
    pub multipole: [f32; CLASSES],
    /// The same of Taylor polynomials, as the distance of a block's centre from its nearest source: this times
    /// [`BlockReach::factor`].
    pub taylor: [f32; CLASSES],
}

/// What a block's radius makes of [`Reach::taylor`], and the least distance.
#[derive(Clone, Copy)]
pub struct BlockReach {
    pub radius: f32,
    pub factor: [f32; CLASSES],
    pub nearest: f32,
}

/// Share of the error that shorter series may have: there are many of them. With 0.3 a tenth of the time is saved, for errors
/// up to a third larger.
const SHARE: f32 = 0.1;

/// Series are not used nearer than this many radii, of a cluster or of a block: their errors grow without bounds.
const NEAREST: f32 = 1.2;

impl DualAccuracy {
    /// Order and degree of a class.
    pub(super) fn class(&self, class: usize) -> (usize, usize) {
        let (order, degree) = SHORTER.get(class).copied().unwrap_or((self.order, self.degree));
        (order.min(self.order), degree.min(self.degree))
    }
}

/// The reaches of all clusters.
///
/// A multipole series leaves out up to A S t^(p+1) (p+2 − (p+1)t)/(1−t)² / 4πd² at a distance d = r/t, where A is the
/// sources' area, r their radius and S a bound of the mean of (|y|/r)^(p+1); a Taylor polynomial the same with its degree for
/// the order, the block's radius for r and without S.
///
/// Bounded points are dipoles only beyond a distance that depends on their extents.
pub fn reaches(clusters: &Clusters, accuracy: &DualAccuracy) -> Vec<Reach> {
    let least = accuracy.of_bounded_points().least;
    map_items(clusters.balls.len(), |k| {
        let (series, radius) = (&clusters.series[k], clusters.balls[k][3]);
        let per_error = series.area / (4.0 * PI * accuracy.error) as f32;
        let area = |class: usize| if class < LONGEST { per_error / SHARE } else { per_error };
        let mut multipole = [0.0; CLASSES];
        for class in 0..CLASSES {
            let (order, _) = accuracy.class(class);
            if class > 0 && class < LONGEST && accuracy.class(class - 1).0 == order {
                multipole[class] = multipole[class - 1];
                continue;
            }
            let weighted = area(class) * spread_of_order(series.spread, order);
            let reach = radius / ratio(radius * radius / weighted, order);
            multipole[class] = if weighted > 0.0 { reach.max(NEAREST * radius) } else { NEAREST * radius };
        }
        if let Some(extent) = clusters.extents.get(k) {
            multipole.iter_mut().for_each(|reach| *reach = reach.max(radius + least * extent));
        }
        let taylor = |class: usize| {
            let (_, degree) = accuracy.class(class);
            libm::powf(area(class) * taylor_factor(degree), 1.0 / (degree as f32 + 3.0))
        };
        Reach { multipole, taylor: std::array::from_fn(taylor) }
    })
}

/// The t for which t^(p+3) (p+2 − (p+1)t)/(1−t)² is `x`, to 3 % below 0.6.
fn ratio(x: f32, order: usize) -> f32 {
    let p = order as f32;
    let power = 1.0 / (p + 3.0);
    // What it were if the quotient were p + 2, as it is at 0.
    let most = libm::powf(x / (p + 2.0), power);
    let mut t = most / (1.0 + 0.5 * most);
    for _ in 0..2 {
        let rest = 1.0 - t.min(0.95);
        t = most / libm::powf((1.0 - (p + 1.0) / (p + 2.0) * t.min(0.95)) / (rest * rest), power);
    }
    t
}

/// (q+2 − (q+1)t)/(1−t)² at a usual t.
fn taylor_factor(degree: usize) -> f32 {
    const USUAL: f32 = 0.4;
    let q = degree as f32;
    (q + 2.0 - (q + 1.0) * USUAL) / ((1.0 - USUAL) * (1.0 - USUAL))
}

impl BlockReach {
    pub fn new(radius: f32, accuracy: &DualAccuracy) -> BlockReach {
        let factor = |class: usize| {
            let degree = accuracy.class(class).1 as f32;
            libm::powf(radius, (degree + 1.0) / (degree + 3.0))
        };
        BlockReach { radius, factor: std::array::from_fn(factor), nearest: NEAREST * radius }
    }

    /// The class of the shortest series of a cluster of radius `own` at `distance` that serves all of the block.
    #[inline(always)]
    pub fn class(&self, reach: &Reach, distance: f32, own: f32) -> Option<usize> {
        let gap = distance - own;
        if gap <= self.nearest {
            return None;
        }
        let serves = f32x4::splat(distance - self.radius).greater(f32x4::from(reach.multipole))
            & f32x4::splat(gap).greater(f32x4::from(self.factor) * f32x4::from(reach.taylor));
        (serves != 0).then(|| serves.trailing_zeros() as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratio_solves_its_equation() {
        for order in 1..4 {
            for t in [0.01, 0.1, 0.3, 0.5, 0.6f32] {
                let p = order as f32;
                let x = t.powi(order as i32 + 3) * (p + 2.0 - (p + 1.0) * t) / ((1.0 - t) * (1.0 - t));
                assert!((ratio(x, order) / t - 1.0).abs() < 0.03, "{order} {t}: {}", ratio(x, order));
            }
        }
    }
}
