//! What is charged: the triangles of a soup that have an area, large ones cut up.
use crate::bvh::Bvh;
use crate::data::{TriangleSoup, map_items};
use crate::math::{Aabb, Vec3, area_vector, barycentre};
use crate::treecode::Frame;

/// Most elements in a leaf of the tree.
const LEAF_SIZE: usize = 4;

/// How triangles are cut up before they are charged: at the middle of the longest edge, again and again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// Largest area of a part, in those of the median triangle.
    pub largest: f64,
    /// Parts in all, at least about so many: few triangles have no even charge.
    pub least_parts: usize,
    /// Parts in all, at most about so many: at least as many as there are triangles, though.
    pub most_parts: usize,
}

impl Default for Refinement {
    fn default() -> Self {
        Refinement { largest: 16.0, least_parts: 2000, most_parts: 200_000 }
    }
}

/// Elements in the order of the tree over them, in its unit frame.
pub struct Elements {
    pub frame: Frame,
    pub bvh: Bvh,
    pub corners: Vec<[Vec3; 3]>,
    /// The triangle of the soup that each is of.
    pub parents: Vec<u32>,
    pub centers: Vec<Vec3>,
    pub areas: Vec<f64>,
    /// Lengths of their longest edges.
    pub sizes: Vec<f64>,
}

impl Elements {
    pub fn new(soup: &TriangleSoup, refinement: Option<&Refinement>) -> Elements {
        let frame = Frame::around(&soup.bounds());
        let local = |t: usize| soup.corners(t).map(|p| frame.local(p));
        let charged: Vec<(u32, [Vec3; 3])> =
            (0..soup.len()).map(|t| (t as u32, local(t))).filter(|(_, corners)| has_area(*corners)).collect();
        let parts = match refinement {
            Some(refinement) => cut(charged, refinement),
            None => charged,
        };
        let boxes = map_items(parts.len(), |i| Aabb::around(parts[i].1));
        let bvh = Bvh::build(&boxes, LEAF_SIZE);
        let sorted: Vec<(u32, [Vec3; 3])> = bvh.items().iter().map(|i| parts[*i as usize]).collect();
        let corners: Vec<[Vec3; 3]> = sorted.iter().map(|(_, corners)| *corners).collect();
        Elements {
            frame,
            bvh,
            parents: sorted.iter().map(|(parent, _)| *parent).collect(),
            centers: corners.iter().map(|corners| barycentre(*corners)).collect(),
            areas: corners.iter().map(|corners| area_vector(*corners).length()).collect(),
            sizes: corners.iter().map(|corners| longest_edge(*corners).1).collect(),
            corners,
        }
    }

    pub fn len(&self) -> usize {
        self.corners.len()
    }

    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }
}

/// Not less than what rounding gives three points on a line.
fn has_area(corners: [Vec3; 3]) -> bool {
    let longest = longest_edge(corners).1;
    area_vector(corners).length() > 4.0 * f64::EPSILON * longest * longest
}

/// The first corner of the longest edge, and its length.
fn longest_edge(corners: [Vec3; 3]) -> (usize, f64) {
    let length = |k: usize| corners[k].distance(corners[(k + 1) % 3]);
    (1..3).fold((0, length(0)), |best, k| if length(k) > best.1 { (k, length(k)) } else { best })
}

fn cut(triangles: Vec<(u32, [Vec3; 3])>, refinement: &Refinement) -> Vec<(u32, [Vec3; 3])> {
    let areas: Vec<f64> = triangles.iter().map(|(_, corners)| area_vector(*corners).length()).collect();
    let mut sorted = areas.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let total: f64 = sorted.iter().sum();
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
    // Halves of what is just too large are half as large as allowed.
    let of_parts = |count: usize| total / count.max(1) as f64;
    let limit = (refinement.largest.max(1.0) * median)
        .min(1.5 * of_parts(refinement.least_parts))
        .max(2.0 * of_parts(refinement.most_parts));
    // Of needles, rounding leaves parts that are not half as large: they are not cut without end.
    let most = triangles.len() + 4 * refinement.most_parts;
    let mut parts = Vec::with_capacity(triangles.len());
    let mut open = Vec::new();
    for (parent, corners) in triangles {
        open.push(corners);
        while let Some(corners) = open.pop() {
            let k = longest_edge(corners).0;
            let [a, b, c] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
            let middle = a.midpoint(b);
            let is_large = area_vector(corners).length() > limit;
            if is_large && middle != a && middle != b && parts.len() + open.len() < most {
                open.extend([[middle, b, c], [a, middle, c]]);
            } else {
                parts.push((parent, corners));
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_triangles_are_cut_up_and_flat_ones_left_out() {
        let positions = vec![Vec3::ZERO, 8.0 * Vec3::X, 8.0 * Vec3::Y, Vec3::Z, Vec3::X, 4.0 * Vec3::X];
        let soup = TriangleSoup::new(positions, vec![[0, 1, 2], [0, 3, 4], [0, 3, 4], [0, 4, 5]]).unwrap();
        assert_eq!(Elements::new(&soup, None).parents.len(), 3);
        let refinement = Refinement { largest: 4.0, least_parts: 0, most_parts: 1000 };
        let elements = Elements::new(&soup, Some(&refinement));
        assert!(!elements.parents.contains(&3));
        let scale = elements.frame.scale;
        assert_eq!(elements.parents.iter().filter(|parent| **parent == 0).count(), 16);
        let area = |parent: u32| -> f64 {
            let own = (0..elements.len()).filter(|i| elements.parents[*i] == parent);
            own.map(|i| elements.areas[i] / (scale * scale)).sum()
        };
        assert!((area(0) - 32.0).abs() < 1e-12 && (area(1) - 0.5).abs() < 1e-15);
        let few = Refinement { most_parts: 10, ..refinement };
        assert!(Elements::new(&soup, Some(&few)).len() <= 16);
        let many = Refinement { least_parts: 500, ..refinement };
        assert!((400..2000).contains(&Elements::new(&soup, Some(&many)).len()));
    }
}
