//! Clusters of charges and dipoles, and their potentials φ = Q/R + D·R/R³ + (3/2) R·S·R/R⁵ about their middles.
use crate::bvh::Bvh;
use crate::data::set_each;
use crate::math::{Aabb, Vec3};
use crate::treecode::links::{Link, link, spans};
use crate::treecode::moments::PAIRS;
use std::ops::Range;

/// Clusters whose moments are one task.
const CLUSTERS_PER_TASK: usize = 256;

/// A hierarchy of clusters of sorted points; those below one are contiguous.
pub struct Clusters {
    /// Middle and radius.
    balls: Vec<[f32; 4]>,
    centers: Vec<Vec3>,
    links: Vec<Link>,
    /// The ranges of the levels, the uppermost first.
    levels: Vec<Range<usize>>,
}

impl Clusters {
    /// The clusters of a hierarchy of points that are in its order.
    pub fn over(bvh: &Bvh, points: &[Vec3]) -> Clusters {
        let (links, levels) = link(bvh);
        let mut centers = Vec::with_capacity(links.len());
        let mut balls = Vec::with_capacity(links.len());
        for span in spans(&links) {
            let own = &points[span];
            let center = Aabb::around(own.iter().copied()).center();
            let radius = own.iter().map(|p| p.distance_squared(center)).fold(0.0, f64::max).sqrt();
            let [x, y, z] = center.to_array().map(|c| c as f32);
            centers.push(Vec3::new(f64::from(x), f64::from(y), f64::from(z)));
            balls.push([x, y, z, radius as f32]);
        }
        Clusters { balls, centers, links, levels }
    }

    pub fn len(&self) -> usize {
        self.links.len()
    }

    pub fn roots(&self) -> Range<u32> {
        self.levels.first().map_or(0..0, |l| l.start as u32..l.end as u32)
    }

    pub fn ball(&self, cluster: u32) -> [f32; 4] {
        self.balls[cluster as usize]
    }

    /// The points of a leaf.
    pub fn leaf(&self, cluster: u32) -> Option<Range<u32>> {
        let link = &self.links[cluster as usize];
        link.is_leaf().then(|| narrowed(link.range()))
    }

    /// The clusters right below one that is no leaf.
    pub fn children(&self, cluster: u32) -> Range<u32> {
        narrowed(self.links[cluster as usize].range())
    }

    /// The moments of all clusters, given those of each point about its own place, which is given too.
    pub fn series(&self, of_point: &(dyn Fn(usize) -> (Vec3, Moments) + Sync)) -> Vec<Series> {
        let mut moments = vec![Moments::ZERO; self.len()];
        for level in self.levels.iter().rev() {
            let (upper, lower) = moments.split_at_mut(level.end);
            set_each(&mut upper[level.clone()], CLUSTERS_PER_TASK, |k, sum| {
                let center = self.centers[level.start + k];
                let link = &self.links[level.start + k];
                for i in link.range() {
                    if link.is_leaf() {
                        let (place, own) = of_point(i);
                        sum.add(&own, place - center);
                    } else {
                        sum.add(&lower[i - level.end], self.centers[i] - center);
                    }
                }
            });
        }
        moments.iter().zip(&self.balls).map(|(m, ball)| m.narrowed(ball)).collect()
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.balls[..]) + size_of_val(&self.centers[..]) + size_of_val(&self.links[..])
    }
}

fn narrowed(range: Range<usize>) -> Range<u32> {
    range.start as u32..range.end as u32
}

/// Moments about a place.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moments {
    pub charge: f64,
    pub dipole: Vec3,
    /// xx, xy, xz, yy, yz, zz of a symmetric tensor, whose trace does not count.
    pub quadrupole: [f64; 6],
}

/// The moments of a cluster as its potential needs them: the quadrupole without a trace, times 3/2.
#[derive(Clone, Copy, Default)]
pub struct Series {
    pub center: [f32; 3],
    pub charge: f32,
    pub dipole: [f32; 3],
    pub quadrupole: [f32; 6],
}

impl Moments {
    pub const ZERO: Moments = Moments { charge: 0.0, dipole: Vec3::ZERO, quadrupole: [0.0; 6] };

    /// Adds moments about a place that lies at `t` from the own one.
    fn add(&mut self, other: &Moments, t: Vec3) {
        let d = other.dipole;
        self.charge += other.charge;
        self.dipole += d + other.charge * t;
        for (sum, (own, (i, j))) in self.quadrupole.iter_mut().zip(other.quadrupole.iter().zip(PAIRS)) {
            *sum += own + t[i] * d[j] + d[i] * t[j] + other.charge * t[i] * t[j];
        }
    }

    fn narrowed(&self, [x, y, z, _]: &[f32; 4]) -> Series {
        let [xx, .., zz] = self.quadrupole;
        let third = (xx + self.quadrupole[3] + zz) / 3.0;
        let traceless = |(s, (i, j)): (&f64, (usize, usize))| 1.5 * (s - if i == j { third } else { 0.0 });
        let mut quadrupole = [0.0; 6];
        for (narrow, wide) in quadrupole.iter_mut().zip(self.quadrupole.iter().zip(PAIRS)) {
            *narrow = traceless(wide) as f32;
        }
        Series {
            center: [*x, *y, *z],
            charge: self.charge as f32,
            dipole: self.dipole.to_array().map(|d| d as f32),
            quadrupole,
        }
    }
}
