//! The exact integer part on a lattice: signed crossings along its rows.
//!
//! A row is a ray along x. Each triangle that covers the row in projection adds its sign at the first sample beyond it; a
//! running sum along the row counts, at each sample, the crossings of the ray from there along −x. Floating point decides
//! where its error bound allows, exact predicates elsewhere: each crossing of an edge or a vertex counts once.
mod rows;

use super::buckets::Buckets;
use super::facets::Facets;
use crate::data::{Cancelled, Lattice, Monitor, map_parts};
use crate::math::Vec3;
use rows::Rows;
use std::ops::Range;

/// Planes of a slab: eight, so that the bits of its samples fill whole bytes.
pub const SLAB_PLANES: usize = 8;
/// Slabs between two reports to the monitor, all in memory at once: fewer where they would take more than
/// [`BYTES_AT_ONCE`], down to the lower number.
const SLABS_PER_REPORT: [usize; 2] = [4, 16];
const BYTES_AT_ONCE: usize = 34_000_000;

/// Triangles distributed over the slabs of a lattice.
pub struct Scan<'a> {
    facets: Facets<'a>,
    lattice: &'a Lattice,
    slabs: Buckets<u32>,
    axes: [Axis; 3],
}

/// Crossings at the samples of one slab.
#[derive(Default)]
pub struct Slab {
    /// Signed crossings, x fastest.
    pub crossings: Vec<i32>,
    /// Samples that lie on a triangle of the soup, by their place in the slab, ascending.
    pub on_surface: Vec<u32>,
}

/// The samples along one axis.
#[derive(Clone, Copy)]
struct Axis {
    origin: f64,
    spacing: f64,
    count: usize,
    /// What rounding may move a coordinate by, in cells, with a margin.
    slack: f64,
}

impl Axis {
    fn new(origin: f64, spacing: f64, count: usize) -> Axis {
        let extent = origin.abs() + spacing * count as f64;
        Axis { origin, spacing, count, slack: 1e-6 + 8.0 * f64::EPSILON * extent / spacing }
    }

    fn at(&self, index: usize) -> f64 {
        self.origin + self.spacing * index as f64
    }

    /// Samples that may lie between two coordinates: all that do, and perhaps one more at each end.
    #[inline]
    fn range(&self, low: f64, high: f64) -> Range<usize> {
        if self.spacing <= 0.0 {
            return if low <= self.origin && self.origin <= high { 0..self.count } else { 0..0 };
        }
        let slack = self.slack + 4.0 * f64::EPSILON * low.abs().max(high.abs()) / self.spacing;
        let first = ((low - self.origin) / self.spacing - slack).ceil().max(0.0);
        let last = ((high - self.origin) / self.spacing + slack).floor().min(self.count as f64 - 1.0);
        if first <= last { first as usize..last as usize + 1 } else { 0..0 }
    }
}

fn extent(corners: &[Vec3; 3]) -> (Vec3, Vec3) {
    let [a, b, c] = corners;
    (a.min(*b).min(*c), a.max(*b).max(*c))
}

