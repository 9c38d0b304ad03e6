//! The sums themselves: eight points at a time, one source after the other.
use super::Group;
use super::series::{Moments, Series};
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};
use crate::treecode::{Octet, parts};
use std::f64::consts::PI;
use std::ops::Range;

/// What is summed at points q over sources p.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sum {
    /// μ·(p − q)/|p − q|³.
    Potential,
    /// The gradients of that.
    Gradient,
    /// The same, each over (1 + |w|/π)^(3/2), w its own potential.
    BoundedGradient,
    /// c (q − p)/|q − p|³.
    Field,
    /// 4π c(w / 4π) of the potentials w of single points, c that of the bounded winding number.
    BoundedPotential,
    /// How that changes with dipoles: the potential of these, each over (1 + |w|/π)^(3/2).
    Change,
    /// The transpose of that.
    TransposedChange,
}

impl Sum {
    /// The moments of a point about its own place. A charge is the first coordinate of its strength.
    pub fn moments(self, strength: Vec3) -> Moments {
        match self {
            Sum::Field | Sum::TransposedChange => Moments { charge: strength.x, ..Moments::ZERO },
            _ => Moments { dipole: strength, ..Moments::ZERO },
        }
    }
}

/// A point as a source.
#[derive(Clone, Copy)]
pub struct Record {
    pub place: [f32; 3],
    pub strength: [f32; 3],
    /// The dipole there that tells how far the point is bounded.
    pub base: [f32; 3],
}

/// A block of points and all that acts on it.
pub struct Block<'a> {
    pub groups: &'a [Group],
    pub far: &'a [u32],
    pub near: &'a [Range<u32>],
    pub series: &'a [Series],
    pub records: &'a [Record],
    /// The dipoles at the points of the groups themselves, for [`Sum::TransposedChange`].
    pub bases: &'a [Group],
    /// What is nearer does not act.
    pub width: f32,
}

impl Block<'_> {
    /// Appends the sums at each point of the groups, of potentials the first of three numbers.
    pub fn add(&self, sum: Sum, sums: &mut Vec<[f32; 3]>) {
        in_widest_registers(Sums { block: self, sum, sums });
    }
}

struct Sums<'a> {
    block: &'a Block<'a>,
    sum: Sum,
    sums: &'a mut Vec<[f32; 3]>,
}

impl Work for Sums<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        let Sums { block, sum, sums } = self;
        match sum {
            Sum::Potential => block.each::<R, Potential>(sums),
            Sum::Gradient => block.each::<R, Gradient>(sums),
            Sum::BoundedGradient => block.each::<R, BoundedGradient>(sums),
            Sum::Field => block.each::<R, Field>(sums),
            Sum::BoundedPotential => block.each::<R, BoundedPotential>(sums),
            Sum::Change => block.each::<R, Change>(sums),
            Sum::TransposedChange => block.each::<R, TransposedChange>(sums),
        }
    }
}

const NO_BASES: Group = [Octet::ZERO; 3];

/// How a point acts on others.
trait Action {
    const IS_VECTOR: bool;
    /// Given its place relative to them, the inverse square and cube of the distance, itself, and the dipoles at them.
    fn act<F: Floats<Number = f32>>(
        offset: [F; 3],
        square: F,
        cube: F,
        source: &Record,
        bases: [F; 3],
    ) -> [F; 3];
}

struct Potential;

impl Action for Potential {
    const IS_VECTOR: bool = false;

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(offset: [F; 3], _: F, cube: F, source: &Record, _: [F; 3]) -> [F; 3] {
        [along(offset, source.strength) * cube, F::splat(0.0), F::splat(0.0)]
    }
}

struct Gradient;

impl Action for Gradient {
    const IS_VECTOR: bool = true;

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(
        offset: [F; 3],
        square: F,
        cube: F,
        Record { strength, .. }: &Record,
        _: [F; 3],
    ) -> [F; 3] {
        let strength = *strength;
        gradient(offset, strength, F::splat(3.0) * along(offset, strength) * square, cube)
    }
}

struct BoundedGradient;

impl Action for BoundedGradient {
    const IS_VECTOR: bool = true;

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(
        offset: [F; 3],
        square: F,
        cube: F,
        source: &Record,
        _: [F; 3],
    ) -> [F; 3] {
        let along = along(offset, source.strength);
        let slope = slope(along * cube);
        gradient(offset, source.strength, F::splat(3.0) * along * square, cube * slope)
    }
}

struct Field;

impl Action for Field {
    const IS_VECTOR: bool = true;

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(offset: [F; 3], _: F, cube: F, source: &Record, _: [F; 3]) -> [F; 3] {
        let factor = F::splat(-source.strength[0]) * cube;
        [offset[0] * factor, offset[1] * factor, offset[2] * factor]
    }
}

struct BoundedPotential;

impl Action for BoundedPotential {
    const IS_VECTOR: bool = false;

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(offset: [F; 3], _: F, cube: F, source: &Record, _: [F; 3]) -> [F; 3] {
        let own = along(offset, source.strength) * cube;
        let root = (F::splat(1.0) + own.abs() * F::splat((1.0 / PI) as f32)).sqrt();
        // 2π (1 − 1/√(1 + |w|/π)), without a difference of numbers that are nearly equal.
        let bounded = own.abs() * F::splat(2.0) / (root * (root + F::splat(1.0)));
        [own.with_signs_on(bounded), F::splat(0.0), F::splat(0.0)]
    }
}

struct Change;

impl Action for Change {
    const IS_VECTOR: bool = false;

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(offset: [F; 3], _: F, cube: F, source: &Record, _: [F; 3]) -> [F; 3] {
        let slope = slope(along(offset, source.base) * cube);
        [along(offset, source.strength) * cube * slope, F::splat(0.0), F::splat(0.0)]
    }
}

