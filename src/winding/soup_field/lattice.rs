//! The field of a soup on a lattice: crossings slab by slab, the fraction where it matters.
use super::boxes::{Box3, cover};
use super::{FractionBy, SoupField, TIE};
use crate::data::{
    Cancelled, Lattice, Monitor, Parts, byte_of, for_each_lattice_block, map_items, map_tasks, set_bit,
    zeroed,
};
use crate::math::Vec3;
use crate::treecode::{DualAccuracy, LatticeTargets, Scratch};
use crate::winding::boundary::Need;
use crate::winding::config::FieldError;
use crate::winding::curtain::LANES;
use crate::winding::many::Many;
use crate::winding::scan::{SLAB_PLANES, Scan, Slab, for_each_slab};
use std::ops::Range;

/// Planes that are classified together are a whole number of slabs and of blocks; as many as this memory for them allows.
const GROUP_PLANES: usize = 32;
const BYTES_OF_GROUP: usize = 17_000_000;
/// Most samples along each axis of a block of fractions.
const TOP: usize = 32;
const BLOCKS_PER_REPORT: usize = 32;
/// How far fractions may be off where they are not needed exactly: at first, and in boxes of samples that this leaves open. What
/// is open still, or in no box, is summed.
const CLASSIFICATION_ERRORS: [f64; 2] = [1e-2, 1e-5];
/// So few samples of a block need no boxes.
const FEW_SUMS: usize = 64;
/// Crossings beyond this are not told apart.
const MOST_CROSSINGS: f64 = 32_000.0;

