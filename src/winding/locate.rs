//! The exact integer part at scattered points: crossings of a ray along −x.
//!
//! Columns of a square grid over the yz plane list the triangles above them; cells of a cubic grid that no triangle comes
//! near carry the crossings of their middle, which hold for the whole cell.
use super::buckets::Buckets;
use super::facets::{Facets, Role};
use super::scan::{Scan, Slab};
use crate::data::{Lattice, map_items, map_parts, map_tasks};
use crate::math::{Aabb, Vec3, covers, orient_yz, perturbed_side_of_plane, touches};

/// Most and fewest cells along a side. On the bunny 128 answers fastest: 256³ bytes no longer stay in the caches.
const SIDES: std::ops::RangeInclusive<usize> = 4..=128;
/// Bytes of cells that a triangle may cost.
const CELL_BYTES_PER_FACET: usize = 32;
/// Entries of columns that a triangle may cost on average.
const ENTRIES_PER_FACET: usize = 8;
/// Cells are widened by this share of their size, to be safe from rounding.
const MARGIN: f64 = 1e-6;
/// In the place of the crossings: a triangle comes near the cell.
const MIXED: i8 = i8::MIN;

/// An index of the triangles of a soup and its closure for rays along x.
pub struct Locator {
    origin: Vec3,
    /// Cells per unit of length.
    density: Vec3,
    side: usize,
    columns_side: usize,
    bounds: Aabb,
    /// Where the entries of each column begin.
    starts: Vec<u32>,
    entries: Vec<u32>,
    cells: Vec<i8>,
}

/// What a ray from a point along −x meets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Location {
    /// Signed crossings of the surface and, if wanted, of the caps.
    pub crossings: i32,
    /// Triangles of the soup that the point lies on.
    pub touching: Vec<u32>,
}

/// Which squares of a grid of `side`² over the yz plane, and which span along x there, a triangle covers.
fn for_each_square(
    corners: &[Vec3; 3],
    origin: Vec3,
    density: Vec3,
    side: usize,
    mut found: impl FnMut(usize, usize, [f64; 2]),
) {
    let local = corners.map(|p| (p - origin) * density);
    let (low, high) = (local[0].min(local[1]).min(local[2]), local[0].max(local[1]).max(local[2]));
    let last = side as f64 - 1.0;
    let cells = |low: f64, high: f64| {
        let bounded = |c: f64| c.floor().clamp(0.0, last) as usize;
        bounded(low - MARGIN)..bounded(high + MARGIN) + 1
    };
    let normal = (local[1] - local[0]).cross(local[2] - local[0]);
    let slopes = [-normal.y / normal.x, -normal.z / normal.x];
    let is_steep = !(slopes[0].abs() < 1e6 && slopes[1].abs() < 1e6);
    for k in cells(low.z, high.z) {
        let (z0, z1) = (k as f64 - MARGIN, (k + 1) as f64 + MARGIN);
        let (y0, y1) = span_between(&local, z0, z1);
        for j in cells(y0, y1) {
            let spread = 0.5 * (slopes[0].abs() + slopes[1].abs()) + 1e-3;
            let middle = local[0].x
                + slopes[0] * (j as f64 + 0.5 - local[0].y)
                + slopes[1] * (k as f64 + 0.5 - local[0].z);
            let x = if is_steep {
                [low.x, high.x]
            } else {
                [low.x.max(middle - spread), high.x.min(middle + spread)]
            };
            found(j, k, x);
        }
    }
}

/// The extent along y of the part of a triangle between two heights.
fn span_between(corners: &[Vec3; 3], z0: f64, z1: f64) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut take = |y: f64| (low, high) = (low.min(y), high.max(y));
    for k in 0..3 {
        let (s, t) = (corners[k], corners[(k + 1) % 3]);
        if z0 <= s.z && s.z <= z1 {
            take(s.y);
        }
        for z in [z0, z1] {
            if (s.z < z) != (t.z < z) {
                take(s.y + (z - s.z) / (t.z - s.z) * (t.y - s.y));
            }
        }
    }
    (low, high)
}

