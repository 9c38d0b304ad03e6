use super::triangles::AngleProduct;
use crate::bvh::WIDTH;
use crate::data::TriangleSoup;
use crate::math::{Vec3, area_vector, perturbed_side_of_plane};
use crate::treecode::{Kernel, Lanes, Quadrature};
use wide::f64x4;

/// Relative rounding error of a triple product of differences, with a margin.
const ERROR: f64 = 16.0 * f64::EPSILON;

/// The sources of a soup's fraction: caps, then triangles of loose components.
pub struct Pieces {
    triangles: Vec<[Vec3; 3]>,
    caps: usize,
}

impl Pieces {
    pub fn new(mut caps: Vec<[Vec3; 3]>, loose: impl IntoIterator<Item = [Vec3; 3]>) -> Pieces {
        let count = caps.len();
        caps.extend(loose);
        Pieces { triangles: caps, caps: count }
    }
}

/// Four triangles; in the lanes of caps the front side is decided as the crossing of the cap is.
#[derive(Clone)]
pub struct PieceBlock {
    corners: [Lanes; 3],
    is_cap: f64x4,
}

impl Kernel for Pieces {
    type Block = PieceBlock;
    type Sum = AngleProduct;

    fn len(&self) -> usize {
        self.triangles.len()
    }

    fn corners(&self, index: usize) -> [Vec3; 3] {
        self.triangles[index]
    }

    fn quadrature(&self, index: usize) -> Quadrature {
        let [a, b, c] = self.triangles[index];
        let area_vector = area_vector([a, b, c]);
        let points = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
        Quadrature { points, area_vector, area: area_vector.length() }
    }

    fn block(&self, members: [Option<usize>; WIDTH]) -> PieceBlock {
        let corners = members.map(|m| m.map_or([Vec3::ZERO; 3], |i| self.triangles[i]));
        let is_cap = members.map(|m| m.is_some_and(|i| i < self.caps));
        let mask = is_cap.map(|cap| f64::from_bits(if cap { u64::MAX } else { 0 }));
        let lanes =
            [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| f64x4::from(corners.map(|c| c[corner][axis]))));
        PieceBlock { corners: lanes, is_cap: f64x4::from(mask) }
    }

    fn sum() -> AngleProduct {
        AngleProduct::ONE
    }

    #[inline(always)]
    fn add(sum: &mut AngleProduct, block: &PieceBlock, q: &Lanes) {
        let (denominator, mut numerator, scale) = super::triangles::angle(&block.corners, q);
        let doubtful = block.is_cap
            & denominator.simd_le(f64x4::ZERO)
            & numerator.abs().simd_le(f64x4::splat(ERROR) * scale);
        if doubtful.any() {
            numerator = decided(numerator, doubtful, block, q);
        }
        sum.multiply(denominator, numerator);
    }

    #[inline(always)]
    fn add_gradient(sum: &mut Lanes, block: &PieceBlock, q: &Lanes) {
        TriangleSoup::add_gradient(sum, &block.corners, q);
    }

    fn total(sum: AngleProduct) -> f64 {
        sum.turns()
    }
}

/// Numerators with the sign that the exact predicate gives q' in the doubtful lanes, where the query lies on a cap or next
/// to it: its solid angle then jumps exactly where its crossing does.
#[cold]
fn decided(numerator: f64x4, doubtful: f64x4, block: &PieceBlock, q: &Lanes) -> f64x4 {
    let mut parts = numerator.to_array();
    let mask = doubtful.to_bitmask();
    for k in (0..WIDTH).filter(|k| mask >> k & 1 == 1) {
        let at = |lanes: &Lanes| Vec3::from_array([0, 1, 2].map(|axis| lanes[axis].to_array()[k]));
        // Seen from the side to which the normal points the solid angle is negative.
        let side = -perturbed_side_of_plane(at(q), block.corners.each_ref().map(at));
        parts[k] = f64::from(side) * parts[k].abs().max(f64::MIN_POSITIVE);
    }
    f64x4::from(parts)
}
