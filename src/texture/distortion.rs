//! How a map from triangles in space to triangles in the plane distorts: by its singular values (Floater & Hormann 2005).
use super::jacobian::{Rest, polar};
use crate::math::{Vec2, Vec3};
use serde::Serialize;

/// Distortion of a map, over the triangles with an area, weighed by it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Distortion {
    /// Mean and largest quasi-conformal ratio, of the larger singular value to the smaller: 1 where angles are kept. Triangles that are
    /// flat or flipped are left out.
    pub mean_ratio: f64,
    pub largest_ratio: f64,
    /// Standard deviation of the natural logarithm of the ratio of areas, plane to space: 0 where all are scaled alike.
    pub area_spread: f64,
    /// Triangles that are flipped, and those that have no area in the plane.
    pub flipped: usize,
    pub flat: usize,
    /// Triangles with an area in space.
    pub triangles: usize,
}

/// A triangle without this share of the area that it should have is flat.
const FLAT: f64 = 1e-9;

/// The distortion of triangles given by their corners in space and in the plane.
pub fn distortion(pairs: impl Iterator<Item = ([Vec3; 3], [Vec2; 3])>) -> Distortion {
    let mut found = Distortion::default();
    let measured: Vec<(f64, [f64; 2])> = pairs
        .filter_map(|(space, plane)| Rest::new(space).map(|rest| (rest.area, polar(rest.jacobian(plane)).0)))
        .collect();
    let total: f64 = measured.iter().map(|m| m.0).sum();
    let in_plane: f64 = measured.iter().map(|(area, s)| area * (s[0] * s[1]).abs()).sum();
    let (mut weight, mut ratios, mut logs, mut squares) = (0.0, 0.0, 0.0, 0.0);
    for (area, [s1, s2]) in &measured {
        found.triangles += 1;
        let scale = s1 * s2 * total / in_plane;
        if scale.abs() < FLAT || scale.is_nan() {
            found.flat += 1;
        } else if scale < 0.0 {
            found.flipped += 1;
        } else {
            weight += area;
            ratios += area * s1 / s2;
            found.largest_ratio = found.largest_ratio.max(s1 / s2);
            let log = libm::log(scale);
            logs += area * log;
            squares += area * log * log;
        }
    }
    if weight > 0.0 {
        found.mean_ratio = ratios / weight;
        found.area_spread = ((squares - logs * logs / weight) / weight).max(0.0).sqrt();
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheared_square_has_the_ratio_of_its_shear() {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(Vec2::from_array);
        let triangles = [[0, 1, 2], [0, 2, 3]];
        let shear = |p: Vec2| Vec2::new(p.x + p.y, p.y);
        let pairs =
            triangles.iter().map(|t| (t.map(|v| corners[v].extend(1.0)), t.map(|v| shear(corners[v]))));
        let found = distortion(pairs);
        // σ₁/σ₂ of [[1, 1], [0, 1]] is (3 + √5) / 2.
        assert!((found.mean_ratio - 0.5 * (3.0 + 5f64.sqrt())).abs() < 1e-12);
        assert!(found.area_spread < 1e-7 && found.flipped == 0);
        let mirror = |p: Vec2| Vec2::new(-p.x, p.y);
        let flipped =
            triangles.iter().map(|t| (t.map(|v| corners[v].extend(1.0)), t.map(|v| mirror(corners[v]))));
        assert_eq!(distortion(flipped).flipped, 2);
    }

    #[test]
    fn areas_that_differ_by_a_factor_of_four_spread_by_its_logarithm() {
        let space = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let plane = |scale: f64| [Vec2::ZERO, scale * Vec2::X, scale * Vec2::Y];
        let found = distortion([(space, plane(1.0)), (space, plane(2.0))].into_iter());
        assert!((found.area_spread - 2f64.ln()).abs() < 1e-12, "{found:?}");
    }
}
