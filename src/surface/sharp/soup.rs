//! What the triangles of a soup say of the surface near a place.
use super::plane::{Plane, meeting_of};
use super::{Evidence, Limits, Search};
use crate::bvh::Bvh;
use crate::data::TriangleSoup;
use crate::math::{Aabb, Vec3, area_vector, distance_to_triangle};
use crate::winding::WindingField;

/// Most triangles in a leaf of the tree.
const LEAF_SIZE: usize = 4;
/// How far from its triangle a vertex is at most, in cells: bisection ends at a millionth.
const ON_TRIANGLE: f64 = 1e-5;
/// How far from it its two sides are looked at, in cells.
const ASIDE: f64 = 1e-3;
/// How far from an edge or a corner, in cells, its triangles are looked for.
const AROUND: f64 = 0.3;
/// How far from each of them it may lie: none is invented where the soup has a fillet.
const OFF: f64 = 0.05;

/// The triangles of a soup, and the field that tells their sides.
pub struct OfSoup<'a> {
    pub soup: &'a TriangleSoup,
    pub field: &'a WindingField,
    pub level: f64,
    pub bvh: Bvh,
    pub spacing: f64,
    pub limits: Limits,
}

/// A tree over the triangles of a soup.
pub fn tree_of(soup: &TriangleSoup) -> Bvh {
    let boxes: Vec<Aabb> = (0..soup.len()).map(|t| Aabb::around(soup.corners(t))).collect();
    Bvh::build(&boxes, LEAF_SIZE)
}

impl OfSoup<'_> {
    /// The distance and the number of the triangle nearest to a place, of those within `reach` for which `wanted` holds.
    fn nearest(&self, place: Vec3, reach: f64, wanted: impl Fn(Vec3) -> bool) -> Option<(f64, usize)> {
        let mut best: Option<(f64, usize)> = None;
        let is_near = |bounds: &Aabb| bounds.padded(reach).contains(place);
        self.bvh.for_each(is_near, |t| {
            let corners = self.soup.corners(t);
            let found = (distance_to_triangle(place, corners), t);
            let is_nearer = found.0 <= reach && best.is_none_or(|best| found < best);
            if is_nearer && wanted(area_vector(corners).normalize_or_zero()) {
                best = Some(found);
            }
        });
        best
    }

    fn hit(&self, place: Vec3) -> Option<Vec3> {
        let found = self.nearest(place, ON_TRIANGLE * self.spacing, |normal| normal != Vec3::ZERO);
        found.map(|(_, t)| area_vector(self.soup.corners(t)).normalize_or_zero())
    }
}

impl Evidence for OfSoup<'_> {
    fn normal(&self, place: Vec3, _: &mut Search) -> Option<Vec3> {
        self.hit(place)
    }

    fn plane(&self, place: Vec3, _: Vec3, search: &mut Search) -> Option<Plane> {
        // Triangles may be flipped, the surface is not.
        let normal = self.hit(place)?;
        let step = ASIDE * self.spacing * normal;
        let mut inside = |place| self.field.is_nearly_above(place, self.level, &mut search.scratch);
        match [inside(place - step), inside(place + step)] {
            [true, false] => Some(Plane { point: place, normal }),
            [false, true] => Some(Plane { point: place, normal: -normal }),
            _ => None,
        }
    }

    fn meeting(&self, place: Vec3, planes: &[Plane], _: &mut Search) -> Option<Vec3> {
        let refit = |plane: &Plane| {
            let is_alike = |normal: Vec3| normal.dot(plane.normal).abs() >= self.limits.same;
            let (_, t) = self.nearest(place, AROUND * self.spacing, is_alike)?;
            let corners = self.soup.corners(t);
            let normal = area_vector(corners).normalize_or_zero();
            let sign = if normal.dot(plane.normal) < 0.0 { -1.0 } else { 1.0 };
            Some((Plane { point: corners[0], normal: sign * normal }, corners))
        };
        let found: Option<Vec<(Plane, [Vec3; 3])>> = planes.iter().map(refit).collect();
        let (planes, triangles): (Vec<Plane>, Vec<[Vec3; 3]>) = found?.into_iter().unzip();
        let is_on =
            |met: &Vec3| triangles.iter().all(|t| distance_to_triangle(*met, *t) <= OFF * self.spacing);
        meeting_of(&planes, place).filter(is_on)
    }
}
