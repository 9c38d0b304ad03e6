//! Distances without a sign: the point of a shape nearest to a place.
//!
//! Boxes and triangles are looked at four at a time in 32-bit floats, with a slack for what these round; what may be nearest by that
//! is measured in 64-bit floats. So the answer is that of a search through all elements, bit by bit.
mod packs;

use crate::bvh::{Bvh, Found, NarrowBvh};
use crate::data::{OrientedCloud, Shape, TriangleSoup, map_items};
use crate::math::{Aabb, Feature, Vec3, area_vector, closest_on_triangle, squared_distance_to_triangle};
use packs::{LEAF_SIZE, PointPack, TrianglePack};
use std::sync::Arc;

/// The point of a shape nearest to a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Closest {
    pub distance: f64,
    pub point: Vec3,
    /// The triangle or the point of the cloud; of those equally near the one of the lowest index.
    pub element: u32,
    /// Weights of the triangle's corners; 1, 0, 0 for a cloud.
    pub barycentric: [f64; 3],
    /// What of the triangle is nearest; a corner for a cloud.
    pub feature: Feature,
}

/// What is known while a search goes on: a squared distance, and whose it is. Of those equally near, the lowest number counts as
/// nearer.
type Best = (f64, u32);

const NOTHING: u32 = u32::MAX;

/// Scratch space of searches. Each begins with what the last one found: searches at places near each other, one after the other, are
/// the fastest.
pub struct Search {
    open: Found,
    last: u32,
}

impl Default for Search {
    fn default() -> Search {
        Search { open: Vec::new(), last: NOTHING }
    }
}

enum Leaves {
    Triangles(Arc<TriangleSoup>, Vec<TrianglePack>),
    Points(Arc<OrientedCloud>, Vec<PointPack>),
}

/// A shape, to be asked for what of it is nearest to a place.
///
/// ```
/// use fast_winding::{TriangleSoup, distance::DistanceTree, math::Vec3};
/// let soup = TriangleSoup::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let closest = DistanceTree::new(&soup.into()).closest(Vec3::new(0.2, -3.0, 4.0)).unwrap();
/// assert_eq!((closest.distance, closest.point, closest.feature.code()), (5.0, Vec3::new(0.2, 0.0, 0.0), 1));
/// # Ok::<(), fast_winding::data::SoupError>(())
/// ```
pub struct DistanceTree {
    tree: NarrowBvh,
    leaves: Leaves,
}

impl DistanceTree {
    /// Builds the tree, in parallel, in time linear in the triangles or points.
    pub fn new(shape: &Shape) -> DistanceTree {
        let of_boxes = |boxes: &[Aabb]| Bvh::build(boxes, LEAF_SIZE);
        let mut numbers = Vec::new();
        let note = |_: usize, elements: &[u32]| {
            numbers.push([0, 1, 2, 3].map(|lane| elements[lane.min(elements.len() - 1)]));
        };
        match shape {
            Shape::Soup(soup) => {
                let of_triangle = |t: u32| {
                    let corners = soup.corners(t as usize);
                    (corners, area_vector(corners))
                };
                let boxes = map_items(soup.len(), |t| Aabb::around(soup.corners(t)));
                let tree = NarrowBvh::new(&of_boxes(&boxes), of_triangle, note);
                let packs = map_items(numbers.len(), |k| TrianglePack::new(soup, &tree, &numbers[k]));
                DistanceTree { tree, leaves: Leaves::Triangles(soup.clone(), packs) }
            }
            Shape::Cloud(cloud) => {
                let points = cloud.points();
                let of_point = |i: u32| ([points[i as usize]; 3], cloud.normals()[i as usize]);
                let boxes = map_items(points.len(), |i| Aabb { min: points[i], max: points[i] });
                let tree = NarrowBvh::new(&of_boxes(&boxes), of_point, note);
                let packs = map_items(numbers.len(), |k| PointPack::new(points, &numbers[k]));
                DistanceTree { tree, leaves: Leaves::Points(cloud.clone(), packs) }
            }
        }
    }

