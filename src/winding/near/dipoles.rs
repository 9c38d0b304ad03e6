//! Dipoles near a block of queries.
use super::{GROUP, LANES, single};
use crate::data::BLOCK;
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};
use crate::treecode::{
    GROUPS, NearLeaf, Octet, QueryBlock, QueryGroup, SourceKind, Sources, parts, relative,
};
use crate::winding::bounded::bounded;
use crate::winding::dipoles::Dipoles;
use std::f64::consts::PI;

impl Sources for Dipoles {
    fn len(&self) -> usize {
        self.cloud.len()
    }

    fn kind(&self) -> SourceKind {
        SourceKind::Points
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        [self.cloud.points()[index]; 3]
    }

    fn area_vector(&self, index: usize) -> Vec3 {
        self.vector(index)
    }

    fn extent(&self, index: usize) -> Option<f64> {
        self.is_bounded.then(|| self.cloud.areas()[index].sqrt())
    }

    fn rounding(&self) -> f64 {
        DIPOLE_ROUNDING
    }

    fn add(
        &self,
        near: &[NearLeaf],
        items: &[u32],
        queries: &QueryBlock,
        _error: f32,
        values: &mut [f64; BLOCK],
    ) {
        in_widest_registers(NearDipoles { dipoles: self, near, items, queries, values });
    }
}

/// The work of [`Sources::add`].
struct NearDipoles<'a> {
    dipoles: &'a Dipoles,
    near: &'a [NearLeaf],
    items: &'a [u32],
    queries: &'a QueryBlock,
    values: &'a mut [f64; BLOCK],
}

impl Work for NearDipoles<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        let NearDipoles { dipoles, near, items, queries, values } = self;
        let mut sums = [Octet::ZERO; GROUPS];
        for leaf in near {
            for &i in leaf.members(items) {
                let (point, vector) = (dipoles.cloud.points()[i as usize], dipoles.vector(i as usize));
                let dipole = Dipole::new(point, vector, queries);
                let least = <R::Singles as Floats>::splat(dipole.least(queries.reach));
                for group in leaf.groups() {
                    for part in parts::<R::Singles>() {
                        let (mut field, cube) = dipole.field::<R::Singles>(&queries.offsets[group], part);
                        if dipoles.is_bounded {
                            field = bounded_field(field);
                        }
                        let (safe, all) = (cube.greater(least), (1 << R::Singles::COUNT) - 1);
                        if safe != all {
                            let mut fields = Octet::ZERO;
                            fields.put(part, field);
                            let lanes = (!safe & all) << part;
                            let place = (queries, group, lanes);
                            add_precisely([point, vector], dipoles.is_bounded, place, &mut fields, values);
                            field = fields.get(part);
                        }
                        sums[group].add(part, field);
                    }
                }
            }
        }
        add_fields(&sums, values);
    }
}

/// 4π c(x) of 4πx, as 2x / s(s + 1), s = √(1 + 4|x|): it loses nothing where x is small.
#[inline(always)]
fn bounded_field<F: Floats<Number = f32>>(field: F) -> F {
    let (one, per_turn) = (F::splat(1.0), F::splat(1.0 / std::f32::consts::PI));
    let root = (one + per_turn * field.abs()).sqrt();
    (field + field) / (root * (root + one))
}

/// Adds sums of 4π times winding numbers to values.
pub fn add_fields(sums: &[Octet; GROUPS], values: &mut [f64; BLOCK]) {
    for (values, sum) in values.chunks_mut(GROUP).zip(sums) {
        values.iter_mut().zip(sum.0).for_each(|(value, s)| *value += f64::from(s) * (1.0 / (4.0 * PI)));
    }
}

/// A dipole near a block of queries, relative to its centre. Its offset from a query is known to about ε L, ε = 2⁻²⁴ and L a
/// bound of the lengths of both, and its field |v|/d² to about 6 ε L |v|/d³.
#[derive(Clone, Copy, Default)]
pub struct Dipole {
    pub point: [f32; 3],
    pub vector: [f32; 3],
}

/// 6 ε / 4π over the error that is allowed.
const LEAST_CUBE: f32 = 0.029;
/// What d must exceed for that estimate to hold: 64 ε.
const LEAST_OFFSET: f32 = 4e-6;
const DIPOLE_ROUNDING: f64 = 1e-6;

impl Dipole {
    #[inline(always)]
    fn new(point: Vec3, vector: Vec3, queries: &QueryBlock) -> Dipole {
        let point = queries.scale * (point - queries.center);
        let vector = queries.scale * queries.scale * vector;
        Dipole { point: single(point), vector: single(vector) }
    }

    /// What d³ must exceed.
    #[inline(always)]
    fn least(&self, reach: f32) -> f32 {
        let size = |[x, y, z]: [f32; 3]| (x * x + y * y + z * z).sqrt();
        let length = size(self.point) + reach;
        let nearest = LEAST_OFFSET * length;
        (LEAST_CUBE * length * size(self.vector)).max(nearest * nearest * nearest)
    }

    /// 4π times the winding numbers at a part of a group, and the distances' cubes.
    #[inline(always)]
    pub fn field<F: Floats<Number = f32>>(&self, queries: &QueryGroup, part: usize) -> (F, F) {
        let [x, y, z] = relative::<F>(queries, part, self.point);
        let [vx, vy, vz] = self.vector;
        let (vx, vy, vz) = (F::splat(-vx), F::splat(-vy), F::splat(-vz));
        let square = x * x + y * y + z * z;
        let cube = square * square.sqrt();
        ((x * vx + y * vy + z * vz) / cube, cube)
    }
}

/// Moves the fields of a dipole in some lanes of a group from there to the values, computed in 64 bits. A dipole at a query
/// adds nothing.
#[cold]
#[inline(never)]
fn add_precisely(
    [point, vector]: [Vec3; 2],
    is_bounded: bool,
    (queries, group, lanes): (&QueryBlock, usize, u32),
    fields: &mut Octet,
    values: &mut [f64; BLOCK],
) {
    for lane in (0..GROUP).filter(|lane| lanes >> lane & 1 == 1) {
        let index = GROUP * group + lane;
        let q = [0, 1, 2].map(|axis| queries.positions[index / LANES][axis].to_array()[index % LANES]);
        let offset = point - Vec3::from_array(q);
        let square = offset.length_squared();
        fields.0[lane] = 0.0;
        if square > 0.0 {
            let winding = offset.dot(vector) / (square * square.sqrt() * 4.0 * PI);
            values[index] += if is_bounded { bounded(winding) } else { winding };
        }
    }
}
