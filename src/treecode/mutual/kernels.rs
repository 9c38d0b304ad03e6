//! The sums themselves: eight points at a time, one source after the other.
use super::Group;
use super::series::{Moments, Series};
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};
use crate::treecode::{Octet, parts};
use std::f64::consts::PI;
use std::ops::Range;

/// A point as a source.
#[derive(Clone, Copy)]
pub struct Record {
    pub place: [f32; 3],
    pub strength: [f32; 3],
}

/// How points act on each other.
pub trait Action: Sync {
    type Strength: Copy + Sync;

    /// The moments of a point about its own place, and that place.
    fn moments(&self, strength: Self::Strength, place: [f32; 3]) -> (Vec3, Moments);
    fn narrowed(&self, strength: Self::Strength) -> [f32; 3];
    fn width(&self) -> f32;
    /// What a source does at points, given its place relative to them, the squared distance and its inverse, and its inverse
    /// cube; the potential is the first of three numbers.
    fn act<F: Floats<Number = f32>>(
        &self,
        is_field: bool,
        offset: [F; 3],
        inverse_square: F,
        inverse_cube: F,
        strength: [f32; 3],
    ) -> [F; 3];
}

/// Dipoles μ, with potentials μ·(p − q)/|p − q|³.
pub struct Dipoles {
    pub width: f32,
    pub is_bounded: bool,
}

/// Charges c, with fields c (q − p)/|q − p|³.
pub struct Charges {
    pub width: f32,
}

impl Action for Dipoles {
    type Strength = Vec3;

    fn moments(&self, strength: Vec3, place: [f32; 3]) -> (Vec3, Moments) {
        (widened(place), Moments { dipole: strength, ..Moments::ZERO })
    }

    fn narrowed(&self, strength: Vec3) -> [f32; 3] {
        strength.to_array().map(|x| x as f32)
    }

    fn width(&self) -> f32 {
        self.width
    }

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(
        &self,
        is_field: bool,
        [x, y, z]: [F; 3],
        inverse_square: F,
        inverse_cube: F,
        [a, b, c]: [f32; 3],
    ) -> [F; 3] {
        let (a, b, c) = (F::splat(a), F::splat(b), F::splat(c));
        let along = x * a + y * b + z * c;
        if !is_field {
            return [along * inverse_cube, F::splat(0.0), F::splat(0.0)];
        }
        let mut factor = inverse_cube;
        if self.is_bounded {
            // |4w| of this source alone.
            let sum = F::splat(1.0) + (along * inverse_cube).abs() * F::splat(1.0 / PI as f32);
            factor = factor / (sum * sum.sqrt());
        }
        let along = F::splat(3.0) * along * inverse_square;
        [(along * x - a) * factor, (along * y - b) * factor, (along * z - c) * factor]
    }
}

impl Action for Charges {
    type Strength = f64;

    fn moments(&self, strength: f64, place: [f32; 3]) -> (Vec3, Moments) {
        (widened(place), Moments { charge: strength, ..Moments::ZERO })
    }

    fn narrowed(&self, strength: f64) -> [f32; 3] {
        [strength as f32, 0.0, 0.0]
    }

    fn width(&self) -> f32 {
        self.width
    }

    #[inline(always)]
    fn act<F: Floats<Number = f32>>(
        &self,
        _is_field: bool,
        [x, y, z]: [F; 3],
        _inverse_square: F,
        inverse_cube: F,
        [charge, ..]: [f32; 3],
    ) -> [F; 3] {
        let factor = F::splat(-charge) * inverse_cube;
        [x * factor, y * factor, z * factor]
    }
}

fn widened(place: [f32; 3]) -> Vec3 {
    Vec3::from_array(place.map(f64::from))
}

/// A block of points and all that acts on it.
pub struct Block<'a> {
    pub groups: &'a [Group],
    pub far: &'a [u32],
    pub near: &'a [Range<u32>],
    pub series: &'a [Series],
    pub records: &'a [Record],
}

impl Block<'_> {
    /// The sums at each point, the first of three numbers for potentials.
    pub fn sums<A: Action>(&self, action: &A, is_field: bool, sums: &mut Vec<[f32; 3]>) {
        in_widest_registers(Sum { block: self, action, is_field, sums });
    }
}

struct Sum<'a, A: Action> {
    block: &'a Block<'a>,
    action: &'a A,
    is_field: bool,
    sums: &'a mut Vec<[f32; 3]>,
}

impl<A: Action> Work for Sum<'_, A> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        let Sum { block, action, is_field, sums } = self;
        for group in block.groups {
            let mut octets = [Octet::ZERO; 3];
            for part in parts::<R::Singles>() {
                let places = [
                    group[0].get::<R::Singles>(part),
                    group[1].get::<R::Singles>(part),
                    group[2].get::<R::Singles>(part),
                ];
                let [x, y, z] = if is_field {
                    sum::<R::Singles, A, true>(block, action, places)
                } else {
                    sum::<R::Singles, A, false>(block, action, places)
                };
                octets[0].put(part, x);
                octets[1].put(part, y);
                octets[2].put(part, z);
            }
            let [x, y, z] = octets;
            sums.extend((0..x.0.len()).map(|k| [x.0[k], y.0[k], z.0[k]]));
        }
    }
}

/// The sums at a register of points.
#[inline(always)]
fn sum<F: Floats<Number = f32>, A: Action, const IS_FIELD: bool>(
    block: &Block,
    action: &A,
    [qx, qy, qz]: [F; 3],
) -> [F; 3] {
    let least = F::splat(action.width() * action.width());
    let (one, half) = (F::splat(1.0), F::splat(0.5));
    let mut sums = [F::splat(0.0); 3];
    for cluster in block.far {
        let series = &block.series[*cluster as usize];
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
        let charge = F::splat(series.charge);
        let scale = counts * inverse_square;
        if IS_FIELD {
            let (two, three, five) = (F::splat(2.0), F::splat(3.0), F::splat(5.0));
            let inward = charge + inverse * (three * dipole + inverse * (five * quadrupole));
            sums[0] = sums[0] + scale * (inward * x - inverse * (dx + inverse * (two * sx)));
            sums[1] = sums[1] + scale * (inward * y - inverse * (dy + inverse * (two * sy)));
            sums[2] = sums[2] + scale * (inward * z - inverse * (dz + inverse * (two * sz)));
        } else {
            // That of dipoles has no charge.
            sums[0] = sums[0] - scale * (dipole + inverse * quadrupole);
        }
    }
    for range in block.near {
        for record in &block.records[range.start as usize..range.end as usize] {
            let [px, py, pz] = record.place;
            let offset = [F::splat(px) - qx, F::splat(py) - qy, F::splat(pz) - qz];
            let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
            let counts = half + (square - least).with_signs_on(half);
            let inverse_square = one / square.max(least);
            let inverse_cube = counts * inverse_square * inverse_square.sqrt();
            let [x, y, z] = action.act(IS_FIELD, offset, inverse_square, inverse_cube, record.strength);
            sums = [sums[0] + x, sums[1] + y, sums[2] + z];
        }
    }
    sums
}
