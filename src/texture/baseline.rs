//! Texture coordinates by standard projections, to compare with (Schier et al. 2018, section 11, Fig. 18): what modelling tools offer
//! for soups.
use super::seams::seams_between_places;
use super::{Distortion, Seams, distortion};
use crate::data::TriangleSoup;
use crate::math::{Vec2, Vec3, area_vector};
use std::f64::consts::TAU;

/// A projection of the whole soup.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Along the shortest side of its bounds.
    Planar,
    /// Each triangle along the axis that it faces.
    Triplanar,
    /// Onto a cylinder about the middle of its bounds, along their longest side.
    Cylindrical,
    /// Onto a sphere about the middle of its bounds; longitudes about their longest side.
    Spherical,
}

/// Texture coordinates in millimetres of the corners of each triangle; angles are as long as at the mean radius. Triangles across the
/// half-plane where angles begin anew are kept whole. With them, how long a full turn is, where there is one.
pub fn projected(soup: &TriangleSoup, projection: Projection) -> (Vec<[Vec2; 3]>, Option<f64>) {
    let bounds = soup.bounds();
    let (middle, size) = (bounds.center(), bounds.size());
    let axis = |k: usize| [Vec3::X, Vec3::Y, Vec3::Z][k];
    let longest = (0..3).fold(2, |best, k| if size[k] > size[best] { k } else { best });
    let shortest = (0..3).fold(2, |best, k| if size[k] < size[best] { k } else { best });
    let frame = |z: usize| [axis((z + 1) % 3), axis((z + 2) % 3), axis(z)];
    let [x, y, z] = frame(longest);
    let local = |p: Vec3| Vec3::new((p - middle).dot(x), (p - middle).dot(y), (p - middle).dot(z));
    let places = || (0..soup.len()).flat_map(|t| soup.corners(t)).map(local);
    let count = (3 * soup.len()).max(1) as f64;
    match projection {
        Projection::Planar => {
            let [x, y, _] = frame(shortest);
            let at = |p: Vec3| Vec2::new(p.dot(x), p.dot(y));
            ((0..soup.len()).map(|t| soup.corners(t).map(at)).collect(), None)
        }
        Projection::Triplanar => ((0..soup.len()).map(|t| along_own_axis(soup.corners(t))).collect(), None),
        Projection::Cylindrical => {
            let radius = places().map(|p| p.truncate().length()).sum::<f64>() / count;
            let at = |p: Vec3| Vec2::new(radius * libm::atan2(p.y, p.x), p.z);
            round(soup, TAU * radius, |p| at(local(p)))
        }
        Projection::Spherical => {
            let radius = places().map(|p| p.length()).sum::<f64>() / count;
            let latitude = |p: Vec3| libm::atan2(p.z, p.truncate().length());
            let at = |p: Vec3| radius * Vec2::new(libm::atan2(p.y, p.x), latitude(p));
            round(soup, TAU * radius, |p| at(local(p)))
        }
    }
}

fn round(soup: &TriangleSoup, turn: f64, at: impl Fn(Vec3) -> Vec2) -> (Vec<[Vec2; 3]>, Option<f64>) {
    ((0..soup.len()).map(|t| whole(soup.corners(t).map(&at), turn)).collect(), Some(turn))
}

fn along_own_axis(corners: [Vec3; 3]) -> [Vec2; 3] {
    let normal = area_vector(corners);
    let k = (0..3).fold(0, |best, k| if normal[k].abs() > normal[best].abs() { k } else { best });
    let mirror = if normal[k] < 0.0 { -1.0 } else { 1.0 };
    corners.map(|p| Vec2::new(mirror * p[(k + 1) % 3], p[(k + 2) % 3]))
}

/// Corners shifted by whole turns until they are as close as they can be to the first.
fn whole(mut corners: [Vec2; 3], turn: f64) -> [Vec2; 3] {
    for k in 1..3 {
        let turns = ((corners[k].x - corners[0].x) / turn).round();
        corners[k].x -= if turns.is_finite() { turns * turn } else { 0.0 };
    }
    corners
}

/// A projection as the texture of a soup, to be compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct Projected {
    /// Of the corners of each triangle, from 0 to 1, v upward. Triangles may lie over each other.
    pub uv: Vec<[Vec2; 3]>,
    /// Texture coordinates for a millimetre.
    pub scale: f64,
    /// How long a full turn is in u, where there is one: coordinates that differ by it are the same.
    pub turn: Option<f64>,
    pub distortion: Distortion,
    pub seams: Seams,
}

