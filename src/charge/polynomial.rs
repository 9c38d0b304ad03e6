//! Functions in a cube by the polynomials through their values at Chebyshev's points.
use super::multipole::SUMS;
use super::walk::Block;
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};
use crate::treecode::{Octet, parts};

/// Points along each axis.
const ORDER: usize = 4;
/// In all.
pub const POINTS: usize = ORDER * ORDER * ORDER;

/// The points of the cube around `center` with edges of 2 · `half`: by x, then y, then z.
pub fn points(center: Vec3, half: f64) -> Vec<Vec3> {
    let at = |n: usize| [n % ORDER, n / ORDER % ORDER, n / ORDER / ORDER].map(|k| f64::from(NODES[k]));
    (0..POINTS).map(|n| center + half * Vec3::from_array(at(n))).collect()
}

/// Adds the polynomials' values at the points of a block around the middle of the cube.
pub fn add(values: &[[f32; SUMS]], half: f64, block: &Block, sums: &mut [[Octet; SUMS]]) {
    in_widest_registers(Interpolation { values, half, block, sums });
}

/// Chebyshev's points: cos((2k + 1)π/8).
const NODES: [f32; ORDER] = [0.923_879_5, 0.382_683_43, -0.382_683_43, -0.923_879_5];
/// 1/Π (tₖ − tₘ) over all others m.
const SCALES: [f32; ORDER] = scales();

const fn scales() -> [f32; ORDER] {
    let mut scales = [1.0; ORDER];
    let mut n = 0;
    while n < ORDER * ORDER {
        let (k, m) = (n / ORDER, n % ORDER);
        if k != m {
            scales[k] /= NODES[k] - NODES[m];
        }
        n += 1;
    }
    scales
}

struct Interpolation<'a> {
    values: &'a [[f32; SUMS]],
    half: f64,
    block: &'a Block,
    sums: &'a mut [[Octet; SUMS]],
}

impl Work for Interpolation<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.add::<R::Singles>();
    }
}

impl Interpolation<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f32>>(self) {
        let scale = F::splat((1.0 / self.half) as f32);
        for (group, sums) in self.block.groups.iter().zip(self.sums) {
            for part in parts::<F>() {
                let place = |axis: usize| group.places[axis].get::<F>(part) * scale;
                let [x, y, z] = [weights(place(0)), weights(place(1)), weights(place(2))];
                let mut total = [F::splat(0.0); SUMS];
                for (n, row) in self.values.chunks_exact(ORDER).enumerate() {
                    let across = y[n % ORDER] * z[n / ORDER];
                    for (value, along) in row.iter().zip(x) {
                        let weight = along * across;
                        for (total, value) in total.iter_mut().zip(value) {
                            *total = *total + weight * F::splat(*value);
                        }
                    }
                }
                sums.iter_mut().zip(total).for_each(|(sum, total)| sum.add(part, total));
            }
        }
    }
}

/// The polynomials that are 1 at one of the points and 0 at the others.
#[inline(always)]
fn weights<F: Floats<Number = f32>>(t: F) -> [F; ORDER] {
    let mut weights = SCALES.map(F::splat);
    for (k, weight) in weights.iter_mut().enumerate() {
        for (m, node) in NODES.into_iter().enumerate() {
            if m != k {
                *weight = *weight * (t - F::splat(node));
            }
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x4;

    #[test]
    fn polynomials_of_degree_3_are_met() {
        for (degree, k) in (0..4).flat_map(|degree| (0..9).map(move |k| (degree, k))) {
            let t = -1.0 + 0.25 * k as f32;
            let weights = weights(f32x4::splat(t)).map(|w| w.to_array()[0]);
            let found: f32 = weights.iter().zip(NODES).map(|(w, node)| w * node.powi(degree)).sum();
            assert!((found - t.powi(degree)).abs() < 2e-6, "{degree} at {t}: {found}");
        }
    }
}