impl Locator {
    pub fn new(facets: Facets, bounds: Aabb) -> Locator {
        let longest = bounds.size().max_element();
        let origin = bounds.min;
        let mut side = *SIDES.start();
        while side < *SIDES.end() && (2 * side).pow(3) <= CELL_BYTES_PER_FACET * facets.len() {
            side *= 2;
        }
        let size = bounds.size().max(Vec3::splat(longest.max(f64::MIN_POSITIVE) * 1e-3));
        let mut locator = Locator {
            origin,
            density: Vec3::splat(side as f64) / size,
            side,
            columns_side: side,
            bounds,
            starts: vec![0; side * side + 1],
            entries: vec![],
            cells: vec![MIXED; side * side * side],
        };
        if !bounds.is_empty() {
            locator.fill_columns(facets);
            locator.fill_cells(facets);
        }
        locator
    }

    fn fill_columns(&mut self, facets: Facets) {
        loop {
            let side = self.columns_side;
            let density = self.density * (side as f64 / self.side as f64);
            let columns: Buckets<u32> = Buckets::collect(facets.len(), side * side, |facet, put| {
                for_each_square(&facets.corners(facet), self.origin, density, side, |j, k, _| {
                    put(k * side + j, facet as u32);
                });
            });
            let total: usize = columns.len();
            if total > ENTRIES_PER_FACET * facets.len() && side > *SIDES.start() {
                self.columns_side = side / 2;
                continue;
            }
            let lists: Vec<Vec<u32>> = map_items(side * side, |c| columns.bucket(c).collect());
            self.starts = std::iter::once(0)
                .chain(lists.iter().scan(0, |sum, list| {
                    *sum += list.len() as u32;
                    Some(*sum)
                }))
                .collect();
            self.entries = lists.concat();
            return;
        }
    }

    fn fill_cells(&mut self, facets: Facets) {
        let side = self.side;
        let spacing = 1.0 / self.density;
        let lattice = Lattice { origin: self.origin + 0.5 * spacing, spacing, counts: [side, side, side] };
        let scan = Scan::new(facets, 0..facets.len(), &lattice);
        let slab_cells = side * side * super::scan::SLAB_PLANES;
        map_parts(&mut self.cells, slab_cells, |s, cells| {
            let mut slab = Slab::default();
            scan.count(s, &mut slab);
            for (cell, crossings) in cells.iter_mut().zip(&slab.crossings) {
                *cell = i8::try_from(*crossings).unwrap_or(MIXED);
            }
        });
        let mixed: Vec<Vec<u32>> = map_tasks(facets.len().div_ceil(4096), |chunk| {
            let mut found = Vec::new();
            for facet in 4096 * chunk..facets.len().min(4096 * (chunk + 1)) {
                let corners = facets.corners(facet);
                for_each_square(&corners, self.origin, self.density, side, |j, k, [low, high]| {
                    let bounded = |c: f64| c.floor().clamp(0.0, side as f64 - 1.0) as usize;
                    for i in bounded(low - 1e-3)..=bounded(high + 1e-3) {
                        found.push(((k * side + j) * side + i) as u32);
                    }
                });
            }
            found
        });
        mixed.into_iter().flatten().for_each(|cell| self.cells[cell as usize] = MIXED);
    }

    /// The cell that holds a point of the bounds.
    #[inline]
    pub fn cell(&self, q: Vec3) -> Option<usize> {
        let last = Vec3::splat(self.side as f64 - 1.0);
        let cell = ((q - self.origin) * self.density).min(last);
        let index = || (cell.z as usize * self.side + cell.y as usize) * self.side + cell.x as usize;
        self.bounds.contains(q).then(index)
    }

    /// The crossings of the surface and the caps at a point that no triangle is near; none elsewhere.
    #[inline]
    pub fn at_a_glance(&self, q: Vec3) -> Option<i32> {
        let crossings = self.cell(q).map_or(0, |cell| self.cells[cell]);
        (crossings != MIXED).then_some(i32::from(crossings))
    }