impl Projected {
    pub fn new(soup: &TriangleSoup, projection: Projection) -> Projected {
        let (places, turn) = projected(soup, projection);
        let none = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        let (low, high) = places.iter().flatten().fold(none, |(low, high), p| (low.min(*p), high.max(*p)));
        let size = (high - low).max_element();
        let scale = if size > 0.0 { 1.0 / size } else { 1.0 };
        let uv: Vec<[Vec2; 3]> = places.iter().map(|corners| corners.map(|p| scale * (p - low))).collect();
        let turn = turn.map(|turn| scale * turn).filter(|turn| *turn > 0.0);
        let distortion = distortion((0..soup.len()).map(|t| (soup.corners(t), uv[t])));
        let seams = seams_between_places(soup, &uv, scale, turn);
        Projected { uv, scale, turn, distortion, seams }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tube of radius 1 and height 4 around z, open at its ends: 24 strips, of two triangles each.
    fn tube() -> TriangleSoup {
        let at = |k: u32, top: bool| {
            let angle = TAU * f64::from(k % 24) / 24.0;
            Vec3::new(libm::cos(angle), libm::sin(angle), if top { 4.0 } else { 0.0 })
        };
        let strip = |k: u32| {
            let [a, b, c, d] = [at(k, false), at(k + 1, false), at(k + 1, true), at(k, true)];
            [a, b, c, a, c, d]
        };
        let positions: Vec<Vec3> = (0..24).flat_map(strip).collect();
        TriangleSoup::new(positions, (0..48).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect()).unwrap()
    }

    #[test]
    fn a_tube_is_unrolled_by_a_cylinder_and_cut_by_axes_and_folded_by_a_plane() {
        let round = Projected::new(&tube(), Projection::Cylindrical);
        // Chords are shorter than their arcs by π² / (6 · 24²): nearly an isometry, all the way round.
        assert!(
            round.distortion.mean_ratio < 1.003 && round.distortion.flipped == 0,
            "{:?}",
            round.distortion
        );
        assert_eq!((round.seams.pieces, round.seams.length), (1, 0.0));
        let turn = round.turn.unwrap();
        assert!((turn / round.scale - TAU).abs() < 1e-12);
        let axes = Projected::new(&tube(), Projection::Triplanar);
        // Four sides: each edge between two of them is a seam as high as the tube.
        assert_eq!((axes.seams.pieces, axes.distortion.flipped), (4, 0));
        assert!((axes.seams.length - 16.0).abs() < 1e-12, "{:?}", axes.seams);
        // Seen from one side: half of it is.
        let plane = Projected::new(&tube(), Projection::Planar);
        assert_eq!((plane.distortion.flipped + plane.distortion.flat >= 22, plane.turn), (true, None));
        for found in [&round, &axes, &plane] {
            assert!(
                found
                    .uv
                    .iter()
                    .flatten()
                    .all(|p| p.cmpge(Vec2::ZERO).all() && p.cmple(Vec2::splat(1.0 + 1e-12)).all())
            );
        }
    }

    #[test]
    fn an_egg_is_one_piece_on_a_sphere_and_worst_next_to_its_poles() {
        let at = |i: u32, j: u32| {
            let (polar, round) = (0.5 * TAU * f64::from(i) / 12.0, TAU * f64::from(j % 24) / 24.0);
            let radius = libm::sin(polar);
            // Longest along z, so that its poles are there.
            Vec3::new(radius * libm::cos(round), radius * libm::sin(round), 1.2 * libm::cos(polar))
        };
        let quad = |k: u32| {
            let (i, j) = (k / 24, k % 24);
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [a, b, c, a, c, d]
        };
        // Open at its poles, 15° wide.
        let positions: Vec<Vec3> = (24..24 * 11).flat_map(quad).collect();
        let count = positions.len() as u32 / 3;
        let egg = TriangleSoup::new(positions, (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect());
        let found = Projected::new(&egg.unwrap(), Projection::Spherical);
        assert_eq!((found.seams.pieces, found.seams.length, found.distortion.flipped), (1, 0.0, 0));
        // A degree of longitude is as much shorter as the circle is smaller, from 15° to 30° away from a pole.
        let least = 1.0 / libm::sin(TAU / 12.0);
        let found = found.distortion;
        assert!(found.largest_ratio > least && found.mean_ratio < least, "{found:?}");
    }
}
