use super::clusters::Ball;
use super::octet::Octet;
use super::{GROUPS, QueryBlock, WIDTH};
use crate::data::BLOCK;
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
            radius,
        }
    }

    /// The centre relative to those of four clusters, and their radii.
    #[inline(always)]
    pub fn relative_to(&self, balls: [&Ball; 4]) -> ([f32x4; 3], f32x4) {
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

fn is_within(frame: &Frame, p: Vec3) -> bool {
    frame.local(p).abs().max_element() <= HORIZON
}

/// The queries of a block as the near and the far field want them.
pub struct Block {
    pub queries: QueryBlock,
    /// Queries beyond the horizon, one bit each.
    pub beyond: u64,
}

impl Default for Block {
    fn default() -> Self {
        let groups = [[Octet::ZERO; 3]; GROUPS];
        let queries = QueryBlock {
            positions: [[f64x4::ZERO; 3]; BLOCK / 4],
            center: Vec3::ZERO,
            offsets: groups,
            scale: 1.0,
            reach: 0.0,
            groups: 0,
            middles: [Octet::ZERO; 3],
            halves: [Octet::ZERO; 3],
        };
        Block { queries, beyond: 0 }
    }
}

/// What a group's box is enlarged by for rounding, in radii of the block.
const BOX_ROUNDING: f32 = 1e-6;

impl Block {
    /// Takes the queries of another block.
    pub fn set(&mut self, points: &[Vec3], bounds: &Aabb, place: &Place, frame: &Frame) {
        let center = bounds.center();
        let queries = &mut self.queries;
        queries.center = center;
        queries.scale = frame.scale;
        queries.reach = place.radius;
        queries.groups = points.len().div_ceil(WIDTH);
        self.beyond = 0;
        let all_are_within = is_within(frame, bounds.min) && is_within(frame, bounds.max);
        for (g, group) in points.chunks(WIDTH).enumerate() {
            let at: [Vec3; WIDTH] = std::array::from_fn(|k| *group.get(k).unwrap_or(&group[0]));
            let clamped = |p: Vec3| if all_are_within { frame.local(p) } else { near(frame, p) };
            let local = at.map(|p| clamped(p) - place.center);
            for axis in 0..3 {
                let [a, b, c, d, e, f, g_, h] = at.map(|p| p[axis]);
                queries.positions[2 * g][axis] = f64x4::from([a, b, c, d]);
                queries.positions[2 * g + 1][axis] = f64x4::from([e, f, g_, h]);
                let offsets = local.map(|p| p[axis] as f32);
                queries.offsets[g][axis] = Octet(offsets);
                let least = offsets.into_iter().fold(f32::INFINITY, f32::min);
                let most = offsets.into_iter().fold(f32::NEG_INFINITY, f32::max);
                queries.middles[axis].0[g] = 0.5 * (least + most);
                queries.halves[axis].0[g] = 0.5 * (most - least) + BOX_ROUNDING * place.radius;
            }
            if !all_are_within {
                for (k, p) in group.iter().enumerate() {
                    self.beyond |= u64::from(!is_within(frame, *p)) << (WIDTH * g + k);
                }
            }
        }
    }

    /// One bit for each group.
    pub fn all(&self) -> u32 {
        (1 << self.queries.groups) - 1
    }
}
