//! The exact integer part at scattered points: crossings of a ray along −x.
//!
//! Cells of a grid that no triangle comes near carry the crossings of all their points. A ray from another cell ends in
//! the first such cell that it reaches: what lies beyond is counted there. Between the two it meets the few triangles
//! above its column (see [`super::columns`]) whose part there is neither beyond that cell nor ahead of the query.
use super::columns::{Columns, FEWEST, STEP_BITS, Steps, step};
use super::facets::{Facets, Role};
use crate::data::{BLOCK, map_parts};
use crate::math::{Aabb, Vec3, meet};
use std::ops::{Range, RangeInclusive};

/// Fewest and most cells along a side, as powers of two. On the bunny 128 cells answer fastest: 256³ bytes no longer stay
/// in the caches.
const BITS: RangeInclusive<u32> = FEWEST..=7;
/// Bytes of cells that a triangle may cost.
const CELL_BYTES_PER_FACET: usize = 32;
/// In the place of the crossings: triangles come near the cell, of the surface, of the caps, or of both.
const SURFACE: i8 = -128;
const CAP: i8 = -127;
const BOTH: i8 = -126;
/// More crossings than that do not fit beside the codes of cells.
const CROSSINGS: RangeInclusive<i32> = -60..=120;
/// Codes from here on are crossings.
pub const FIRST_KNOWN: i8 = -60;

/// An index of the triangles of a soup and its closure for rays along x.
pub struct Locator {
    steps: Steps,
    bounds: Aabb,
    /// Cells along a side, as a power of two.
    bits: u32,
    columns: Columns,
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

/// What comes near a block of cells.
#[derive(Clone, Copy, Debug, Default)]
pub struct Near {
    pub surface: bool,
    pub caps: bool,
}

impl Locator {
    pub fn new(facets: Facets, bounds: Aabb) -> Locator {
        let mut bits = *BITS.start();
        while bits < *BITS.end() && 1usize << (3 * (bits + 1)) <= CELL_BYTES_PER_FACET * facets.len() {
            bits += 1;
        }
        let steps = Steps::new(bounds);
        let columns = Columns::new(facets, &steps, bits);
        let mut locator = Locator { steps, bounds, bits, columns, cells: vec![] };
        let mut cells = vec![0; 1 << (3 * bits)];
        map_parts(&mut cells, 1 << (2 * bits), |k, plane| {
            locator.mark(facets, k, plane);
            locator.count(facets, k, plane);
        });
        locator.cells = cells;
        locator
    }

    /// Cells along a side.
    pub fn side(&self) -> usize {
        1 << self.bits
    }

    pub fn cells(&self) -> &[i8] {
        &self.cells
    }

    /// The middle of a block of cells, and half the size of the block.
    pub fn middle(&self, first: [usize; 3], side: usize) -> (Vec3, Vec3) {
        let width = f64::from(1u32 << self.shift());
        let half = 0.5 * side as f64;
        let middle = Vec3::from_array(first.map(|c| c as f64 + half));
        (self.steps.point(width * middle), self.steps.length(width * half))
    }

    /// Whether triangles of the surface and of the caps come near a block of cells.
    pub fn near(&self, first: [usize; 3], side: usize) -> Near {
        let mut near = Near::default();
        for k in 0..side * side {
            let row = ((first[2] + k / side) << self.bits) + first[1] + k % side;
            let row = &self.cells[(row << self.bits) + first[0]..][..side];
            near.surface |= row.iter().fold(false, |any, code| any | (*code == SURFACE) | (*code == BOTH));
            near.caps |= row.iter().fold(false, |any, code| any | (*code == CAP) | (*code == BOTH));
        }
        near
    }

    fn shift(&self) -> u32 {
        STEP_BITS - self.bits
    }

