//! Where the fraction of a capped soup need not be summed for an inside test: one byte for each cell of a locator.
//!
//! Over a block of cells that no cap comes near, the fraction −w_C is smooth; over one that no triangle of the surface
//! comes near, w itself is, whatever caps there are. Either is known all through the block from its exact value in the
//! middle and a bound of its variation (see [`crate::winding::variation`]). Blocks are halved until that decides.
use super::SoupField;
use crate::data::map_tasks;
use crate::math::Vec3;
use crate::winding::THRESHOLD;
use crate::winding::curtain::LANES;
use crate::winding::locate::{FIRST_KNOWN, Locator};
use crate::winding::variation::BoundaryEdges;

/// Cells along a side of the blocks with which division begins.
const TOP: usize = 32;
/// Most blocks along a side. On the bunny, whose table has twice as many cells, halving once more takes as long as
/// three million queries would gain.
const DIVISIONS: usize = 64;
/// Rounding of an exactly summed fraction, with a margin.
const ROUNDING: f64 = 1e-11;
/// Blocks over which w may vary by more are divided at once: half a winding number away from the threshold at most.
const LARGEST_VARIATION: f64 = 0.5;

/// What is known of a cell.
const UNKNOWN: i8 = i8::MIN;
const OUTSIDE: i8 = 0;
pub const INSIDE: i8 = 1;
/// Below the codes of known answers: the least integer part that is inside, added to this.
const LEAST_ZERO: i8 = -94;
const LEAST: std::ops::RangeInclusive<f64> = -33.0..=33.0;

/// The least integer part that is inside, all through a cell.
pub fn least_of(code: i8) -> Option<i32> {
    (UNKNOWN < code && code < FIRST_KNOWN).then(|| i32::from(code) - i32::from(LEAST_ZERO))
}

#[derive(Clone, Copy)]
struct Block {
    first: [usize; 3],
    middle: Vec3,
    variation: f64,
    has_caps: bool,
}

/// The codes of all cells of a locator, for the threshold 1/2.
pub fn answers(field: &SoupField, locator: &Locator) -> Vec<i8> {
    let boundary = BoundaryEdges::new(field.curtain.each_edge());
    let side = locator.side();
    let top = TOP.min(side);
    let tops = side / top;
    let at = |k: usize| [k % tops, k / tops % tops, k / (tops * tops)].map(|c| c * top);
    let found = map_tasks(tops * tops * tops, |k| {
        let mut codes = vec![UNKNOWN; top * top * top];
        Division { field, locator, boundary: &boundary, corner: at(k), top, codes: &mut codes }.run();
        codes
    });
    let mut codes = vec![UNKNOWN; side * side * side];
    for (k, some) in found.iter().enumerate() {
        let corner = at(k);
        for (row, values) in some.chunks_exact(top).enumerate() {
            let [y, z] = [corner[1] + row % top, corner[2] + row / top];
            codes[(z * side + y) * side + corner[0]..][..top].copy_from_slice(values);
        }
    }
    codes
}

/// The division of one of the blocks at the top.
struct Division<'a> {
    field: &'a SoupField,
    locator: &'a Locator,
    boundary: &'a BoundaryEdges,
    corner: [usize; 3],
    top: usize,
    codes: &'a mut [i8],
}

impl Division<'_> {
    fn run(mut self) {
        let mut side = self.top;
        let finest = (self.locator.side() / DIVISIONS).max(1);
        let mut firsts = vec![self.corner];
        while !firsts.is_empty() {
            let (mut plausible, mut divided) = (Vec::new(), Vec::new());
            for first in firsts {
                let (middle, half) = self.locator.middle(first, side);
                // Points are rounded to cells by far less than that.
                let radius = half.length() * (1.0 + 1e-5);
                let near = self.locator.near(first, side);
                // Neither the fraction nor w is smooth in all of the block.
                let variation = if near.caps && near.surface {
                    f64::INFINITY
                } else {
                    self.boundary.variation(middle, radius, LARGEST_VARIATION)
                };
                if variation.is_finite() {
                    plausible.push(Block { first, middle, variation, has_caps: near.caps });
                } else {
                    divided.push(first);
                }
            }
            for blocks in plausible.chunks(LANES) {
                let middles = std::array::from_fn(|k| blocks[k.min(blocks.len() - 1)].middle);
                let fractions = self.field.curtain.fractions(&middles);
                let undecided = |(block, fraction): &(&Block, f64)| !self.decide(block, side, *fraction);
                let undecided: Vec<_> = blocks.iter().zip(fractions).filter(undecided).collect();
                divided.extend(undecided.iter().map(|(block, _)| block.first));
            }
            firsts = if side > finest {
                divided.into_iter().flat_map(|f| halves(f, side / 2)).collect()
            } else {
                vec![]
            };
            side /= 2;
        }
    }

    /// Sets the codes of a block, given the sum of the curtains in its middle, if it is known what they are.
    fn decide(&mut self, block: &Block, side: usize, fraction: f64) -> bool {
        let slack = block.variation + ROUNDING;
        if !block.has_caps {
            let fraction = fraction - f64::from(self.field.cap_crossings(block.middle));
            let least = |fraction: f64| (THRESHOLD - fraction).ceil();
            let (low, high) = (least(fraction + slack), least(fraction - slack));
            if low != high || !LEAST.contains(&low) {
                return false;
            }
            let least = low as i8;
            self.set(block.first, side, |crossings| match crossings {
                FIRST_KNOWN.. => {
                    if crossings >= least {
                        INSIDE
                    } else {
                        OUTSIDE
                    }
                }
                _ => LEAST_ZERO + least,
            });
            return true;
        }
        let crossings = self.locator.locate(self.field.facets(), block.middle, false).crossings;
        let w = f64::from(crossings) + fraction;
        if (w - THRESHOLD).abs() <= slack {
            return false;
        }
        let code = if w > THRESHOLD { INSIDE } else { OUTSIDE };
        self.set(block.first, side, |_| code);
        true
    }

    fn set(&mut self, first: [usize; 3], side: usize, code: impl Fn(i8) -> i8) {
        let all = self.locator.side();
        let [x, y, z] = std::array::from_fn(|k| first[k] - self.corner[k]);
        for k in 0..side * side {
            let (dy, dz) = (k % side, k / side);
            let crossings =
                &self.locator.cells()[((first[2] + dz) * all + first[1] + dy) * all + first[0]..][..side];
            let codes = &mut self.codes[((z + dz) * self.top + y + dy) * self.top + x..][..side];
            codes.iter_mut().zip(crossings).for_each(|(to, from)| *to = code(*from));
        }
    }
}

fn halves(first: [usize; 3], side: usize) -> [[usize; 3]; 8] {
    std::array::from_fn(|k| std::array::from_fn(|axis| first[axis] + (k >> axis & 1) * side))
}
