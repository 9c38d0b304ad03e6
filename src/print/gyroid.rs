//! Slices of the gyroid, sin x cos y + sin y cos z + sin z cos x = 0 (Schoen 1970).
//!
//! In a plane of constant z the equation has, for each y or for each x, two closed solutions: where |sin z| is the larger of |sin z|
//! and |cos z| the curves run along y, else along x.
use super::hatch::{back, turn};
use crate::data::Polygon;
use crate::math::Vec2;
use crate::polygon::EdgeGrid;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// Length of the curves for each area, times the period, averaged over z; it is measured by a test below.
const LENGTH_PER_PERIOD: f64 = 2.44;
/// Chords of each period: they leave the curve by less than a 500th of the period.
const CHORDS: f64 = 40.0;

/// The gyroid's curves at height `z` in an area: lines of this width cover the share `density`, averaged over heights.
pub(super) fn gyroid(area: &[Polygon], z: f64, angle: f64, width: f64, density: f64) -> Vec<Vec<Vec2>> {
    let unit = LENGTH_PER_PERIOD * width / density / TAU;
    let turn = turn(angle);
    let corners = area.iter().flat_map(|p| &p.outer).map(|p| back(turn).rotate(*p) / unit);
    let (low, high) =
        corners.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    if !(high - low).is_finite() {
        return Vec::new();
    }
    let place = |p: Vec2| turn.rotate(unit * p);
    let grid = EdgeGrid::new(area);
    let mut parts = Vec::new();
    for curve in curves(z / unit, low, high) {
        let curve: Vec<Vec2> = curve.into_iter().map(place).collect();
        let inside = grid.cut(&curve, false).into_iter().filter(|stretch| stretch.is_inside);
        parts.extend(inside.map(|stretch| stretch.points));
    }
    parts
}

/// The curves that meet a box, where a period is 2π.
fn curves(z: f64, low: Vec2, high: Vec2) -> Vec<Vec<Vec2>> {
    let (sin_z, cos_z) = libm::sincos(z);
    let runs_along_y = sin_z.abs() >= FRAC_1_SQRT_2;
    // Along the curves, and across them.
    let (from, to, left, right) =
        if runs_along_y { (low.y, high.y, low.x, high.x) } else { (low.x, high.x, low.y, high.y) };
    let steps = ((to - from) / TAU * CHORDS).ceil().max(1.0) as usize;
    let first = (from / TAU * CHORDS).floor();
    let mut curves = Vec::new();
    for is_second in [false, true] {
        let curve: Vec<Vec2> = (0..=steps + 1)
            .map(|k| {
                let along = (first + k as f64) * TAU / CHORDS;
                let across = if runs_along_y {
                    x_of(along, sin_z, cos_z, is_second)
                } else {
                    y_of(along, sin_z, cos_z, is_second)
                };
                Vec2::new(along, across)
            })
            .collect();
        let reach = curve
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), p| (least.min(p.y), most.max(p.y)));
        let mut shift = ((left - reach.1) / TAU).ceil();
        while reach.0 + shift * TAU <= right {
            let moved = curve.iter().map(|p| {
                let (along, across) = (p.x, p.y + shift * TAU);
                if runs_along_y { Vec2::new(across, along) } else { Vec2::new(along, across) }
            });
            curves.push(moved.collect());
            shift += 1.0;
        }
    }
    curves
}

/// x for given y: A sin(x + φ) = −sin y cos z with A and φ those of cos y sin x + sin z cos x.
fn x_of(y: f64, sin_z: f64, cos_z: f64, is_second: bool) -> f64 {
    let (sin_y, cos_y) = libm::sincos(y);
    solved(cos_y, sin_z, -sin_y * cos_z, is_second)
}

/// y for given x: A sin(y + φ) = −sin z cos x with A and φ those of cos z sin y + sin x cos y.
fn y_of(x: f64, sin_z: f64, cos_z: f64, is_second: bool) -> f64 {
    let (sin_x, cos_x) = libm::sincos(x);
    // φ must not jump by 2π on the way: its cosine keeps a sign, made positive.
    let sign = cos_z.signum();
    solved(sign * cos_z, sign * sin_x, -sign * sin_z * cos_x, is_second)
}

/// One of the two t with a sin t + b cos t = c.
fn solved(a: f64, b: f64, c: f64, is_second: bool) -> f64 {
    let phase = libm::atan2(b, a);
    let arc = libm::asin((c / libm::hypot(a, b)).clamp(-1.0, 1.0));
    if is_second { PI - arc - phase } else { arc - phase }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print::path::length_of;

    fn square(side: f64) -> Polygon {
        let outer = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        Polygon { outer: outer.map(Vec2::from).to_vec(), holes: Vec::new() }
    }

    #[test]
    fn curves_solve_the_equation_and_do_not_jump() {
        for k in 0..100 {
            let z = 0.1 + TAU * f64::from(k) / 100.0;
            for curve in curves(z, Vec2::splat(-3.0), Vec2::splat(10.0)) {
                for p in &curve {
                    let value = p.x.sin() * p.y.cos() + p.y.sin() * z.cos() + z.sin() * p.x.cos();
                    assert!(value.abs() < 1e-12, "{value} at z = {z}");
                }
                assert!(curve.windows(2).all(|w| w[0].distance(w[1]) < 0.8), "z = {z}");
            }
        }
    }

    #[test]
    fn the_asked_share_is_covered() {
        // Whole periods of a large square: 61 heights of one period.
        let (width, density) = (0.4, 0.2);
        let period = LENGTH_PER_PERIOD * width / density;
        let side = 12.0 * period;
        let heights = 61;
        let mut length = 0.0;
        for k in 0..heights {
            let z = period * f64::from(k) / f64::from(heights);
            let lines = gyroid(&[square(side)], z, 0.0, width, density);
            length += lines.iter().map(|l| length_of(l, false)).sum::<f64>();
        }
        let share = length / f64::from(heights) * width / (side * side);
        assert!((share / density - 1.0).abs() < 0.01, "{share}");
    }

    #[test]
    fn lines_stay_inside() {
        let lines = gyroid(&[square(20.0)], 3.3, 0.7, 0.4, 0.3);
        assert!(lines.len() > 5);
        let points = lines.iter().flatten();
        assert!(points.clone().all(|p| p.min_element() > -1e-9 && p.max_element() < 20.0 + 1e-9));
    }
}
