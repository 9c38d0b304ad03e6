//! Far fields of the four children of a node, evaluated together.
//!
//! With R = q − c, the field of a cluster is (1/4π) Σ A_γ ∂^γ(1/|R|), |γ| = 1, 2, 3. Each degree n equals
//! (−1)ⁿ (2n−1)!! Hₙ(R) / |R|^(2n+1), Hₙ the harmonic part of the polynomial Σ A_γ R^γ: 3, 5 and 7 coefficients
//! instead of 3, 9 and 18 (Barill et al. 2018, eqs. 22 to 24, with their traces removed).
mod gradient;

use super::moments::Moments;
use crate::bvh::WIDTH;
use crate::math::Vec3;
use std::f64::consts::PI;
use std::sync::LazyLock;
use wide::f32x4;

/// How many terms of the expansion are summed (Barill et al. 2018, section 3.2.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// One dipole for a cluster.
    Zero,
    One,
    Two,
}

/// Positions in the tree's unit frame, one in each lane, each coordinate as the sum of two 32-bit floats: near a cluster
/// a single one would lose the direction.
#[derive(Clone, Copy)]
pub(super) struct Positions {
    high: [f32x4; 3],
    low: [f32x4; 3],
}

impl Positions {
    fn new(points: [Vec3; WIDTH]) -> Positions {
        let lanes = |axis: usize, part: fn(f64) -> f32| f32x4::from(points.map(|p| part(p[axis])));
        Positions {
            high: [0, 1, 2].map(|axis| lanes(axis, high)),
            low: [0, 1, 2].map(|axis| lanes(axis, low)),
        }
    }

    /// The same point in all lanes.
    pub fn splat(point: Vec3) -> Positions {
        Positions::new([point; WIDTH])
    }

    #[inline(always)]
    fn minus(&self, other: &Positions) -> [f32x4; 3] {
        [0, 1, 2].map(|i| (self.high[i] - other.high[i]) + (self.low[i] - other.low[i]))
    }

    fn lane(&self, lane: usize) -> Vec3 {
        let exact = |axis: usize| {
            f64::from(self.high[axis].to_array()[lane]) + f64::from(self.low[axis].to_array()[lane])
        };
        Vec3::new(exact(0), exact(1), exact(2))
    }
}

fn high(x: f64) -> f32 {
    x as f32
}

fn low(x: f64) -> f32 {
    (x - f64::from(high(x))) as f32
}

/// Far fields of four clusters, one in each lane: the children of a node. An empty child has no coefficients and lies
/// far outside the unit frame.
#[derive(Clone, Copy)]
pub(super) struct Expansion {
    centers: Positions,
    radius_squared: f32x4,
    /// What [`Remainder`] needs: Σ a / 4π, and r Σ a |y|² / 4π.
    area: f32x4,
    third: f32x4,
    series: Series,
}

/// What expansions of order 2 leave out at a query: r Σ a |y|² / |R|⁵ and Σ a / |R|², over 4π, of the clusters that are far.
#[derive(Clone, Copy)]
pub(super) struct Remainder {
    third: f32x4,
    area: f32x4,
    /// Fields that were added.
    count: u32,
}

/// Errors of 32-bit rounding of a field, in units of Σ a / 4π|R|²: measured, with a margin of 20.
const ROUNDING: f64 = 4e-6;
/// The same of a sum, for each that is added.
const ROUNDING_OF_SUM: f64 = 6e-8;

impl Remainder {
    pub const NOTHING: Remainder = Remainder { third: f32x4::ZERO, area: f32x4::ZERO, count: 0 };

    /// A bound of the error of w: the term of degree k of the field of an area a at y is at most (k+1) a |y|ᵏ / 4π|R|ᵏ⁺²,
    /// |y| ≤ r ≤ |R| / β, and with t = 1/β the sum of (k+1) t^(k−3) over k > 2 is (4 − 3t) / (1 − t)². Sources lack up to
    /// `lacking` / β² of a / 4πd², d ≥ (1 − t) |R| being their own distance, for each such share of a field.
    pub fn bound(&self, beta: f64, lacking: f64) -> f64 {
        let t = 1.0 / beta;
        let square = (1.0 - t) * (1.0 - t);
        let tail = (4.0 - 3.0 * t) / square;
        let lacking = lacking * t * t / (square * square);
        let rounding = ROUNDING + ROUNDING_OF_SUM * f64::from(self.count) + lacking;
        (1.0 + rounding) * (tail * sum_of_lanes(self.third) + rounding * sum_of_lanes(self.area))
    }
}

