//! Flat charts of low distortion: Rabinovich, Poranne, Panozzo & Sorkine-Hornung 2017, *Scalable Locally Injective Mappings*, with the
//! symmetric Dirichlet energy; steps that stop short of the first triangle to flip (Smith & Schaefer 2015).
use super::system::System;
use crate::math::Vec2;
use crate::texture::jacobian::{Rest, determinant, polar};

/// Part of the way to the first flip that a step goes.
const BEFORE_FLIP: f64 = 0.8;
const HALVINGS: usize = 14;
/// Conjugate gradients of a step: each is already a way down.
const INNER: usize = 150;
const INNER_TOLERANCE: f64 = 1e-3;
/// Share of what the energy is above that of an isometry that a round gains at least, to be followed by another.
const GAIN: f64 = 0.01;
/// Ties vertices to where they are, in their diagonals: without it the system leaves the place of the chart open.
const TIE: f64 = 1e-7;

/// The energy of a map: Σ area · (σ₁² + σ₂² + σ₁⁻² + σ₂⁻²), 4 per area for an isometry; infinite if a triangle is flipped or flat.
pub fn energy(rest: &[Rest], triangles: &[[u32; 3]], uv: &[Vec2]) -> f64 {
    let of = |(rest, t): (&Rest, &[u32; 3])| {
        let j = rest.jacobian(t.map(|v| uv[v as usize]));
        let determinant = determinant(j);
        if determinant <= 0.0 {
            return f64::INFINITY;
        }
        let squares = j[0].length_squared() + j[1].length_squared();
        rest.area * squares * (1.0 + 1.0 / (determinant * determinant))
    };
    rest.iter().zip(triangles).map(of).sum()
}

/// Lowers the energy of a map without flips, in rounds.
pub fn relax(rest: &[Rest], triangles: &[[u32; 3]], uv: &mut Vec<Vec2>, rounds: usize) {
    let mut system = System::new(uv.len(), triangles);
    let area: f64 = rest.iter().map(|r| r.area).sum();
    let mut before = energy(rest, triangles, uv);
    for _ in 0..rounds {
        let target = proxy_minimum(&mut system, rest, triangles, uv);
        let step: Vec<Vec2> = target.iter().zip(uv.iter()).map(|(t, u)| *t - *u).collect();
        let mut share = (BEFORE_FLIP * first_flip(triangles, uv, &step)).min(1.0);
        let mut best = None;
        for _ in 0..HALVINGS {
            let tried: Vec<Vec2> = uv.iter().zip(&step).map(|(u, s)| *u + share * *s).collect();
            let energy = energy(rest, triangles, &tried);
            if energy < before {
                best = Some((energy, tried));
                break;
            }
            share *= 0.5;
        }
        let Some((energy, tried)) = best else { return };
        *uv = tried;
        let is_enough = before - energy < GAIN * (before - 4.0 * area);
        before = energy;
        if is_enough {
            return;
        }
    }
}

/// Where the quadratic proxy of the energy is least: Σ area · |W (J − R)|², with W such that its gradient is that of the energy.
fn proxy_minimum(system: &mut System, rest: &[Rest], triangles: &[[u32; 3]], uv: &[Vec2]) -> Vec<Vec2> {
    system.clear();
    let mut right = vec![Vec2::ZERO; uv.len()];
    for (t, (rest, corners)) in rest.iter().zip(triangles).enumerate() {
        let ([s1, s2], r, u) = polar(rest.jacobian(corners.map(|v| uv[v as usize])));
        let [w1, w2] = [s1, s2].map(weight);
        // W² = w1 u uᵀ + w2 u⊥ u⊥ᵀ, the weights being squares already.
        let square =
            [w1 * u.x * u.x + w2 * u.y * u.y, (w1 - w2) * u.x * u.y, w1 * u.y * u.y + w2 * u.x * u.x];
        for row in 0..3 {
            let g = rest.gradients[row];
            let turned = Vec2::new(r.x * g.x - r.y * g.y, r.y * g.x + r.x * g.y);
            let weighed = Vec2::new(
                square[0] * turned.x + square[1] * turned.y,
                square[1] * turned.x + square[2] * turned.y,
            );
            right[corners[row] as usize] += rest.area * weighed;
            for column in 0..3 {
                let scale = rest.area * g.dot(rest.gradients[column]);
                system.add(t, [row, column], scale, square);
            }
        }
    }
    for (vertex, right) in right.iter_mut().enumerate() {
        let [xx, _, yy] = system.diagonal(vertex);
        let tie = TIE * (xx + yy);
        system.add_diagonal(vertex, tie);
        *right += tie * uv[vertex];
    }
    let mut target = uv.to_vec();
    system.solve(&right, &mut target, INNER_TOLERANCE, INNER);
    target
}

