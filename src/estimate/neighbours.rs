use crate::data::{Cancelled, Monitor, fill_in_blocks};
use crate::math::Vec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use std::num::NonZero;

/// The nearest neighbours of every point, without the point itself, nearest first.
pub(super) struct Neighbourhoods(Vec<Vec<u32>>);

impl Neighbourhoods {
    /// Finds the `count` nearest neighbours of each point; fewer where there are not as many points.
    pub fn find(points: &[Vec3], count: usize, monitor: &dyn Monitor) -> Result<Neighbourhoods, Cancelled> {
        monitor.report(0.0, "neighbours")?;
        let coordinates: Vec<[f64; 3]> = points.iter().map(|p| p.to_array()).collect();
        let tree = ImmutableKdTree::new_from_slice(&coordinates).expect("the points are finite");
        let wanted = NonZero::new(count + 1).expect("one more than a count is not zero");
        let mut lists = vec![Vec::new(); points.len()];
        let neighbours = |i: usize, (): &mut ()| {
            let mut found: Vec<(f64, u32)> = (tree.query(&coordinates[i]))
                .nearest_n::<SquaredEuclidean<f64>>(wanted)
                .execute()
                .iter()
                .map(|near| (near.distance, near.item))
                .filter(|near| near.1 != i as u32)
                .collect();
            // Equal distances in a fixed order, whatever the library's.
            found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            found.into_iter().take(count).map(|near| near.1).collect()
        };
        fill_in_blocks(&mut lists, neighbours, "neighbours", monitor)?;
        Ok(Neighbourhoods(lists))
    }

    /// Neighbours of `point`, nearest first.
    pub fn of(&self, point: usize) -> &[u32] {
        &self.0[point]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    #[test]
    fn duplicates_are_neighbours_of_each_other() {
        let mut points = vec![Vec3::ONE; 40];
        points.push(Vec3::ZERO);
        let found = Neighbourhoods::find(&points, 5, &Silent).unwrap();
        for i in 0..40 {
            assert_eq!(found.of(i).len(), 5);
            assert!(found.of(i).iter().all(|&j| j != i as u32 && j < 40), "{:?}", found.of(i));
        }
        assert_eq!(Neighbourhoods::find(&points[..3], 5, &Silent).unwrap().of(0), [1, 2]);
    }
}
