//! Texture coordinates by standard projections, to compare with (Schier et al. 2018, section 11, Fig. 18): what modelling tools offer
//! for soups.
use crate::data::{Sets, TriangleSoup, sort_keyed};
use crate::math::{Vec2, Vec3, area_vector};
use serde::Serialize;
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

/// Where a texture is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Seams {
    /// Parts within which the texture is continuous.
    pub pieces: usize,
    /// Millimetres of edges on whose two sides the texture differs.
    pub length: f64,
}

/// The seams of a texture: edges of two triangles at one of whose ends their texture coordinates are more than `tolerance` apart.
/// `vertices` says which corners are the same, as in the mesh that a soup was made of; `turn` is a length in u by which coordinates may
/// differ as if they did not, for coordinates that go round.
pub fn seams(
    soup: &TriangleSoup,
    uv: &[[Vec2; 3]],
    vertices: &[[u32; 3]],
    tolerance: f64,
    turn: Option<f64>,
) -> Seams {
    let mut sides: Vec<(u64, u32)> = Vec::with_capacity(3 * vertices.len());
    for (t, corners) in vertices.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (u64::from(corners[k]), u64::from(corners[(k + 1) % 3]));
            sides.push((a.min(b) << 32 | a.max(b), (3 * t + k) as u32));
        }
    }
    sort_keyed(&mut sides);
    let ends = |side: u32| {
        let (t, k) = (side as usize / 3, side as usize % 3);
        let ends = [uv[t][k], uv[t][(k + 1) % 3]];
        if vertices[t][k] < vertices[t][(k + 1) % 3] { ends } else { [ends[1], ends[0]] }
    };
    let apart = |a: Vec2, b: Vec2| {
        let mut between = a - b;
        if let Some(turn) = turn {
            between.x -= turn * (between.x / turn).round();
        }
        between.length() > tolerance
    };
    let mut sets = Sets::new(vertices.len());
    let mut found = Seams::default();
    for same in sides.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        for pair in same.windows(2) {
            let (one, other) = (ends(pair[0].1), ends(pair[1].1));
            if apart(one[0], other[0]) || apart(one[1], other[1]) {
                let (t, k) = (pair[0].1 as usize / 3, pair[0].1 as usize % 3);
                let corners = soup.corners(t);
                found.length += corners[k].distance(corners[(k + 1) % 3]);
            } else {
                sets.join(pair[0].1 / 3, pair[1].1 / 3);
            }
        }
    }
    found.pieces = (0..vertices.len() as u32).filter(|t| sets.find(*t) == *t).count();
    found
}
