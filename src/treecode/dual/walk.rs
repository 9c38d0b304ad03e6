//! The walk down the blocks of queries, each with the clusters that its parents left to it.
use super::bounds::{ROUND_UP, ROUNDING_OF_SUMS};
use super::clusters::Clusters;
use super::far::FarFields;
use super::local::Local;
use super::near::Near;
use super::octet::Octet;
use super::place::{Block, Place};
use super::reach::{BlockReach, CLASSES, Reach};
use super::sources::NearLeaf;
use super::targets::Cells;
use super::{DualAccuracy, GROUPS, Sources, Targets, WIDTH};
use crate::data::BLOCK;
use crate::math::Vec3;

/// What does not change during walks.
pub struct Walk<'a> {
    pub clusters: &'a Clusters,
    pub reaches: Vec<Reach>,
    pub sources: &'a dyn Sources,
    pub targets: &'a dyn Targets,
    pub accuracy: DualAccuracy,
    /// If bounds of errors are asked for: what sources acting as dipoles lack, a share of the largest field of such sources.
    pub lacking: Option<f32>,
}

/// What one task found.
pub struct Findings {
    /// Numbers of queries in the blocks, and bounds of their errors.
    pub blocks: Vec<(usize, f64)>,
    pub values: Vec<f64>,
    /// Of the queries with these values.
    pub indices: Vec<usize>,
}

/// Space for walks, used again and again.
#[derive(Default)]
pub struct Space {
    far_fields: FarFields,
    /// Clusters left to the blocks below, as a stack of lists.
    pub pending: Vec<u32>,
    work: Vec<u32>,
    /// Clusters far from the block, by their class.
    pub far: [Vec<u32>; CLASSES],
    /// Clusters and the groups of queries that they still have to act on.
    pub near: Vec<(u32, u32)>,
    pub leaves: Vec<NearLeaf>,
    points: Vec<Vec3>,
    pub block: Block,
}

/// What a block inherits.
#[derive(Clone, Copy)]
struct Inherited {
    place: Place,
    local: Local,
    /// A bound of the error of the polynomial.
    error: f64,
}

