//! A chart laid flat: seen along its axis where that flips nothing, else on a disk (Tutte 1963); then relaxed.
use super::charts::Chart;
use super::overlap::is_simple;
use super::slim::relax;
use super::system::System;
use crate::math::{Vec2, Vec3};
use crate::texture::jacobian::{Rest, laid_flat};
use std::f64::consts::TAU;

/// Share of its area that each triangle shows along the axis at least, so that the view is a place to relax from.
const SHOWN: f64 = 0.05;
const TUTTE_TOLERANCE: f64 = 1e-12;
const TUTTE_STEPS: usize = 20_000;

/// Places in millimetres of a chart's vertices in the plane, without triangles that are flipped and without overlaps, counter-clockwise
/// seen from outside; nothing if the chart has to be halved first. Triangles without area stay out of account.
pub fn flattened(chart: &Chart, rounds: usize) -> Option<Vec<Vec2>> {
    let corners = |t: &[u32; 3]| t.map(|v| chart.positions[v as usize]);
    if let [only] = &chart.triangles[..] {
        let mut uv = vec![Vec2::ZERO; chart.positions.len()];
        only.iter().zip(laid_flat(corners(only))).for_each(|(v, place)| uv[*v as usize] = place);
        return Some(uv);
    }
    let (rest, triangles): (Vec<Rest>, Vec<[u32; 3]>) =
        chart.triangles.iter().filter_map(|t| Some((Rest::new(corners(t))?, *t))).unzip();
    let mut uv = projected(chart, &rest, &triangles).or_else(|| on_disk(chart, &rest, &triangles))?;
    relax(&rest, &triangles, &mut uv, rounds);
    (all_positive(&triangles, &uv) && is_simple(&chart.rim, &uv)).then_some(uv)
}

fn doubled_area([a, b, c]: [Vec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

fn all_positive(triangles: &[[u32; 3]], uv: &[Vec2]) -> bool {
    triangles.iter().all(|t| doubled_area(t.map(|v| uv[v as usize])) > 0.0)
}

/// Seen along the axis, at its true scale; nothing if a triangle faces away or nearly so.
fn projected(chart: &Chart, rest: &[Rest], triangles: &[[u32; 3]]) -> Option<Vec<Vec2>> {
    let axis = chart.axis();
    if axis == Vec3::ZERO {
        return None;
    }
    let x = axis.any_orthonormal_vector();
    let y = axis.cross(x);
    let uv: Vec<Vec2> = chart.positions.iter().map(|p| Vec2::new(p.dot(x), p.dot(y))).collect();
    let shows =
        |(rest, t): (&Rest, &[u32; 3])| doubled_area(t.map(|v| uv[v as usize])) > 2.0 * SHOWN * rest.area;
    rest.iter().zip(triangles).all(shows).then_some(uv)
}

/// Each inner vertex at the mean of its neighbours, the rim on a circle: no triangle of a disk is flipped (Tutte 1963).
fn on_disk(chart: &Chart, rest: &[Rest], triangles: &[[u32; 3]]) -> Option<Vec<Vec2>> {
    let order = rim_order(chart)?;
    let area: f64 = rest.iter().map(|r| r.area).sum();
    let radius = (area / (0.5 * TAU)).sqrt();
    let mut uv = vec![Vec2::ZERO; chart.positions.len()];
    let mut is_rim = vec![false; uv.len()];
    let lengths: Vec<f64> = (0..order.len())
        .map(|k| {
            let ends = [order[k], order[(k + 1) % order.len()]].map(|v| chart.positions[v as usize]);
            ends[0].distance(ends[1])
        })
        .collect();
    let perimeter: f64 = lengths.iter().sum();
    let mut at = 0.0;
    for (vertex, length) in order.iter().zip(&lengths) {
        let angle = TAU * at;
        uv[*vertex as usize] = radius * Vec2::new(libm::cos(angle), libm::sin(angle));
        is_rim[*vertex as usize] = true;
        // Equal steps mixed in: no two places of the circle may be the same.
        at += 0.5 * length / perimeter + 0.5 / order.len() as f64;
    }
    let mut system = System::new(uv.len(), triangles);
    let mut right = vec![Vec2::ZERO; uv.len()];
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..6 {
            let (row, column) = (k / 2, (k / 2 + 1 + k % 2) % 3);
            let [from, to] = [corners[row] as usize, corners[column] as usize];
            if is_rim[from] {
                continue;
            }
            system.add(t, [row, row], 1.0, [1.0, 0.0, 1.0]);
            if is_rim[to] {
                right[from] += uv[to];
            } else {
                system.add(t, [row, column], -1.0, [1.0, 0.0, 1.0]);
            }
        }
    }
    for vertex in (0..uv.len()).filter(|v| is_rim[*v]) {
        system.add_diagonal(vertex, 1.0);
        right[vertex] = uv[vertex];
    }
    system.solve(&right, &mut uv, TUTTE_TOLERANCE, TUTTE_STEPS);
    all_positive(triangles, &uv).then_some(uv)
}

/// The vertices of the rim in their order, if it is one ring.
fn rim_order(chart: &Chart) -> Option<Vec<u32>> {
    let mut next = vec![u32::MAX; chart.positions.len()];
    for [from, to] in &chart.rim {
        if std::mem::replace(&mut next[*from as usize], *to) != u32::MAX {
            return None;
        }
    }
    let first = chart.rim.first()?[0];
    let mut order = vec![first];
    loop {
        match next[*order.last()? as usize] {
            v if v == first => break,
            v if v == u32::MAX || order.len() > chart.rim.len() => return None,
            v => order.push(v),
        }
    }
    (order.len() == chart.rim.len()).then_some(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid bent to most of a cylinder, so that no view shows all of it.
    fn bent() -> Chart {
        let n = 24u32;
        let place = |k: u32| {
            let angle = 5.0 * f64::from(k / (n + 1)) / f64::from(n);
            Vec3::new(angle.cos(), angle.sin(), f64::from(k % (n + 1)) / f64::from(n))
        };
        let quad = |k: u32| {
            let v = k / n * (n + 1) + k % n;
            [[v, v + n + 1, v + 1], [v + 1, v + n + 1, v + n + 2]]
        };
        let triangles: Vec<[u32; 3]> = (0..n * n).flat_map(quad).collect();
        let sides = triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
        let all: std::collections::HashSet<[u32; 2]> = sides.clone().collect();
        Chart {
            faces: (0..2 * n * n).collect(),
            positions: (0..(n + 1) * (n + 1)).map(place).collect(),
            rim: sides.filter(|[a, b]| !all.contains(&[*b, *a])).collect(),
            triangles,
        }
    }

    #[test]
    fn what_no_view_shows_is_unrolled_from_a_disk() {
        let chart = bent();
        assert!(chart.is_disk());
        let uv = flattened(&chart, 100).unwrap();
        // The sides of a cylinder unrolled: 5 long, 1 high.
        let (a, b, c) = (uv[0], uv[24], uv[24 * 25]);
        assert!((a.distance(b) - 1.0).abs() < 0.02 && (a.distance(c) - 5.0).abs() < 0.1, "{a} {b} {c}");
        assert!((b - a).perp_dot(c - a) < 0.0 || (b - a).dot(c - a).abs() < 0.1);
    }
}