/// The sum of four lanes, in f64.
pub(super) fn sum_of_lanes(lanes: f32x4) -> f64 {
    let [a, b, c, d] = lanes.to_array().map(f64::from);
    (a + b) + (c + d)
}

/// Where empty children are put: far from every query of interest, so that no 0/0 arises.
const NOWHERE: Vec3 = Vec3::splat(1e6);

impl Expansion {
    /// Packs moments and radii (farthest source point from the centre), both in the unit frame.
    pub fn pack(children: &[Option<(Moments, f64)>; WIDTH]) -> Expansion {
        let coefficients = children.each_ref().map(|c| c.as_ref().map(|(m, _)| Coefficients::of(m)));
        let lane = |f: &dyn Fn(&Coefficients) -> f64| {
            f32x4::from(coefficients.each_ref().map(|c| c.as_ref().map_or(0.0, |c| f(c) as f32)))
        };
        let of_ball = |f: &dyn Fn(&Moments, f64) -> f64| {
            f32x4::from(children.each_ref().map(|c| c.as_ref().map_or(0.0, |(m, r)| f(m, *r) as f32)))
        };
        Expansion {
            centers: Positions::new(children.each_ref().map(|c| c.as_ref().map_or(NOWHERE, |c| c.0.center))),
            radius_squared: of_ball(&|_, r| r * r),
            area: of_ball(&|m, _| m.area / (4.0 * PI)),
            third: of_ball(&|m, r| r * m.spread / (4.0 * PI)),
            series: Series {
                dipole: [0, 1, 2].map(|k| lane(&|c| c.dipole[k])),
                quadrupole: [0, 1, 2, 3, 4].map(|k| lane(&|c| c.quadrupole[k])),
                octupole: [0, 1, 2, 3, 4, 5, 6].map(|k| lane(&|c| c.octupole[k])),
            },
        }
    }

    /// The cluster of one lane in all four, with its centre relative to `origin`.
    pub fn cluster(&self, lane: usize, origin: Vec3) -> Cluster {
        let one = |v: f32x4| f32x4::splat(v.to_array()[lane]);
        Cluster {
            center: (self.centers.lane(lane) - origin).to_array().map(|x| f32x4::splat(x as f32)),
            radius_squared: one(self.radius_squared),
            series: Series {
                dipole: self.series.dipole.map(one),
                quadrupole: self.series.quadrupole.map(one),
                octupole: self.series.octupole.map(one),
            },
        }
    }

    /// Which clusters are farther from the query than β radii, |R|² > β² r², as bits; and their winding numbers, 0 in the
    /// other lanes.
    #[inline(always)]
    pub fn far_field(&self, query: &Positions, order: Order, beta_squared: f32x4) -> (f32x4, u32) {
        let offset = query.minus(&self.centers);
        let square = squared_length(&offset);
        let is_far = square.simd_gt(beta_squared * self.radius_squared);
        let far = is_far.to_bitmask();
        if far == 0 { (f32x4::splat(0.0), 0) } else { (is_far & self.series.at(offset, square, order), far) }
    }

    /// [`Expansion::far_field`] of order 2, which adds what it leaves out to `remainder`.
    #[inline(always)]
    pub fn bounded_field(
        &self,
        query: &Positions,
        beta_squared: f32x4,
        remainder: &mut Remainder,
    ) -> (f32x4, u32) {
        let offset = query.minus(&self.centers);
        let square = squared_length(&offset);
        let is_far = square.simd_gt(beta_squared * self.radius_squared);
        let far = is_far.to_bitmask();
        if far == 0 {
            return (f32x4::ZERO, 0);
        }
        let inverse_square = f32x4::splat(1.0) / square;
        remainder.count += 1;
        remainder.area += is_far & (self.area * inverse_square);
        remainder.third +=
            is_far & (self.third * square.sqrt() * inverse_square * inverse_square * inverse_square);
        (is_far & self.series.at(offset, square, Order::Two), far)
    }
}

