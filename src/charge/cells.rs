//! What acts on points that move on from one question to the next, such as the ends of lines: the field of all that is far from
//! a cube is interpolated in it, in cubes as small as is worth it, each with that of the one around it.
use super::elements::Elements;
use super::multipole::SUMS;
use super::polynomial;
use super::sources::Sources;
use super::sum::{Charged, Value, add_far};
use super::walk::{Block, LANES, Lists, WITHOUT_OCTUPOLE, roots};
use crate::bvh::{Child, WIDTH};
use crate::data::BLOCK;
use crate::math::Vec3;
use crate::treecode::Octet;

/// Clusters are far from a cube when they are farther than this times its radius from its middle.
const FAR: f64 = 2.0;
/// What is not far is left to smaller cubes, or to single questions, in clusters of at most this share of the radius.
const LARGEST: f64 = 0.6;
/// The edges of the cube that holds all others are at least this, in the elements' frame.
const ROOM: f64 = 2.0;
/// Cubes with at most so many leaves of the tree that are not far have no smaller ones.
const FEW: usize = 32;

struct Cell {
    center: Vec3,
    half: f64,
    /// The field of what is far, at the polynomial's points.
    values: Vec<[f32; SUMS]>,
    parts: Parts,
}

enum Parts {
    /// Clusters that are not far, none of them in another; numbers of the eight smaller cubes, 0 as long as there is none.
    Smaller { rest: Vec<u32>, cells: [u32; 8] },
    /// What is not far.
    Whole(Sources),
}

/// What is kept from one question to the next.
pub struct Cells {
    cells: Vec<Cell>,
    /// Half the edges of the smallest cubes.
    smallest: f64,
}

impl Cells {
    /// The smallest cubes are to have edges of `edge`, in the elements' frame; there are none if that is infinite.
    pub fn new(edge: f64) -> Cells {
        Cells { cells: Vec::new(), smallest: 0.5 * edge }
    }

    /// Potential and field at finite points.
    pub fn at(&mut self, charged: &Charged, points: &[Vec3]) -> Vec<Value> {
        if self.cells.is_empty() {
            self.cells.push(root(charged.elements, self.smallest));
        }
        let mut order: Vec<(u32, u32)> = Vec::with_capacity(points.len());
        for (k, point) in points.iter().enumerate() {
            order.push((self.around(charged, *point), k as u32));
        }
        order.sort_unstable();
        let mut values = vec![(0.0, Vec3::ZERO); points.len()];
        for run in order.chunk_by(|a, b| a.0 == b.0).flat_map(|run| run.chunks(BLOCK)) {
            let own: Vec<Vec3> = run.iter().map(|(_, k)| points[*k as usize]).collect();
            let cell = &self.cells[run[0].0 as usize];
            let found = match &cell.parts {
                Parts::Smaller { .. } => charged.at(&Block::new(&own), &mut Lists::default()),
                Parts::Whole(sources) => cell.at(charged, sources, &own),
            };
            run.iter().zip(found).for_each(|((_, k), value)| values[*k as usize] = value);
        }
        values
    }

    /// The smallest cube around a point; 0 if it is in none.
    fn around(&mut self, charged: &Charged, point: Vec3) -> u32 {
        let offset = (point - self.cells[0].center).abs().max_element();
        if offset > self.cells[0].half || self.smallest.is_infinite() {
            return 0;
        }
        let mut at = 0;
        loop {
            let cell = &self.cells[at];
            let Cell { center, half, .. } = cell;
            let Parts::Smaller { rest, cells } = &cell.parts else {
                return at as u32;
            };
            let octant = (0..3).map(|axis| usize::from(point[axis] >= center[axis]) << axis).sum::<usize>();
            let side = |axis: usize| if octant >> axis & 1 == 1 { 0.5 } else { -0.5 };
            let middle = *center + *half * Vec3::new(side(0), side(1), side(2));
            let mut next = cells[octant];
            if next == 0 {
                next = self.cells.len() as u32;
                let part = cell.part(charged, rest, middle, self.smallest);
                self.cells.push(part);
                if let Parts::Smaller { cells, .. } = &mut self.cells[at].parts {
                    cells[octant] = next;
                }
            }
            at = next as usize;
        }
    }
}

