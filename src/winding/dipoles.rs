//! Oriented points as sources: area-weighted dipoles (Barill et al. 2018, eqs. 5 to 7), each bounded or not (*Leaps and Bounds*,
//! section 4).
use crate::bvh::WIDTH;
use crate::data::OrientedCloud;
use crate::math::Vec3;
use crate::treecode::{Kernel, Lanes, Quadrature};
use std::f64::consts::PI;
use std::sync::Arc;
use wide::f64x4;

/// The points of a cloud as sources of its winding field.
pub struct Dipoles {
    pub(super) cloud: Arc<OrientedCloud>,
    pub(super) is_bounded: bool,
}

impl Dipoles {
    /// `is_bounded`: of the bounded winding number.
    pub fn new(cloud: Arc<OrientedCloud>, is_bounded: bool) -> Dipoles {
        Dipoles { cloud, is_bounded }
    }

    pub(super) fn vector(&self, index: usize) -> Vec3 {
        self.cloud.areas()[index] * self.cloud.normals()[index]
    }
}

/// A sum over dipoles: 4π times a winding number, or, of bounded ones, that itself.
pub struct DipoleSum {
    lanes: f64x4,
    is_bounded: bool,
}

/// Four dipoles: positions, and area times normal.
#[derive(Clone)]
pub struct DipoleBlock {
    points: Lanes,
    area_vectors: Lanes,
}

impl Kernel for Dipoles {
    type Block = DipoleBlock;
    type Sum = DipoleSum;
    /// Whether they are bounded.
    type Mode = bool;

    fn len(&self) -> usize {
        self.cloud.len()
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        [self.cloud.points()[index]; 3]
    }

    fn quadrature(&self, index: usize) -> Quadrature {
        Quadrature {
            points: [self.cloud.points()[index]; 3],
            area_vector: self.vector(index),
            area: self.cloud.areas()[index],
            extent: if self.is_bounded { self.cloud.areas()[index].sqrt() } else { 0.0 },
        }
    }

    fn block(&self, members: [Option<usize>; WIDTH]) -> DipoleBlock {
        let points = members.map(|m| m.map_or(Vec3::ZERO, |i| self.cloud.points()[i]));
        let vectors = members.map(|m| m.map_or(Vec3::ZERO, |i| self.vector(i)));
        let lanes = |v: [Vec3; WIDTH]| [0, 1, 2].map(|axis| f64x4::from(v.map(|v| v[axis])));
        DipoleBlock { points: lanes(points), area_vectors: lanes(vectors) }
    }

    fn is_bounded(&self) -> bool {
        self.is_bounded
    }

    fn mode(&self) -> bool {
        self.is_bounded
    }

    fn sum(is_bounded: bool) -> DipoleSum {
        DipoleSum { lanes: f64x4::ZERO, is_bounded }
    }

    #[inline(always)]
    fn add(sum: &mut DipoleSum, block: &DipoleBlock, q: &Lanes) {
        let [x, y, z] = [0, 1, 2].map(|i| block.points[i] - q[i]);
        let [nx, ny, nz] = block.area_vectors;
        let square = x * x + y * y + z * z;
        let field = (x * nx + y * ny + z * nz) / (square * square.sqrt());
        let field = if sum.is_bounded { bounded(field) } else { field };
        sum.lanes += square.simd_gt(f64x4::ZERO) & field;
    }

    fn total(sum: DipoleSum) -> f64 {
        let [a, b, c, d] = sum.lanes.to_array();
        let total = (a + b) + (c + d);
        if sum.is_bounded { total } else { total / (4.0 * PI) }
    }

    #[inline(always)]
    fn add_gradient(sum: &mut Lanes, block: &DipoleBlock, q: &Lanes, is_bounded: bool) {
        let offset = [0, 1, 2].map(|i| block.points[i] - q[i]);
        let [x, y, z] = offset;
        let [nx, ny, nz] = block.area_vectors;
        let square = x * x + y * y + z * z;
        let is_apart = square.simd_gt(f64x4::ZERO);
        let across = x * nx + y * ny + z * nz;
        let along = f64x4::splat(3.0) * across / square;
        let cube = square * square.sqrt();
        let divisor = if is_bounded { cube * steepness(across / cube) } else { cube };
        for i in 0..3 {
            sum[i] += is_apart & ((along * offset[i] - block.area_vectors[i]) / divisor);
        }
    }
}

/// [`super::bounded`] of 4π times winding numbers.
#[inline(always)]
fn bounded(field: f64x4) -> f64x4 {
    let half = f64x4::splat(0.5);
    let root = (f64x4::ONE + field.abs() * f64x4::splat(1.0 / PI)).sqrt();
    (half - half / root).copysign(field)
}

/// (1 + 4|x|)^(3/2) of 4π times winding numbers x.
#[inline(always)]
fn steepness(field: f64x4) -> f64x4 {
    let square = f64x4::ONE + field.abs() * f64x4::splat(1.0 / PI);
    square * square.sqrt()
}
