//! Caps seen from a grid amid them, one by one: by their solid angles, with exact predicates where these are in doubt.
use super::curtains::{Grid, Region};
use super::product::Product;
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};
use crate::winding::half_angle::{HalfAngle, Triangle};

/// A sample and a cap whose solid angle there is in doubt.
pub struct Doubt {
    pub sample: [usize; 3],
    pub cap: usize,
}

/// The share at which angles are good to 1e-12 (see [`HalfAngle::is_certain`]).
const LEAST: f64 = 2e-3;

/// Multiplies a product by the solid angles of caps at the samples of a region of a grid; those in doubt are left out, and
/// listed. Lengths are multiplied by `unit`, a power of two.
pub fn multiply(
    product: &mut Product<f64>,
    grid: &Grid,
    region: &Region,
    caps: impl Iterator<Item = (usize, [Vec3; 3])>,
    unit: f64,
    doubts: &mut Vec<Doubt>,
) {
    let cap = |(number, corners): (usize, [Vec3; 3])| Cap {
        number,
        triangle: Triangle::new(corners.map(|c| unit * c)),
    };
    let caps: Vec<Cap> = caps.map(cap).collect();
    in_widest_registers(CapWork { product, grid, region, caps: &caps, unit, doubts });
}

struct Cap {
    number: usize,
    triangle: Triangle,
}

struct CapWork<'a> {
    product: &'a mut Product<f64>,
    grid: &'a Grid,
    region: &'a Region,
    caps: &'a [Cap],
    unit: f64,
    doubts: &'a mut Vec<Doubt>,
}

impl Work for CapWork<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        let CapWork { product, grid, region, caps, unit, doubts } = self;
        let [xs, ys, zs] = region.clone();
        let mut queries = [[0.0; 4]; 3];
        for k in zs {
            queries[2] = [unit * grid[2][k]; 4];
            for j in ys.clone() {
                queries[1] = [unit * grid[1][j]; 4];
                for first in xs.clone().step_by(4) {
                    let count = (xs.end - first).min(4);
                    for lane in 0..4 {
                        queries[0][lane] = unit * grid[0][first + lane.min(count - 1)];
                    }
                    let q = [
                        R::Doubles::load(&queries[0]),
                        R::Doubles::load(&queries[1]),
                        R::Doubles::load(&queries[2]),
                    ];
                    let mut four = product.four::<R::Doubles>([first, j, k], count);
                    for cap in caps {
                        let half = cap.triangle.half_angle(q);
                        let open = !half.is_certain(LEAST) & ((1 << count) - 1);
                        let HalfAngle { numerator, denominator, .. } = half;
                        if open == 0 {
                            four.multiply(denominator, numerator);
                            continue;
                        }
                        let (mut reals, mut imaginaries) = ([0.0; 4], [0.0; 4]);
                        denominator.store(&mut reals);
                        numerator.store(&mut imaginaries);
                        for lane in (0..count).filter(|lane| open >> lane & 1 == 1) {
                            (reals[lane], imaginaries[lane]) = (1.0, 0.0);
                            doubts.push(Doubt { sample: [first + lane, j, k], cap: cap.number });
                        }
                        four.multiply(R::Doubles::load(&reals), R::Doubles::load(&imaginaries));
                    }
                    product.set_four([first, j, k], count, four);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::solid_angle;
    use crate::winding::boundary::curtains::all;
    use std::f64::consts::PI;

    #[test]
    fn solid_angles_are_right_or_in_doubt() {
        let axis = |count: usize| -> Vec<f64> { (0..count).map(|i| 0.25 * (i as f64 - 1.0)).collect() };
        let grid: Grid = [axis(11), axis(9), axis(7)];
        let counts = grid.each_ref().map(Vec::len);
        // The first lies in a plane of samples, its corners and edges on them; the second in none.
        let flat = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let tilted = [Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.7, 0.4, 1.1), Vec3::new(0.3, 1.6, 0.2)];
        let mut product = Product::of(counts);
        let mut doubts = Vec::new();
        let caps = [flat, tilted].into_iter().enumerate();
        multiply(&mut product, &grid, &all(&grid), caps, 0.5, &mut doubts);
        let mut values = vec![0.0; counts.iter().product()];
        product.add_to(&mut values);
        // In doubt is what lies in the plane of the first, and no more than what touches an edge of the second.
        assert!(doubts.iter().filter(|d| d.cap == 0).all(|d| grid[2][d.sample[2]] == 0.0));
        assert_eq!(doubts.iter().filter(|d| d.cap == 0).count(), 11 * 9);
        assert!(doubts.iter().filter(|d| d.cap == 1).count() < 3);
        for (place, value) in values.iter().enumerate() {
            let sample = [place % 11, place / 11 % 9, place / 99];
            let q = Vec3::from_array([0, 1, 2].map(|a| grid[a][sample[a]]));
            let is_left_out = |cap: usize| doubts.iter().any(|d| (d.cap, d.sample) == (cap, sample));
            let sure = [flat, tilted].into_iter().enumerate().filter(|(cap, _)| !is_left_out(*cap));
            let expected: f64 = sure.map(|(_, cap)| solid_angle(q, cap) / (4.0 * PI)).sum();
            assert!((value - expected).abs() < 1e-12, "{q}: {value} instead of {expected}");
        }
    }
}
