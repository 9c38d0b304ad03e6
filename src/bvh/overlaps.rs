//! Which boxes of two hierarchies overlap: both are walked together.
use super::{Bvh, Child, WIDTH};
use crate::data::map_tasks;
use crate::math::{Aabb, Vec3};

/// Pairs of subtrees that are made before tasks are: enough for any number of threads.
const TASKS: usize = 256;

/// A part of each hierarchy, and the box around it.
type Places = [(Child, Aabb); 2];

impl Bvh {
    /// The pairs of an item of this hierarchy and one of `other` whose boxes overlap, touching ones too; `boxes` and
    /// `of_other` are those the hierarchies were built over. In parallel, the same order for any number of threads.
    pub fn overlaps(&self, boxes: &[Aabb], other: &Bvh, of_other: &[Aabb]) -> Vec<[u32; 2]> {
        pairs([self, other], [boxes, of_other], false)
    }

    /// The pairs of different items whose boxes overlap, each once, the lower item first.
    pub fn own_overlaps(&self, boxes: &[Aabb]) -> Vec<[u32; 2]> {
        pairs([self, self], [boxes, boxes], true)
    }
}

fn pairs(trees: [&Bvh; 2], boxes: [&[Aabb]; 2], is_own: bool) -> Vec<[u32; 2]> {
    if trees.iter().any(|tree| tree.items.is_empty()) {
        return Vec::new();
    }
    let everything = Aabb { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };
    let mut open: Vec<Places> = vec![[(Child::Inner(0), everything); 2]];
    let mut found = Vec::new();
    while open.len() < TASKS && !open.is_empty() {
        let mut below = Vec::new();
        open.iter().for_each(|places| step(trees, boxes, is_own, places, &mut below, &mut found));
        open = below;
    }
    let of_tasks = map_tasks(open.len(), |task| {
        let (mut stack, mut found) = (vec![open[task]], Vec::new());
        while let Some(places) = stack.pop() {
            step(trees, boxes, is_own, &places, &mut stack, &mut found);
        }
        found
    });
    of_tasks.into_iter().for_each(|some| found.extend(some));
    found
}

/// Opens the inner ones of two places; two leaves give their pairs of items.
fn step(
    trees: [&Bvh; 2],
    boxes: [&[Aabb]; 2],
    is_own: bool,
    places: &Places,
    below: &mut Vec<Places>,
    found: &mut Vec<[u32; 2]>,
) {
    let is_same = is_own && places[0].0 == places[1].0;
    let parts = [0, 1].map(|side| parts(trees[side], places[side]));
    if parts.iter().all(Option::is_none) {
        let items = [0, 1].map(|side| &trees[side].items[trees[side].places(places[side].0)]);
        for (i, &first) in items[0].iter().enumerate() {
            for &second in &items[1][if is_same { i + 1 } else { 0 }..] {
                if boxes[0][first as usize].overlaps(&boxes[1][second as usize]) {
                    found.push(if is_own { [first.min(second), first.max(second)] } else { [first, second] });
                }
            }
        }
        return;
    }
    let whole = |side: usize| {
        let mut only = [(Child::Empty, Aabb::EMPTY); WIDTH];
        only[0] = places[side];
        only
    };
    let [firsts, seconds] = [0, 1].map(|side| parts[side].unwrap_or_else(|| whole(side)));
    for (i, first) in firsts.iter().enumerate().filter(|(_, part)| part.0 != Child::Empty) {
        for second in seconds[if is_same { i } else { 0 }..].iter().filter(|part| part.0 != Child::Empty) {
            if first.1.overlaps(&second.1) {
                below.push([*first, *second]);
            }
        }
    }
}

fn parts(tree: &Bvh, (child, _): (Child, Aabb)) -> Option<[(Child, Aabb); WIDTH]> {
    let Child::Inner(node) = child else { return None };
    let node = &tree.nodes[node as usize];
    Some([0, 1, 2, 3].map(|k| (node.children[k], node.bounds[k])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered(count: u32, shift: f64) -> Vec<Aabb> {
        let place = |i: u32, s: f64| (f64::from(i) * s + shift).sin();
        (0..count)
            .map(|i| {
                let p = Vec3::new(place(i, 0.37), place(i, 1.73), place(i, 2.91));
                Aabb { min: p, max: p + 0.3 * Vec3::new(0.5 + place(i, 5.1), 0.5, 0.7).abs() }
            })
            .collect()
    }

    #[test]
    fn pairs_are_those_of_all_tries() {
        for (m, n) in [(0, 5), (1, 1), (3, 200), (300, 170), (700, 700)] {
            let (a, b) = (scattered(m, 0.0), scattered(n, 1.0));
            let (left, right) = (Bvh::build(&a, 4), Bvh::build(&b, 4));
            let mut pairs = left.overlaps(&a, &right, &b);
            pairs.sort();
            let all = (0..m).flat_map(|i| (0..n).map(move |j| [i, j]));
            let expected: Vec<[u32; 2]> =
                all.filter(|[i, j]| a[*i as usize].overlaps(&b[*j as usize])).collect();
            assert_eq!(pairs, expected);
            let mut own = left.own_overlaps(&a);
            own.sort();
            let all = (0..m).flat_map(|i| (i + 1..m).map(move |j| [i, j]));
            let expected: Vec<[u32; 2]> =
                all.filter(|[i, j]| a[*i as usize].overlaps(&a[*j as usize])).collect();
            assert_eq!(own, expected);
        }
    }
}
