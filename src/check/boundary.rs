use crate::data::TriangleSoup;
use crate::math::Vec3;
use crate::winding::{net_edges, weld};

/// The edges along which a soup is open, as pairs of end points: those that its triangles run through more often in one
/// direction than in the other, vertices welded by exact position (the net boundary chain ∂M).
///
/// A closed, consistently oriented soup has none. An edge appears in the prevailing direction,
/// as often as it is run through more in that than in the other.
pub fn boundary_edges(soup: &TriangleSoup) -> Vec<[Vec3; 2]> {
    let edges = net_edges(soup, &weld(soup.positions()));
    edges.into_iter().map(|ends| ends.map(|v| soup.positions()[v as usize])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loose_tetrahedron_without_a_face_is_open_along_three_edges() {
        let [o, x, y, z] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
        let soup = |faces: &[[Vec3; 3]]| {
            let positions = faces.concat();
            let triangles = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
            TriangleSoup::new(positions, triangles).unwrap()
        };
        assert!(boundary_edges(&soup(&faces)).is_empty());
        let mut open = boundary_edges(&soup(&faces[..3]));
        open.sort_by(|a, b| a[0].to_array().partial_cmp(&b[0].to_array()).unwrap());
        assert_eq!(open, [[z, y], [y, x], [x, z]]);
        let negative_zero = [[-o, y, x], [o, x, z], [-o, z, y], [x, y, z]];
        assert!(boundary_edges(&soup(&negative_zero)).is_empty());
    }
}
