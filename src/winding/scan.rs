//! The exact integer part on a lattice: signed crossings along its rows.
//!
//! A row is a ray along x. Each triangle that covers the row in projection adds its sign at the first sample beyond it; a
//! running sum along the row counts, at each sample, the crossings of the ray from there along −x. Floating point decides
//! where its error bound allows, exact predicates elsewhere: each crossing of an edge or a vertex counts once.
use super::buckets::Buckets;
use super::facets::{Facets, Role};
use crate::data::Lattice;
use crate::math::{Sign, Vec3, covers, normal_signs, orient_yz, side_of_plane, tie_break, touches};
use std::ops::Range;

/// Planes of a slab: eight, so that the bits of its samples fill whole bytes.
pub const SLAB_PLANES: usize = 8;

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

/// The rows of a slab.
struct Rows<'a> {
    axes: &'a [Axis; 3],
    planes: Range<usize>,
    result: &'a mut Slab,
}

/// A triangle whose projection to the yz plane has an area.
struct Facet {
    corners: [Vec3; 3],
    low: Vec3,
    high: Vec3,
    /// Of the normal's x component.
    facing: Sign,
    role: Role,
    /// x = corners[0].x + slopes · ((y, z) − corners[0]).
    slopes: [f64; 2],
    /// Bound of the rounding error of that x, and of the ends of a row on the triangle.
    x_error: f64,
    y_error: f64,
}

impl Facet {
    fn new(corners: [Vec3; 3], facing: Sign, role: Role) -> Facet {
        let (low, high) = extent(&corners);
        let [a, b, c] = corners;
        let (u, v) = (b - a, c - a);
        let normal = u.cross(v);
        let permanent = |i: usize, j: usize| (u[i] * v[j]).abs() + (u[j] * v[i]).abs();
        let (px, py, pz) = (permanent(1, 2), permanent(2, 0), permanent(0, 1));
        let size = high - low;
        const ERROR: f64 = 16.0 * f64::EPSILON;
        let safe = normal.x.abs() - ERROR * px;
        let largest = low.abs().max(high.abs());
        let x_error = if safe > 0.0 {
            ERROR * (py * size.y + pz * size.z + px * size.x) / safe + ERROR * largest.x
        } else {
            f64::INFINITY
        };
        let slopes = [-normal.y / normal.x, -normal.z / normal.x];
        let y_error = ERROR * (largest.y + size.y);
        Facet { corners, low, high, facing, role, slopes, x_error, y_error }
    }

    /// Where the projection meets the line at `z`, along y.
    fn span(&self, z: f64) -> (f64, f64) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in 0..3 {
            let (s, t) = (self.corners[k], self.corners[(k + 1) % 3]);
            let (s, t) = if s.z <= t.z { (s, t) } else { (t, s) };
            if s.z <= z && z <= t.z {
                let ends =
                    if s.z == t.z { [s.y, t.y] } else { [s.y + (z - s.z) / (t.z - s.z) * (t.y - s.y); 2] };
                low = low.min(ends[0]).min(ends[1]);
                high = high.max(ends[0]).max(ends[1]);
            }
        }
        (low, high)
    }

    /// Whether the plane of the triangle lies before q' on its row.
    fn is_before(&self, side: Sign) -> bool {
        let side = if side == 0 { tie_break(self.corners) } else { side };
        side == self.facing
    }
}

