//! What acts on points that move a little from one question to the next, such as the ends of lines step by step: of all that is
//! far from a box around them the field is interpolated in it, by the polynomial through its values at Chebyshev's points.
use super::elements::Elements;
use super::multipole::SUMS;
use super::sum::{Charged, Value, add_far};
use super::walk::{Block, LANES, Lists, roots};
use crate::bvh::{Child, WIDTH};
use crate::data::BLOCK;
use crate::math::{Aabb, Floats, Registers, Vec3, Work, in_widest_registers};
use crate::treecode::{Octet, parts};

/// Points of the polynomial along each axis.
const ORDER: usize = 5;
/// Clusters are far from a box when they are farther than this times its radius from its middle.
const FAR: f64 = 2.0;
/// What is not far is left to single questions in clusters of at most this share of the box's radius.
const LARGEST: f64 = 0.3;
/// How far a box reaches beyond the points, in radii of these.
const MARGIN: f64 = 0.5;
/// A box is worth its making if it is asked so often.
const LEAST_USES: usize = 4;
/// And if there are so many points.
const LEAST_POINTS: usize = BLOCK / 2;

/// A box, and what is known of the field in it.
struct Region {
    bounds: Aabb,
    /// By x, then y, then z.
    values: Vec<[f32; SUMS]>,
    /// Clusters that are not far, none of them in another.
    rest: Vec<u32>,
}

/// What is kept for a block of points from one question to the next.
#[derive(Default)]
pub struct Held {
    lists: Lists,
    region: Option<Region>,
    uses: usize,
    /// Points move too far for boxes.
    is_in_vain: bool,
}

impl Held {
    /// Potential and field at the points of a block.
    pub fn at(&mut self, charged: &Charged, block: &Block) -> Vec<Value> {
        let is_inside = |region: &Region| block.points.iter().all(|p| region.bounds.contains(*p));
        if !self.region.as_ref().is_some_and(is_inside) {
            self.is_in_vain |= self.region.is_some() && self.uses < LEAST_USES;
            let is_worth = !self.is_in_vain && block.points.len() >= LEAST_POINTS && block.radius > 0.0;
            self.region = is_worth.then(|| Region::around(charged, block));
            self.uses = 0;
        }
        self.uses += 1;
        let Some(region) = &self.region else {
            return charged.at(block, &mut self.lists);
        };
        let mut values = charged.below(block, region.rest.iter().copied(), &mut self.lists);
        let mut sums = vec![[Octet::ZERO; SUMS]; block.groups.len()];
        in_widest_registers(Interpolation { region, block, sums: &mut sums });
        for (k, value) in values.iter_mut().enumerate() {
            let [potential, x, y, z] = sums[k / LANES].map(|sum| f64::from(sum.0[k % LANES]));
            value.0 += potential;
            value.1 += Vec3::new(x, y, z);
        }
        values
    }
}

impl Region {
    fn around(charged: &Charged, block: &Block) -> Region {
        let margin = Vec3::splat(MARGIN * block.radius);
        let around = Aabb::around(block.points.iter().copied());
        let bounds = Aabb { min: around.min - margin, max: around.max + margin };
        let (middle, half) = (bounds.center(), 0.5 * (bounds.max - bounds.min));
        let (far, rest) = split(charged, middle, half.length());
        let nodes: Vec<Vec3> = (0..ORDER * ORDER * ORDER)
            .map(|n| {
                let at = [n % ORDER, n / ORDER % ORDER, n / ORDER / ORDER].map(|k| f64::from(NODES[k]));
                middle + half * Vec3::from_array(at)
            })
            .collect();
        let mut values = Vec::with_capacity(nodes.len());
        for points in nodes.chunks(BLOCK) {
            let block = Block::new(points);
            let mut sums = vec![[Octet::ZERO; SUMS]; block.groups.len()];
            let list: Vec<(u32, u32)> = far.iter().map(|c| (*c, block.all())).collect();
            add_far(&block, &list, &charged.clusters.centers, charged.of_clusters, 0, &mut sums);
            values.extend((0..points.len()).map(|k| sums[k / LANES].map(|sum| sum.0[k % LANES])));
        }
        Region { bounds, values, rest }
    }
}

