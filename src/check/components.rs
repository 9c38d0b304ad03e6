use crate::data::TriangleSoup;
use crate::winding::{self, weld};

/// Number of pieces of a soup: two triangles belong to one piece if a chain of triangles that share vertices, welded
/// by exact position, leads from one to the other.
pub fn components(soup: &TriangleSoup) -> usize {
    components_of(soup, &weld(soup.positions()))
}

/// The same, given for each vertex the one in the same place that stands for it.
pub(super) fn components_of(soup: &TriangleSoup, welded: &[u32]) -> usize {
    let roots = winding::components(soup, welded);
    let mut of_triangles: Vec<u32> = soup.triangles().iter().map(|t| roots[t[0] as usize]).collect();
    of_triangles.sort_unstable();
    of_triangles.dedup();
    of_triangles.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn loose_triangles_that_touch_are_one_piece() {
        let [o, x, y, z] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let far = |p: Vec3| p + Vec3::splat(9.0);
        let positions = vec![x, y, far(z), o, x, z, far(o), far(x), far(y), z, y, Vec3::splat(-1.0)];
        let count = |triangles: &[[u32; 3]]| {
            components(&TriangleSoup::new(positions.clone(), triangles.to_vec()).unwrap())
        };
        assert_eq!(count(&[[3, 4, 5], [6, 7, 8]]), 2);
        assert_eq!(count(&[[3, 4, 5], [6, 7, 8], [9, 10, 11]]), 2);
        assert_eq!(count(&[[3, 4, 5], [6, 7, 8], [0, 1, 2], [2, 6, 7]]), 1);
    }
}
