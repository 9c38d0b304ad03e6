use super::boundary::weld;
use crate::data::TriangleSoup;

/// Number of pieces of a soup: two triangles belong to one piece if a chain of triangles that share vertices, welded
/// by exact position, leads from one to the other.
pub fn components(soup: &TriangleSoup) -> usize {
    let mut parents = weld(soup.positions());
    for corners in soup.triangles() {
        let [a, b, c] = corners.map(|i| root(&mut parents, i));
        let lowest = a.min(b).min(c);
        [a, b, c].into_iter().for_each(|i| parents[i as usize] = lowest);
    }
    let mut roots: Vec<u32> = soup.triangles().iter().map(|t| root(&mut parents, t[0])).collect();
    roots.sort_unstable();
    roots.dedup();
    roots.len()
}

/// The vertex that stands for the piece of vertex `i`; shortens the way there.
fn root(parents: &mut [u32], mut i: u32) -> u32 {
    while parents[i as usize] != i {
        let above = parents[parents[i as usize] as usize];
        parents[i as usize] = above;
        i = above;
    }
    i
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
