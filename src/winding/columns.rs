//! The triangles of a soup and its closure above each square of a grid over the yz plane, for rays along x.
//!
//! Space is measured in steps, 2¹⁶ of them along each side of the bounds. The step of a point never falls when its
//! coordinate rises, so a triangle whose steps are all above or all below those of a query cannot meet it: boxes in whole
//! steps, or in 256ths of a column, reject most triangles before their corners are fetched, and never one too many.
use super::buckets::Buckets;
use super::facets::Facets;
use crate::math::{Aabb, Vec3};
use std::ops::RangeInclusive;

/// Steps along a side, as a power of two.
pub const STEP_BITS: u32 = 16;
const LAST_STEP: f64 = ((1 << STEP_BITS) - 1) as f64;
/// Adding it rounds to an integer, which is left in the lowest bits.
const ROUND: f64 = 1.5 * (1u64 << 52) as f64;
/// In steps: boxes are widened by it, to be safe from rounding (of some 1e-10 steps).
const MARGIN: f64 = 5e-4;
/// Bound of the rounding error of a product of two differences of coordinates in steps, 16 ε · 2³², with a margin.
const PRODUCT_ERROR: f64 = 1e-4;
/// A plane whose height above the yz plane is known worse than that, in steps, does not narrow a box.
const HEIGHT_ERROR: f64 = 0.5;
/// Where planes are steeper than that, their height at a column says nothing.
const STEEP: f64 = 1e6;
/// Entries that a triangle may cost on average.
const ENTRIES_PER_FACET: usize = 8;
/// Fewest columns along a side, as a power of two.
pub const FEWEST: u32 = 2;

/// Measures points in steps.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    origin: Vec3,
    /// Steps per unit of length.
    density: Vec3,
}

impl Steps {
    pub fn new(bounds: Aabb) -> Steps {
        let longest = bounds.size().max_element();
        let size = bounds.size().max(Vec3::splat(longest * 1e-3)).max(Vec3::splat(1e-300));
        Steps { origin: bounds.min, density: (LAST_STEP + 1.0) / size }
    }

    /// Steps from the lowest corner of the bounds, with fractions.
    #[inline(always)]
    pub fn local(&self, q: Vec3) -> Vec3 {
        (q - self.origin) * self.density
    }

    /// A point of the given steps, with fractions.
    pub fn point(&self, steps: Vec3) -> Vec3 {
        self.origin + steps / self.density
    }

    /// The length of so many steps.
    pub fn length(&self, steps: f64) -> Vec3 {
        steps / self.density
    }

    /// The step that holds each coordinate, the nearest one for points beyond the ends.
    #[inline]
    pub fn of(&self, q: Vec3) -> [u32; 3] {
        self.local(q).to_array().map(step)
    }
}

/// The whole step of a coordinate; 0 for NaN.
#[inline(always)]
pub fn step(coordinate: f64) -> u32 {
    let low = if coordinate > 0.5 { coordinate - 0.5 } else { 0.0 };
    let bounded = if low < LAST_STEP { low } else { LAST_STEP };
    (bounded + ROUND).to_bits() as u32
}

/// The steps between two coordinates; all of them where these are not numbers.
fn steps_between(low: f64, high: f64) -> RangeInclusive<u32> {
    let high = if high < LAST_STEP { high } else { LAST_STEP };
    step(low - MARGIN)..=step(high + MARGIN)
}

/// A triangle above a column: where its part there lies.
#[derive(Clone, Copy, Debug, Default)]
pub struct Entry {
    pub facet: u32,
    /// First and last step along x.
    pub x: [u16; 2],
    /// First and last 256th of the column.
    pub y: [u8; 2],
    pub z: [u8; 2],
}

/// Columns and what is above them.
pub struct Columns {
    /// Columns along a side, as a power of two.
    bits: u32,
    /// Where the entries of each column begin, y fastest.
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

impl Columns {
    /// 2^`bits` columns along a side, or fewer where triangles would be above too many.
    pub fn new(facets: Facets, steps: &Steps, mut bits: u32) -> Columns {
        loop {
            let count = 1usize << (2 * bits);
            let found: Buckets<Entry> = Buckets::collect(facets.len(), count, |facet, put| {
                let corners = facets.corners(facet).map(|p| steps.local(p));
                for_each_column(facet as u32, &corners, bits, &mut *put);
            });
            if found.len() > ENTRIES_PER_FACET * facets.len() && bits > FEWEST {
                bits -= 1;
                continue;
            }
            let mut columns = Columns {
                bits,
                starts: Vec::with_capacity(count + 1),
                entries: Vec::with_capacity(found.len()),
            };
            for column in 0..count {
                columns.starts.push(columns.entries.len() as u32);
                columns.entries.extend(found.bucket(column));
            }
            columns.starts.push(columns.entries.len() as u32);
            return columns;
        }
    }

    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// The entries of the column at (y, z), counted in columns.
    #[inline]
    pub fn at(&self, y: usize, z: usize) -> &[Entry] {
        let column = (z << self.bits) + y;
        &self.entries[self.starts[column] as usize..self.starts[column + 1] as usize]
    }

