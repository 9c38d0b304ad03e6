//! Triangles as sources: solid angles near, dipole moments far (Barill et al. 2018, section 3.3).
use super::angle_product::{AngleProduct, with_signs};
use super::closure::{Closure, crossings_of_caps};
use super::curtain::factors_of;
use super::half_angle::LEAST_OF_CAP;
use crate::bvh::WIDTH;
use crate::data::{TriangleSoup, ones};
use crate::math::{Vec3, area_vector, perturbed_side_of_plane};
use crate::treecode::{Kernel, Lanes, Quadrature};
use std::sync::Arc;
use wide::f64x4;

/// Relative rounding error of a triple product of differences, with a margin.
const ERROR: f64 = 16.0 * f64::EPSILON;

/// Squared sine between an edge of a cap and the query below which there is no gradient (NaN). What the caps on both sides add
/// cancels, but grows as 1/distance, and with it what rounding leaves of it.
const BESIDE: f64 = 1e-18;

/// All triangles of a soup; or with a closure the sources of the soup's fraction: its caps, then its loose triangles.
#[derive(Clone)]
pub struct Triangles {
    soup: Arc<TriangleSoup>,
    closure: Option<Arc<Closure>>,
}

impl Triangles {
    /// All triangles of a soup: what the paper's evaluator sums.
    pub fn new(soup: Arc<TriangleSoup>) -> Triangles {
        Triangles { soup, closure: None }
    }

    /// How many caps come first.
    pub(super) fn caps(&self) -> usize {
        self.closure.as_ref().map_or(0, |c| c.caps.len())
    }

    /// Whether these are what a fraction is summed over: its jumps are where crossings have theirs.
    pub(super) fn is_fraction(&self) -> bool {
        self.closure.is_some()
    }

    pub(super) fn of_fraction(soup: Arc<TriangleSoup>, closure: Arc<Closure>) -> Triangles {
        Triangles { soup, closure: Some(closure) }
    }
}

/// Four triangles.
#[derive(Clone)]
pub struct TriangleBlock {
    corners: [Lanes; 3],
    /// The lanes of a fraction's caps and of its loose triangles, a bit each: where rounding leaves solid angles open, exact
    /// predicates decide.
    caps: u32,
    loose: u32,
}

impl TriangleBlock {
    /// Up to four triangles. A lane without one holds three equal corners: it has no normal and adds nothing.
    pub fn new(triangles: [Option<[Vec3; 3]>; WIDTH]) -> TriangleBlock {
        let triangles = triangles.map(|t| t.unwrap_or([Vec3::ZERO; 3]));
        let lanes = |corner: usize, axis: usize| f64x4::from(triangles.map(|t| t[corner][axis]));
        TriangleBlock { corners: [0, 1, 2].map(|c| [0, 1, 2].map(|axis| lanes(c, axis))), caps: 0, loose: 0 }
    }

    fn triangle(&self, lane: usize) -> [Vec3; 3] {
        self.corners.each_ref().map(|c| point_of(c, lane))
    }

    /// Numerators, 0 in the lanes of `caps` that hold a cap: that is added by its edges and its crossing. Those of loose
    /// triangles in the lanes of `flat`, in the plane of which the query lies to rounding, have the sign of the exact predicate.
    #[cold]
    fn decided(&self, sum: &mut AngleProduct, numerators: f64x4, [near, flat]: [u32; 2], q: &Lanes) -> f64x4 {
        let mut parts = numerators.to_array();
        for lane in ones(u64::from(near & self.caps)) {
            let (cap, q) = (self.triangle(lane), point_of(q, lane));
            sum.multiply_lane(lane, &factors_of(&cap, q), -f64::from(crossings_of_caps(&[cap], q)));
            parts[lane] = 0.0;
        }
        with_signs(f64x4::from(parts), flat & self.loose, |lane| {
            side_of_loose(self.triangle(lane), point_of(q, lane))
        })
    }
}

/// The sign of the numerator of a loose triangle at q'.
pub(super) fn side_of_loose(corners: [Vec3; 3], q: Vec3) -> f64 {
    // Seen from the side to which the normal points the solid angle is negative.
    -f64::from(perturbed_side_of_plane(q, corners))
}

/// The point in a lane.
pub(super) fn point_of(points: &Lanes, lane: usize) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|axis| points[axis].to_array()[lane]))
}

impl Kernel for Triangles {
    type Block = TriangleBlock;
    type Sum = AngleProduct;
    type Mode = ();

    fn len(&self) -> usize {
        self.closure.as_ref().map_or(self.soup.len(), |c| c.caps.len() + c.loose.len())
    }

    #[inline]
    fn corners(&self, index: usize) -> [Vec3; 3] {
        match &self.closure {
            None => self.soup.corners(index),
            Some(closure) => match index.checked_sub(closure.caps.len()) {
                None => closure.caps[index],
                Some(place) => self.soup.corners(closure.loose[place] as usize),
            },
        }
    }

