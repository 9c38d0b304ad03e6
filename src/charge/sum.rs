//! The sums over what acts on a block of points.
use super::clusters::Clusters;
use super::elements::Elements;
use super::moments::{Moments, Series};
use super::multipole::{SUMS, act};
use super::panel::potential_and_field;
use super::panel_lanes::Panel;
use super::walk::{Block, LANES, Lists, Opening, roots};
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
    pub panels: &'a [Panel],
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
    /// Potential and field at the points of a block of all elements.
    pub fn at(&self, block: &Block, lists: &mut Lists) -> Vec<Value> {
        lists.find(block, self.elements, self.clusters, &self.opening, roots(self.elements));
        self.listed(block, lists)
    }

    /// The same of what is listed for its groups.
    fn listed(&self, block: &Block, lists: &Lists) -> Vec<Value> {
        let mut values = vec![(0.0, Vec3::ZERO); block.points.len()];
        let mut far = vec![[Octet::ZERO; SUMS]; block.groups.len()];
        for order in [0, 1] {
            let centers = &self.clusters.centers;
            add_far(block, &lists.clusters[order], centers, self.of_clusters, order, &mut far);
            add_far(block, &lists.elements[order], &self.elements.centers, self.of_elements, order, &mut far);
        }
        let mut touching = Vec::new();
        let near = Near { charged: self, block, list: &lists.near, sums: &mut far, touching: &mut touching };
        in_widest_registers(near);
        touching.iter().for_each(|(i, points)| self.add_near(block, *i as usize, *points, &mut values));
        for (k, value) in values.iter_mut().enumerate() {
            let [potential, x, y, z] = far[k / LANES].map(|sum| f64::from(sum.0[k % LANES]));
            value.0 += potential;
            value.1 += Vec3::new(x, y, z);
        }
        values
    }

    /// An element at the points next to it, exactly: eight at once, of whichever groups.
    pub fn add_near(&self, block: &Block, i: usize, points: u64, values: &mut [Value]) {
        let (corners, center) = (self.elements.corners[i], self.elements.centers[i]);
        let density = self.charges[i] / self.elements.areas[i];
        let is_wide = is_wide(block.radius, self.elements.sizes[i]);
        let mut rest = points;
        while rest != 0 {
            let mut numbers = [0; LANES];
            let mut count = 0;
            while rest != 0 && count < LANES {
                numbers[count] = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                count += 1;
            }
            let numbers = &numbers[..count];
            if is_wide {
                numbers.iter().for_each(|k| self.add_alone(block.points[*k], i, density, &mut values[*k]));
                continue;
            }
            let offset = |lane: usize| block.points[numbers[lane.min(count - 1)]] - center;
            let offsets: [Vec3; LANES] = std::array::from_fn(offset);
            let lanes = [0, 1, 2].map(|axis| f32x8::from(offsets.map(|offset| offset[axis] as f32)));
            let (potential, field, low) = self.panels[i].at(&lanes);
            let (potential, field) = (potential.to_array(), field.map(|f| f.to_array()));
            for (lane, k) in numbers.iter().enumerate() {
                let value = &mut values[*k];
                let (potential, field) = if low >> lane & 1 == 0 {
                    let field = field.map(|f| f64::from(f[lane]));
                    (f64::from(potential[lane]), Vec3::from_array(field))
                } else {
                    potential_and_field(block.points[*k], corners)
                };
                value.0 += density * potential;
                value.1 += density * field;
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

/// Whether the points within `radius` are too coarse for an element's size.
pub fn is_wide(radius: f64, size: f64) -> bool {
    radius > WIDE * size
}

/// Elements next to some points of groups, each point for itself: by their series where it is not so near, and the others told.
struct Near<'a> {
    charged: &'a Charged<'a>,
    block: &'a Block,
    list: &'a [(u32, u32)],
    sums: &'a mut [[Octet; SUMS]],
    touching: &'a mut Vec<(u32, u64)>,
}

impl Work for Near<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.add::<R::Singles>();
    }
}

impl Near<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f32>>(self) {
        let Near { charged: Charged { elements, opening, of_elements, .. }, block, list, sums, touching } =
            self;
        let real = u64::MAX >> (u64::BITS as usize - block.points.len());
        let every = (1 << F::COUNT) - 1;
        for (source, groups) in list {
            let i = *source as usize;
            let center = (elements.centers[i] - block.center).to_array().map(|x| F::splat(x as f32));
            let reach = (opening.near * elements.sizes[i]) as f32;
            let reach_squared = F::splat(reach * reach);
            let is_wide = is_wide(block.radius, elements.sizes[i]);
            let (mut near, mut rest) = (0, *groups & block.all());
            while rest != 0 {
                let g = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                for part in parts::<F>() {
                    let [x, y, z] = &block.groups[g].places;
                    let offset: [F; 3] = [
                        x.get::<F>(part) - center[0],
                        y.get::<F>(part) - center[1],
                        z.get::<F>(part) - center[2],
                    ];
                    let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
                    let far = if is_wide { 0 } else { square.greater(reach_squared) };
                    near |= u64::from(every & !far) << (g * LANES + part);
                    if far == 0 {
                        continue;
                    }
                    let found = act::<F, 3>(|k| F::splat(of_elements[i][k]), offset);
                    for (sum, found) in sums[g].iter_mut().zip(found) {
                        if far == every {
                            sum.add(part, found);
                            continue;
                        }
                        let mut lanes = Octet::ZERO;
                        lanes.put(0, found);
                        for lane in (0..F::COUNT).filter(|lane| far >> lane & 1 == 1) {
                            sum.0[part + lane] += lanes.0[lane];
                        }
                    }
                }
            }
            if near & real != 0 {
                touching.push((*source, near & real));
            }
        }
    }
}

fn act_alone(series: &Series, offset: Vec3) -> [f64; SUMS] {
    let offset = offset.to_array().map(|x| f32x4::splat(x as f32));
    act::<f32x4, 3>(|k| f32x4::splat(series[k]), offset).map(|lanes| f64::from(lanes.to_array()[0]))
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
        for (g, (group, sums)) in self.block.groups.iter().zip(self.sums).enumerate() {
            for part in parts::<F>() {
                let [x, y, z] = &group.places;
                let place: [F; 3] = [x.get(part), y.get(part), z.get(part)];
                let mut total = [F::splat(0.0); SUMS];
                for (source, _) in self.list.iter().filter(|(_, groups)| groups >> g & 1 == 1) {
                    let center = self.centers[*source as usize] - self.block.center;
                    let axis = |x: f64| F::splat(x as f32);
                    let offset =
                        [place[0] - axis(center.x), place[1] - axis(center.y), place[2] - axis(center.z)];
                    let series = &self.series[*source as usize];
                    let found = act::<F, ORDER>(|k| F::splat(series[k]), offset);
                    total.iter_mut().zip(found).for_each(|(total, found)| *total = *total + found);
                }
                sums.iter_mut().zip(total).for_each(|(sum, total)| sum.add(part, total));
            }
        }
    }
}