    /// The column that holds a point of those steps along y and z, and the 256ths of it in which the point lies.
    #[inline]
    pub fn square(&self, [y, z]: [u32; 2]) -> ([usize; 2], [u8; 2]) {
        let width = STEP_BITS - self.bits;
        ([(y >> width) as usize, (z >> width) as usize], [y, z].map(|c| (c >> (width - 8)) as u8))
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.entries[..]) + size_of_val(&self.starts[..])
    }
}

/// Which columns a triangle is above, and where.
fn for_each_column(facet: u32, corners: &[Vec3; 3], bits: u32, mut found: impl FnMut(usize, Entry)) {
    let [a, b, c] = *corners;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let plane = Plane::new(corners, high - low);
    let width = STEP_BITS - bits;
    let within = |steps: &RangeInclusive<u32>, column: u32| {
        let (first, last) = (column << width, ((column + 1) << width) - 1);
        [*steps.start().max(&first), *steps.end().min(&last)].map(|s| (s >> (width - 8)) as u8)
    };
    let rows = steps_between(low.z, high.z);
    let is_narrow = rows.start() >> width == rows.end() >> width;
    for k in rows.start() >> width..=rows.end() >> width {
        let (z0, z1) = (f64::from(k << width), f64::from((k + 1) << width));
        let span = if is_narrow { (low.y, high.y) } else { span_between(corners, z0 - MARGIN, z1 + MARGIN) };
        let (z0, z1) = (z0.max(low.z), z1.min(high.z));
        let squares = steps_between(span.0, span.1);
        for j in squares.start() >> width..=squares.end() >> width {
            let (y0, y1) = (f64::from(j << width).max(span.0), f64::from((j + 1) << width).min(span.1));
            let [x0, x1] = plane.between([y0, y1], [z0, z1]);
            let x = steps_between(if x0 > low.x { x0 } else { low.x }, if x1 < high.x { x1 } else { high.x });
            // In bounds that are 10³⁰ times longer than the triangle rounding may leave nothing between the two.
            let x = if x.is_empty() { steps_between(low.x, high.x) } else { x };
            let x = [*x.start() as u16, *x.end() as u16];
            let column = ((k << bits) + j) as usize;
            found(column, Entry { facet, x, y: within(&squares, j), z: within(&rows, k) });
        }
    }
}

/// The plane of a triangle as a height x over the yz plane.
struct Plane {
    corner: Vec3,
    slopes: [f64; 2],
    /// Bound of the error of a height; infinite where the plane is too steep or the triangle too thin to tell.
    error: f64,
}

impl Plane {
    fn new([a, b, c]: &[Vec3; 3], size: Vec3) -> Plane {
        let normal = (*b - *a).cross(*c - *a);
        let slopes = [-normal.y / normal.x, -normal.z / normal.x];
        let error = PRODUCT_ERROR * (size.x + size.y + size.z) / (normal.x.abs() - PRODUCT_ERROR);
        let is_known =
            (0.0..HEIGHT_ERROR).contains(&error) && slopes[0].abs() < STEEP && slopes[1].abs() < STEEP;
        Plane { corner: *a, slopes, error: if is_known { error + MARGIN } else { f64::INFINITY } }
    }

    /// Lowest and highest x over a rectangle.
    fn between(&self, [y0, y1]: [f64; 2], [z0, z1]: [f64; 2]) -> [f64; 2] {
        if self.error.is_infinite() {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        let middle = self.corner.x
            + self.slopes[0] * (0.5 * (y0 + y1) - self.corner.y)
            + self.slopes[1] * (0.5 * (z0 + z1) - self.corner.z);
        // The rectangle is widened by a margin too.
        let half = |low: f64, high: f64| 0.5 * (high - low).abs() + MARGIN;
        let spread = self.slopes[0].abs() * half(y0, y1) + self.slopes[1].abs() * half(z0, z1) + self.error;
        [middle - spread, middle + spread]
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
