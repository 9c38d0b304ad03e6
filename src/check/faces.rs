//! The faces of a soup one by one.
use crate::data::{TriangleSoup, map_items};
use crate::math::{Vec3, area_vector, normal_signs};

/// What is needed of each face again and again.
pub struct Face {
    /// Half the cross product of two sides.
    pub area_vector: Vec3,
    pub area: f64,
    /// Whether it has no area, exactly.
    pub is_degenerate: bool,
    /// Its least height over its longest side; 0 without area.
    pub slimness: f64,
}

pub fn faces(soup: &TriangleSoup) -> Vec<Face> {
    map_items(soup.len(), |t| {
        let corners = soup.corners(t);
        let [a, b, c] = corners;
        let area_vector = area_vector(corners);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let area = area_vector.length();
        let is_degenerate = normal_signs(corners) == [0; 3];
        let slimness = if is_degenerate { 0.0 } else { 2.0 * area / longest / longest };
        Face { area_vector, area, is_degenerate, slimness }
    })
}