    fn quadrature(&self, index: usize) -> Quadrature {
        let [a, b, c] = self.corners(index);
        let area_vector = area_vector([a, b, c]);
        let points = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
        Quadrature { points, area_vector, area: area_vector.length(), extent: 0.0 }
    }

    fn block(&self, members: [Option<usize>; WIDTH]) -> TriangleBlock {
        let block = TriangleBlock::new(members.map(|m| m.map(|i| self.corners(i))));
        if !self.is_fraction() {
            return block;
        }
        let lanes = |is_one: &dyn Fn(usize) -> bool| {
            (0..WIDTH).fold(0, |lanes, k| lanes | u32::from(members[k].is_some_and(is_one)) << k)
        };
        let caps = self.caps();
        TriangleBlock { caps: lanes(&|i| i < caps), loose: lanes(&|i| i >= caps), ..block }
    }

    fn mode(&self) {}

    fn sum((): ()) -> AngleProduct {
        AngleProduct::ONE
    }

    #[inline(always)]
    fn add(sum: &mut AngleProduct, block: &TriangleBlock, q: &Lanes) {
        let [a, b, c] = &block.corners;
        // The normal from edges, not from corners relative to the query: that stays accurate far away.
        let (u, v) = (minus(b, a), minus(c, a));
        let normal = cross(&u, &v);
        let (a, b, c) = (minus(a, q), minus(b, q), minus(c, q));
        let mut numerator = dot(&a, &normal);
        let (la, lb, lc) = (dot(&a, &a).sqrt(), dot(&b, &b).sqrt(), dot(&c, &c).sqrt());
        let denominator = la * lb * lc + dot(&a, &b) * lc + dot(&b, &c) * la + dot(&c, &a) * lb;
        if block.caps | block.loose != 0 {
            let size = la * dot(&u, &u).sqrt() * dot(&v, &v).sqrt();
            let small = f64x4::splat(LEAST_OF_CAP) * (size + la * lb * lc);
            let near = (numerator.abs().simd_le(small) & denominator.simd_le(small)).to_bitmask();
            if near != 0 {
                let is_flat = numerator.abs().simd_le(f64x4::splat(ERROR) * size);
                let flat = (is_flat & denominator.simd_le(f64x4::ZERO)).to_bitmask();
                numerator = block.decided(sum, numerator, [near, flat], q);
            }
        }
        sum.multiply(denominator, numerator);
    }

    fn total(sum: AngleProduct) -> f64 {
        sum.turns()
    }

    #[inline(always)]
    fn add_gradient(sum: &mut Lanes, block: &TriangleBlock, q: &Lanes, (): ()) {
        let relative = block.corners.each_ref().map(|c| minus(c, q));
        let lengths = relative.each_ref().map(|r| dot(r, r).sqrt());
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let along = minus(&block.corners[j], &block.corners[i]);
            let sine_squared = add_edge(sum, [&relative[i], &relative[j]], [lengths[i], lengths[j]], &along);
            let is_beside =
                block.caps != 0 && sine_squared.simd_lt(f64x4::splat(BESIDE)).to_bitmask() & block.caps != 0;
            if is_beside {
                sum[0] = f64x4::splat(f64::NAN);
            }
        }
    }
}

/// Adds [`super::edge_gradient`] of four edges, times 4π, given their ends relative to the query. Gives the squared sines between these
/// and the edges.
#[inline(always)]
fn add_edge(sum: &mut Lanes, [a, b]: [&Lanes; 2], [la, lb]: [f64x4; 2], along: &Lanes) -> f64x4 {
    let one = f64x4::ONE;
    // With both as near as each other it is their middle: of an edge and of the same turned around they are to cancel exactly.
    let (is_a_nearer, is_b_nearer) = (la.simd_lt(lb), lb.simd_lt(la));
    let near = [0, 1, 2].map(|i| {
        let middle = f64x4::splat(0.5) * (a[i] + b[i]);
        is_a_nearer.bitselect(a[i], is_b_nearer.bitselect(b[i], middle))
    });
    let inverse = one / (la * lb);
    let sine = cross(&near, along).map(|c| c * inverse);
    let sine_squared = dot(&sine, &sine);
    let cosine = dot(a, b) * inverse;
    let weight = cosine.simd_ge(f64x4::ZERO).bitselect(one / (one + cosine), (one - cosine) / sine_squared);
    // Comparisons with NaN, at an end of the edge, fail too.
    let is_aside = sine_squared.simd_gt(f64x4::ZERO);
    let weight = weight * (la + lb) * inverse;
    for i in 0..3 {
        sum[i] += is_aside & (weight * sine[i]);
    }
    sine_squared
}

fn minus(a: &Lanes, b: &Lanes) -> Lanes {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: &Lanes, b: &Lanes) -> f64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Lanes, b: &Lanes) -> Lanes {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
