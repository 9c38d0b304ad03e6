//! Triangles near a block of queries: by their solid angles at groups of queries next to them, and as dipoles at those that are
//! a few times farther away than they are large.
use super::angles::Angles;
use super::dipoles::{Dipole, add_fields};
use super::solid_angles::{NearTriangle, Sides, TRIANGLE_ROUNDING, add_cap};
use super::{GROUP, single};
use crate::data::BLOCK;
use crate::math::{Registers, Vec3, Work, area_vector, in_widest_registers};
use crate::treecode::{
    GROUPS, Kernel, Lanes, NearLeaf, Octet, QueryBlock, SourceKind, Sources, groups_of, parts,
};
use crate::winding::angle_product::with_signs;
use crate::winding::triangles::{Triangles, point_of, side_of_loose};
use std::f64::consts::PI;
use wide::f64x4;

/// The sources of a fraction are decided as crossings are, so that the solid angles of caps jump where these do; where it is
/// the principal value that is asked for, sides are taken as computed.
struct AsCrossings {
    is_fraction: bool,
}

impl Sides for AsCrossings {
    fn decide(&self, corners: &[Vec3; 3], queries: &Lanes, numerators: f64x4, open: u32) -> f64x4 {
        if !self.is_fraction {
            return numerators;
        }
        with_signs(numerators, open, |lane| side_of_loose(*corners, point_of(queries, lane)))
    }
}

impl Sources for Triangles {
    fn len(&self) -> usize {
        Kernel::len(self)
    }

    fn kind(&self) -> SourceKind {
        SourceKind::Triangles
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        Kernel::corners(self, index)
    }

    fn area_vector(&self, index: usize) -> Vec3 {
        area_vector(Kernel::corners(self, index))
    }

    fn rounding(&self) -> f64 {
        TRIANGLE_ROUNDING
    }

    fn add(
        &self,
        near: &[NearLeaf],
        items: &[u32],
        queries: &QueryBlock,
        error: f32,
        values: &mut [f64; BLOCK],
    ) {
        in_widest_registers(NearTriangles { triangles: self, near, items, queries, error, values });
    }
}

/// The work of [`Sources::add`].
struct NearTriangles<'a> {
    triangles: &'a Triangles,
    near: &'a [NearLeaf],
    items: &'a [u32],
    queries: &'a QueryBlock,
    error: f32,
    values: &'a mut [f64; BLOCK],
}

/// Least squared distance of a query from the barycentre of a triangle that acts on it as a dipole, in squared distances of the
/// farthest corner.
///
/// With t = r/d the series of a triangle of area A about its barycentre, where it has no terms of degree 1 in y, leaves out up
/// to 3 A m t² (1 − 2t/3)/(1−t)² / 4πd², where m ≤ 1/4 is the mean of |y|²/r², and A ≤ 1.3 r².
fn dipole_reach(error: f32) -> f32 {
    const FACTOR: f32 = 3.0 * 1.3 / 4.0 * (1.0 - 2.0 / 9.0) * 9.0 / 4.0 / (4.0 * PI) as f32;
    (FACTOR / error).sqrt().max(9.0)
}

/// Least squared distance for that, in squares of the distances of triangle and queries from the middle of the block: nearer,
/// 32-bit positions give a wrong direction. By no more than 2e-4, of a field that is no more than 0.012.
const NEAREST_DIPOLE: f32 = 4e-6;

/// Triangles that are prepared together.
const BATCH: usize = 16;

/// A triangle relative to the middle of a block.
#[derive(Clone, Copy, Default)]
struct Prepared {
    dipole: Dipole,
    /// From which squared distance on it acts as that.
    least: f32,
    near: NearTriangle,
}

impl Prepared {
    #[inline(always)]
    fn new(corners: &[Vec3; 3], queries: &QueryBlock, dipole_reach: f32) -> Prepared {
        let [a, b, c] = corners;
        let a = queries.scale * (*a - queries.center);
        let b = queries.scale * (*b - queries.center);
        let c = queries.scale * (*c - queries.center);
        let normal = (b - a).cross(c - a);
        let middle = (a + b + c) * (1.0 / 3.0);
        let dipole = Dipole { point: single(middle), vector: single(0.5 * normal) };
        let near = NearTriangle::new([single(a), single(b), single(c)], single(normal), queries.reach);
        let [x, y, z] = dipole.point;
        let extent = x * x + y * y + z * z + queries.reach * queries.reach;
        let least = (dipole_reach * near.largest_square(dipole.point)).max(NEAREST_DIPOLE * extent);
        Prepared { dipole, least, near }
    }
}

impl Work for NearTriangles<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        let NearTriangles { triangles, near, items, queries, error, values } = self;
        let (mut dipoles, mut angles) = ([Octet::ZERO; GROUPS], [Angles::ZERO; GROUPS]);
        let (caps, reach) = (triangles.caps(), dipole_reach(error));
        let sides = AsCrossings { is_fraction: triangles.is_fraction() };
        // Groups whose angles are not all 0.
        let mut turned = 0;
        let mut batch = [Prepared::default(); BATCH];
        for leaf in near {
            for members in leaf.members(items).chunks(BATCH) {
                for (prepared, i) in batch.iter_mut().zip(members) {
                    *prepared = Prepared::new(&Kernel::corners(triangles, *i as usize), queries, reach);
                }
                for (triangle, i) in batch.iter().zip(members) {
                    let corners = || Kernel::corners(triangles, *i as usize);
                    if (*i as usize) < caps {
                        add_cap(&corners(), queries, leaf.wanted, &mut angles);
                        turned |= leaf.wanted;
                        continue;
                    }
                    let point = triangle.dipole.point;
                    let far = leaf.wanted & queries.groups_beyond::<R::Singles>(point, triangle.least);
                    for group in groups_of(far) {
                        for part in parts::<R::Singles>() {
                            let queries = &queries.offsets[group];
                            let (field, _) = triangle.dipole.field::<R::Singles>(queries, part);
                            dipoles[group].add(part, field);
                        }
                    }
                    let close = leaf.wanted & !far;
                    turned |= close;
                    for group in groups_of(close) {
                        triangle.near.add::<R::Singles, _>(
                            corners,
                            &sides,
                            queries,
                            group,
                            &mut angles[group],
                        );
                    }
                }
            }
        }
        add_fields(&dipoles, values);
        for group in groups_of(turned) {
            let values = &mut values[GROUP * group..][..GROUP];
            values.iter_mut().zip(angles[group].turns()).for_each(|(value, turns)| *value += turns);
        }
    }
}
