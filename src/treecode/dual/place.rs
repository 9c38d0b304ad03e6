use super::clusters::Ball;
use super::{GROUPS, QueryBlock, QueryLanes, WIDTH};
use crate::math::{Aabb, Vec3};
use crate::treecode::frame::Frame;
use wide::{f32x4, f64x4};

/// Where a block of queries is, in the tree's unit frame.
#[derive(Clone, Copy)]
pub struct Place {
    pub center: Vec3,
    /// The centre as the sum of two 32-bit floats: near a cluster a single one would lose the direction.
    high: [f32x4; 3],
    low: [f32x4; 3],
    /// Half the edges of the block.
    pub half: Vec3,
    /// A bound of the distance of a query from the centre; never 0, as lengths are measured in it.
    pub radius: f32,
}

/// Queries farther than this in the unit frame get 0: less than 1e-30 of the area, and powers stay within 32-bit floats.
const HORIZON: f64 = 1e15;
const SMALLEST_RADIUS: f64 = 1e-12;

impl Place {
    pub fn new(bounds: &Aabb, frame: &Frame) -> Place {
        let (low, high) = (near(frame, bounds.min), near(frame, bounds.max));
        let half = 0.5 * (high - low);
        Place::around(low + half, half)
    }

    pub fn around(center: Vec3, half: Vec3) -> Place {
        let parts = center.to_array().map(|x| (x as f32, (x - f64::from(x as f32)) as f32));
        // Rounded up by more than the rounding of positions relative to the centre.
        let radius = (half.length() * (1.0 + 1e-6)).max(SMALLEST_RADIUS) as f32;
        Place {
            center,
            high: parts.map(|p| f32x4::splat(p.0)),
            low: parts.map(|p| f32x4::splat(p.1)),
            half,
            radius,
        }
    }

    /// The centre relative to those of four clusters, and their radii.
    #[inline(always)]
    pub fn relative_to(&self, balls: [&Ball; WIDTH]) -> ([f32x4; 3], f32x4) {
        let [a, b, c, d] = balls;
        let rows = [f32x4::from(*a), f32x4::from(*b), f32x4::from(*c), f32x4::from(*d)];
        let [x, y, z, radius] = f32x4::transpose(rows);
        let offset = |axis: usize, c: f32x4| (self.high[axis] - c) + self.low[axis];
        ([offset(0, x), offset(1, y), offset(2, z)], radius)
    }

    /// The centre of a cluster relative to the block's.
    pub fn offset_of(&self, ball: &Ball) -> Vec3 {
        Vec3::new(f64::from(ball[0]), f64::from(ball[1]), f64::from(ball[2])) - self.center
    }
}

fn near(frame: &Frame, p: Vec3) -> Vec3 {
    frame.local(p).clamp(Vec3::splat(-HORIZON), Vec3::splat(HORIZON))
}

/// The queries of a block as the near and the far field want them.
pub struct Block {
    pub queries: QueryBlock,
    /// Positions relative to the block's centre, in units of its radius.
    pub scaled: [QueryLanes; GROUPS],
    /// Queries beyond the horizon, one bit each.
    pub beyond: u64,
}

impl Default for Block {
    fn default() -> Self {
        let queries = QueryBlock {
            positions: [[f64x4::ZERO; 3]; GROUPS],
            center: Vec3::ZERO,
            offsets: [[f32x4::ZERO; 3]; GROUPS],
            scale: 1.0,
            reach: 0.0,
            groups: 0,
        };
        Block { queries, scaled: [[f32x4::ZERO; 3]; GROUPS], beyond: 0 }
    }
}

impl Block {
    /// Takes the queries of another block. Lanes without a query are put in the middle.
    pub fn set(&mut self, points: &[Vec3], bounds: &Aabb, place: &Place, frame: &Frame) {
        let center = bounds.center();
        self.queries.center = center;
        self.queries.scale = frame.scale;
        self.queries.reach = place.radius;
        self.queries.groups = points.len().div_ceil(WIDTH);
        self.beyond = 0;
        let inverse = f32x4::splat(1.0 / place.radius);
        for (g, four) in points.chunks(WIDTH).enumerate() {
            let at = |k: usize| *four.get(k).unwrap_or(&center);
            let four = [at(0), at(1), at(2), at(3)];
            let local = |k: usize| near(frame, four[k]) - place.center;
            let local = [local(0), local(1), local(2), local(3)];
            for axis in 0..3 {
                let [a, b, c, d] = &four;
                self.queries.positions[g][axis] = f64x4::from([a[axis], b[axis], c[axis], d[axis]]);
                let [a, b, c, d] = &local;
                let offset = [a[axis] as f32, b[axis] as f32, c[axis] as f32, d[axis] as f32];
                self.queries.offsets[g][axis] = f32x4::from(offset);
                self.scaled[g][axis] = f32x4::from(offset) * inverse;
            }
            for (k, p) in four.into_iter().enumerate() {
                let is_beyond = frame.local(p).abs().max_element() > HORIZON;
                self.beyond |= u64::from(is_beyond) << (WIDTH * g + k);
            }
        }
    }

    /// One bit for each group.
    pub fn all(&self) -> u32 {
        ((1u64 << self.queries.groups) - 1) as u32
    }
}