impl<'a> Scan<'a> {
    /// Distributes those facets of a range of numbers that cross rows of the lattice.
    pub fn new(facets: Facets<'a>, range: Range<usize>, lattice: &'a Lattice) -> Scan<'a> {
        let axis = |k: usize| Axis::new(lattice.origin[k], lattice.spacing[k], lattice.counts[k]);
        let axes = [axis(0), axis(1), axis(2)];
        let slabs = Buckets::collect(range.len(), lattice.counts[2].div_ceil(SLAB_PLANES), |place, put| {
            let facet = range.start + place;
            let (low, high) = extent(&facets.corners(facet));
            let planes = axes[2].range(low.z, high.z);
            if planes.is_empty()
                || axes[1].range(low.y, high.y).is_empty()
                || low.x > axes[0].at(axes[0].count)
            {
                return;
            }
            for slab in planes.start / SLAB_PLANES..=(planes.end - 1) / SLAB_PLANES {
                put(slab, facet as u32);
            }
        });
        Scan { facets, lattice, slabs, axes }
    }

    pub fn samples_of_plane(&self) -> usize {
        self.lattice.counts[0] * self.lattice.counts[1]
    }

    /// Number of slabs, of [`SLAB_PLANES`] planes each; the last may have fewer.
    pub fn slabs(&self) -> usize {
        self.lattice.counts[2].div_ceil(SLAB_PLANES)
    }

    /// Planes of a slab, by their index along z.
    pub fn planes(&self, slab: usize) -> Range<usize> {
        SLAB_PLANES * slab..(SLAB_PLANES * (slab + 1)).min(self.lattice.counts[2])
    }

    /// Counts the crossings at the samples of a slab.
    pub fn count(&self, slab: usize, result: &mut Slab) {
        let planes = self.planes(slab);
        result.crossings.clear();
        result.crossings.resize(self.axes[0].count * self.axes[1].count * planes.len(), 0);
        result.on_surface.clear();
        let mut rows = Rows { axes: &self.axes, planes, result };
        for facet in self.slabs.bucket(slab) {
            let corners = self.facets.corners(facet as usize);
            rows.add(corners, self.facets.role(facet as usize));
        }
        result.on_surface.sort_unstable();
        result.on_surface.dedup();
        for row in result.crossings.chunks_exact_mut(self.axes[0].count) {
            let mut sum = 0;
            row.iter_mut().for_each(|crossings| {
                sum += *crossings;
                *crossings = sum;
            });
        }
    }
}