/// Around all elements, which are in a cube with edges of 1 about the origin; halved some times, its edges are those of the
/// smallest cubes.
fn root(elements: &Elements, smallest: f64) -> Cell {
    let rest = roots(elements).collect();
    let mut half = smallest;
    while half < 0.5 * ROOM {
        half *= 2.0;
    }
    Cell {
        center: Vec3::ZERO,
        half,
        values: vec![[0.0; SUMS]; polynomial::POINTS],
        parts: Parts::Smaller { rest, cells: [0; 8] },
    }
}

impl Cell {
    /// Potential and field at points in it, of which `sources` are not far.
    fn at(&self, charged: &Charged, sources: &Sources, points: &[Vec3]) -> Vec<Value> {
        let block = Block::about(self.center, radius(self.half), points);
        let mut values = sources.at(charged, &block);
        let mut sums = vec![[Octet::ZERO; SUMS]; block.groups.len()];
        polynomial::add(&self.values, self.half, &block, &mut sums);
        for (k, value) in values.iter_mut().enumerate() {
            let [potential, x, y, z] = sums[k / LANES].map(|sum| f64::from(sum.0[k % LANES]));
            value.0 += potential;
            value.1 += Vec3::new(x, y, z);
        }
        values
    }

    /// One of the eight cubes in it, of which `rest` is not far.
    fn part(&self, charged: &Charged, rest: &[u32], center: Vec3, smallest: f64) -> Cell {
        let half = 0.5 * self.half;
        let (far, rest) = split(charged, rest, center, radius(half));
        let lists = far.map(|some| some.into_iter().map(|c| (c, u32::MAX)).collect::<Vec<(u32, u32)>>());
        let mut values = Vec::with_capacity(polynomial::POINTS);
        for points in polynomial::points(center, half).chunks(BLOCK) {
            let block = Block::about(self.center, radius(self.half), points);
            let mut sums = vec![[Octet::ZERO; SUMS]; block.groups.len()];
            polynomial::add(&self.values, self.half, &block, &mut sums);
            for (order, list) in lists.iter().enumerate() {
                add_far(&block, list, &charged.clusters.centers, charged.of_clusters, order, &mut sums);
            }
            values.extend((0..points.len()).map(|k| sums[k / LANES].map(|sum| sum.0[k % LANES])));
        }
        let Charged { elements, clusters, opening, .. } = charged;
        let is_leaf = |c: &u32| matches!(child(elements, *c), Child::Leaf { .. });
        let parts = if half <= smallest || rest.len() <= FEW && rest.iter().all(is_leaf) {
            let radius = radius(half);
            let lists = Lists::of_ball(center, radius, elements, clusters, opening, rest.into_iter());
            Parts::Whole(Sources::new(charged, &lists, center, radius))
        } else {
            Parts::Smaller { rest, cells: [0; 8] }
        };
        Cell { center, half, values, parts }
    }
}

fn child(elements: &Elements, cluster: u32) -> Child {
    elements.bvh.nodes()[cluster as usize / WIDTH].children[cluster as usize % WIDTH]
}

fn radius(half: f64) -> f64 {
    3f64.sqrt() * half
}

/// Of some clusters and what is below them: those that are far from a ball, and those that hold the rest.
fn split(charged: &Charged, below: &[u32], middle: Vec3, radius: f64) -> ([Vec<u32>; 2], Vec<u32>) {
    let (mut far, mut rest) = ([Vec::new(), Vec::new()], Vec::new());
    let mut open = below.to_vec();
    while let Some(c) = open.pop() {
        let (own, center) = (charged.clusters.radii[c as usize], charged.clusters.centers[c as usize]);
        let reach = (radius + charged.opening.beta * own).max(FAR * radius + own);
        match child(charged.elements, c) {
            Child::Empty => {}
            _ if center.distance_squared(middle) > reach * reach => {
                let without = radius + WITHOUT_OCTUPOLE * charged.opening.beta * own;
                far[usize::from(center.distance_squared(middle) > without * without)].push(c);
            }
            Child::Inner(below) if own > LARGEST * radius => {
                open.extend((0..WIDTH as u32).map(|k| WIDTH as u32 * below + k));
            }
            _ => rest.push(c),
        }
    }
    (far, rest)
}
