//! Leaves of the tree: four triangles, or four points, that are looked at together.
use crate::bvh::{NarrowBvh, Narrowed};
use crate::data::TriangleSoup;
use crate::math::{Vec3, area_vector};
use wide::f32x4;

/// Elements of a leaf: as many as 32-bit floats in a register.
pub const LEAF_SIZE: usize = 4;

type Four = [f32; LEAF_SIZE];

/// Four triangles in 32-bit floats, by axis, as their tree has coordinates.
#[derive(Clone, Copy, Debug, Default)]
pub struct TrianglePack {
    a: [Four; 3],
    /// From the first corner to the others.
    ab: [Four; 3],
    ac: [Four; 3],
    /// Unit; NaN where there is no area.
    normal: [Four; 3],
    /// The triangles' numbers; the last one is repeated.
    pub elements: [u32; LEAF_SIZE],
}

type Wide = [f32x4; 3];

#[inline(always)]
fn wide(values: &[Four; 3]) -> Wide {
    // Written out: calls of `map` are not inlined here.
    [f32x4::new(values[0]), f32x4::new(values[1]), f32x4::new(values[2])]
}

#[inline(always)]
fn dot(u: &Wide, v: &Wide) -> f32x4 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

#[inline(always)]
fn cross(u: &Wide, v: &Wide) -> Wide {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

#[inline(always)]
fn minus(u: &Wide, v: &Wide) -> Wide {
    [u[0] - v[0], u[1] - v[1], u[2] - v[2]]
}

/// The squared distance from the end of `p` to the segment from 0 to the end of `side`.
#[inline(always)]
fn to_segment(p: &Wide, side: &Wide) -> f32x4 {
    // A side without length is its first end.
    let length = dot(side, side).fast_max(f32x4::splat(f32::MIN_POSITIVE));
    let share = (dot(p, side) / length).fast_max(f32x4::ZERO).fast_min(f32x4::ONE);
    let left = [p[0] - share * side[0], p[1] - share * side[1], p[2] - share * side[2]];
    dot(&left, &left)
}

impl TrianglePack {
    pub fn new(soup: &TriangleSoup, tree: &NarrowBvh, triangles: &[u32]) -> TrianglePack {
        let mut pack = TrianglePack::default();
        for lane in 0..LEAF_SIZE {
            let triangle = triangles[lane.min(triangles.len() - 1)];
            let [a, b, c] = soup.corners(triangle as usize);
            let normal =
                area_vector([a, b, c]).try_normalize().map_or([f32::NAN; 3], |n| n.as_vec3().to_array());
            let parts = [
                (&mut pack.a, tree.narrow(a).place),
                (&mut pack.ab, tree.narrow_offset(b - a)),
                (&mut pack.ac, tree.narrow_offset(c - a)),
                (&mut pack.normal, normal),
            ];
            for (wide, vector) in parts {
                (0..3).for_each(|axis| wide[axis][lane] = vector[axis]);
            }
            pack.elements[lane] = triangle;
        }
        pack
    }

    /// Squared distances in 32-bit floats.
    #[inline]
    pub fn squared_distances(&self, from: &Narrowed) -> Four {
        let [x, y, z] = from.place;
        let place = [f32x4::splat(x), f32x4::splat(y), f32x4::splat(z)];
        let (ab, ac, normal) = (wide(&self.ab), wide(&self.ac), wide(&self.normal));
        let p = minus(&place, &wide(&self.a));
        let (pb, bc) = (minus(&p, &ab), minus(&ac, &ab));
        let outline = to_segment(&p, &ab).fast_min(to_segment(&p, &ac)).fast_min(to_segment(&pb, &bc));
        let height = dot(&p, &normal);
        let across = cross(&p, &normal);
        // Which side of each side's perpendicular plane: (normal × side) · p = side · (p × normal). NaN is outside.
        let is_within = dot(&ab, &across).simd_ge(f32x4::ZERO)
            & dot(&ac, &across).simd_le(f32x4::ZERO)
            & dot(&bc, &cross(&pb, &normal)).simd_ge(f32x4::ZERO);
        is_within.bitselect(height * height, outline).to_array()
    }
}

/// Four points.
#[derive(Clone, Copy, Debug, Default)]
pub struct PointPack {
    points: [Vec3; LEAF_SIZE],
    /// The points' numbers; the last one is repeated.
    pub elements: [u32; LEAF_SIZE],
}

impl PointPack {
    pub fn new(points: &[Vec3], elements: &[u32]) -> PointPack {
        let element = |lane: usize| elements[lane.min(elements.len() - 1)];
        let elements = [0, 1, 2, 3].map(element);
        PointPack { points: elements.map(|e| points[e as usize]), elements }
    }

    #[inline]
    pub fn squared_distances(&self, place: Vec3) -> [f64; LEAF_SIZE] {
        let [a, b, c, d] = &self.points;
        [
            a.distance_squared(place),
            b.distance_squared(place),
            c.distance_squared(place),
            d.distance_squared(place),
        ]
    }
}
