//! The field of a soup on a lattice: crossings slab by slab, the fraction where it matters.
use super::curtain::LANES;
use super::field::FieldError;
use super::many::Many;
use super::scan::{SLAB_PLANES, Scan, Slab};
use super::soup_field::{FractionBy, SoupField, TIE};
use crate::data::{Cancelled, Lattice, Monitor, for_each_lattice_block, map_items, map_parts, zeroed};
use crate::math::Vec3;
use crate::treecode::{DualAccuracy, LatticeTargets, Scratch};

/// Slabs between two reports to the monitor.
const SLABS_PER_REPORT: usize = 8;
/// Samples along x and y of the blocks with which subdivision begins.
const TOP: usize = 32;
/// Blocks of up to this many samples are not divided further, but summed.
const FEW_SAMPLES: usize = 8;

impl SoupField {
    /// Winding numbers at every sample; with `loose_by` the fraction is left to that.
    pub(super) fn lattice_values(
        &self,
        lattice: &Lattice,
        by: FractionBy,
        loose_by: Option<(&Many, DualAccuracy)>,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, FieldError> {
        let mut values = zeroed::<f64>(lattice.len())?;
        let stage = "winding numbers";
        let end = if by == FractionBy::Edges { self.soup.len() } else { self.facets().len() };
        let scan = Scan::new(self.facets(), 0..end, lattice);
        let fill = |slab: usize, counted: &Slab, values: &mut [f64]| {
            values.iter_mut().zip(&counted.crossings).for_each(|(value, n)| *value = f64::from(*n));
            self.on_surface(lattice, slab, counted)
        };
        let on_surface = for_each_slab(&scan, lattice, &mut values, SLAB_PLANES, fill, stage, monitor)?;
        if let Some((many, accuracy)) = loose_by {
            many.add(&LatticeTargets::new(lattice), &accuracy, &mut values, monitor)?;
        } else if !self.is_closed() {
            let fractions = |points: &[Vec3], results: &mut [f64], scratch: &mut Scratch| {
                self.fractions(points, by, results, scratch);
            };
            let store = |index: usize, fraction: f64| values[index] += fraction;
            for_each_lattice_block(lattice, fractions, store, stage, monitor)?;
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

    /// One bit for each sample, set where w ≥ `threshold`; proven, of a soup without loose components.
    pub(super) fn lattice_bits(
        &self,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u8>, FieldError> {
        let mut bits = zeroed::<u8>(lattice.len().div_ceil(8))?;
        let facets = self.facets();
        let surface = Scan::new(facets, 0..facets.soup.len(), lattice);
        let caps = Scan::new(facets, facets.soup.len()..facets.len(), lattice);
        let fill = |slab: usize, counted: &Slab, bits: &mut [u8]| {
            let inside = self.slab_inside(lattice, &caps, slab, counted, threshold);
            for (byte, eight) in bits.iter_mut().zip(inside.chunks(8)) {
                *byte = eight.iter().rev().fold(0, |byte, inside| byte << 1 | u8::from(*inside));
            }
            let touching = self.on_surface(lattice, slab, counted);
            touching
                .into_iter()
                .map(|index| {
                    let q = lattice.point(lattice.sample(index));
                    (index, self.is_inside_on_surface(q, threshold))
                })
                .collect()
        };
        let touching = for_each_slab(&surface, lattice, &mut bits, 1, fill, "inside test", monitor)?;
        for (index, inside) in touching {
            let bit = 1 << (index % 8);
            bits[index / 8] = if inside { bits[index / 8] | bit } else { bits[index / 8] & !bit };
        }
        Ok(bits)
    }

    fn slab_inside(
        &self,
        lattice: &Lattice,
        caps: &Scan,
        slab: usize,
        counted: &Slab,
        threshold: f64,
    ) -> Vec<bool> {
        if self.is_closed() {
            let least = threshold.ceil().clamp(-1e9, 1e9) as i32;
            return counted.crossings.iter().map(|n| *n >= least).collect();
        }
        let mut of_caps = Slab::default();
        caps.count(slab, &mut of_caps);
        let planes = caps.planes(slab);
        let mut settling = Settling {
            field: self,
            lattice,
            first_plane: planes.start,
            crossings: &counted.crossings,
            of_caps: &of_caps.crossings,
            threshold,
            inside: vec![false; counted.crossings.len()],
            refined: 0,
        };
        let [nx, ny, _] = lattice.counts;
        for y in (0..ny).step_by(TOP) {
            for x in (0..nx).step_by(TOP) {
                let high = [nx.min(x + TOP), ny.min(y + TOP), planes.end];
                settling.settle([x, y, planes.start], high);
            }
        }
        self.count_refined(settling.refined);
        settling.inside
    }
}

/// Counts the crossings of every slab, in parallel, and hands them with the slab's part of `output`, `per_plane` items for
/// each sample of a plane, to `fill`; gives what `fill` has found, in order.
fn for_each_slab<T: Send, R: Send>(
    scan: &Scan,
    lattice: &Lattice,
    output: &mut [T],
    per_plane: usize,
    fill: impl Fn(usize, &Slab, &mut [T]) -> Vec<R> + Sync,
    stage: &str,
    monitor: &dyn Monitor,
) -> Result<Vec<R>, Cancelled> {
    let part = (lattice.counts[0] * lattice.counts[1] * per_plane).max(1);
    let mut found = Vec::new();
    for (run, parts) in output.chunks_mut(SLABS_PER_REPORT * part).enumerate() {
        let first = run * SLABS_PER_REPORT;
        monitor.report(first as f64 / scan.slabs() as f64, stage)?;
        let of_run = map_parts(parts, part, |slab, part| {
            let mut counted = Slab::default();
            scan.count(first + slab, &mut counted);
            fill(first + slab, &counted, part)
        });
        found.extend(of_run.into_iter().flatten());
    }
    monitor.report(1.0, stage)?;
    Ok(found)
}

/// Subdivision of a slab until the fraction no longer matters.
struct Settling<'a> {
    field: &'a SoupField,
    lattice: &'a Lattice,
    first_plane: usize,
    /// Of the surface and of the caps.
    crossings: &'a [i32],
    of_caps: &'a [i32],
    threshold: f64,
    inside: Vec<bool>,
    refined: usize,
}

impl Settling<'_> {
    fn place(&self, [x, y, z]: [usize; 3]) -> usize {
        self.lattice.index([x, y, z - self.first_plane])
    }

    fn settle(&mut self, low: [usize; 3], high: [usize; 3]) {
        let counts: [usize; 3] = std::array::from_fn(|k| high[k] - low[k]);
        if let Some(least) = self.least_crossings(low, counts) {
            for z in low[2]..high[2] {
                for y in low[1]..high[1] {
                    let row = self.place([low[0], y, z])..self.place([high[0], y, z]);
                    for place in row {
                        self.inside[place] = self.crossings[place] + self.of_caps[place] >= least;
                    }
                }
            }
        } else if counts.iter().product::<usize>() <= FEW_SAMPLES {
            self.sum_singly(low, high);
        } else {
            let longest = |k: &usize| self.lattice.spacing[*k] * counts[*k] as f64;
            let axis = (0..3).filter(|k| counts[*k] > 1).max_by(|a, b| longest(a).total_cmp(&longest(b)));
            let axis = axis.expect("more than one sample is left");
            let middle = low[axis] + counts[axis] / 2;
            let (mut end, mut start) = (high, low);
            (end[axis], start[axis]) = (middle, middle);
            self.settle(low, end);
            self.settle(start, high);
        }
    }

    /// The integer part from which on all samples of a block are inside, if there is one.
    fn least_crossings(&self, low: [usize; 3], counts: [usize; 3]) -> Option<i32> {
        let middle: [usize; 3] = std::array::from_fn(|k| low[k] + counts[k] / 2);
        let center = self.lattice.point(middle);
        let reach = Vec3::from_array(std::array::from_fn(|k| (counts[k] / 2) as f64)) * self.lattice.spacing;
        // Samples are rounded by far less than that.
        let radius = reach.length() * (1.0 + 1e-6) + 1e-9 * self.lattice.spacing.max_element();
        if self.field.balls.variation(center, radius).is_infinite() {
            return None;
        }
        let fraction = self.field.curtain.fraction(center) - f64::from(self.of_caps[self.place(middle)]);
        self.field.balls.least_crossings(center, radius, fraction, self.threshold)
    }

    fn sum_singly(&mut self, low: [usize; 3], high: [usize; 3]) {
        let samples: Vec<[usize; 3]> = (low[2]..high[2])
            .flat_map(|z| (low[1]..high[1]).flat_map(move |y| (low[0]..high[0]).map(move |x| [x, y, z])))
            .collect();
        for four in samples.chunks(LANES) {
            let queries = std::array::from_fn(|k| self.lattice.point(four[k.min(four.len() - 1)]));
            let fractions = self.field.curtain.fractions(&queries);
            for (sample, fraction) in four.iter().zip(fractions) {
                let place = self.place(*sample);
                self.inside[place] = f64::from(self.crossings[place]) + fraction >= self.threshold - TIE;
            }
        }
        self.refined += samples.len();
    }
}