/// Clusters that are far from a ball, and those that hold the rest.
fn split(charged: &Charged, middle: Vec3, radius: f64) -> (Vec<u32>, Vec<u32>) {
    let Elements { bvh, .. } = charged.elements;
    let (mut far, mut rest) = (Vec::new(), Vec::new());
    let mut open: Vec<u32> = roots(charged.elements).collect();
    while let Some(c) = open.pop() {
        let (own, center) = (charged.clusters.radii[c as usize], charged.clusters.centers[c as usize]);
        let reach = (radius + charged.opening.beta * own).max(FAR * radius + own);
        match bvh.nodes()[c as usize / WIDTH].children[c as usize % WIDTH] {
            Child::Empty => {}
            _ if center.distance_squared(middle) > reach * reach => far.push(c),
            Child::Inner(below) if own > LARGEST * radius => {
                open.extend((0..WIDTH as u32).map(|k| WIDTH as u32 * below + k));
            }
            _ => rest.push(c),
        }
    }
    (far, rest)
}

/// Chebyshev's points: cos((2k + 1)π/10).
const NODES: [f32; ORDER] = [0.951_056_5, 0.587_785_25, 0.0, -0.587_785_25, -0.951_056_5];
/// 1/Π (tₖ − tₘ) over all others m.
const SCALES: [f32; ORDER] = scales();

const fn scales() -> [f32; ORDER] {
    let mut scales = [1.0; ORDER];
    let mut n = 0;
    while n < ORDER * ORDER {
        let (k, m) = (n / ORDER, n % ORDER);
        if k != m {
            scales[k] /= NODES[k] - NODES[m];
        }
        n += 1;
    }
    scales
}

struct Interpolation<'a> {
    region: &'a Region,
    block: &'a Block,
    sums: &'a mut [[Octet; SUMS]],
}

impl Work for Interpolation<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.add::<R::Singles>();
    }
}

impl Interpolation<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f32>>(self) {
        let Aabb { min, max } = self.region.bounds;
        let shift = (self.block.center - 0.5 * (min + max)).to_array().map(|x| F::splat(x as f32));
        let scale = (2.0 / (max - min)).to_array().map(|x| F::splat(x as f32));
        for (group, sums) in self.block.groups.iter().zip(self.sums) {
            for part in parts::<F>() {
                let place = |axis: usize| (group.places[axis].get::<F>(part) + shift[axis]) * scale[axis];
                let [x, y, z] = [weights(place(0)), weights(place(1)), weights(place(2))];
                let mut total = [F::splat(0.0); SUMS];
                for (n, row) in self.region.values.chunks_exact(ORDER).enumerate() {
                    let across = y[n % ORDER] * z[n / ORDER];
                    for (value, along) in row.iter().zip(x) {
                        let weight = along * across;
                        for (total, value) in total.iter_mut().zip(value) {
                            *total = *total + weight * F::splat(*value);
                        }
                    }
                }
                sums.iter_mut().zip(total).for_each(|(sum, total)| sum.add(part, total));
            }
        }
    }
}

/// The polynomials that are 1 at one of the points and 0 at the others.
#[inline(always)]
fn weights<F: Floats<Number = f32>>(t: F) -> [F; ORDER] {
    let mut weights = SCALES.map(F::splat);
    for (k, weight) in weights.iter_mut().enumerate() {
        for (m, node) in NODES.into_iter().enumerate() {
            if m != k {
                *weight = *weight * (t - F::splat(node));
            }
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x4;

    #[test]
    fn polynomials_of_degree_4_are_met() {
        for (degree, k) in (0..5).flat_map(|degree| (0..9).map(move |k| (degree, k))) {
            let t = -1.0 + 0.25 * k as f32;
            let weights = weights(f32x4::splat(t)).map(|w| w.to_array()[0]);
            let found: f32 = weights.iter().zip(NODES).map(|(w, node)| w * node.powi(degree)).sum();
            assert!((found - t.powi(degree)).abs() < 2e-6, "{degree} at {t}: {found}");
        }
    }
}