/// The square of the weight that gives w² (σ − 1) the slope σ − σ⁻³ of the energy.
fn weight(s: f64) -> f64 {
    let s = s.max(1e-3);
    if (s - 1.0).abs() < 1e-6 { 4.0 } else { (s - 1.0 / (s * s * s)) / (s - 1.0) }
}

/// The least positive share of a step at which a triangle becomes flat.
fn first_flip(triangles: &[[u32; 3]], uv: &[Vec2], step: &[Vec2]) -> f64 {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| uv[v as usize]);
        let [da, db, dc] = t.map(|v| step[v as usize]);
        let (u, v, du, dv) = (b - a, c - a, db - da, dc - da);
        least_root(du.perp_dot(dv), u.perp_dot(dv) + du.perp_dot(v), u.perp_dot(v))
    };
    triangles.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// The least positive root of ax² + bx + c with c > 0.
fn least_root(a: f64, b: f64, c: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 || c <= 0.0 {
        return f64::INFINITY;
    }
    // No difference of nearly equal numbers: x = 2c / (−b ± √), and of these the positive ones.
    let root = discriminant.sqrt();
    let candidates = [2.0 * c / (-b + root), 2.0 * c / (-b - root)];
    candidates.into_iter().filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn roots_are_where_a_polynomial_vanishes_first() {
        for (a, b, c, root) in [(1.0, -3.0, 2.0, 1.0), (0.0, -2.0, 1.0, 0.5), (-1.0, 0.0, 4.0, 2.0)] {
            assert_eq!(least_root(a, b, c), root);
        }
        for (a, b, c) in [(1.0, 0.0, 1.0), (0.0, 1.0, 1.0), (1.0, 3.0, 2.0), (0.0, 0.0, 1.0)] {
            assert_eq!(least_root(a, b, c), f64::INFINITY);
        }
    }

    #[test]
    fn a_cone_without_its_tip_is_unrolled() {
        // A part of a cone is developable: the least energy is that of an isometry, 4 per area.
        let at = |i: usize, j: usize| {
            let (r, a) = (1.0 + 0.1 * j as f64, 0.15 * i as f64);
            Vec3::new(r * a.cos(), r * a.sin(), 0.8 * r)
        };
        let positions: Vec<Vec3> = (0..11 * 11).map(|k| at(k / 11, k % 11)).collect();
        let quad = |k: u32| {
            let v = k / 10 * 11 + k % 10;
            [[v, v + 11, v + 1], [v + 1, v + 11, v + 12]]
        };
        let triangles: Vec<[u32; 3]> = (0..100).flat_map(quad).collect();
        let rest: Vec<Rest> =
            triangles.iter().map(|t| Rest::new(t.map(|v| positions[v as usize])).unwrap()).collect();
        let area: f64 = rest.iter().map(|r| r.area).sum();
        // Seen from above every triangle is flipped or none.
        let mut uv: Vec<Vec2> = positions.iter().map(|p| Vec2::new(p.y, p.x)).collect();
        if energy(&rest, &triangles, &uv) == f64::INFINITY {
            uv.iter_mut().for_each(|p| *p = Vec2::new(p.y, p.x));
        }
        let before = energy(&rest, &triangles, &uv) / area;
        relax(&rest, &triangles, &mut uv, 60);
        let after = energy(&rest, &triangles, &uv) / area;
        assert!(before > 4.2 && (after - 4.0).abs() < 1e-3, "{before} {after}");
    }
}
