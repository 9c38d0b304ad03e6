//! What acts on the points in a cube, eight sources to a register: hardly ever are there as many points at once as fill one.
use super::moments::{COEFFICIENTS, Series};
use super::multipole::{OF_QUADRUPOLE, SUMS, act};
use super::sum::{Charged, Value, is_wide};
use super::walk::{Block, LANES, Lists};
use crate::math::{Floats, Registers, Vec3, Work, in_widest_registers};
use crate::treecode::{Octet, parts};

/// Where there is no source: far from all points, in the elements' frame.
const NOWHERE: f32 = 16.0;

/// Series about centres, with their first `N` coefficients.
struct Eight<const N: usize> {
    centers: [Octet; 3],
    series: [Octet; N],
}

impl<const N: usize> Eight<N> {
    const EMPTY: Eight<N> = Eight { centers: [Octet([NOWHERE; LANES]); 3], series: [Octet::ZERO; N] };

    fn put(&mut self, lane: usize, center: Vec3, series: &Series) {
        (0..3).for_each(|axis| self.centers[axis].0[lane] = center[axis] as f32);
        self.series.iter_mut().zip(series).for_each(|(octet, coefficient)| octet.0[lane] = *coefficient);
    }

    #[inline(always)]
    fn offset<F: Floats<Number = f32>>(&self, part: usize, place: &[f32; 3]) -> [F; 3] {
        let [x, y, z] = &self.centers;
        [F::splat(place[0]) - x.get(part), F::splat(place[1]) - y.get(part), F::splat(place[2]) - z.get(part)]
    }

    #[inline(always)]
    fn act<F: Floats<Number = f32>, const ORDER: usize>(&self, part: usize, offset: [F; 3]) -> [F; SUMS] {
        act::<F, ORDER>(|k| self.series[k].get(part), offset)
    }
}

/// Elements that are next to some points in the cube.
struct NearEight {
    eight: Eight<COEFFICIENTS>,
    /// An element acts by its series where it is farther than this.
    reach_squared: Octet,
    numbers: [u32; LANES],
}

/// What a cube's lists say, ready for points in it.
pub struct Sources {
    octupoles: Vec<Eight<COEFFICIENTS>>,
    quadrupoles: Vec<Eight<OF_QUADRUPOLE>>,
    near: Vec<NearEight>,
}

impl Sources {
    /// Of a cube with its middle at `center` and all its points within `radius`.
    pub fn new(charged: &Charged, lists: &Lists, center: Vec3, radius: f64) -> Sources {
        let far = |order: usize| {
            let of = |list: &[(u32, u32)], centers: &[Vec3], series: &[Series]| {
                let source = |(k, _): &(u32, u32)| (centers[*k as usize] - center, series[*k as usize]);
                list.iter().map(source).collect::<Vec<(Vec3, Series)>>()
            };
            let mut all = of(&lists.clusters[order], &charged.clusters.centers, charged.of_clusters);
            all.extend(of(&lists.elements[order], &charged.elements.centers, charged.of_elements));
            all
        };
        let near = |list: &[(u32, u32)]| {
            let mut near = NearEight { eight: Eight::EMPTY, reach_squared: Octet::ZERO, numbers: [0; LANES] };
            for (lane, (source, _)) in list.iter().enumerate() {
                let i = *source as usize;
                near.eight.put(lane, charged.elements.centers[i] - center, &charged.of_elements[i]);
                let reach = (charged.opening.near * charged.elements.sizes[i]) as f32;
                let is_wide = is_wide(radius, charged.elements.sizes[i]);
                near.reach_squared.0[lane] = if is_wide { f32::INFINITY } else { reach * reach };
                near.numbers[lane] = *source;
            }
            near
        };
        Sources {
            octupoles: packed(&far(0)),
            quadrupoles: packed(&far(1)),
            near: lists.near.chunks(LANES).map(near).collect(),
        }
    }

