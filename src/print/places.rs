use crate::math::Vec2;

/// Points to be found by nearness and taken away: a balanced tree of two dimensions in an array, the root of each range in its
/// middle.
pub(super) struct Places {
    points: Vec<Vec2>,
    /// Which point is at each place of the tree.
    items: Vec<u32>,
    /// Where each point is in the tree.
    place: Vec<u32>,
    /// How many points of the range around each root are left.
    left: Vec<u32>,
    is_there: Vec<bool>,
}

impl Places {
    pub(super) fn new(points: Vec<Vec2>) -> Places {
        let count = points.len();
        let mut items: Vec<u32> = (0..count as u32).collect();
        let mut left = vec![0; count];
        arrange(&points, &mut items, &mut left, true);
        let mut place = vec![0; count];
        (0..).zip(&items).for_each(|(k, item)| place[*item as usize] = k);
        Places { points, items, place, left, is_there: vec![true; count] }
    }

    /// The number of the point nearest to `p`, of equally near ones the lowest; nothing if none is left.
    pub(super) fn nearest(&self, p: Vec2) -> Option<usize> {
        let mut best = (f64::INFINITY, u32::MAX);
        self.search(p, 0, self.items.len(), true, &mut best);
        (best.1 != u32::MAX).then_some(best.1 as usize)
    }

    fn search(&self, p: Vec2, from: usize, to: usize, by_x: bool, best: &mut (f64, u32)) {
        let middle = (from + to) / 2;
        if from == to || self.left[middle] == 0 {
            return;
        }
        let item = self.items[middle];
        let root = self.points[item as usize];
        if self.is_there[item as usize] {
            let found = (root.distance_squared(p), item);
            if found < *best {
                *best = found;
            }
        }
        let offset = if by_x { p.x - root.x } else { p.y - root.y };
        let halves = [(from, middle), (middle + 1, to)];
        let (near, far) = if offset < 0.0 { (halves[0], halves[1]) } else { (halves[1], halves[0]) };
        self.search(p, near.0, near.1, !by_x, best);
        if offset * offset <= best.0 {
            self.search(p, far.0, far.1, !by_x, best);
        }
    }

    /// Takes a point away, if it is still there.
    pub(super) fn remove(&mut self, point: usize) {
        if !std::mem::take(&mut self.is_there[point]) {
            return;
        }
        let place = self.place[point] as usize;
        let (mut from, mut to) = (0, self.items.len());
        loop {
            let middle = (from + to) / 2;
            self.left[middle] -= 1;
            match place.cmp(&middle) {
                std::cmp::Ordering::Less => to = middle,
                std::cmp::Ordering::Equal => return,
                std::cmp::Ordering::Greater => from = middle + 1,
            }
        }
    }
}

/// Puts the median of a range in its middle, and does so with both halves.
fn arrange(points: &[Vec2], items: &mut [u32], left: &mut [u32], by_x: bool) {
    if items.is_empty() {
        return;
    }
    let middle = items.len() / 2;
    let along = |item: &u32| if by_x { points[*item as usize].x } else { points[*item as usize].y };
    items.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
    left[middle] = items.len() as u32;
    let (items, (left_low, left_high)) = (items, left.split_at_mut(middle));
    let (low, high) = items.split_at_mut(middle);
    arrange(points, low, left_low, !by_x);
    arrange(points, &mut high[1..], &mut left_high[1..], !by_x);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_is_that_of_a_search_through_all() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 40) % 50) as f64
        };
        let points: Vec<Vec2> = (0..500).map(|_| Vec2::new(random(), random())).collect();
        let mut places = Places::new(points.clone());
        let mut rest: Vec<usize> = (0..500).collect();
        let mut at = Vec2::new(20.5, 20.25);
        while let Some(found) = places.nearest(at) {
            let slow = rest.iter().copied().min_by(|a, b| {
                points[*a].distance_squared(at).total_cmp(&points[*b].distance_squared(at)).then(a.cmp(b))
            });
            assert_eq!(Some(found), slow);
            rest.retain(|k| *k != found);
            places.remove(found);
            places.remove(found);
            at = points[found] + Vec2::new(0.25, 0.5);
        }
        assert!(rest.is_empty());
    }
}
