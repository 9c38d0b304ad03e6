//! Which clusters act on which blocks as a whole, and which points singly.
use super::series::Clusters;
use super::{Group, WIDTH};
use crate::data::map_tasks;
use crate::math::{Aabb, Vec3};
use crate::treecode::Octet;
use std::ops::Range;

/// Blocks whose lists are one task.
const BLOCKS_PER_TASK: usize = 64;

/// The points that are summed for together: those of a leaf, eight to a group; the last one fills the places left over.
pub struct Blocks {
    points: Vec<Range<u32>>,
    groups: Vec<Group>,
    /// Where the groups of each begin, and after the last.
    starts: Vec<u32>,
    /// Around the points: x, y, z and radius.
    balls: Vec<[f32; 4]>,
}

impl Blocks {
    pub fn of(clusters: &Clusters, points: &[Vec3]) -> Blocks {
        let mut blocks = Blocks { points: vec![], groups: vec![], starts: vec![0], balls: vec![] };
        let mut leaves: Vec<u32> =
            (0..clusters.len() as u32).filter(|c| clusters.leaf(*c).is_some()).collect();
        leaves.sort_by_key(|c| clusters.leaf(*c).map(|range| range.start));
        for leaf in leaves {
            let range = clusters.leaf(leaf).expect("it is a leaf");
            let own = &points[range.start as usize..range.end as usize];
            add_groups(own, &mut blocks.groups);
            let bounds = Aabb::around(own.iter().copied());
            let [x, y, z] = bounds.center().to_array().map(|c| c as f32);
            blocks.balls.push([x, y, z, (0.5 * bounds.diagonal()) as f32]);
            blocks.points.push(range);
            blocks.starts.push(blocks.groups.len() as u32);
        }
        blocks
    }

    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// The points of a block, in the order of the curve.
    pub fn points(&self, block: usize) -> Range<u32> {
        self.points[block].clone()
    }

    /// The places of all points.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Vectors of the sorted points in such groups; none if there are none.
    pub fn grouped(&self, vectors: &[Vec3]) -> Vec<Group> {
        let mut groups = Vec::new();
        if !vectors.is_empty() {
            let own = |range: &Range<u32>| &vectors[range.start as usize..range.end as usize];
            self.points.iter().for_each(|range| add_groups(own(range), &mut groups));
        }
        groups
    }

    /// The groups of a block among those of all; none if there are none.
    pub fn of_block<'a>(&self, block: usize, groups: &'a [Group]) -> &'a [Group] {
        groups.get(self.starts[block] as usize..self.starts[block + 1] as usize).unwrap_or(&[])
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.points[..])
            + size_of_val(&self.groups[..])
            + size_of_val(&self.starts[..])
            + size_of_val(&self.balls[..])
    }
}

fn add_groups(vectors: &[Vec3], groups: &mut Vec<Group>) {
    for some in vectors.chunks(WIDTH) {
        let axis = |axis: usize| Octet(std::array::from_fn(|k| some[k.min(some.len() - 1)][axis] as f32));
        groups.push([axis(0), axis(1), axis(2)]);
    }
}

/// For each block: clusters that act as a whole, and ranges of points that act singly.
pub struct Lists {
    far: Vec<u32>,
    near: Vec<Range<u32>>,
    /// Where the lists of each block begin, and after the last.
    starts: Vec<[usize; 2]>,
}

impl Lists {
    pub fn find(clusters: &Clusters, blocks: &Blocks, opening: f32) -> Lists {
        let tasks = map_tasks(blocks.len().div_ceil(BLOCKS_PER_TASK), |task| {
            let first = task * BLOCKS_PER_TASK;
            let mut lists = Lists { far: vec![], near: vec![], starts: vec![] };
            for block in first..blocks.len().min(first + BLOCKS_PER_TASK) {
                lists.add(clusters, &blocks.balls[block], opening);
            }
            lists
        });
        let mut all = Lists { far: vec![], near: vec![], starts: vec![[0, 0]] };
        for lists in tasks {
            let [far, near] = [all.far.len(), all.near.len()];
            all.starts.extend(lists.starts.iter().map(|[f, n]| [far + f, near + n]));
            all.far.extend(lists.far);
            all.near.extend(lists.near);
        }
        all
    }

    fn add(&mut self, clusters: &Clusters, [x, y, z, radius]: &[f32; 4], opening: f32) {
        let mut stack: Vec<u32> = clusters.roots().rev().collect();
        while let Some(cluster) = stack.pop() {
            let [cx, cy, cz, own] = clusters.ball(cluster);
            let distance = ((cx - x) * (cx - x) + (cy - y) * (cy - y) + (cz - z) * (cz - z)).sqrt();
            if distance - radius > opening * own && distance > *radius {
                self.far.push(cluster);
            } else if let Some(points) = clusters.leaf(cluster) {
                // Not one that belongs to the block before.
                let own = self.starts.last().map_or(0, |s| s[1]);
                match self.near[own..].last_mut() {
                    Some(last) if last.end == points.start => last.end = points.end,
                    _ => self.near.push(points),
                }
            } else {
                stack.extend(clusters.children(cluster).rev());
            }
        }
        self.starts.push([self.far.len(), self.near.len()]);
    }

    pub fn far(&self, block: usize) -> &[u32] {
        &self.far[self.starts[block][0]..self.starts[block + 1][0]]
    }

    pub fn near(&self, block: usize) -> &[Range<u32>] {
        &self.near[self.starts[block][1]..self.starts[block + 1][1]]
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.far[..]) + size_of_val(&self.near[..]) + size_of_val(&self.starts[..])
    }
}
