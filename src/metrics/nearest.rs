use crate::bvh::{Nearest, PointTree};
use crate::data::map_tasks;
use crate::math::Vec3;

/// Queries that share their scratch space: some milliseconds of work.
const QUERIES_PER_TASK: usize = 1024;

/// Points to look for the nearest of many at once.
pub struct NearestPoints(PointTree);

impl NearestPoints {
    pub fn new(points: &[Vec3]) -> NearestPoints {
        NearestPoints(PointTree::new(points))
    }

    /// For each query the number of the nearest point and the distance to it, in parallel; of equally near points the first.
    /// Nothing at all if there are no points.
    pub fn of(&self, queries: &[Vec3]) -> Vec<(usize, f64)> {
        if self.0.is_empty() {
            return vec![];
        }
        let task = |task: usize| {
            let mut nearest = Nearest::default();
            let first = task * QUERIES_PER_TASK;
            let some = &queries[first..queries.len().min(first + QUERIES_PER_TASK)];
            let found = some.iter().filter_map(|q| nearest.nearest_to(&self.0, *q));
            found.map(|(squared, point)| (point as usize, squared.sqrt())).collect::<Vec<_>>()
        };
        map_tasks(queries.len().div_ceil(QUERIES_PER_TASK), task).concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_query_gets_its_nearest_point() {
        let points: Vec<Vec3> = (0..50).map(|i| Vec3::X * f64::from(i)).collect();
        let queries: Vec<Vec3> = (0..5000).map(|i| Vec3::new(f64::from(i % 49) + 0.25, 0.0, 1.0)).collect();
        let found = NearestPoints::new(&points).of(&queries);
        assert_eq!(found.len(), 5000);
        let expected = |i: usize| (i % 49, 1.0625f64.sqrt());
        assert!(found.iter().enumerate().all(|(i, near)| *near == expected(i)));
        assert!(NearestPoints::new(&[]).of(&queries).is_empty());
    }
}
