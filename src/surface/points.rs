//! The points of a cloud, to be looked for by place.
use crate::bvh::{Bvh, Nearest};
use crate::math::{Aabb, Vec3};

/// Most points in a leaf of the tree.
const LEAF_SIZE: usize = 8;

pub struct Points {
    pub bvh: Bvh,
    /// In the order of the tree.
    pub places: Vec<Vec3>,
}

impl Points {
    pub fn new(points: &[Vec3]) -> Points {
        let boxes: Vec<Aabb> = points.iter().map(|p| Aabb { min: *p, max: *p }).collect();
        let bvh = Bvh::build(&boxes, LEAF_SIZE);
        let places = bvh.items().iter().map(|&i| points[i as usize]).collect();
        Points { bvh, places }
    }

    /// The squared distance and the number of the point nearest to a place.
    pub fn nearest_to(&self, place: Vec3, nearest: &mut Nearest) -> Option<(f64, u32)> {
        nearest.nearest_to(&self.bvh, &self.places, place)
    }
}
