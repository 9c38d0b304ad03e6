//! Signed distances at all samples of a lattice.
use super::{DistanceConfig, DistanceError, DistanceSign, SignedDistance, hard, smooth};
use crate::data::{Grid, Lattice, Monitor, Parts, bit, map_tasks, zeroed};
use crate::distance::Search;
use crate::winding::{Accuracy, THRESHOLD};
use std::ops::Range;

/// Samples across a strip, and layers of a slab.
const WIDTH: usize = 4;
/// Strips between two reports.
const STRIPS_PER_REPORT: usize = 64;
/// The part of the progress that signing tells, which comes first.
const SIGNED: f64 = 0.4;

/// Layers of a lattice, and their values, x fastest.
pub type Slab<'a> = dyn FnMut(Range<usize>, &[f32]) + 'a;

impl SignedDistance<'_> {
    /// Signed distances at every sample of a lattice, as 32-bit floats; four bytes a sample.
    ///
    /// # Errors
    /// As [`SignedDistance::distances`].
    pub fn lattice(
        &self,
        lattice: &Lattice,
        config: &DistanceConfig,
        monitor: &dyn Monitor,
    ) -> Result<Grid<f32>, DistanceError> {
        let layer = lattice.counts[0] * lattice.counts[1];
        let mut values = zeroed(lattice.len())?;
        let mut store = |layers: Range<usize>, slab: &[f32]| {
            values[layer * layers.start..layer * layers.end].copy_from_slice(slab);
        };
        self.for_each_slab(lattice, config, monitor, &mut store)?;
        Ok(Grid { lattice: *lattice, values })
    }

    /// The same, four layers at a time from the lowest up: memory is that of a slab, and a bit for each sample. With a smooth sign it
    /// is eight bytes for each sample.
    ///
    /// # Errors
    /// As [`SignedDistance::distances`].
    pub fn for_each_slab(
        &self,
        lattice: &Lattice,
        config: &DistanceConfig,
        monitor: &dyn Monitor,
        slab: &mut Slab,
    ) -> Result<(), DistanceError> {
        let band = self.check(config)?;
        if lattice.is_empty() {
            return Ok(());
        }
        let monitor = &Parts::new(monitor);
        let signed_at = if config.sign == DistanceSign::None { 0.0 } else { SIGNED };
        monitor.begin(0.0, signed_at);
        let (mut bits, mut winding) = (Vec::new(), Vec::new());
        match config.sign {
            DistanceSign::None => {}
            DistanceSign::Hard => bits = self.field.classify_lattice(lattice, THRESHOLD, monitor)?,
            DistanceSign::Smooth => {
                winding = self.field.evaluate_lattice(lattice, Accuracy::default(), monitor)?.values;
            }
        }
        monitor.begin(signed_at, 1.0);
        let signed = |index: usize, distance: f64| match config.sign {
            DistanceSign::None => distance,
            DistanceSign::Hard => hard(distance, bit(&bits, index)),
            DistanceSign::Smooth => smooth(distance, winding[index]),
        };
        let [nx, ny, nz] = lattice.counts;
        let strips = ny.div_ceil(WIDTH);
        let total = (strips * nz.div_ceil(WIDTH)) as f64;
        let mut values = zeroed(nx * ny * nz.min(WIDTH))?;
        for first in (0..nz).step_by(WIDTH) {
            let layers = first..nz.min(first + WIDTH);
            for some in (0..strips).step_by(STRIPS_PER_REPORT) {
                let done = strips * (first / WIDTH) + some;
                monitor.report(done as f64 / total, "distances")?;
                let found = map_tasks(STRIPS_PER_REPORT.min(strips - some), |task| {
                    let row = (some + task) * WIDTH;
                    self.strip(lattice, row..ny.min(row + WIDTH), layers.clone(), band)
                });
                for (task, strip) in found.into_iter().enumerate() {
                    let row = (some + task) * WIDTH;
                    for (number, run) in strip.chunks(nx).enumerate() {
                        let width = WIDTH.min(ny - row);
                        let (j, k) = (row + number % width, number / width);
                        let start = nx * (ny * k + j);
                        let place = nx * (ny * (first + k) + j);
                        for (i, distance) in run.iter().enumerate() {
                            values[start + i] = signed(place + i, f64::from(*distance)) as f32;
                        }
                    }
                }
            }
            slab(layers.clone(), &values[..nx * ny * layers.len()]);
        }
        monitor.report(1.0, "distances")?;
        Ok(())
    }

    /// Distances at the samples of some rows of some layers, row by row: no longer than `band`.
    fn strip(&self, lattice: &Lattice, rows: Range<usize>, layers: Range<usize>, band: f64) -> Vec<f32> {
        let nx = lattice.counts[0];
        let mut values = vec![0.0; nx * rows.len() * layers.len()];
        let mut search = Search::default();
        let across: Vec<[usize; 2]> = snake(rows.len(), layers.len());
        for i in 0..nx {
            // Forth and back: each sample is next to the last one.
            let turn = |n: usize| if i.is_multiple_of(2) { n } else { across.len() - 1 - n };
            for n in 0..across.len() {
                let [j, k] = across[turn(n)];
                let place = lattice.point([i, rows.start + j, layers.start + k]);
                let found = self.tree.distance_within(place, band, &mut search);
                values[nx * (rows.len() * k + j) + i] = found.unwrap_or(band) as f32;
            }
        }
        values
    }
}

/// All of `rows` × `layers`, each next to the last.
fn snake(rows: usize, layers: usize) -> Vec<[usize; 2]> {
    let row = |k: usize, n: usize| if k.is_multiple_of(2) { n } else { rows - 1 - n };
    (0..layers).flat_map(|k| (0..rows).map(move |n| [row(k, n), k])).collect()
}
