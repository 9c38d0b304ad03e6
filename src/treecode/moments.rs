//! Multipole moments of clusters of dipoles, in f64, and how they move from centre to centre.
use super::kernel::Quadrature;
use crate::math::Vec3;

/// Index pairs of a symmetric 3×3 tensor in storage order: xx, xy, xz, yy, yz, zz.
pub(super) const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// Moments of orders 0, 1 and 2 of a cluster about its area-weighted centre (Barill et al. 2018, eqs. 13 to 15).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    pub area: f64,
    pub center: Vec3,
    /// Σ a |y|², y = x − centre
    pub spread: f64,
    /// The largest extent of a source.
    pub extent: f64,
    /// Σ a n
    pub zeroth: Vec3,
    /// `first[i]` = Σ a yᵢ n, y = x − centre
    pub first: [Vec3; 3],
    /// `second[k]` = Σ a yᵢ yⱼ n for pair k of [`PAIRS`]
    pub second: [Vec3; 6],
}

impl Moments {
    /// Moments of sources about their common centre; `fallback` is the centre when they have no area.
    pub fn of_sources(sources: &[Quadrature], fallback: Vec3) -> Moments {
        let area: f64 = sources.iter().map(|s| s.area).sum();
        let weighted: Vec3 = sources.iter().map(|s| s.area * mean(s.points)).sum();
        let center = if area > 0.0 { weighted / area } else { fallback };
        let mut moments = Moments { area, center, ..Moments::default() };
        for source in sources {
            moments.zeroth += source.area_vector;
            moments.extent = moments.extent.max(source.extent);
            for point in source.points {
                let y = point - center;
                moments.spread += source.area * y.length_squared() / 3.0;
                moments.add_displaced(y, source.area_vector / 3.0);
            }
        }
        moments
    }

    /// Moments of the union of clusters about its centre (M2M).
    pub fn of_clusters(parts: &[Moments], fallback: Vec3) -> Moments {
        let area: f64 = parts.iter().map(|p| p.area).sum();
        let weighted: Vec3 = parts.iter().map(|p| p.area * p.center).sum();
        let center = if area > 0.0 { weighted / area } else { fallback };
        let mut moments = Moments { area, center, ..Moments::default() };
        for part in parts {
            let d = part.center - center;
            moments.spread += part.spread + part.area * d.length_squared();
            moments.zeroth += part.zeroth;
            moments.extent = moments.extent.max(part.extent);
            moments.add_displaced(d, part.zeroth);
            for i in 0..3 {
                moments.first[i] += part.first[i];
            }
            for (k, (i, j)) in PAIRS.into_iter().enumerate() {
                moments.second[k] += part.second[k] + d[i] * part.first[j] + d[j] * part.first[i];
            }
        }
        moments
    }

    /// Adds the first and second moments of a dipole `n` at displacement `y`.
    fn add_displaced(&mut self, y: Vec3, n: Vec3) {
        for i in 0..3 {
            self.first[i] += y[i] * n;
        }
        for (k, (i, j)) in PAIRS.into_iter().enumerate() {
            self.second[k] += y[i] * y[j] * n;
        }
    }

    /// Σ a yᵢ yⱼ n for any i, j.
    pub fn second_at(&self, i: usize, j: usize) -> Vec3 {
        let pair = (i.min(j), i.max(j));
        let k = PAIRS.iter().position(|p| *p == pair).expect("i and j are axes");
        self.second[k]
    }
}

fn mean(points: [Vec3; 3]) -> Vec3 {
    (points[0] + points[1] + points[2]) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn union_of_clusters_has_the_moments_of_its_sources() {
        let source = |i: usize| {
            let t = i as f64;
            let points = [0.3, 1.7, 2.9].map(|s| Vec3::new((t * s).sin(), (t + s).cos(), (t * s * s).sin()));
            let area_vector = Vec3::new((3.0 * t).cos(), 0.5, (2.0 * t).sin());
            Quadrature { points, area_vector, area: area_vector.length(), extent: 0.0 }
        };
        let sources: Vec<Quadrature> = (0..12).map(source).collect();
        let whole = Moments::of_sources(&sources, Vec3::ZERO);
        let parts: Vec<Moments> = sources.chunks(5).map(|c| Moments::of_sources(c, Vec3::ZERO)).collect();
        let joined = Moments::of_clusters(&parts, Vec3::ZERO);
        assert!((whole.center - joined.center).length() < 1e-15);
        assert!((whole.spread - joined.spread).abs() < 1e-14);
        for i in 0..3 {
            assert!((whole.first[i] - joined.first[i]).length() < 1e-14);
            for j in 0..3 {
                assert!((whole.second_at(i, j) - joined.second_at(i, j)).length() < 1e-14);
            }
        }
    }
}
