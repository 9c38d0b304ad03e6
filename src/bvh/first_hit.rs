use super::{Bvh, Child, WIDTH};
use crate::math::Ray;

/// The search for what a ray meets first, with scratch space that many searches share.
#[derive(Default)]
pub struct FirstHit {
    /// What is still to be looked at, with where the ray enters it.
    open: Vec<(f64, Child)>,
}

impl FirstHit {
    /// The least distance that `meet(item, limit)` gives, with its item; of equal ones the lowest item. Items further than
    /// `limit` are left out.
    pub fn find(
        &mut self,
        bvh: &Bvh,
        ray: &Ray,
        limit: f64,
        mut meet: impl FnMut(usize) -> Option<f64>,
    ) -> Option<(f64, usize)> {
        let mut best = None;
        let mut limit = limit;
        self.open.clear();
        if !bvh.items().is_empty() {
            self.open.push((0.0, Child::Inner(0)));
        }
        while let Some((entry, child)) = self.open.pop() {
            if entry > limit {
                continue;
            }
            let Child::Inner(node) = child else {
                for &item in &bvh.items()[bvh.places(child)] {
                    let found = meet(item as usize).map(|distance| (distance, item as usize));
                    if let Some(found) = found.filter(|f| f.0 <= limit && best.is_none_or(|best| *f < best)) {
                        best = Some(found);
                        limit = found.0;
                    }
                }
                continue;
            };
            let node = &bvh.nodes()[node as usize];
            let before = self.open.len();
            for k in 0..WIDTH {
                let entry = ray.enters(&node.bounds[k]);
                if node.children[k] != Child::Empty && entry <= limit && entry < f64::INFINITY {
                    // The nearest is taken next.
                    let behind = self.open[before..].partition_point(|other| other.0 > entry);
                    self.open.insert(before + behind, (entry, node.children[k]));
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Aabb, Vec3};

    #[test]
    fn the_first_hit_is_that_of_a_search_through_all() {
        let scattered = |i: u32| Vec3::from_array([0.37, 1.73, 2.91].map(|s| (f64::from(i) * s).sin()));
        let triangles: Vec<[Vec3; 3]> =
            (0..400).map(|i| [0, 1, 2].map(|k| scattered(i) + 0.2 * scattered(1000 + 3 * i + k))).collect();
        let boxes: Vec<Aabb> = triangles.iter().map(|t| Aabb::around(*t)).collect();
        let bvh = Bvh::build(&boxes, 4);
        let mut hits = 0;
        for i in 0..300 {
            let ray = Ray::new(1.5 * scattered(5000 + i), scattered(9000 + i));
            let meet = |t: usize| ray.meet(triangles[t]).map(|hit| hit.0);
            let expected =
                (0..400).filter_map(|t| Some((meet(t)?, t))).min_by(|a, b| a.partial_cmp(b).unwrap());
            assert_eq!(FirstHit::default().find(&bvh, &ray, f64::INFINITY, meet), expected);
            hits += usize::from(expected.is_some());
        }
        assert!(hits > 100, "{hits}");
    }
}
