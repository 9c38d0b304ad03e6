use crate::data::TriangleSoup;
use crate::math::Vec3;
use rayon::prelude::*;

/// The edges along which a soup is open, as pairs of end points: those that its triangles run through more often in one
/// direction than in the other, vertices welded by exact position (the net boundary chain ∂M).
///
/// A closed, consistently oriented soup has none. An edge appears once, in the prevailing direction.
pub fn boundary_edges(soup: &TriangleSoup) -> Vec<[Vec3; 2]> {
    let welded = weld(soup.positions());
    // An undirected edge as (lower, upper), and whether it is run through upward.
    let mut edges: Vec<(u32, u32, bool)> = (soup.triangles().par_iter())
        .flat_map_iter(|corners| {
            let [a, b, c] = corners.map(|i| welded[i as usize]);
            [(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b), a < b))
        })
        .filter(|(a, b, _)| a != b)
        .collect();
    edges.par_sort_unstable();
    let position = |i: u32| soup.positions()[i as usize];
    (edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)))
        .filter_map(|same| {
            let upward = same.iter().filter(|e| e.2).count();
            let (lower, upper, _) = same[0];
            match (2 * upward).cmp(&same.len()) {
                std::cmp::Ordering::Equal => None,
                std::cmp::Ordering::Greater => Some([position(lower), position(upper)]),
                std::cmp::Ordering::Less => Some([position(upper), position(lower)]),
            }
        })
        .collect()
}

/// For each vertex, the lowest index of those in exactly the same place; −0 is 0.
pub(super) fn weld(positions: &[Vec3]) -> Vec<u32> {
    let bits = |p: Vec3| (p + 0.0).to_array().map(f64::to_bits);
    let mut sorted: Vec<([u64; 3], u32)> =
        positions.par_iter().enumerate().map(|(i, p)| (bits(*p), i as u32)).collect();
    sorted.par_sort_unstable();
    let mut first = vec![0; positions.len()];
    for same in sorted.chunk_by(|a, b| a.0 == b.0) {
        same.iter().for_each(|(_, i)| first[*i as usize] = same[0].1);
    }
    first
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