impl SoupField {
    /// Winding numbers at every sample, to a tolerance; with `loose_by` the fraction is left to that.
    pub fn lattice_values(
        &self,
        lattice: &Lattice,
        tolerance: f64,
        by: FractionBy,
        loose_by: Option<(&Many, DualAccuracy)>,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, FieldError> {
        let mut values = zeroed::<f64>(lattice.len())?;
        let (stage, monitor) = ("winding numbers", &Parts::new(monitor));
        monitor.begin(0.0, if self.is_closed() { 1.0 } else { 0.5 });
        let without_caps = by == FractionBy::Edges && !self.closure.loose.is_empty();
        let end = if without_caps { self.soup.len() } else { self.facets().len() };
        let scan = Scan::new(self.facets(), 0..end, lattice);
        let fill = |slab: usize, counted: &Slab, values: &mut [f64]| {
            values.iter_mut().zip(&counted.crossings).for_each(|(value, n)| *value = f64::from(*n));
            self.on_surface(lattice, slab, counted)
        };
        let planes = 0..lattice.counts[2];
        let on_surface =
            for_each_slab(&scan, planes.clone(), &mut values, SLAB_PLANES, fill, stage, monitor)?;
        monitor.begin(0.5, 1.0);
        if let Some((many, accuracy)) = loose_by {
            many.add(&LatticeTargets::new(lattice), &accuracy, &mut values, monitor)?;
        } else if !self.closure.loose.is_empty() {
            let fractions = |points: &[Vec3], results: &mut [f64], scratch: &mut Scratch| {
                self.fractions(points, by, results, scratch);
            };
            let store = |index: usize, fraction: f64| values[index] += fraction;
            for_each_lattice_block(lattice, fractions, store, stage, monitor)?;
        } else if !self.is_closed() {
            let add = |first: usize, row: &[f64]| {
                values[first..first + row.len()].iter_mut().zip(row).for_each(|(value, add)| *value += add);
            };
            let need = Need::Value { tolerance };
            let of_block = |ends| self.boundary.block(&self.closure.caps, lattice, ends, need);
            self.for_each_boundary_row(lattice, planes, of_block, add, (stage, monitor))?;
        }
        let principal =
            map_items(on_surface.len(), |k| self.principal_at(lattice.point(lattice.sample(on_surface[k]))));
        on_surface.iter().zip(principal).for_each(|(index, value)| values[*index] = value);
        Ok(values)
    }

    /// Samples of a slab that lie on the surface, by their place in the lattice.
    fn on_surface(&self, lattice: &Lattice, slab: usize, counted: &Slab) -> Vec<usize> {
        let first = slab * SLAB_PLANES * lattice.counts[0] * lattice.counts[1];
        counted.on_surface.iter().map(|place| first + *place as usize).collect()
    }

    /// Cuts some planes into blocks, from their first samples to before their last; hands what `of_block` gives for the
    /// samples of each, in parallel, row by row to `store(place of the row's first sample, values)`.
    fn for_each_boundary_row<T: Send>(
        &self,
        lattice: &Lattice,
        planes: Range<usize>,
        of_block: impl Fn([[usize; 3]; 2]) -> Vec<T> + Sync,
        mut store: impl FnMut(usize, &[T]),
        (stage, monitor): (&str, &dyn Monitor),
    ) -> Result<(), Cancelled> {
        let [nx, ny, _] = lattice.counts;
        let sizes = [nx, ny, planes.len()];
        let blocks = sizes.map(|size| size.div_ceil(TOP));
        let total: usize = blocks.iter().product();
        for first in (0..total).step_by(BLOCKS_PER_REPORT) {
            monitor.report(first as f64 / total as f64, stage)?;
            let results = map_tasks(BLOCKS_PER_REPORT.min(total - first), |task| {
                let block = first + task;
                let at = [block % blocks[0], block / blocks[0] % blocks[1], block / (blocks[0] * blocks[1])];
                let [low, high] = [0, 1].map(|end| {
                    let mut corner: [usize; 3] =
                        std::array::from_fn(|k| sizes[k] * (at[k] + end) / blocks[k]);
                    corner[2] += planes.start;
                    corner
                });
                ([low, high], of_block([low, high]))
            });
            for ([low, high], values) in results {
                let rows = (low[2]..high[2]).flat_map(|k| (low[1]..high[1]).map(move |j| [low[0], j, k]));
                rows.zip(values.chunks(high[0] - low[0])).for_each(|(at, row)| store(lattice.index(at), row));
            }
        }
        Ok(())
    }

    /// One bit for each sample, set where w ≥ `threshold`; proven, of a soup without loose components.
    pub fn lattice_bits(
        &self,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u8>, FieldError> {
        let mut bits = zeroed::<u8>(lattice.len().div_ceil(8))?;
        let plane = lattice.counts[0] * lattice.counts[1];
        let groups = BYTES_OF_GROUP / (size_of::<i16>() * GROUP_PLANES * plane.max(1));
        let group = GROUP_PLANES * groups.max(1);
        let scan = Scan::new(self.facets(), 0..self.facets().len(), lattice);
        for (planes, bits) in groups_of(lattice, group).zip(bits.chunks_mut((plane * group / 8).max(1))) {
            self.bits_of_planes(&scan, lattice, planes, threshold, bits, monitor)?;
        }
        Ok(bits)
    }

    /// [`SoupField::lattice_bits`], handed to `store` some planes at a time, with the first of them, which is a multiple of eight.
    pub fn for_each_group_of_planes(
        &self,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
        store: &mut dyn FnMut(usize, &[u8]),
    ) -> Result<(), FieldError> {
        let plane = lattice.counts[0] * lattice.counts[1];
        let scan = Scan::new(self.facets(), 0..self.facets().len(), lattice);
        let mut bits = zeroed::<u8>((plane * GROUP_PLANES.min(lattice.counts[2])).div_ceil(8))?;
        for planes in groups_of(lattice, GROUP_PLANES) {
            let bits = &mut bits[..(plane * planes.len()).div_ceil(8)];
            self.bits_of_planes(&scan, lattice, planes.clone(), threshold, bits, monitor)?;
            store(planes.start, bits);
        }
        Ok(())
    }

    /// The bits of some planes, a group of which the first is a multiple of [`SLAB_PLANES`].
    fn bits_of_planes(
        &self,
        scan: &Scan,
        lattice: &Lattice,
        planes: Range<usize>,
        threshold: f64,
        bits: &mut [u8],
        monitor: &dyn Monitor,
    ) -> Result<(), FieldError> {
        let plane = lattice.counts[0] * lattice.counts[1];
        let start = planes.start * plane;
        let monitor = &Parts::new(monitor);
        let of_all = |plane: usize| plane as f64 / lattice.counts[2] as f64;
        monitor.begin(of_all(planes.start), of_all(planes.end));
        let stage = "inside test";
        let least = self.least_crossings(lattice, planes.clone(), threshold, (stage, monitor))?;
        let fill = |slab: usize, counted: &Slab, bits: &mut [u8]| {
            let first = slab * SLAB_PLANES * plane;
            match &least {
                Least::Everywhere(least) => {
                    let least = i32::from(*least);
                    for (byte, crossings) in bits.iter_mut().zip(counted.crossings.chunks(8)) {
                        *byte = byte_of(crossings.iter().map(|n| *n >= least));
                    }
                }
                Least::Each(least) => {
                    let eights = counted.crossings.chunks(8).zip(least[first - start..].chunks(8));
                    for (byte, (crossings, least)) in bits.iter_mut().zip(eights) {
                        *byte =
                            byte_of(crossings.iter().zip(least).map(|(n, least)| *n >= i32::from(*least)));
                    }
                }
            }
            let decide = |index: usize| {
                let q = lattice.point(lattice.sample(index));
                let least = match &least {
                    Least::Everywhere(least) => *least,
                    Least::Each(least) => least[index - start],
                };
                (index, self.is_inside_on_surface(q, i32::from(least), threshold))
            };
            self.on_surface(lattice, slab, counted).into_iter().map(decide).collect()
        };
        let touching = for_each_slab(scan, planes, bits, 1, fill, stage, monitor)?;
        touching.into_iter().for_each(|(index, inside)| set_bit(bits, index - start, inside));
        monitor.report(1.0, stage)?;
        Ok(())
    }

    /// For the samples of some planes the least number of crossings, of surface and caps, that is inside: the fraction's
    /// bound decides, or an exact sum.
    fn least_crossings(
        &self,
        lattice: &Lattice,
        planes: Range<usize>,
        threshold: f64,
        report: (&str, &dyn Monitor),
    ) -> Result<Least, FieldError> {
        if self.is_closed() {
            return Ok(Least::Everywhere(least_integer(threshold, 0.0)));
        }
        let plane = lattice.counts[0] * lattice.counts[1];
        let mut result = zeroed::<i16>(plane * planes.len())?;
        let of_block = |ends| self.least_of_block(lattice, ends, threshold);
        let first = planes.start * plane;
        let store = |place: usize, row: &[i16]| result[place - first..][..row.len()].copy_from_slice(row);
        self.for_each_boundary_row(lattice, planes, of_block, store, report)?;
        Ok(Least::Each(result))
    }

    fn least_of_block(&self, lattice: &Lattice, [low, high]: [[usize; 3]; 2], threshold: f64) -> Vec<i16> {
        let mut result = Vec::new();
        let mut open = Vec::new();
        let looks = CLASSIFICATION_ERRORS.map(|error| Need::Side { threshold, error });
        let block = Box3 { low, high };
        let fractions = self.boundary.block(&self.closure.caps, lattice, [low, high], looks[0]);
        let (least, highest) = extremes(&fractions);
        let [error, finer] = CLASSIFICATION_ERRORS;
        let decided = least_integer(threshold, least - error);
        if decided == least_integer(threshold, highest + error) {
            return vec![decided; fractions.len()];
        }
        for (place, fraction) in fractions.iter().enumerate() {
            let least = least_integer(threshold, fraction - error);
            result.push(least);
            if least != least_integer(threshold, fraction + error) {
                open.push(block.sample(place));
            }
        }
        let (mut boxes, mut singly) = (Vec::new(), Vec::new());
        if open.len() > FEW_SUMS {
            cover(open, &mut boxes, &mut singly);
        } else {
            singly = open;
        }
        for (one, samples) in boxes {
            let fractions = self.boundary.block(&self.closure.caps, lattice, [one.low, one.high], looks[1]);
            for sample in samples {
                let fraction = fractions[one.place(sample)];
                let least = least_integer(threshold, fraction - finer);
                result[block.place(sample)] = least;
                if least != least_integer(threshold, fraction + finer) {
                    singly.push(sample);
                }
            }
        }
        for four in singly.chunks(LANES) {
            let queries: [Vec3; LANES] = std::array::from_fn(|k| lattice.point(four[k.min(four.len() - 1)]));
            for ((sample, q), fraction) in four.iter().zip(queries).zip(self.curtain.fractions(&queries)) {
                let fraction = fraction - f64::from(self.cap_crossings(q));
                result[block.place(*sample)] = least_integer(threshold, fraction + TIE);
            }
        }
        self.count_refined(singly.len());
        result
    }
}

/// The least numbers of crossings that are inside.
enum Least {
    Everywhere(i16),
    /// At each sample of some planes.
    Each(Vec<i16>),
}

/// The planes of a lattice, `size` of them at a time.
fn groups_of(lattice: &Lattice, size: usize) -> impl Iterator<Item = Range<usize>> + use<> {
    let count = lattice.counts[2];
    (0..count).step_by(size).map(move |start| start..count.min(start + size))
}

/// The least integer that reaches a threshold together with a fraction.
fn least_integer(threshold: f64, fraction: f64) -> i16 {
    // Rounded up; exact, and cheaper than a call where a processor has no instruction for it.
    let least = (threshold - fraction).clamp(-MOST_CROSSINGS, MOST_CROSSINGS);
    let towards_zero = least as i16;
    towards_zero + i16::from(f64::from(towards_zero) < least)
}

fn extremes(values: &[f64]) -> (f64, f64) {
    let both = |(least, most): (f64, f64), v: &f64| (least.min(*v), most.max(*v));
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), both)
}
