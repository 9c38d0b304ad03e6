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
        // O has no trace: Oᵢzz = −Oᵢxx − Oᵢyy.
        let (xx, yy) = (half * (x * x - z * z), half * (y * y - z * z));
        let (xy, xz, yz) = (x * y, x * z, y * z);
        let steep = [
            c(10) * xx + c(15) * yy + c(13) * xy + c(14) * xz + c(19) * yz,
            c(13) * xx + c(11) * yy + c(15) * xy + c(19) * xz + c(16) * yz,
            c(14) * xx + c(16) * yy + c(19) * xy + c(17) * xz + c(18) * yz,
        ];
        let steep = [steep[0] * inverse, steep[1] * inverse, steep[2] * inverse];
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