    /// Bytes held beside the shape.
    pub fn bytes(&self) -> usize {
        self.tree.bytes()
            + match &self.leaves {
                Leaves::Triangles(_, packs) => size_of_val(&packs[..]),
                Leaves::Points(_, packs) => size_of_val(&packs[..]),
            }
    }

    /// The point nearest to `place`; nothing if the shape is empty or `place` is not finite.
    pub fn closest(&self, place: Vec3) -> Option<Closest> {
        self.closest_within(place, f64::INFINITY, &mut Search::default())
    }

    /// The point nearest to `place`, if it is no farther than `limit`.
    pub fn closest_within(&self, place: Vec3, limit: f64, search: &mut Search) -> Option<Closest> {
        let (squared, element) = self.nearest(place, limit, search)?;
        Some(self.details(place, squared, element))
    }

    /// The distance to the shape, if it is no longer than `limit`.
    pub fn distance_within(&self, place: Vec3, limit: f64, search: &mut Search) -> Option<f64> {
        self.nearest(place, limit, search).map(|(squared, _)| squared.sqrt())
    }

    fn details(&self, place: Vec3, squared: f64, element: u32) -> Closest {
        let distance = squared.sqrt();
        match &self.leaves {
            Leaves::Triangles(soup, _) => {
                let found = closest_on_triangle(place, soup.corners(element as usize));
                Closest {
                    distance,
                    point: found.point,
                    element,
                    barycentric: found.barycentric,
                    feature: found.feature,
                }
            }
            Leaves::Points(cloud, _) => Closest {
                distance,
                point: cloud.points()[element as usize],
                element,
                barycentric: [1.0, 0.0, 0.0],
                feature: Feature::Vertex(0),
            },
        }
    }

    /// The unit normal of a triangle, zero if it has no area, or of a point.
    pub fn normal(&self, element: u32) -> Vec3 {
        match &self.leaves {
            Leaves::Triangles(soup, _) => area_vector(soup.corners(element as usize)).normalize_or_zero(),
            Leaves::Points(cloud, _) => cloud.normals()[element as usize],
        }
    }

    #[inline]
    fn squared_distance(&self, place: Vec3, element: u32) -> f64 {
        match &self.leaves {
            Leaves::Triangles(soup, _) => squared_distance_to_triangle(place, soup.corners(element as usize)),
            Leaves::Points(cloud, _) => cloud.points()[element as usize].distance_squared(place),
        }
    }

    /// The squared distance and the number of what is nearest within `limit`.
    #[inline]
    fn nearest(&self, place: Vec3, limit: f64, search: &mut Search) -> Option<Best> {
        if !place.is_finite() {
            return None;
        }
        let mut best = (limit * limit, NOTHING);
        if search.last != NOTHING {
            let last = (self.squared_distance(place, search.last), search.last);
            best = if last < best { last } else { best };
        }
        let from = self.tree.narrow(place);
        let start = from.limit(best.0.sqrt());
        match &self.leaves {
            Leaves::Triangles(soup, packs) => {
                self.tree.search(&from, start, &mut search.open, |leaf, mut limit| {
                    let pack = &packs[leaf];
                    let narrow = pack.squared_distances(&from);
                    for (&narrow, &element) in narrow.iter().zip(&pack.elements) {
                        if narrow <= limit && element != best.1 {
                            let corners = soup.corners(element as usize);
                            let found = (squared_distance_to_triangle(place, corners), element);
                            if found < best {
                                best = found;
                                limit = from.limit(best.0.sqrt());
                            }
                        }
                    }
                    limit
                });
            }
            Leaves::Points(_, packs) => {
                self.tree.search(&from, start, &mut search.open, |leaf, limit| {
                    let pack = &packs[leaf];
                    let before = best.0;
                    for found in pack.squared_distances(place).into_iter().zip(pack.elements) {
                        best = if found < best { found } else { best };
                    }
                    if best.0 < before { from.limit(best.0.sqrt()) } else { limit }
                });
            }
        }
        search.last = if best.1 == NOTHING { search.last } else { best.1 };
        (best.1 != NOTHING).then_some(best)
    }
}

#[cfg(test)]
mod tests;
