//! Far fields of the four children of a node, evaluated together.
//!
//! With R = q − c, the field of a cluster is (1/4π) Σ A_γ ∂^γ(1/|R|), |γ| = 1, 2, 3. Each degree n equals
//! (−1)ⁿ (2n−1)!! Hₙ(R) / |R|^(2n+1), Hₙ the harmonic part of the polynomial Σ A_γ R^γ: 3, 5 and 7 coefficients
//! instead of 3, 9 and 18 (Barill et al. 2018, eqs. 22 to 24, with their traces removed).
use super::moments::Moments;
use crate::bvh::WIDTH;
use crate::math::Vec3;
use std::f64::consts::PI;
use wide::f32x4;

/// How many terms of the expansion are summed (Barill et al. 2018, section 3.2.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// One dipole for a cluster.
    Zero,
    One,
    Two,
}

/// A query in the tree's unit frame, each coordinate as the sum of two 32-bit floats: near a cluster a single one
/// would lose the direction.
#[derive(Clone, Copy)]
pub(super) struct Query {
    high: [f32x4; 3],
    low: [f32x4; 3],
}

impl Query {
    pub fn new(q: Vec3) -> Query {
        let parts = q.to_array().map(split);
        Query { high: parts.map(|p| f32x4::splat(p.0)), low: parts.map(|p| f32x4::splat(p.1)) }
    }
}

fn split(x: f64) -> (f32, f32) {
    let high = x as f32;
    (high, (x - f64::from(high)) as f32)
}

/// Far fields of the children of one node. An empty child has no coefficients and lies far outside the unit frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expansion {
    center_high: [f32x4; 3],
    center_low: [f32x4; 3],
    radius_squared: f32x4,
    dipole: [f32x4; 3],
    quadrupole: [f32x4; 5],
    octupole: [f32x4; 7],
}

/// Where empty children are put: far from every query of interest, so that no 0/0 arises.
const NOWHERE: f64 = 1e6;

impl Expansion {
    /// Packs moments and radii (farthest source point from the centre), both in the unit frame.
    pub fn pack(children: &[Option<(Moments, f64)>; WIDTH]) -> Expansion {
        let coefficients = children.each_ref().map(|c| c.as_ref().map(|(m, _)| Coefficients::of(m)));
        let lane = |f: &dyn Fn(&Coefficients) -> f64| {
            f32x4::from(coefficients.each_ref().map(|c| c.as_ref().map_or(0.0, |c| f(c) as f32)))
        };
        let center =
            |axis: usize| children.each_ref().map(|c| c.as_ref().map_or(NOWHERE, |c| c.0.center[axis]));
        Expansion {
            center_high: [0, 1, 2].map(|axis| f32x4::from(center(axis).map(|x| split(x).0))),
            center_low: [0, 1, 2].map(|axis| f32x4::from(center(axis).map(|x| split(x).1))),
            radius_squared: f32x4::from(
                children.each_ref().map(|c| c.as_ref().map_or(0.0, |c| (c.1 * c.1) as f32)),
            ),
            dipole: [0, 1, 2].map(|k| lane(&|c| c.dipole[k])),
            quadrupole: [0, 1, 2, 3, 4].map(|k| lane(&|c| c.quadrupole[k])),
            octupole: [0, 1, 2, 3, 4, 5, 6].map(|k| lane(&|c| c.octupole[k])),
        }
    }

