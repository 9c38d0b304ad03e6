//! The exact fraction of an open soup, from its boundary edges alone.
//!
//! Each boundary edge (a, b) hangs a *curtain*: the strip from the edge to infinity along +x. The soup and the curtains
//! have no boundary, so w = (crossings of the soup by the ray from q along −x) + Σ (solid angles of the curtains) / 4π;
//! the ray runs along the curtains and crosses none. With a and b relative to q, |a| + aₓ = s and a_y + i·a_z = ζ, the
//! half solid angle of a curtain is the argument of s_a s_b + ζ̄_a ζ_b: the formula of van Oosterom & Strackee 1983 with
//! one corner at infinity. All arguments are summed as one product (Antipodal, arXiv 2605.01536, has the same curtain).
//!
//! Crossing and solid angle jump together where q passes under an edge: there the argument is near ±π, and its sign is
//! that of the exact predicate which also decides the crossing.
use super::angle_product::{AngleProduct, with_signs};
use crate::bvh::WIDTH;
use crate::math::{Vec3, side_of_edge, touches_segment};
use wide::f64x4;

/// Queries evaluated together.
pub const LANES: usize = WIDTH;

/// Relative error of a cross product of two rounded differences, with a margin.
const CROSS_ERROR: f64 = 4.0 * f64::EPSILON;
/// In the place of the infinitely small ε of the predicates: its square is still a normal number.
const TINY: f64 = 1e-100;

/// The boundary cycles of a soup.
#[derive(Clone, Debug, Default)]
pub struct Curtain {
    cycles: Vec<Vec<Vec3>>,
    edges: usize,
}

/// One end of an edge, seen from four queries.
#[derive(Clone, Copy)]
struct End {
    s: f64x4,
    y: f64x4,
    z: f64x4,
}

impl Curtain {
    pub fn new(cycles: Vec<Vec<Vec3>>) -> Curtain {
        let edges = cycles.iter().map(Vec::len).sum();
        Curtain { cycles, edges }
    }

    pub fn cycles(&self) -> &[Vec<Vec3>] {
        &self.cycles
    }

    /// Number of boundary edges.
    pub fn edges(&self) -> usize {
        self.edges
    }

    /// Directed boundary edges.
    pub fn each_edge(&self) -> impl Iterator<Item = [Vec3; 2]> + '_ {
        self.cycles.iter().flat_map(|c| (0..c.len()).map(move |k| [c[k], c[(k + 1) % c.len()]]))
    }

    /// Whether `q` lies on a boundary edge.
    pub fn touches(&self, q: Vec3) -> bool {
        self.each_edge().any(|edge| touches_segment(q, edge))
    }

    /// Σ (solid angles of the curtains) / 4π at four queries. Not defined on a boundary edge itself.
    pub fn fractions(&self, queries: &[Vec3; LANES]) -> [f64; LANES] {
        let lanes = [0, 1, 2].map(|axis| f64x4::from(queries.map(|q| q[axis])));
        let mut product = AngleProduct::ONE;
        self.cycles.iter().for_each(|cycle| multiply_cycle(&mut product, cycle, queries, &lanes));
        product.turns_of_lanes()
    }

    /// [`Curtain::fractions`] at one query.
    pub fn fraction(&self, q: Vec3) -> f64 {
        if self.edges == 0 { 0.0 } else { self.fractions(&[q; LANES])[0] }
    }
}

/// [`Curtain::fractions`] of a single cycle.
pub fn fractions_of(cycle: &[Vec3], queries: &[Vec3; LANES]) -> [f64; LANES] {
    let lanes = [0, 1, 2].map(|axis| f64x4::from(queries.map(|q| q[axis])));
    let mut product = AngleProduct::ONE;
    multiply_cycle(&mut product, cycle, queries, &lanes);
    product.turns_of_lanes()
}

fn multiply_cycle(product: &mut AngleProduct, cycle: &[Vec3], queries: &[Vec3; LANES], lanes: &[f64x4; 3]) {
    let mut from = cycle[cycle.len() - 1];
    let mut from_end = end(from, lanes);
    for &to in cycle {
        let to_end = end(to, lanes);
        multiply(product, &from_end, &to_end, [from, to], queries);
        (from, from_end) = (to, to_end);
    }
}

fn end(p: Vec3, q: &[f64x4; 3]) -> End {
    let (x, y, z) = (f64x4::splat(p.x) - q[0], f64x4::splat(p.y) - q[1], f64x4::splat(p.z) - q[2]);
    let across = y * y + z * z;
    let length = (x * x + across).sqrt();
    // Behind the query the sum would cancel; both forms are equal.
    let behind = x.simd_lt(f64x4::ZERO);
    if behind.none() {
        return End { s: length + x, y, z };
    }
    let on_axis = behind & across.simd_eq(f64x4::ZERO);
    let s = behind.bitselect(across / (length - x), length + x);
    if on_axis.none() {
        return End { s, y, z };
    }
    // Seen from q' the vertex lies at (−ε, −ε²).
    let y = on_axis.bitselect(f64x4::splat(-TINY), y);
    let z = on_axis.bitselect(f64x4::splat(-TINY * TINY), z);
    End { s: on_axis.bitselect(f64x4::ZERO, s), y, z }
}