    /// One answer for each cell, `unknown` where there is none: `decide(center, radius)` is asked for ever smaller blocks
    /// of cells until it answers for all of a ball around the block.
    pub fn subdivide(&self, unknown: i8, decide: impl Fn(Vec3, f64) -> Option<i8> + Sync) -> Vec<i8> {
        const TOP: usize = 16;
        let block = TOP.min(self.side);
        let blocks = self.side / block;
        let tops = map_tasks(blocks * blocks * blocks, |top| {
            let at = [top % blocks, top / blocks % blocks, top / (blocks * blocks)].map(|c| c * block);
            let mut answers = vec![unknown; block * block * block];
            self.descend(at, at, block, block, &decide, &mut answers);
            answers
        });
        let mut cells = vec![unknown; self.cells.len()];
        for (cell, answer) in cells.iter_mut().enumerate() {
            let at = [cell % self.side, cell / self.side % self.side, cell / (self.side * self.side)];
            let [tx, ty, tz] = at.map(|c| c / block);
            let [x, y, z] = at.map(|c| c % block);
            *answer = tops[(tz * blocks + ty) * blocks + tx][(z * block + y) * block + x];
        }
        cells
    }

    fn descend(
        &self,
        top: [usize; 3],
        at: [usize; 3],
        side: usize,
        block: usize,
        decide: &impl Fn(Vec3, f64) -> Option<i8>,
        answers: &mut [i8],
    ) {
        let first = Vec3::from_array(at.map(|c| c as f64));
        let half = Vec3::splat(0.5 * side as f64);
        let center = self.origin + (first + half) / self.density;
        let radius = (half / self.density).length() * (1.0 + MARGIN);
        if let Some(answer) = decide(center, radius) {
            for k in 0..side * side * side {
                let [x, y, z] = [k % side, k / side % side, k / (side * side)];
                let local = [at[0] - top[0] + x, at[1] - top[1] + y, at[2] - top[2] + z];
                answers[(local[2] * block + local[1]) * block + local[0]] = answer;
            }
        } else if side > 1 {
            let half = side / 2;
            for k in 0..8usize {
                let corner = [at[0] + (k & 1) * half, at[1] + (k >> 1 & 1) * half, at[2] + (k >> 2) * half];
                self.descend(top, corner, half, block, decide, answers);
            }
        }
    }

    /// Crossings of the ray from `q`, by exact predicates, and the triangles that `q` lies on.
    pub fn locate(&self, facets: Facets, q: Vec3, with_caps: bool) -> Location {
        let mut location = Location::default();
        // Beyond the largest x the ray still crosses all that lies on its way.
        if !self.bounds.contains(q.with_x(q.x.min(self.bounds.max.x))) {
            return location;
        }
        let side = self.columns_side;
        let density = self.density * (side as f64 / self.side as f64);
        let square = ((q - self.origin) * density).min(Vec3::splat(side as f64 - 1.0));
        let column = square.z as usize * side + square.y as usize;
        for &facet in &self.entries[self.starts[column] as usize..self.starts[column + 1] as usize] {
            let corners = facets.corners(facet as usize);
            let [a, b, c] = corners;
            if q.x < a.x.min(b.x).min(c.x) {
                continue;
            }
            let role = facets.role(facet as usize);
            if role != Role::Cap && Aabb::around(corners).contains(q) && touches(q, corners) {
                location.touching.push(facet);
            }
            if role == Role::Surface || role == Role::Cap && with_caps {
                location.crossings += crossing(q, corners);
            }
        }
        location
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.cells.len() + size_of_val(&self.entries[..]) + size_of_val(&self.starts[..])
    }
}

/// The sign with which the ray from q' along −x crosses a triangle; 0 if it does not.
#[inline]
fn crossing(q: Vec3, corners: [Vec3; 3]) -> i32 {
    let [a, b, c] = corners;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    if q.y < low.y || q.y > high.y || q.z < low.z || q.z > high.z || !covers(q, corners) {
        return 0;
    }
    let facing = orient_yz(a, b, c);
    if q.x > high.x || perturbed_side_of_plane(q, corners) == facing { -facing } else { 0 }
}