    /// Winding numbers of the children that are farther than β radii (0 for the others), and which must be opened.
    ///
    /// `beta_squared` is the opening parameter of the paper, squared: far means |R|² > β² r².
    #[inline(always)]
    pub fn far_field(&self, q: &Query, order: Order, beta_squared: f32x4) -> (f32x4, u32) {
        let [x, y, z] =
            [0, 1, 2].map(|i| (q.high[i] - self.center_high[i]) + (q.low[i] - self.center_low[i]));
        let square = x * x + y * y + z * z;
        let far = square.simd_gt(beta_squared * self.radius_squared);
        let open = !far.to_bitmask() & 0b1111;
        if open == 0b1111 {
            return (f32x4::splat(0.0), open);
        }
        let inverse = f32x4::splat(1.0) / square.sqrt();
        let (x, y, z) = (x * inverse, y * inverse, z * inverse);
        let [d0, d1, d2] = self.dipole;
        let mut sum = d0 * x + d1 * y + d2 * z;
        if order >= Order::One {
            let (xx, yy, zz) = (x * x, y * y, z * z);
            let [a, b, c, d, e] = self.quadrupole;
            let quadrupole = a * (xx - zz) + b * (yy - zz) + x * (c * y + d * z) + e * (y * z);
            let mut higher = quadrupole;
            if order >= Order::Two {
                let [o0, o1, o2, o3, o4, o5, o6] = self.octupole;
                let (three_x, three_y) = (xx + xx + xx, yy + yy + yy);
                let four_z = zz + zz + zz + zz - xx - yy;
                let octupole = x * (o0 * (y * z) + o2 * (xx - three_y) + o5 * four_z)
                    + y * (o3 * (three_x - yy) + o6 * four_z)
                    + z * (o1 * (xx - yy) + o4 * (zz + zz - three_x - three_y));
                higher = quadrupole + octupole * inverse;
            }
            sum += higher * inverse;
        }
        (far.bitselect(sum * (inverse * inverse), f32x4::splat(0.0)), open)
    }
}

/// Coefficients of the harmonic polynomials of one cluster, all constant factors included:
/// dipole x, y, z; quadrupole x²−z², y²−z², xy, xz, yz;
/// octupole xyz, z(x²−y²), x(x²−3y²), y(3x²−y²), z(2z²−3x²−3y²), x(4z²−x²−y²), y(4z²−x²−y²).
struct Coefficients {
    dipole: [f64; 3],
    quadrupole: [f64; 5],
    octupole: [f64; 7],
}

impl Coefficients {
    fn of(moments: &Moments) -> Coefficients {
        let scale = 1.0 / (4.0 * PI);
        Coefficients {
            dipole: (-scale * moments.zeroth).to_array(),
            quadrupole: quadrupole(moments).map(|c| 3.0 * scale * c),
            octupole: octupole(moments).map(|c| -15.0 * scale * c),
        }
    }
}

/// The harmonic part of P₂(u) = −Σ uᵢ uⱼ M₁ᵢⱼ, in the basis above.
fn quadrupole(moments: &Moments) -> [f64; 5] {
    let entry = |i: usize, j: usize| -(moments.first[i][j] + moments.first[j][i]);
    let third = (entry(0, 0) + entry(1, 1) + entry(2, 2)) / 6.0; // ΔP₂ / 6
    [entry(0, 0) / 2.0 - third, entry(1, 1) / 2.0 - third, entry(0, 1), entry(0, 2), entry(1, 2)]
}

/// The harmonic part of P₃(u) = ½ Σ uᵢ uⱼ uₖ M₂ᵢⱼₖ, in the basis above.
fn octupole(moments: &Moments) -> [f64; 7] {
    // p(i, j, k): the coefficient of the monomial uᵢ uⱼ uₖ, i ≤ j ≤ k.
    let m = |i: usize, j: usize, k: usize| 0.5 * moments.second_at(i, j)[k];
    let cube = |i: usize| m(i, i, i);
    let mixed = |i: usize, j: usize| m(i, i, j) + 2.0 * m(i, j, i); // coefficient of uᵢ² uⱼ
    let tenth = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        (6.0 * cube(i) + 2.0 * mixed(j, i) + 2.0 * mixed(k, i)) / 10.0 // coefficient of uᵢ in ΔP₃ / 10
    };
    let (x, y, z) = (0, 1, 2);
    let xyz = 2.0 * (m(0, 1, 2) + m(1, 2, 0) + m(0, 2, 1));
    let z_cubed = cube(z) - tenth(z);
    let axial_z = z_cubed / 2.0;
    let axial_x = (mixed(z, x) - tenth(x)) / 4.0;
    let axial_y = (mixed(z, y) - tenth(y)) / 4.0;
    [
        xyz,
        mixed(x, z) - tenth(z) + 3.0 * axial_z,
        cube(x) - tenth(x) + axial_x,
        -(cube(y) - tenth(y)) - axial_y,
        axial_z,
        axial_x,
        axial_y,
    ]
}