/// One cluster for four queries near an origin. There, single 32-bit floats do: the error is a part in 10⁷ of the distance
/// from the origin.
pub(super) struct Cluster {
    center: [f32x4; 3],
    radius_squared: f32x4,
    series: Series,
}

impl Cluster {
    /// Whether every point within `radius` of the origin is farther than β radii of the cluster.
    pub fn is_far_from_all(&self, radius: f32, beta: f32) -> bool {
        let [square, own] = [squared_length(&self.center), self.radius_squared].map(|v| v.to_array()[0]);
        square.sqrt() > beta * own.sqrt() + radius
    }

    /// The winding numbers at four queries, given relative to the origin.
    #[inline(always)]
    pub fn field(&self, queries: &[f32x4; 3], order: Order) -> f32x4 {
        let offset = [0, 1, 2].map(|i| queries[i] - self.center[i]);
        self.series.at(offset, squared_length(&offset), order)
    }

    /// Which of the `wanted` queries are farther than β radii, and the winding numbers there, 0 in the other lanes.
    #[inline(always)]
    pub fn far_field(
        &self,
        queries: &[f32x4; 3],
        order: Order,
        beta_squared: f32x4,
        wanted: u32,
    ) -> (f32x4, u32) {
        let offset = [0, 1, 2].map(|i| queries[i] - self.center[i]);
        let square = squared_length(&offset);
        let is_far = square.simd_gt(beta_squared * self.radius_squared) & LANES[wanted as usize];
        let far = is_far.to_bitmask();
        if far == 0 { (f32x4::splat(0.0), 0) } else { (is_far & self.series.at(offset, square, order), far) }
    }
}

#[inline(always)]
fn squared_length([x, y, z]: &[f32x4; 3]) -> f32x4 {
    *x * *x + *y * *y + *z * *z
}

/// The coefficients of four far fields.
#[derive(Clone, Copy)]
struct Series {
    dipole: [f32x4; 3],
    quadrupole: [f32x4; 5],
    octupole: [f32x4; 7],
}

impl Series {
    /// Σ Hₙ(R) / |R|^(2n+1), given |R|² too.
    #[inline(always)]
    fn at(&self, offset: [f32x4; 3], square: f32x4, order: Order) -> f32x4 {
        // The root and the quotient do not wait for each other.
        let inverse_square = f32x4::splat(1.0) / square;
        let inverse = square.sqrt() * inverse_square;
        let [x, y, z] = offset.map(|c| c * inverse);
        let [d0, d1, d2] = self.dipole;
        let mut sum = d0 * x + d1 * y + d2 * z;
        if order >= Order::One {
            let (xx, yy, zz) = (x * x, y * y, z * z);
            let [a, b, c, d, e] = self.quadrupole;
            let mut higher = a * (xx - zz) + b * (yy - zz) + x * (c * y + d * z) + e * (y * z);
            if order >= Order::Two {
                let [o0, o1, o2, o3, o4, o5, o6] = self.octupole;
                let (three_x, three_y) = (xx + xx + xx, yy + yy + yy);
                let four_z = zz + zz + zz + zz - xx - yy;
                let octupole = x * (o0 * (y * z) + o2 * (xx - three_y) + o5 * four_z)
                    + y * (o3 * (three_x - yy) + o6 * four_z)
                    + z * (o1 * (xx - yy) + o4 * (zz + zz - three_x - three_y));
                higher += octupole * inverse;
            }
            sum += higher * inverse;
        }
        sum * inverse_square
    }
}

/// All bits of lane k set where bit k of the index is.
static LANES: LazyLock<[f32x4; 16]> = LazyLock::new(|| {
    std::array::from_fn(|bits| {
        f32x4::from(std::array::from_fn(|k| f32::from_bits(if bits >> k & 1 == 1 { u32::MAX } else { 0 })))
    })
});

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
