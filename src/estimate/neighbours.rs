use crate::bvh::{Nearest, PointTree};
use crate::data::{Cancelled, Monitor, fill_in_blocks};
use crate::math::Vec3;

/// So many times as many neighbours are looked at where fewer than half of them look to a point's own side.
const MORE: usize = 3;

/// The nearest neighbours of every point, without the point itself, nearest first.
pub(super) struct Neighbourhoods(Vec<Vec<u32>>);

impl Neighbourhoods {
    /// Finds the `count` nearest neighbours of each point, equally near ones in the order of their numbers; fewer where
    /// there are not as many points, and more on thin sheets, where the other side takes up most of them. `normals` are as
    /// many as the points, or none.
    pub fn find(
        points: &[Vec3],
        normals: &[Vec3],
        count: usize,
        monitor: &dyn Monitor,
    ) -> Result<Neighbourhoods, Cancelled> {
        monitor.report(0.0, "neighbours")?;
        let tree = PointTree::new(points);
        let mut lists = vec![Vec::new(); points.len()];
        let neighbours = |place: usize, nearest: &mut Nearest| {
            let own = tree.items()[place];
            let mut wanted = count;
            let found = nearest.find(&tree, place, count + 1);
            let faces_own_side = |near: &&(f64, u32)| is_same_side(normals, own, near.1);
            let found = if 2 * found.iter().filter(faces_own_side).count() < count {
                wanted = MORE * count;
                nearest.find(&tree, place, wanted + 1)
            } else {
                found
            };
            found.iter().map(|near| near.1).filter(|near| *near != own).take(wanted).collect()
        };
        fill_in_blocks(&mut lists, neighbours, "neighbours", monitor)?;
        let mut by_point = vec![Vec::new(); points.len()];
        tree.items().iter().zip(lists).for_each(|(&point, list)| by_point[point as usize] = list);
        Ok(Neighbourhoods(by_point))
    }

    /// Neighbours of `point`, nearest first.
    pub fn of(&self, point: usize) -> &[u32] {
        &self.0[point]
    }
}

/// Whether two points look to the same side; without normals, all do.
pub(super) fn is_same_side(normals: &[Vec3], i: u32, j: u32) -> bool {
    normals.is_empty() || normals[i as usize].dot(normals[j as usize]) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    #[test]
    fn duplicates_are_neighbours_of_each_other() {
        let mut points = vec![Vec3::ONE; 40];
        points.push(Vec3::ZERO);
        let found = Neighbourhoods::find(&points, &[], 5, &Silent).unwrap();
        for i in 0..40 {
            assert_eq!(found.of(i).len(), 5);
            assert!(found.of(i).iter().all(|&j| j != i as u32 && j < 40), "{:?}", found.of(i));
        }
        assert_eq!(Neighbourhoods::find(&points[..3], &[], 5, &Silent).unwrap().of(0), [1, 2]);
    }
}
