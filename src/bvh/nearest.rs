use super::{Bvh, Child, WIDTH};
use crate::math::{Aabb, Vec3};

/// Most points in a leaf.
const LEAF_SIZE: usize = 8;

/// Points to look for the nearest of; built once, asked many times.
pub struct PointTree {
    bvh: Bvh,
    /// In the order of the hierarchy's items: what is looked for together lies together.
    ordered: Vec<Vec3>,
}

impl PointTree {
    pub fn new(points: &[Vec3]) -> PointTree {
        let box_of = |p: &Vec3| Aabb { min: *p, max: *p };
        let bvh = Bvh::build(&points.iter().map(box_of).collect::<Vec<_>>(), LEAF_SIZE);
        let ordered = bvh.items().iter().map(|&i| points[i as usize]).collect();
        PointTree { bvh, ordered }
    }

    pub fn is_empty(&self) -> bool {
        self.ordered.is_empty()
    }

    /// The numbers of the points in the order of the tree, in which those that lie together follow each other.
    pub fn items(&self) -> &[u32] {
        self.bvh.items()
    }
}

/// The search for what lies nearest to a point, with scratch space that many searches share.
#[derive(Default)]
pub struct Nearest {
    /// Squared distances and item numbers, ascending.
    found: Vec<(f64, u32)>,
    /// What is still to be looked at, with the least squared distance of anything in it.
    open: Vec<(f64, Child)>,
}

impl Nearest {
    /// The `count` points nearest to that at `place` in the order of the tree, itself among them, nearest first and equally near
    /// ones in the order of their numbers; fewer where there are not as many.
    pub fn find(&mut self, tree: &PointTree, place: usize, count: usize) -> &[(f64, u32)] {
        let points = &tree.ordered;
        let center = points[place];
        // The points around it on the curve bound from the start how far to look.
        let first = place.saturating_sub(count / 2).min(points.len().saturating_sub(count));
        let around = first..points.len().min(first + count);
        let is_bounded = around.len() == count;
        let start = around.map(|place| points[place].distance_squared(center)).fold(0.0, f64::max);
        self.search(tree, center, count, if is_bounded { start } else { f64::INFINITY })
    }

    /// The point nearest to `center` as squared distance and number, of equally near points that of the lowest number; nothing if
    /// there are no points.
    pub fn nearest_to(&mut self, tree: &PointTree, center: Vec3) -> Option<(f64, u32)> {
        self.search(tree, center, 1, f64::INFINITY).first().copied()
    }

    /// The `count` points nearest to `center`, in the order of [`Nearest::find`]; fewer where there are not as many.
    pub fn around(&mut self, tree: &PointTree, center: Vec3, count: usize) -> &[(f64, u32)] {
        self.search(tree, center, count, f64::INFINITY)
    }

    /// The `count` points nearest to `center`, none farther than the square root of `limit`.
    fn search(&mut self, tree: &PointTree, center: Vec3, count: usize, limit: f64) -> &[(f64, u32)] {
        let PointTree { bvh, ordered: points } = tree;
        let distance = |place: usize| (points[place].distance_squared(center), bvh.items()[place]);
        let mut limit = (limit, u32::MAX);
        self.found.clear();
        self.open.clear();
        if !points.is_empty() {
            self.open.push((0.0, Child::Inner(0)));
        }
        while let Some((least, child)) = self.open.pop() {
            if least > limit.0 {
                continue;
            }
            if let Child::Inner(node) = child {
                let node = &bvh.nodes()[node as usize];
                let before = self.open.len();
                for k in 0..WIDTH {
                    let bounds = &node.bounds[k];
                    let offset = (bounds.min - center).max(center - bounds.max).max(Vec3::ZERO);
                    let least = offset.length_squared();
                    if node.children[k] != Child::Empty && least <= limit.0 {
                        // The nearest is taken next.
                        let behind = self.open[before..].partition_point(|other| other.0 > least);
                        self.open.insert(before + behind, (least, node.children[k]));
                    }
                }
                continue;
            }
            for near in bvh.places(child).map(distance) {
                if near > limit {
                    continue;
                }
                let place = self.found.partition_point(|other| *other < near);
                self.found.truncate(count - 1);
                self.found.insert(place, near);
                if self.found.len() == count {
                    limit = self.found[count - 1];
                }
            }
        }
        &self.found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn those_found_are_those_of_a_search_through_all() {
        let on_a_grid = |i: u32| Vec3::new(f64::from(i * 7 % 9), f64::from(i * 5 % 7), f64::from(i * 3 % 5));
        let scattered = |i: u32| Vec3::from_array([0.37, 1.73, 2.91].map(|s| (f64::from(i) * s).sin()));
        assert_eq!(Nearest::default().nearest_to(&PointTree::new(&[]), Vec3::ONE), None);
        for (total, points) in [(1, true), (7, false), (300, true), (700, false)] {
            let points: Vec<Vec3> =
                (0..total).map(|i| if points { on_a_grid(i) } else { scattered(i) }).collect();
            let tree = PointTree::new(&points);
            let mut nearest = Nearest::default();
            for (place, own) in tree.ordered.iter().enumerate() {
                let mut all: Vec<(f64, u32)> =
                    (0..total).map(|i| (points[i as usize].distance_squared(*own), i)).collect();
                all.sort_by(|a, b| a.partial_cmp(b).unwrap());
                for count in [1, 2, 21] {
                    let expected = &all[..all.len().min(count)];
                    assert_eq!(nearest.find(&tree, place, count), expected);
                }
                let center = 1.1 * *own + Vec3::splat(0.3);
                let distances = points.iter().map(|p| p.distance_squared(center)).zip(0..);
                let expected = distances.min_by(|a, b| a.partial_cmp(b).unwrap());
                assert_eq!(nearest.nearest_to(&tree, center), expected);
                let several = nearest.around(&tree, center, 5);
                assert_eq!((several.len(), several.first().copied()), (points.len().min(5), expected));
            }
        }
    }
}
