//! Values with bounds of their errors, and inside tests made of them.
use super::{LEAST_RADIUS, Scratch, Tree, sum_of_lanes};
use crate::bvh::WIDTH;
use crate::math::Vec3;
use crate::treecode::expansion::{Positions, Remainder};
use crate::treecode::kernel::Kernel;
use std::f64::consts::PI;
use wide::{f32x4, f64x4};

/// β of the looks that an inside test takes: the first decides where w is near an integer, the last leaves open what is some
/// 1e-3 from the threshold.
const LOOKS: [f64; 3] = [2.0, 4.0, 10.0];
/// What dipoles lack of bounded points is 3x² ≤ 3 (a / 4πd²) |x|, and a ≤ (d / [`LEAST_RADIUS`] β)².
const LACKING: f64 = 3.0 / (4.0 * PI * LEAST_RADIUS * LEAST_RADIUS);
/// Errors of the 64-bit sums over what is near, next to edges too.
const ROUNDING_OF_SUMS: f64 = 1e-10;

/// Whether a value reaches a threshold.
#[derive(Clone, Copy)]
pub struct Reaches {
    pub threshold: bool,
    pub is_proven: bool,
}

impl<K: Kernel> Tree<K> {
    /// The winding number at `q`: clusters farther than β > 1 times their radius by their expansion of order 2, the rest
    /// exactly (Barill et al. 2018, algorithm 1); and a bound of its error. NaN where `q` is not finite.
    pub fn bounded(&self, q: Vec3, beta: f64, scratch: &mut Scratch) -> (f64, f64) {
        if !q.is_finite() {
            return (f64::NAN, f64::NAN);
        }
        let query = Positions::splat(self.frame.local(q));
        let lanes = q.to_array().map(f64x4::splat);
        let beta_squared = f32x4::splat((beta * beta) as f32);
        let mut far = f32x4::splat(0.0);
        let mut remainder = Remainder::NOTHING;
        let mut near = K::sum(self.mode);
        let visit = |node: usize, ()| {
            let (field, is_far) = self.expansions[node].bounded_field(&query, beta_squared, &mut remainder);
            far += field;
            (!is_far & 0b1111, [(); WIDTH])
        };
        let leaf = |node: usize, child: usize, ()| {
            self.leaf(node, child).iter().for_each(|block| K::add(&mut near, block, &lanes));
        };
        self.bvh.traverse(&mut scratch.single, (), visit, leaf);
        let lacking = if self.is_bounded { LACKING } else { 0.0 };
        (K::total(near) + sum_of_lanes(far), remainder.bound(beta, lacking) + ROUNDING_OF_SUMS)
    }

    /// Whether w ≥ `threshold` at `q`, proven or, where only [`Tree::direct`] can prove it, as the last look has it.
    pub fn reaches(&self, q: Vec3, threshold: f64, scratch: &mut Scratch) -> Reaches {
        let mut reaches = Reaches { threshold: false, is_proven: false };
        for beta in LOOKS {
            let (w, bound) = self.bounded(q, beta, scratch);
            reaches = Reaches { threshold: w >= threshold, is_proven: (w - threshold).abs() > bound };
            if reaches.is_proven {
                break;
            }
        }
        reaches
    }
}