impl Rows<'_> {
    fn index(&self, i: usize, j: usize, k: usize) -> usize {
        ((k - self.planes.start) * self.axes[1].count + j) * self.axes[0].count + i
    }

    fn point(&self, i: usize, j: usize, k: usize) -> Vec3 {
        Vec3::new(self.axes[0].at(i), self.axes[1].at(j), self.axes[2].at(k))
    }

    fn planes_of(&self, low: f64, high: f64) -> Range<usize> {
        let all = self.axes[2].range(low, high);
        all.start.max(self.planes.start)..all.end.min(self.planes.end)
    }

    fn add(&mut self, corners: [Vec3; 3], role: Role) {
        let facing = orient_yz(corners[0], corners[1], corners[2]);
        if facing == 0 {
            if role != Role::Cap && normal_signs(corners) != [0; 3] {
                self.mark_upright(corners);
            }
            return;
        }
        let facet = Facet::new(corners, facing, role);
        for k in self.planes_of(facet.low.z, facet.high.z) {
            let z = self.axes[2].at(k);
            let (low, high) = facet.span(z);
            // On its lowest or highest line a triangle may have an edge along all of the row.
            let is_between = facet.low.z < z && z < facet.high.z;
            for j in self.axes[1].range(low - facet.y_error, high + facet.y_error) {
                let y = self.axes[1].at(j);
                let is_inside = is_between && low + facet.y_error < y && y < high - facet.y_error;
                self.cross(&facet, j, k, is_inside);
            }
        }
    }

    /// Adds the crossing of a row, if there is one: `is_inside` if the row is known to pass through the inside of the
    /// triangle's projection.
    fn cross(&mut self, facet: &Facet, j: usize, k: usize, is_inside: bool) {
        let [x_axis, y_axis, z_axis] = self.axes;
        let (y, z) = (y_axis.at(j), z_axis.at(k));
        let [a, ..] = facet.corners;
        let estimate = a.x + facet.slopes[0] * (y - a.y) + facet.slopes[1] * (z - a.z);
        // NaN where the slopes are not finite: then the whole extent is in doubt.
        let (low, high) = (estimate - facet.x_error, estimate + facet.x_error);
        let low = if low > facet.low.x { low } else { facet.low.x };
        let high = if high < facet.high.x { high } else { facet.high.x };
        let doubtful = x_axis.range(low, high);
        let is_crossed = is_inside || covers(Vec3::new(a.x, y, z), facet.corners);
        if facet.role != Role::Cap && !doubtful.is_empty() {
            self.mark_touching(facet, doubtful.clone(), j, k, is_inside);
        }
        if facet.role == Role::Loose || !is_crossed {
            return;
        }
        let first = if doubtful.is_empty() {
            doubtful_start(x_axis, high)
        } else {
            first_beyond(facet, doubtful, |i| self.point(i, j, k))
        };
        if first < x_axis.count {
            let index = self.index(first, j, k);
            self.result.crossings[index] -= facet.facing;
        }
    }

    /// Marks the samples of a row that lie on the triangle; at most one of them lies on its plane.
    fn mark_touching(&mut self, facet: &Facet, doubtful: Range<usize>, j: usize, k: usize, is_inside: bool) {
        let first = first_beyond(facet, doubtful.clone(), |i| self.point(i, j, k));
        for i in [first.wrapping_sub(1), first] {
            if !doubtful.contains(&i) {
                continue;
            }
            let q = self.point(i, j, k);
            let is_on =
                if is_inside { side_of_plane(q, facet.corners) == 0 } else { touches(q, facet.corners) };
            if is_on {
                let index = self.index(i, j, k);
                self.result.on_surface.push(index as u32);
            }
        }
    }

    /// Marks the samples that lie on a triangle parallel to the rows.
    fn mark_upright(&mut self, corners: [Vec3; 3]) {
        let facet = Facet::new(corners, 1, Role::Surface);
        for k in self.planes_of(facet.low.z, facet.high.z) {
            let (low, high) = facet.span(self.axes[2].at(k));
            for j in self.axes[1].range(low - facet.y_error, high + facet.y_error) {
                let row = self.point(0, j, k);
                // The projection is a segment: two of its three sides span it.
                let off_line = (0..3).any(|s| orient_yz(corners[s], corners[(s + 1) % 3], row) != 0);
                if off_line {
                    continue;
                }
                for i in self.axes[0].range(facet.low.x, facet.high.x) {
                    if touches(self.point(i, j, k), corners) {
                        let index = self.index(i, j, k);
                        self.result.on_surface.push(index as u32);
                    }
                }
            }
        }
    }
}

/// The first sample beyond `x`, of which no sample is in doubt.
fn doubtful_start(axis: &Axis, x: f64) -> usize {
    if axis.spacing <= 0.0 {
        return if axis.origin > x { 0 } else { axis.count };
    }
    ((x - axis.origin) / axis.spacing).ceil().clamp(0.0, axis.count as f64) as usize
}

/// The first sample of a row that lies beyond the plane of a triangle; by bisection of those in doubt.
fn first_beyond(facet: &Facet, doubtful: Range<usize>, point: impl Fn(usize) -> Vec3) -> usize {
    let (mut low, mut high) = (doubtful.start, doubtful.end);
    while low < high {
        let middle = (low + high) / 2;
        if facet.is_before(side_of_plane(point(middle), facet.corners)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::TriangleSoup;
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