struct TransposedChange;

impl Action for TransposedChange {
    const IS_VECTOR: bool = true;

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(
        [x, y, z]: [F; 3],
        _: F,
        cube: F,
        source: &Record,
        [a, b, c]: [F; 3],
    ) -> [F; 3] {
        let factor = F::splat(-source.strength[0]) * cube * slope((x * a + y * b + z * c) * cube);
        [x * factor, y * factor, z * factor]
    }
}

/// What the bounded potential of a point changes by where its potential w changes by 1: (1 + |w|/π)^(−3/2), *Leaps and Bounds*,
/// eq. 45.
#[inline(always)]
fn slope<F: Floats<Number = f32>>(own: F) -> F {
    let sum = F::splat(1.0) + own.abs() * F::splat((1.0 / PI) as f32);
    F::splat(1.0) / (sum * sum.sqrt())
}

#[inline(always)]
fn along<F: Floats<Number = f32>>([x, y, z]: [F; 3], [a, b, c]: [f32; 3]) -> F {
    x * F::splat(a) + y * F::splat(b) + z * F::splat(c)
}

/// (`along` · offset − strength) · `factor`.
#[inline(always)]
fn gradient<F: Floats<Number = f32>>([x, y, z]: [F; 3], [a, b, c]: [f32; 3], along: F, factor: F) -> [F; 3] {
    let part = |offset: F, strength: f32| (along * offset - F::splat(strength)) * factor;
    [part(x, a), part(y, b), part(z, c)]
}

impl Block<'_> {
    #[inline(always)]
    fn each<R: Registers, A: Action>(&self, sums: &mut Vec<[f32; 3]>) {
        for (k, group) in self.groups.iter().enumerate() {
            let bases = self.bases.get(k).unwrap_or(&NO_BASES);
            let mut octets = [Octet::ZERO; 3];
            for part in parts::<R::Singles>() {
                let x = group[0].get::<R::Singles>(part);
                let y = group[1].get::<R::Singles>(part);
                let z = group[2].get::<R::Singles>(part);
                let bases = [
                    bases[0].get::<R::Singles>(part),
                    bases[1].get::<R::Singles>(part),
                    bases[2].get::<R::Singles>(part),
                ];
                let sum = self.sum::<R::Singles, A>([x, y, z], bases);
                octets[0].put(part, sum[0]);
                octets[1].put(part, sum[1]);
                octets[2].put(part, sum[2]);
            }
            let [x, y, z] = octets;
            sums.extend((0..x.0.len()).map(|k| [x.0[k], y.0[k], z.0[k]]));
        }
    }

    /// The sums at a register of points.
    #[inline(always)]
    fn sum<F: Floats<Number = f32>, A: Action>(&self, [qx, qy, qz]: [F; 3], bases: [F; 3]) -> [F; 3] {
        let least = F::splat(self.width * self.width);
        let (one, half) = (F::splat(1.0), F::splat(0.5));
        let mut sums = [F::splat(0.0); 3];
        for cluster in self.far {
            let series = &self.series[*cluster as usize];
            let [cx, cy, cz] = series.center;
            let (x, y, z) = (qx - F::splat(cx), qy - F::splat(cy), qz - F::splat(cz));
            let square = x * x + y * y + z * z;
            // 1 or 0: whether it is no nearer than the width.
            let counts = half + (square - least).with_signs_on(half);
            let inverse_square = one / square.max(least);
            let inverse = inverse_square.sqrt();
            let (x, y, z) = (x * inverse, y * inverse, z * inverse);
            let [dx, dy, dz] = series.dipole;
            let (dx, dy, dz) = (F::splat(dx), F::splat(dy), F::splat(dz));
            let [xx, xy, xz, yy, yz, zz] = series.quadrupole;
            let sx = F::splat(xx) * x + F::splat(xy) * y + F::splat(xz) * z;
            let sy = F::splat(xy) * x + F::splat(yy) * y + F::splat(yz) * z;
            let sz = F::splat(xz) * x + F::splat(yz) * y + F::splat(zz) * z;
            let (dipole, quadrupole) = (dx * x + dy * y + dz * z, sx * x + sy * y + sz * z);
            let scale = counts * inverse_square;
            if A::IS_VECTOR {
                let (two, three, five) = (F::splat(2.0), F::splat(3.0), F::splat(5.0));
                let inward =
                    F::splat(series.charge) + inverse * (three * dipole + inverse * (five * quadrupole));
                sums[0] = sums[0] + scale * (inward * x - inverse * (dx + inverse * (two * sx)));
                sums[1] = sums[1] + scale * (inward * y - inverse * (dy + inverse * (two * sy)));
                sums[2] = sums[2] + scale * (inward * z - inverse * (dz + inverse * (two * sz)));
            } else {
                // Dipoles have no charge.
                sums[0] = sums[0] - scale * (dipole + inverse * quadrupole);
            }
        }
        for range in self.near {
            for record in &self.records[range.start as usize..range.end as usize] {
                let [px, py, pz] = record.place;
                let offset = [F::splat(px) - qx, F::splat(py) - qy, F::splat(pz) - qz];
                let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
                let counts = half + (square - least).with_signs_on(half);
                let inverse_square = one / square.max(least);
                let inverse_cube = counts * inverse_square * inverse_square.sqrt();
                let [x, y, z] = A::act(offset, inverse_square, inverse_cube, record, bases);
                sums = [sums[0] + x, sums[1] + y, sums[2] + z];
            }
        }
        sums
    }
}