impl Walk<'_> {
    /// Walks everything below a block, from the top of the tree of sources.
    pub fn run(&self, block: &Cells, space: &mut Space) -> Findings {
        let queries = self.targets.len(block);
        let mut findings = Findings {
            blocks: Vec::new(),
            values: Vec::with_capacity(queries),
            indices: Vec::with_capacity(queries),
        };
        space.pending.clear();
        space.pending.extend(self.clusters.roots.clone().map(|c| c as u32));
        let place = Place::new(&self.targets.bounds(block), &self.clusters.frame);
        let inherited = Inherited { place, local: Local::ZERO, error: 0.0 };
        self.descend(block, &inherited, 0, space, &mut findings);
        findings
    }

    /// Treats one block, whose parent's clusters are `space.pending[from..]`.
    fn descend(
        &self,
        block: &Cells,
        inherited: &Inherited,
        from: usize,
        space: &mut Space,
        findings: &mut Findings,
    ) {
        let bounds = self.targets.bounds(block);
        let place = Place::new(&bounds, &self.clusters.frame);
        let is_leaf = self.targets.len(block) <= BLOCK;
        let mark = space.pending.len();
        let reach = BlockReach::new(place.radius, &self.accuracy);
        self.sift(&place, &reach, from, space);
        // A leaf takes the values of what it inherits as they are: moving the polynomial is more work.
        let mut own = if is_leaf {
            inherited.without_local(place)
        } else {
            inherited.moved_to(place, self.accuracy.degree)
        };
        if !is_leaf {
            self.add_far(&mut own, space);
        }
        if is_leaf {
            space.points.clear();
            self.targets.gather(block, &mut findings.indices, &mut space.points);
            space.block.set(&space.points, &bounds, &place, &self.clusters.frame);
            let bound = self.values(inherited, &mut own, &reach, mark, space, &mut findings.values);
            findings.blocks.push((space.points.len(), bound));
        } else {
            self.targets.split(block, &mut |child| self.descend(&child, &own, mark, space, findings));
        }
        space.pending.truncate(mark);
    }

    /// Sorts the clusters `space.pending[from..]` into those far from the block (`space.far`) and those left to the blocks
    /// below (appended to `space.pending`), opening the large ones.
    fn sift(&self, place: &Place, of_block: &BlockReach, from: usize, space: &mut Space) {
        let Space { pending, work, far, .. } = space;
        work.clear();
        work.extend_from_slice(&pending[from..]);
        let small = 0.5 * place.radius;
        let mut next = 0;
        while next < work.len() {
            let count = 4.min(work.len() - next);
            let at = |k: usize| work[next + if k < count { k } else { 0 }];
            let four = [at(0), at(1), at(2), at(3)];
            next += count;
            let (offset, radius) = place.relative_to(four.map(|c| &self.clusters.balls[c as usize]));
            let distance = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]).sqrt();
            let (distance, radius) = (distance.to_array(), radius.to_array());
            for (k, cluster) in four.into_iter().enumerate().take(count) {
                let link = &self.clusters.links[cluster as usize];
                let class = of_block.class(&self.reaches[cluster as usize], distance[k], radius[k]);
                if let Some(class) = class {
                    far[class].push(cluster);
                } else if link.is_leaf() || radius[k] < small {
                    pending.push(cluster);
                } else {
                    work.extend(link.range().map(|c| c as u32));
                }
            }
        }
    }

    fn add_far(&self, own: &mut Inherited, space: &mut Space) {
        let Space { far_fields, far, .. } = space;
        own.error +=
            far_fields.add(self.clusters, far, &own.place, &self.accuracy, self.lacking, &mut own.local);
        far.iter_mut().for_each(Vec::clear);
    }

    /// Appends the values at the queries of a leaf; answers a bound of their errors.
    fn values(
        &self,
        inherited: &Inherited,
        own: &mut Inherited,
        reach: &BlockReach,
        mark: usize,
        space: &mut Space,
        values: &mut Vec<f64>,
    ) -> f64 {
        let mut far = [Octet::ZERO; GROUPS];
        let mut near = Near { walk: self, place: &own.place, reach, mark, space, far: &mut far, error: 0.0 };
        near.add();
        own.error += ROUND_UP * near.error + ROUNDING_OF_SUMS;
        self.add_far(own, space);
        let (block, count) = (&space.block, space.points.len());
        let groups = block.queries.groups;
        for local in [inherited, &*own] {
            let shift = (own.place.center - local.place.center) / f64::from(local.place.radius);
            let to_local = (1.0 / local.place.radius, shift.to_array().map(|x| x as f32));
            local.local.add_values(
                &block.queries.offsets[..groups],
                to_local,
                self.accuracy.degree,
                &mut far[..groups],
            );
        }
        let mut all: [f64; BLOCK] = std::array::from_fn(|i| f64::from(far[i / WIDTH].0[i % WIDTH]));
        let (leaves, items) = (&space.leaves, &self.clusters.items);
        self.sources.add(leaves, items, &block.queries, self.accuracy.of_source(), &mut all);
        values.extend(&all[..count]);
        if block.beyond != 0 {
            let first = values.len() - count;
            (0..count).filter(|i| block.beyond >> i & 1 == 1).for_each(|i| values[first + i] = 0.0);
        }
        if self.lacking.is_some() { own.error } else { f64::INFINITY }
    }
}

impl Inherited {
    fn moved_to(&self, place: Place, degree: usize) -> Inherited {
        let radius = f64::from(self.place.radius);
        let d = ((place.center - self.place.center) / radius).to_array();
        let local = self.local.moved(d, f64::from(place.radius) / radius, degree);
        Inherited { place, local, error: self.error }
    }

    fn without_local(&self, place: Place) -> Inherited {
        Inherited { place, local: Local::ZERO, error: self.error }
    }
}
