//! The potential and field of multipoles at as many points at once as registers hold.
use crate::math::Floats;

/// What is summed at a point: the potential, and the field's three coordinates.
pub const SUMS: usize = 4;

/// Coefficients of a series to its quadrupole.
pub const OF_QUADRUPOLE: usize = 10;

/// Potential and field at `offset` from the middle of a series, by its terms up to `ORDER` (2 the quadrupole, 3 the octupole); `c`
/// gives the coefficients.
///
/// With u = R/r, φ = Σ Hₙ(u)/rⁿ⁺¹ and E = Σ ((2n + 1) Hₙ(u) u − ∇Hₙ(u))/rⁿ⁺².
#[inline(always)]
pub fn act<F: Floats<Number = f32>, const ORDER: usize>(c: impl Fn(usize) -> F, offset: [F; 3]) -> [F; SUMS] {
    let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    let inverse = F::splat(1.0) / square.sqrt();
    let [x, y, z] = [offset[0] * inverse, offset[1] * inverse, offset[2] * inverse];
    let (half, third) = (F::splat(0.5), F::splat(1.0 / 3.0));
    let mut slope =
        [c(4) * x + c(7) * y + c(8) * z, c(7) * x + c(5) * y + c(9) * z, c(8) * x + c(9) * y + c(6) * z];
    let second = half * (slope[0] * x + slope[1] * y + slope[2] * z);
    let mut potential = second;
    let mut radial = F::splat(5.0) * second;
    if ORDER >= 3 {
        let xx = c(10) * x + c(13) * y + c(14) * z;
        let yy = c(15) * x + c(11) * y + c(16) * z;
        let zz = c(17) * x + c(18) * y + c(12) * z;
        let xy = c(13) * x + c(15) * y + c(19) * z;
        let xz = c(14) * x + c(19) * y + c(17) * z;
        let yz = c(19) * x + c(16) * y + c(18) * z;
        let steep = [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z];
        let scale = half * inverse;
        let steep = [scale * steep[0], scale * steep[1], scale * steep[2]];
        let octupole = third * (steep[0] * x + steep[1] * y + steep[2] * z);
        potential = potential + octupole;
        radial = radial + F::splat(7.0) * octupole;
        slope = [slope[0] + steep[0], slope[1] + steep[1], slope[2] + steep[2]];
    }
    let first = c(1) * x + c(2) * y + c(3) * z;
    potential = c(0) + inverse * (first + inverse * potential);
    radial = c(0) + inverse * (F::splat(3.0) * first + inverse * radial);
    let inverse_square = inverse * inverse;
    let along =
        |u: F, dipole: F, slope: F| inverse_square * (radial * u - inverse * (dipole + inverse * slope));
    [inverse * potential, along(x, c(1), slope[0]), along(y, c(2), slope[1]), along(z, c(3), slope[2])]
}
