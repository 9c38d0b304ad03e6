//! The gradient of the field by the same walk as its value.
use super::{Scratch, Tree};
use crate::bvh::WIDTH;
use crate::math::Vec3;
use crate::treecode::expansion::{Order, Positions, sum_of_lanes};
use crate::treecode::kernel::{Kernel, Lanes};
use std::f64::consts::PI;
use wide::{f32x4, f64x4};

const NOTHING: Lanes = [f64x4::ZERO; 3];

impl<K: Kernel> Tree<K> {
    /// The gradient of [`Tree::at_block`] at `q`, from the same clusters and the same sources. Not finite where `q` is
    /// not, or where a source near it has no gradient that rounding leaves anything of.
    ///
    /// It is the derivative of the approximation within one choice of clusters; its error falls with one power of the
    /// distance more than the error of the value.
    pub fn gradient(&self, q: Vec3, order: Order, beta: f64, scratch: &mut Scratch) -> Vec3 {
        if !q.is_finite() {
            return Vec3::NAN;
        }
        let query = Positions::splat(self.frame.local(q));
        let lanes = q.to_array().map(f64x4::splat);
        let beta_squared = f32x4::splat((beta * beta) as f32);
        let mut far = [f32x4::ZERO; 3];
        let mut near = NOTHING;
        let visit = |node: usize, ()| {
            let (field, is_far) = self.expansions[node].far_gradient(&query, order, beta_squared);
            far.iter_mut().zip(field).for_each(|(sum, f)| *sum += f);
            (!is_far & 0b1111, [(); WIDTH])
        };
        let leaf = |node: usize, child: usize, ()| {
            self.leaf(node, child)
                .iter()
                .for_each(|block| K::add_gradient(&mut near, block, &lanes, self.mode));
        };
        self.bvh.traverse(&mut scratch.single, (), visit, leaf);
        total(near) + self.frame.scale * Vec3::from_array(far.map(sum_of_lanes))
    }

    /// The gradient summed over every source singly: exact to rounding, and the slow way.
    pub fn direct_gradient(&self, q: Vec3) -> Vec3 {
        if !q.is_finite() {
            return Vec3::NAN;
        }
        let lanes = q.to_array().map(f64x4::splat);
        let mut sum = NOTHING;
        self.blocks.iter().for_each(|block| K::add_gradient(&mut sum, block, &lanes, self.mode));
        total(sum)
    }
}

fn total(sum: Lanes) -> Vec3 {
    let add = |lanes: f64x4| {
        let [a, b, c, d] = lanes.to_array();
        (a + b) + (c + d)
    };
    Vec3::from_array(sum.map(add)) / (4.0 * PI)
}
