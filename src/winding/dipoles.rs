//! Oriented points as sources: area-weighted dipoles (Barill et al. 2018, eqs. 5 to 7).
use crate::bvh::WIDTH;
use crate::data::OrientedCloud;
use crate::math::Vec3;
use crate::treecode::{Kernel, Lanes, Quadrature};
use std::f64::consts::PI;
use wide::f64x4;

/// Four dipoles: positions, and area times normal.
#[derive(Clone)]
pub struct DipoleBlock {
    points: Lanes,
    area_vectors: Lanes,
}

impl Kernel for OrientedCloud {
    type Block = DipoleBlock;
    type Sum = f64x4;

    fn len(&self) -> usize {
        self.points().len()
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        [self.points()[index]; 3]
    }

    fn quadrature(&self, index: usize) -> Quadrature {
        let area = self.areas()[index];
        Quadrature { points: [self.points()[index]; 3], area_vector: area * self.normals()[index], area }
    }

    fn block(&self, members: [Option<usize>; WIDTH]) -> DipoleBlock {
        let points = members.map(|m| m.map_or(Vec3::ZERO, |i| self.points()[i]));
        let vectors = members.map(|m| m.map_or(Vec3::ZERO, |i| self.areas()[i] * self.normals()[i]));
        let lanes = |v: [Vec3; WIDTH]| [0, 1, 2].map(|axis| f64x4::from(v.map(|v| v[axis])));
        DipoleBlock { points: lanes(points), area_vectors: lanes(vectors) }
    }

    fn sum() -> f64x4 {
        f64x4::ZERO
    }

    #[inline(always)]
    fn add(sum: &mut f64x4, block: &DipoleBlock, q: &Lanes) {
        let [x, y, z] = [0, 1, 2].map(|i| block.points[i] - q[i]);
        let [nx, ny, nz] = block.area_vectors;
        let square = x * x + y * y + z * z;
        let field = (x * nx + y * ny + z * nz) / (square * square.sqrt());
        *sum += square.simd_gt(f64x4::ZERO) & field;
    }

    fn total(sum: f64x4) -> f64 {
        let [a, b, c, d] = sum.to_array();
        ((a + b) + (c + d)) / (4.0 * PI)
    }

    #[inline(always)]
    fn add_gradient(sum: &mut Lanes, block: &DipoleBlock, q: &Lanes) {
        let offset = [0, 1, 2].map(|i| block.points[i] - q[i]);
        let [x, y, z] = offset;
        let [nx, ny, nz] = block.area_vectors;
        let square = x * x + y * y + z * z;
        let is_apart = square.simd_gt(f64x4::ZERO);
        let along = f64x4::splat(3.0) * (x * nx + y * ny + z * nz) / square;
        let cube = square * square.sqrt();
        for i in 0..3 {
            sum[i] += is_apart & ((along * offset[i] - block.area_vectors[i]) / cube);
        }
    }
}
