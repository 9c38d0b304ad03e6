//! Dipoles near a block of queries, four queries at a time.
use crate::bvh::WIDTH;
use crate::data::{BLOCK, OrientedCloud};
use crate::math::Vec3;
use crate::treecode::{GROUPS, Lanes, NearLeaf, QueryBlock, SourceKind, Sources};
use std::f64::consts::PI;
use wide::{f32x4, f64x4};

impl Sources for OrientedCloud {
    fn len(&self) -> usize {
        self.points().len()
    }

    fn kind(&self) -> SourceKind {
        SourceKind::Points
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        [self.points()[index]; 3]
    }

    fn area_vector(&self, index: usize) -> Vec3 {
        self.areas()[index] * self.normals()[index]
    }

    fn rounding(&self) -> f64 {
        DIPOLE_ROUNDING
    }

    fn add(&self, near: &[NearLeaf], items: &[u32], queries: &QueryBlock, values: &mut [f64; BLOCK]) {
        let mut sums = [f64x4::ZERO; GROUPS];
        for leaf in near {
            for &i in leaf.members(items) {
                let (point, vector) = (self.points()[i as usize], Sources::area_vector(self, i as usize));
                let dipole = Dipole32::new(point, vector, queries);
                for group in leaf.groups() {
                    sums[group] += match dipole.field(&queries.offsets[group]) {
                        Some(field) => widened(field),
                        None => precise_dipole(point, vector, &queries.positions[group]),
                    };
                }
            }
        }
        for (values, sum) in values.chunks_mut(WIDTH).zip(sums) {
            values.iter_mut().zip(sum.to_array()).for_each(|(value, s)| *value += s / (4.0 * PI));
        }
    }
}

#[inline(always)]
fn widened(lanes: f32x4) -> f64x4 {
    let [a, b, c, d] = lanes.to_array();
    f64x4::new([f64::from(a), f64::from(b), f64::from(c), f64::from(d)])
}

/// A dipole near a block of queries, relative to its centre, in all lanes. Its offset from a query is known to about ε L, ε = 2⁻²⁴
/// and L a bound of the lengths of both, and its field |v|/d² to about 6 ε L |v|/d³.
struct Dipole32 {
    point: [f32x4; 3],
    vector: [f32x4; 3],
    /// What d³ must exceed.
    least: f32x4,
}

/// 6 ε / 4π over the error that is allowed.
const LEAST_CUBE: f32 = 0.029;
/// What d must exceed for that estimate to hold: 64 ε.
const LEAST_OFFSET: f32 = 4e-6;
const DIPOLE_ROUNDING: f64 = 1e-6;

impl Dipole32 {
    #[inline(always)]
    fn new(point: Vec3, vector: Vec3, queries: &QueryBlock) -> Dipole32 {
        let point = queries.scale * (point - queries.center);
        let vector = queries.scale * queries.scale * vector;
        let splat = |v: Vec3| [f32x4::splat(v.x as f32), f32x4::splat(v.y as f32), f32x4::splat(v.z as f32)];
        let length = point.length() as f32 + queries.reach;
        let least = (LEAST_CUBE * length * vector.length() as f32).max((LEAST_OFFSET * length).powi(3));
        Dipole32 { point: splat(point), vector: splat(vector), least: f32x4::splat(least) }
    }

    /// 4π times the winding numbers; none where a lane might be wrong.
    #[inline(always)]
    fn field(&self, q: &[f32x4; 3]) -> Option<f32x4> {
        let [x, y, z] = [self.point[0] - q[0], self.point[1] - q[1], self.point[2] - q[2]];
        let square = x * x + y * y + z * z;
        let cube = square * square.sqrt();
        let field = (x * self.vector[0] + y * self.vector[1] + z * self.vector[2]) / cube;
        cube.simd_gt(self.least).all().then_some(field)
    }
}

/// A dipole at a query adds nothing.
#[cold]
#[inline(never)]
fn precise_dipole(point: Vec3, vector: Vec3, q: &Lanes) -> f64x4 {
    let [x, y, z] = [0, 1, 2].map(|axis| f64x4::splat(point[axis]) - q[axis]);
    let square = x * x + y * y + z * z;
    let [vx, vy, vz] = vector.to_array().map(f64x4::splat);
    let field = (x * vx + y * vy + z * vz) / (square * square.sqrt());
    square.simd_gt(f64x4::ZERO) & field
}