/// The factors of the edges of a triangle at a query, real and imaginary part: their arguments and 2π for each crossing by the
/// ray along −x make up half its solid angle. In two triangles that share an edge, its factors are exactly conjugate.
pub fn factors_of(triangle: &[Vec3; 3], q: Vec3) -> [[f64; 2]; 3] {
    let ends = triangle.map(|p| end(p, &q.to_array().map(f64x4::splat)));
    [0, 1, 2].map(|k| {
        let next = (k + 1) % 3;
        factors(&ends[k], &ends[next], [triangle[k], triangle[next]], &[q; LANES])
            .map(|part| part.to_array()[0])
    })
}

/// Multiplies by the factors of an edge, one for each query.
#[inline(always)]
fn multiply(product: &mut AngleProduct, a: &End, b: &End, edge: [Vec3; 2], queries: &[Vec3; LANES]) {
    let [real, imaginary] = factors(a, b, edge, queries);
    product.multiply(real, imaginary);
}

#[inline(always)]
fn factors(a: &End, b: &End, edge: [Vec3; 2], queries: &[Vec3; LANES]) -> [f64x4; 2] {
    let real = a.s * b.s + a.y * b.y + a.z * b.z;
    let (left, right) = (a.y * b.z, a.z * b.y);
    let mut imaginary = left - right;
    let bound = f64x4::splat(CROSS_ERROR) * (left.abs() + right.abs());
    let doubtful = real.simd_lt(f64x4::ZERO) & imaginary.abs().simd_le(bound);
    if doubtful.any() {
        imaginary = decided(imaginary, doubtful, edge, queries);
    }
    [real, imaginary]
}

/// Imaginary parts with the signs of the exact predicate in the doubtful lanes.
#[cold]
fn decided(imaginary: f64x4, doubtful: f64x4, [from, to]: [Vec3; 2], queries: &[Vec3; LANES]) -> f64x4 {
    with_signs(imaginary, doubtful.to_bitmask(), |k| f64::from(side_of_edge(queries[k], from, to)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::TriangleSoup;
    use crate::math::{covers, perturbed_side_of_plane};
    use crate::winding::winding_of_soup;

    /// Crossings of the ray along −x.
    fn crossings(q: Vec3, triangle: [Vec3; 3]) -> f64 {
        if !covers(q, triangle) {
            return 0.0;
        }
        let outward = f64::from(crate::math::orient_yz(triangle[0], triangle[1], triangle[2]));
        if f64::from(perturbed_side_of_plane(q, triangle)) * outward > 0.0 { -outward } else { 0.0 }
    }

    #[test]
    fn crossings_and_curtains_of_a_triangle_give_its_solid_angle() {
        let triangle = [Vec3::new(0.3, -0.2, 0.1), Vec3::new(-0.4, 0.9, 0.2), Vec3::new(0.1, 0.3, 1.1)];
        let soup = TriangleSoup::new(triangle.to_vec(), vec![[0, 1, 2]]).unwrap();
        let curtain = Curtain::new(vec![triangle.to_vec()]);
        let grid = |i: i32| -2.0 + 0.1 * f64::from(i);
        for k in 0..41 * 41 {
            for x in [-3.0, -0.3, 0.05, 0.4, 5.0, 1e4] {
                let q = Vec3::new(x, grid(k % 41), grid(k / 41));
                let w = crossings(q, triangle) + curtain.fraction(q);
                assert!((w - winding_of_soup(&soup, q)).abs() < 1e-14, "{q}: {w}");
            }
        }
    }

    #[test]
    fn a_square_rim_with_vertices_in_line_is_right() {
        let corner = |k: usize| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)][k % 4];
        let rim: Vec<Vec3> = (0..24)
            .map(|k| {
                let ((y0, z0), (y1, z1), t) = (corner(k / 6), corner(k / 6 + 1), (k % 6) as f64 / 6.0);
                Vec3::new(-1.0, y0 + t * (y1 - y0), z0 + t * (z1 - z0))
            })
            .collect();
        let fan: Vec<[u32; 3]> = (1..23).map(|k| [0, k, k + 1]).collect();
        let soup = TriangleSoup::new(rim.clone(), fan).unwrap();
        let curtain = Curtain::new(vec![rim]);
        for k in 0..21 * 21 {
            for x in [-4.0, -1.25, -0.75, 1.25, 1e3] {
                let q = Vec3::new(x, -1.5 + 0.125 * f64::from(k % 21), -1.5 + 0.125 * f64::from(k / 21));
                let n: f64 = (0..soup.len()).map(|t| crossings(q, soup.corners(t))).sum();
                let w = n + curtain.fraction(q);
                assert!((w - winding_of_soup(&soup, q)).abs() < 1e-13, "{q}: {n} + {}", w - n);
            }
        }
    }

    #[test]
    fn queries_straight_under_a_vertex_or_an_edge_are_right() {
        let triangle = [Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.25, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];
        let soup = TriangleSoup::new(triangle.to_vec(), vec![[0, 1, 2]]).unwrap();
        let curtain = Curtain::new(vec![triangle.to_vec()]);
        for (y, z) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5), (0.25, 0.75)] {
            for x in [-4.0, -1.0, 1.0, 3.0, 1e3] {
                let q = Vec3::new(x, y, z);
                let w = crossings(q, triangle) + curtain.fraction(q);
                assert!((w - winding_of_soup(&soup, q)).abs() < 1e-14, "{q}: {w}");
            }
        }
    }
}
