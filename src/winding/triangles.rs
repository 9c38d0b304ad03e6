//! Triangles as sources: solid angles near, dipole moments far (Barill et al. 2018, section 3.3).
use super::angle_product::AngleProduct;
use super::closure::Closure;
use super::surface_rule::{decided_halves, lane};
use crate::bvh::WIDTH;
use crate::data::TriangleSoup;
use crate::math::{Vec3, area_vector};
use crate::treecode::{Kernel, Lanes, Quadrature};
use std::sync::Arc;
use wide::f64x4;

/// Relative rounding error of a triple product of differences, with a margin.
const ERROR: f64 = 16.0 * f64::EPSILON;

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
    /// Whether exact predicates tell the side of a query where rounding leaves it open.
    is_decided: bool,
}

impl TriangleBlock {
    /// Up to four triangles. A lane without one holds three equal corners: it has no normal and adds nothing.
    pub fn new(triangles: [Option<[Vec3; 3]>; WIDTH]) -> TriangleBlock {
        let triangles = triangles.map(|t| t.unwrap_or([Vec3::ZERO; 3]));
        let lanes = |corner: usize, axis: usize| f64x4::from(triangles.map(|t| t[corner][axis]));
        TriangleBlock { corners: [0, 1, 2].map(|c| [0, 1, 2].map(|axis| lanes(c, axis))), is_decided: false }
    }
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
        TriangleBlock { is_decided: self.is_fraction(), ..block }
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
        let mut denominator = la * lb * lc + dot(&a, &b) * lc + dot(&b, &c) * la + dot(&c, &a) * lb;
        if block.is_decided {
            let size = la * dot(&u, &u).sqrt() * dot(&v, &v).sqrt();
            let is_small = numerator.abs().simd_le(f64x4::splat(ERROR) * size);
            // On the rim both are 0, to rounding.
            let doubtful = (is_small & denominator.simd_le(f64x4::splat(ERROR) * la * lb * lc)).to_bitmask();
            if doubtful != 0 {
                let corners =
                    |k: usize| [&block.corners[0], &block.corners[1], &block.corners[2]].map(|c| lane(c, k));
                [numerator, denominator] = decided_halves([numerator, denominator], doubtful, q, corners);
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
            add_edge(sum, [&relative[i], &relative[j]], [lengths[i], lengths[j]], &along);
        }
    }
}

/// [`super::edge_gradient`] of four edges, times 4π, given their ends relative to the query.
#[inline(always)]
fn add_edge(sum: &mut Lanes, [a, b]: [&Lanes; 2], [la, lb]: [f64x4; 2], along: &Lanes) {
    let one = f64x4::ONE;
    let is_a_nearer = la.simd_le(lb);
    let near = [0, 1, 2].map(|i| is_a_nearer.bitselect(a[i], b[i]));
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