    /// Marks the cells of a plane that triangles come near.
    fn mark(&self, facets: Facets, k: usize, plane: &mut [i8]) {
        // Columns may be wider than cells.
        let finer = self.bits - self.columns.bits();
        let parts = |range: [u8; 2]| range.map(|p| usize::from(p) >> (8 - finer));
        let part = k & ((1 << finer) - 1);
        for column in 0..1 << self.columns.bits() {
            for entry in self.columns.at(column, k >> finer) {
                let ([y0, y1], [z0, z1]) = (parts(entry.y), parts(entry.z));
                if part < z0 || z1 < part {
                    continue;
                }
                let [x0, x1] = entry.x.map(|x| usize::from(x) >> self.shift());
                let is_cap = facets.role(entry.facet as usize) == Role::Cap;
                for y in y0..=y1 {
                    let row = ((column << finer) + y) << self.bits;
                    for cell in &mut plane[row + x0..=row + x1] {
                        *cell = match (*cell, is_cap) {
                            (0 | CAP, true) => CAP,
                            (0 | SURFACE, false) => SURFACE,
                            _ => BOTH,
                        };
                    }
                }
            }
        }
    }

    /// Counts the crossings at the other cells of a marked plane.
    fn count(&self, facets: Facets, k: usize, plane: &mut [i8]) {
        let side = self.side();
        for j in 0..side {
            let (before, rest) = plane.split_at_mut(j * side);
            let (row, below) = (&mut rest[..side], before.chunks_exact(side).next_back());
            let mut last = None;
            let mut start = 0;
            while let Some(run) = next_run(row, start) {
                start = run.end;
                // Neighbours without a triangle between them have the same crossings; outside of the bounds there are none.
                let beside = below.and_then(|below| below[run.clone()].iter().find(|c| **c >= FIRST_KNOWN));
                let is_outermost = run.start == 0 || run.end == side || j == 0 || k == 0 || k + 1 == side;
                let code = match beside {
                    _ if is_outermost => 0,
                    Some(code) => *code,
                    None => self.code(facets, [run.start, j, k], last),
                };
                row[run.clone()].fill(code);
                last = Some((run.end - 1, code)).filter(|_| code >= FIRST_KNOWN).or(last);
            }
        }
    }

    /// The crossings in the middle of a cell, given those at an earlier cell of its row.
    fn code(&self, facets: Facets, cell: [usize; 3], earlier: Option<(usize, i8)>) -> i8 {
        let middle = Vec3::from_array(cell.map(|c| c as f64 + 0.5)) * f64::from(1u32 << self.shift());
        let q = self.steps.point(middle);
        let at = self.steps.of(q);
        if at.map(|s| (s >> self.shift()) as usize) != cell {
            return SURFACE; // no number lies in the cell: its coordinates are too large for its size
        }
        let crossings = self.meet_all(facets, q, at, self.end_of_ray(earlier), true).crossings;
        if CROSSINGS.contains(&crossings) { crossings as i8 } else { SURFACE }
    }

    /// The last step of a cell at which a ray ends, and the crossings there.
    fn end_of_ray(&self, cell: Option<(usize, i8)>) -> (i32, i32) {
        cell.map_or((-1, 0), |(cell, crossings)| {
            ((((cell + 1) << self.shift()) - 1) as i32, i32::from(crossings))
        })
    }

    #[inline]
    fn cell_of(&self, [x, y, z]: [u32; 3]) -> usize {
        let [x, y, z] = [x, y, z].map(|c| (c >> self.shift()) as usize);
        (((z << self.bits) + y) << self.bits) + x
    }

    /// The square of the distance of a point from the bounds.
    pub fn distance_squared(&self, q: Vec3) -> f64 {
        let bounds = &self.bounds;
        if bounds.is_empty() { 0.0 } else { q.distance_squared(q.max(bounds.min).min(bounds.max)) }
    }

    /// The cell that holds a point of the bounds.
    #[inline]
    pub fn cell(&self, q: Vec3) -> Option<usize> {
        self.bounds.contains(q).then(|| self.cell_of(self.steps.of(q)))
    }

