//! Where the texture of a soup is cut, whatever gave it.
use crate::data::{Sets, TriangleSoup, by_edge, sides_by_edge};
use crate::math::Vec2;
use crate::winding::weld;
use serde::Serialize;

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
    let sides = sides_by_edge(vertices, |_, _| true);
    let apart = |a: Vec2, b: Vec2| {
        let mut between = a - b;
        if let Some(turn) = turn {
            between.x -= turn * (between.x / turn).round();
        }
        between.length() > tolerance
    };
    let mut sets = Sets::new(vertices.len());
    let mut found = Seams::default();
    for same in by_edge(&sides).filter(|same| same.len() > 1) {
        for pair in same.windows(2) {
            let [one, other] = [pair[0].1, pair[1].1].map(|side| ends(side, uv, vertices));
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

/// The seams of a texture between triangles whose corners lie in the same places, those of loose ones thus among them. Texture
/// coordinates are at a scale, and differ where they are more than a thousandth of a mean edge apart.
pub fn seams_between_places(soup: &TriangleSoup, uv: &[[Vec2; 3]], scale: f64, turn: Option<f64>) -> Seams {
    let welded = weld(soup.positions());
    let vertices: Vec<[u32; 3]> = soup.triangles().iter().map(|t| t.map(|v| welded[v as usize])).collect();
    let lengths = (0..soup.len()).flat_map(|t| {
        let [a, b, c] = soup.corners(t);
        [a.distance(b), b.distance(c), c.distance(a)]
    });
    let mean = lengths.sum::<f64>() / (3 * soup.len()).max(1) as f64;
    seams(soup, uv, &vertices, SAME * mean * scale, turn)
}

/// Rounding and single precision are below.
const SAME: f64 = 1e-3;

/// Texture coordinates such that those of different charts are never the same.
pub fn apart_by_chart(uv: &[[Vec2; 3]], charts: &[u32]) -> Vec<[Vec2; 3]> {
    uv.iter().zip(charts).map(|(uv, chart)| uv.map(|p| p + 2.0 * f64::from(*chart) * Vec2::X)).collect()
}

/// What the corners at the ends of a side have, that of the lower vertex first.
pub fn ends<T: Copy>(side: u32, of_corners: &[[T; 3]], vertices: &[[u32; 3]]) -> [T; 2] {
    let (t, k) = (side as usize / 3, side as usize % 3);
    let ends = [of_corners[t][k], of_corners[t][(k + 1) % 3]];
    if vertices[t][k] < vertices[t][(k + 1) % 3] { ends } else { [ends[1], ends[0]] }
}
