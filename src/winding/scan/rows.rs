//! Where triangles cross the rows of a slab, and which samples they touch.
use super::{Axis, Slab, extent};
use crate::math::{Sign, Vec3, covers, orient_yz, side_of_plane, tie_break, touches};
use crate::winding::facets::Role;
use std::ops::Range;

/// The rows of a slab.
pub(super) struct Rows<'a> {
    pub axes: &'a [Axis; 3],
    pub planes: Range<usize>,
    pub result: &'a mut Slab,
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

    pub fn add(&mut self, corners: [Vec3; 3], role: Role) {
        let facing = orient_yz(corners[0], corners[1], corners[2]);
        if facing == 0 {
            if role != Role::Cap {
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
