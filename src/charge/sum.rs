//! The sums over what acts on a block of points.
use super::clusters::Clusters;
use super::elements::Elements;
use super::moments::{Moments, Series};
use super::multipole::{SUMS, act};
use super::panel::potential_and_field;
use super::panel_lanes::Panel;
use super::walk::{Block, LANES, Lists, Opening, bits};
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};
use crate::treecode::{Octet, parts};
use wide::{f32x4, f32x8};

/// Where a block's radius is more than this times an element's longest edge, its 32-bit places are too coarse for that.
const WIDE: f64 = 64.0;

/// A potential and a field.
pub type Value = (f64, Vec3);

/// Charged elements, ready to be asked for their field: lengths are those of the elements' unit frame.
pub struct Charged<'a> {
    pub elements: &'a Elements,
    pub clusters: &'a Clusters,
    pub opening: Opening,
    pub charges: &'a [f64],
    pub of_clusters: &'a [Series],
    pub of_elements: &'a [Series],
}

/// The series of the elements themselves.
pub fn series_of_elements(own: &[Moments], charges: &[f64]) -> Vec<Series> {
    let charged = |(moments, charge): (&Moments, &f64)| {
        let mut sum = Moments::default();
        sum.add(moments, *charge, Vec3::ZERO);
        sum.series()
    };
    own.iter().zip(charges).map(charged).collect()
}

impl Charged<'_> {
    /// Potential and field at the points of a block.
    pub fn at(&self, block: &Block, lists: &mut Lists) -> Vec<Value> {
        lists.find(block, self.elements, self.clusters, &self.opening);
        let mut values = vec![(0.0, Vec3::ZERO); block.points.len()];
        let mut far = vec![[Octet::ZERO; SUMS]; block.groups.len()];
        for order in [0, 1] {
            let centers = &self.clusters.centers;
            add_far(block, &lists.clusters[order], centers, self.of_clusters, order, &mut far);
            add_far(block, &lists.elements[order], &self.elements.centers, self.of_elements, order, &mut far);
        }
        lists.near.iter().for_each(|(i, groups)| self.add_near(block, *i as usize, *groups, &mut values));
        for (k, value) in values.iter_mut().enumerate() {
            let [potential, x, y, z] = far[k / LANES].map(|sum| f64::from(sum.0[k % LANES]));
            value.0 += potential;
            value.1 += Vec3::new(x, y, z);
        }
        values
    }

    /// An element next to some points of groups, exactly.
    fn add_near(&self, block: &Block, i: usize, groups: u32, values: &mut [Value]) {
        let (corners, center) = (self.elements.corners[i], self.elements.centers[i]);
        let size = self.elements.sizes[i];
        let density = self.charges[i] / self.elements.areas[i];
        let panel = Panel::new(corners, center, size);
        let from = (center - block.center).to_array().map(|x| f32x8::splat(x as f32));
        for g in bits(groups) {
            let own = g * LANES..((g + 1) * LANES).min(block.points.len());
            let group = &block.groups[g];
            let is_wide = block.radius > WIDE * size;
            if is_wide {
                own.for_each(|k| self.add_alone(block.points[k], i, density, &mut values[k]));
                continue;
            }
            let points = [0, 1, 2].map(|axis| f32x8::from(group.places[axis].0) - from[axis]);
            let (potential, field, low) = panel.at(&points);
            let (potential, field) = (potential.to_array(), field.map(|f| f.to_array()));
            for (lane, k) in own.enumerate() {
                let value = &mut values[k];
                if low >> lane & 1 == 0 {
                    value.0 += density * f64::from(potential[lane]);
                    value.1 += density * Vec3::from_array(field.map(|f| f64::from(f[lane])));
                } else {
                    let (potential, field) = potential_and_field(block.points[k], corners);
                    value.0 += density * potential;
                    value.1 += density * field;
                }
            }
        }
    }

    /// An element at one point: exactly if it is near, by its series if not.
    fn add_alone(&self, q: Vec3, i: usize, density: f64, value: &mut Value) {
        let offset = q - self.elements.centers[i];
        let reach = self.opening.near * self.elements.sizes[i];
        if offset.length_squared() > reach * reach {
            let [potential, x, y, z] = act_alone(&self.of_elements[i], offset);
            value.0 += potential;
            value.1 += Vec3::new(x, y, z);
        } else {
            let (potential, field) = potential_and_field(q, self.elements.corners[i]);
            value.0 += density * potential;
            value.1 += density * field;
        }
    }
}

fn act_alone(series: &Series, offset: Vec3) -> [f64; SUMS] {
    let offset = offset.to_array().map(|x| f32x4::splat(x as f32));
    act::<f32x4, 3>(series, offset).map(|lanes| f64::from(lanes.to_array()[0]))
}

/// Adds what listed sources give at the groups by their series.
pub fn add_far(
    block: &Block,
    list: &[(u32, u32)],
    centers: &[Vec3],
    series: &[Series],
    order: usize,
    sums: &mut [[Octet; SUMS]],
) {
    in_widest_registers(Far { block, list, centers, series, order, sums });
}

struct Far<'a> {
    block: &'a Block,
    list: &'a [(u32, u32)],
    centers: &'a [Vec3],
    series: &'a [Series],
    order: usize,
    sums: &'a mut [[Octet; SUMS]],
}

impl Work for Far<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        match self.order {
            0 => self.add::<R::Singles, 3>(),
            _ => self.add::<R::Singles, 2>(),
        }
    }
}

impl Far<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f32>, const ORDER: usize>(self) {
        for (source, groups) in self.list {
            let series = &self.series[*source as usize];
            let center = (self.centers[*source as usize] - self.block.center).to_array();
            let center = center.map(|x| F::splat(x as f32));
            let mut rest = *groups;
            while rest != 0 {
                let g = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let (places, sums) = (&self.block.groups[g].places, &mut self.sums[g]);
                for part in parts::<F>() {
                    let x = places[0].get::<F>(part) - center[0];
                    let y = places[1].get::<F>(part) - center[1];
                    let z = places[2].get::<F>(part) - center[2];
                    let [potential, along_x, along_y, along_z] = act::<F, ORDER>(series, [x, y, z]);
                    sums[0].add(part, potential);
                    sums[1].add(part, along_x);
                    sums[2].add(part, along_y);
                    sums[3].add(part, along_z);
                }
            }
        }
    }
}