    /// The crossings of the surface and the caps at a point that no triangle is near; none elsewhere.
    #[inline]
    pub fn at_a_glance(&self, q: Vec3) -> Option<i32> {
        let crossings = self.cell(q).map_or(0, |cell| self.cells[cell]);
        (crossings >= FIRST_KNOWN).then_some(i32::from(crossings))
    }

    /// Answers `code >= least` where a table has a known code for the cell of a point, `outside` beyond all cells, and
    /// gives the others to `open` by number.
    #[inline]
    pub fn glance(
        &self,
        points: &[Vec3],
        (table, outside): (&[i8], i8),
        least: i8,
        results: &mut [bool],
        mut open: impl FnMut(usize),
    ) {
        // A point of the bounds may be rounded out of them.
        const SLACK: f64 = 1e-3;
        const END: f64 = (1u32 << STEP_BITS) as f64 + SLACK;
        const BEYOND: u32 = u32::MAX;
        let within = |c: f64| (-SLACK..=END).contains(&c);
        for (block, (points, results)) in points.chunks(BLOCK).zip(results.chunks_mut(BLOCK)).enumerate() {
            // Apart from each other, so that many of the look-ups, which miss the caches, wait at the same time.
            let mut cells = [BEYOND; BLOCK];
            for (q, cell) in points.iter().zip(&mut cells) {
                let Vec3 { x, y, z } = self.steps.local(*q);
                if within(x) & within(y) & within(z) {
                    *cell = self.cell_of([x, y, z].map(step)) as u32;
                }
            }
            let codes = cells.map(|cell| table.get(cell as usize).copied().unwrap_or(outside));
            for (number, (code, result)) in codes.into_iter().zip(results).enumerate() {
                *result = code >= least;
                if code < FIRST_KNOWN {
                    open(block * BLOCK + number);
                }
            }
        }
    }

    /// Crossings of the ray from `q`, by exact predicates, and the triangles that `q` lies on.
    pub fn locate(&self, facets: Facets, q: Vec3, with_caps: bool) -> Location {
        // Beyond the largest x the ray still crosses all that lies on its way.
        if !self.bounds.contains(q.with_x(q.x.min(self.bounds.max.x))) {
            return Location::default();
        }
        let at = self.steps.of(q);
        let cell = self.cell_of(at);
        let row = &self.cells[cell >> self.bits << self.bits..cell];
        // The cells count the caps too.
        let earlier = if with_caps { row.iter().rposition(|c| *c >= FIRST_KNOWN) } else { None };
        let end = self.end_of_ray(earlier.map(|place| (place, row[place])));
        self.meet_all(facets, q, at, end, with_caps)
    }

    /// What a ray meets from `q`, in the steps `at`, to the step `last` where there are `crossings`.
    fn meet_all(
        &self,
        facets: Facets,
        q: Vec3,
        at: [u32; 3],
        (last, crossings): (i32, i32),
        with_caps: bool,
    ) -> Location {
        let mut location = Location { crossings, touching: vec![] };
        let ([column, row], [y, z]) = self.columns.square([at[1], at[2]]);
        for entry in self.columns.at(column, row) {
            let x = i32::from(entry.x[0]);
            let is_near = (last < x) & (x <= at[0] as i32);
            let is_below = (entry.y[0] <= y) & (y <= entry.y[1]) & (entry.z[0] <= z) & (z <= entry.z[1]);
            if !(is_near & is_below) {
                continue;
            }
            let role = facets.role(entry.facet as usize);
            let (crossing, touches) = meet(q, facets.corners(entry.facet as usize));
            if touches && role != Role::Cap {
                location.touching.push(entry.facet);
            }
            if role == Role::Surface || role == Role::Cap && with_caps {
                location.crossings += crossing;
            }
        }
        location
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.cells.len() + self.columns.bytes()
    }
}

/// The first run of cells, from `start` on, that no triangle comes near.
fn next_run(row: &[i8], start: usize) -> Option<Range<usize>> {
    let first = start + row[start..].iter().position(|code| *code == 0)?;
    let length = row[first..].iter().position(|code| *code != 0).unwrap_or(row.len() - first);
    Some(first..first + length)
}