/// Counts the crossings of every slab, in parallel, and hands them with the slab's part of `output`, `per_plane` items for
/// each sample of a plane, to `fill`; gives what `fill` has found, in order.
pub fn for_each_slab<T: Send, R: Send>(
    scan: &Scan,
    planes: Range<usize>,
    output: &mut [T],
    per_plane: usize,
    fill: impl Fn(usize, &Slab, &mut [T]) -> Vec<R> + Sync,
    stage: &str,
    monitor: &dyn Monitor,
) -> Result<Vec<R>, Cancelled> {
    let part = (scan.samples_of_plane() * per_plane).max(1);
    let [fewest, most] = SLABS_PER_REPORT;
    let bytes = size_of::<i32>() * SLAB_PLANES * scan.samples_of_plane().max(1);
    let at_once = (BYTES_AT_ONCE / bytes).clamp(fewest, most);
    let mut found = Vec::new();
    for (run, parts) in output.chunks_mut(at_once * part).enumerate() {
        let first = planes.start / SLAB_PLANES + run * at_once;
        monitor.report(first as f64 / scan.slabs() as f64, stage)?;
        let of_run = map_parts(parts, part, |slab, part| {
            let mut counted = Slab::default();
            scan.count(first + slab, &mut counted);
            fill(first + slab, &counted, part)
        });
        found.extend(of_run.into_iter().flatten());
    }
    monitor.report(1.0, stage)?;
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::TriangleSoup;
    use crate::math::{Sign, covers, orient_yz, touches};
    use crate::winding::closure::Closure;
    use crate::winding::winding_of_soup;

    /// A box of twelve triangles.
    fn cuboid(low: Vec3, high: Vec3) -> TriangleSoup {
        let pick = |c: usize, axis: usize| if c >> axis & 1 == 1 { high[axis] } else { low[axis] };
        let corners = (0..8).map(|c| Vec3::new(pick(c, 0), pick(c, 1), pick(c, 2))).collect();
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles = faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect();
        TriangleSoup::new(corners, triangles).unwrap()
    }

    fn check(soup: &TriangleSoup, lattice: &Lattice) -> usize {
        let closure = Closure::of(soup);
        let scan = Scan::new(Facets { soup, closure: &closure }, 0..soup.len() + closure.caps.len(), lattice);
        let mut slab = Slab::default();
        let mut touching = 0;
        for s in 0..scan.slabs() {
            scan.count(s, &mut slab);
            touching += slab.on_surface.len();
            for (index, crossings) in slab.crossings.iter().enumerate() {
                let mut sample = lattice.sample(index);
                sample[2] += SLAB_PLANES * s;
                let q = lattice.point(sample);
                let is_on = (0..soup.len()).any(|t| touches(q, soup.corners(t)));
                assert_eq!(is_on, slab.on_surface.contains(&(index as u32)), "{q}");
                if !is_on {
                    assert!(
                        (f64::from(*crossings) - winding_of_soup(soup, q)).abs() < 1e-12,
                        "{q}: {crossings}"
                    );
                }
            }
        }
        touching
    }

    #[test]
    fn rows_through_edges_and_vertices_count_once() {
        // Every second sample of the lattice lies on a face, an edge or a vertex of the box, or in line with one.
        let soup = cuboid(Vec3::ZERO, Vec3::ONE);
        let lattice = Lattice { origin: Vec3::splat(-0.5), spacing: Vec3::splat(0.25), counts: [9, 9, 11] };
        assert_eq!(check(&soup, &lattice), 125 - 27);
        let flat = Lattice { spacing: Vec3::new(0.25, 0.0, 0.25), counts: [9, 1, 9], ..lattice };
        assert_eq!(check(&soup, &flat), 0);
    }

    #[test]
    fn triangles_without_area_are_touched_on_their_edges() {
        let soup = |corners: [Vec3; 3]| TriangleSoup::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
        let lattice = Lattice { origin: Vec3::splat(-0.5), spacing: Vec3::splat(0.25), counts: [9, 9, 11] };
        assert_eq!(check(&soup([Vec3::ZERO, Vec3::splat(0.6), Vec3::ONE]), &lattice), 5);
        assert_eq!(check(&soup([Vec3::ZERO, Vec3::X, 0.5 * Vec3::X]), &lattice), 5);
        assert_eq!(check(&soup([Vec3::splat(0.25); 3]), &lattice), 1);
    }

    #[test]
    fn slanted_slivers_far_from_the_origin_count_right() {
        let offset = Vec3::new(1e6, -1e6, 3e5);
        let tip = |k: usize| {
            let t = k as f64;
            offset + Vec3::new((t * 0.37).sin(), (t * 1.7).cos() * 1e-3, t.sin()) * 4e-3
        };
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for k in 0..200u32 {
            let first = positions.len() as u32;
            positions.extend((0..4).map(|v| tip(7 * k as usize + v)));
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| first + i);
            triangles.extend([[a, c, b], [a, b, d], [a, d, c], [b, c, d]]);
        }
        let soup = TriangleSoup::new(positions, triangles).unwrap();
        let closure = Closure::of(&soup);
        assert!(closure.is_empty());
        let lattice = Lattice::with_counts(soup.bounds(), [20, 20, 20]).unwrap();
        let scan = Scan::new(Facets { soup: &soup, closure: &closure }, 0..soup.len(), &lattice);
        let mut slab = Slab::default();
        for s in 0..scan.slabs() {
            scan.count(s, &mut slab);
            for (index, crossings) in slab.crossings.iter().enumerate() {
                let mut sample = lattice.sample(index);
                sample[2] += SLAB_PLANES * s;
                let q = lattice.point(sample);
                let exact: Sign = (0..soup.len()).map(|t| crossing(q, soup.corners(t))).sum();
                assert_eq!(*crossings, exact, "{q}");
            }
        }
    }

    fn crossing(q: Vec3, t: [Vec3; 3]) -> Sign {
        let facing = orient_yz(t[0], t[1], t[2]);
        let is_before = crate::math::perturbed_side_of_plane(q, t) == facing;
        if covers(q, t) && is_before { -facing } else { 0 }
    }
}
