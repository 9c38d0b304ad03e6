//! Which clusters and elements act on a block of points, and in what manner: far ones by their series.
use super::clusters::Clusters;
use super::elements::Elements;
use crate::bvh::{Child, Stack, WIDTH};
use crate::data::BLOCK;
use crate::math::{Aabb, Vec3};
use crate::treecode::{GROUPS, Octet};

/// Points in a group.
pub const LANES: usize = BLOCK / GROUPS;

/// What is far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// A cluster acts as a whole where it is farther than this times its radius.
    pub beta: f64,
    /// A triangle acts by its series where it is farther than this times its longest edge.
    pub near: f64,
}

impl Default for Opening {
    fn default() -> Self {
        Opening { beta: 2.0, near: 1.0 }
    }
}

/// Farther than this times the distance where a series begins to be used, its octupole is left out.
pub const WITHOUT_OCTUPOLE: f64 = 1.8;

/// Eight points that are taken together.
pub struct Group {
    /// Relative to the middle of the block.
    pub places: [Octet; 3],
    pub center: Vec3,
    pub radius: f64,
}

/// Up to [`BLOCK`] points that lie close together, in groups.
pub struct Block {
    pub points: Vec<Vec3>,
    pub center: Vec3,
    pub radius: f64,
    pub groups: Vec<Group>,
}

impl Block {
    /// Neighbours are to follow each other; all are finite.
    pub fn new(points: &[Vec3]) -> Block {
        let (center, radius) = ball(points);
        Block::about(center, radius, points)
    }

    /// Points in a ball; their places are relative to its middle.
    pub fn about(center: Vec3, radius: f64, points: &[Vec3]) -> Block {
        let group = |points: &[Vec3]| {
            let lane = |axis: usize, k: usize| (points[k.min(points.len() - 1)] - center)[axis] as f32;
            let places = [0, 1, 2].map(|axis| Octet(std::array::from_fn(|k| lane(axis, k))));
            let (center, radius) = ball(points);
            Group { places, center, radius }
        };
        Block { points: points.to_vec(), center, radius, groups: points.chunks(LANES).map(group).collect() }
    }

    /// What acts on any points in a ball is found for it.
    pub fn of_ball(center: Vec3, radius: f64) -> Block {
        let places = [Octet::ZERO; 3];
        Block { points: Vec::new(), center, radius, groups: vec![Group { places, center, radius }] }
    }

    /// One bit for each group.
    pub fn all(&self) -> u32 {
        (1 << self.groups.len()) - 1
    }
}

fn ball(points: &[Vec3]) -> (Vec3, f64) {
    let center = Aabb::around(points.iter().copied()).center();
    let farthest = points.iter().map(|p| p.distance_squared(center)).fold(0.0, f64::max);
    (center, farthest.sqrt())
}

/// The clusters below the root.
pub fn roots(elements: &Elements) -> impl Iterator<Item = u32> {
    let first = elements.bvh.nodes().first().map_or([Child::Empty; WIDTH], |root| root.children);
    (0..WIDTH as u32).filter(move |k| first[*k as usize] != Child::Empty)
}

/// What acts on the groups of a block: numbers of clusters or elements, each with the groups as bits.
#[derive(Default)]
pub struct Lists {
    /// By series to the octupole, and to the quadrupole.
    pub clusters: [Vec<(u32, u32)>; 2],
    pub elements: [Vec<(u32, u32)>; 2],
    /// Elements next to some point of a group.
    pub near: Vec<(u32, u32)>,
    stack: Stack<u32>,
}

impl Lists {
    /// What acts on any points in a ball of all there is below some clusters.
    pub fn of_ball(
        center: Vec3,
        radius: f64,
        elements: &Elements,
        clusters: &Clusters,
        opening: &Opening,
        below: impl Iterator<Item = u32>,
    ) -> Lists {
        let mut lists = Lists::default();
        lists.find(&Block::of_ball(center, radius), elements, clusters, opening, below);
        lists
    }

    /// What acts on a block of all there is below some clusters.
    pub fn find(
        &mut self,
        block: &Block,
        elements: &Elements,
        clusters: &Clusters,
        opening: &Opening,
        below: impl Iterator<Item = u32>,
    ) {
        let Lists { clusters: by_cluster, elements: by_element, near, stack, .. } = self;
        by_cluster.iter_mut().chain(by_element.iter_mut()).for_each(Vec::clear);
        near.clear();
        let (bvh, beta) = (&elements.bvh, opening.beta);
        let rest = |c: usize, groups: u32, listed: &mut [Vec<(u32, u32)>; 2]| {
            groups & !sort(block, clusters.centers[c], beta * clusters.radii[c], groups, c, listed)
        };
        let mut leaf = |node: usize, k: usize, groups: u32| {
            for i in bvh.places(bvh.nodes()[node].children[k]) {
                let reach = opening.near * elements.sizes[i];
                let rest = groups & !sort(block, elements.centers[i], reach, groups, i, by_element);
                if rest != 0 {
                    near.push((i as u32, rest));
                }
            }
        };
        for c in below {
            let (node, k) = (c as usize / WIDTH, c as usize % WIDTH);
            let groups = rest(c as usize, block.all(), &mut *by_cluster);
            match bvh.nodes()[node].children[k] {
                _ if groups == 0 => {}
                Child::Empty => {}
                Child::Leaf { .. } => leaf(node, k, groups),
                Child::Inner(inner) => {
                    let visit = |node: usize, groups: u32| {
                        let mut below = [0; WIDTH];
                        let mut open = 0;
                        for (k, child) in bvh.nodes()[node].children.into_iter().enumerate() {
                            if child != Child::Empty {
                                below[k] = rest(WIDTH * node + k, groups, &mut *by_cluster);
                                open |= u32::from(below[k] != 0) << k;
                            }
                        }
                        (open, below)
                    };
                    bvh.traverse_below(inner, stack, groups, visit, &mut leaf);
                }
            }
        }
    }
}

/// Those of `groups` that are farther from `center` than `reach`; `source` is listed for them.
#[inline]
fn sort(
    block: &Block,
    center: Vec3,
    reach: f64,
    groups: u32,
    source: usize,
    lists: &mut [Vec<(u32, u32)>; 2],
) -> u32 {
    let distance = block.center.distance(center);
    let mut add = |order: usize, bits: u32| {
        if bits != 0 {
            lists[order].push((source as u32, bits));
        }
    };
    if distance - block.radius > WITHOUT_OCTUPOLE * reach {
        add(1, groups);
        return groups;
    }
    if distance + block.radius < reach {
        return 0;
    }
    let mut far = [0, 0];
    for g in bits(groups) {
        let group = &block.groups[g];
        let distance = group.center.distance(center) - group.radius;
        far[0] |= u32::from(distance > reach) << g;
        far[1] |= u32::from(distance > WITHOUT_OCTUPOLE * reach) << g;
    }
    add(0, far[0] & !far[1]);
    add(1, far[1]);
    far[0]
}

/// The places of the bits that are set.
pub fn bits(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (mask != 0).then(|| mask.trailing_zeros() as usize);
        mask &= mask.wrapping_sub(1);
        lowest
    })
}