    /// Potential and field at a block of points about the middle of the cube.
    pub fn at(&self, charged: &Charged, block: &Block) -> Vec<Value> {
        let mut sums = vec![[Octet::ZERO; SUMS]; block.points.len()];
        let mut touching = Vec::new();
        in_widest_registers(Sum { sources: self, block, sums: &mut sums, touching: &mut touching });
        let total = |octet: Octet| octet.0.iter().map(|x| f64::from(*x)).sum::<f64>();
        let value = |sums: [Octet; SUMS]| {
            let [potential, x, y, z] = sums.map(total);
            (potential, Vec3::new(x, y, z))
        };
        let mut values: Vec<Value> = sums.into_iter().map(value).collect();
        touching.iter().for_each(|(i, points)| charged.add_near(block, *i as usize, *points, &mut values));
        values
    }
}

fn packed<const N: usize>(sources: &[(Vec3, Series)]) -> Vec<Eight<N>> {
    let eight = |some: &[(Vec3, Series)]| {
        let mut eight = Eight::EMPTY;
        some.iter().enumerate().for_each(|(lane, (center, series))| eight.put(lane, *center, series));
        eight
    };
    sources.chunks(LANES).map(eight).collect()
}

struct Sum<'a> {
    sources: &'a Sources,
    block: &'a Block,
    /// Eight for each point, one for each lane of the sources.
    sums: &'a mut [[Octet; SUMS]],
    /// Elements too near for their series, with points as bits.
    touching: &'a mut Vec<(u32, u64)>,
}

impl Work for Sum<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        self.add::<R::Singles>();
    }
}

impl Sum<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f32>>(self) {
        let Sum { sources, block, sums, touching } = self;
        let places = (0..block.points.len())
            .map(|k| block.groups[k / LANES].places.map(|octet| octet.0[k % LANES]))
            .collect::<Vec<[f32; 3]>>();
        add_far::<F, COEFFICIENTS, 3>(&sources.octupoles, &places, sums);
        add_far::<F, OF_QUADRUPOLE, 2>(&sources.quadrupoles, &places, sums);
        let every = (1 << F::COUNT) - 1;
        for NearEight { eight, reach_squared, numbers } in &sources.near {
            let mut near = [0_u64; LANES];
            for (k, (place, sums)) in places.iter().zip(sums.iter_mut()).enumerate() {
                for part in parts::<F>() {
                    let offset = eight.offset::<F>(part, place);
                    let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
                    let far = square.greater(reach_squared.get::<F>(part));
                    let found =
                        if far == 0 { [F::splat(0.0); SUMS] } else { eight.act::<F, 3>(part, offset) };
                    if far == every {
                        sums.iter_mut().zip(found).for_each(|(sum, found)| sum.add(part, found));
                        continue;
                    }
                    let mut lanes = [Octet::ZERO; SUMS];
                    lanes.iter_mut().zip(found).for_each(|(octet, found)| octet.put(0, found));
                    for lane in 0..F::COUNT {
                        if far >> lane & 1 == 0 {
                            near[part + lane] |= 1 << k;
                            continue;
                        }
                        for (sum, octet) in sums.iter_mut().zip(&lanes) {
                            sum.0[part + lane] += octet.0[lane];
                        }
                    }
                }
            }
            let some = numbers.iter().zip(near).filter(|(_, points)| *points != 0);
            touching.extend(some.map(|(number, points)| (*number, points)));
        }
    }
}

#[inline(always)]
fn add_far<F: Floats<Number = f32>, const N: usize, const ORDER: usize>(
    sources: &[Eight<N>],
    places: &[[f32; 3]],
    sums: &mut [[Octet; SUMS]],
) {
    for eight in sources {
        for (place, sums) in places.iter().zip(sums.iter_mut()) {
            for part in parts::<F>() {
                let found = eight.act::<F, ORDER>(part, eight.offset(part, place));
                sums.iter_mut().zip(found).for_each(|(sum, found)| sum.add(part, found));
            }
        }
    }
}
