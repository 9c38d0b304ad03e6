use super::{Cancelled, Lattice, Monitor, map_parts, map_tasks};
use crate::math::Vec3;

/// Samples between two reports to the monitor: some 5 ms of work on one thread.
const SAMPLES_PER_REPORT: usize = 4096;

/// A large buffer could not be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{bytes} bytes do not fit in memory: ask for fewer samples")]
pub struct OutOfMemory {
    pub bytes: usize,
}

/// A buffer of `len` default values.
///
/// # Errors
/// If and only if the allocator refuses it; nothing is lost then.
pub fn zeroed<T: Clone + Default>(len: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut values = Vec::new();
    let bytes = len.saturating_mul(size_of::<T>());
    values.try_reserve_exact(len).map_err(|_| OutOfMemory { bytes })?;
    values.resize(len, T::default());
    Ok(values)
}

/// Sets each of `values` to `value(its index, scratch)`, in parallel, with reports of `stage` to `monitor` between
/// blocks.
///
/// # Errors
/// If and only if the monitor cancels; the values are then partly set.
pub fn fill_in_blocks<T: Send, S: Default>(
    values: &mut [T],
    value: impl Fn(usize, &mut S) -> T + Sync,
    stage: &str,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let each = |first: usize, run: &mut [T], scratch: &mut S| {
        run.iter_mut().enumerate().for_each(|(offset, slot)| *slot = value(first + offset, scratch));
    };
    fill_blocks(values, BLOCK, each, stage, monitor)
}

/// Sets `values` in runs of up to `size` by `fill(index of the first, run, scratch)`, in parallel, with reports of
/// `stage` to `monitor` between blocks of runs.
///
/// # Errors
/// If and only if the monitor cancels; the values are then partly set.
pub fn fill_blocks<T: Send, S: Default>(
    values: &mut [T],
    size: usize,
    fill: impl Fn(usize, &mut [T], &mut S) + Sync,
    stage: &str,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let total = values.len();
    for (block, run) in values.chunks_mut(SAMPLES_PER_REPORT).enumerate() {
        let start = block * SAMPLES_PER_REPORT;
        monitor.report(start as f64 / total as f64, stage)?;
        map_parts(run, size, |task, chunk| fill(start + task * size, chunk, &mut S::default()));
    }
    monitor.report(1.0, stage)
}

/// Samples along each axis of a cube of lattice samples.
const CUBE: usize = 4;
/// Most samples in a block of a lattice.
pub const BLOCK: usize = CUBE * CUBE * CUBE;

/// Computes the values of a lattice block by block, 4 × 4 × 4 samples (8 × 8 in a lattice of one layer), in parallel, and
/// gives each to `store(its index, value)` on the calling thread. Samples of a block lie close together, which
/// `values(points, results, scratch)` can use.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn for_each_lattice_block<T: Copy + Default + Send, S: Default>(
    lattice: &Lattice,
    values: impl Fn(&[Vec3], &mut [T], &mut S) + Sync,
    mut store: impl FnMut(usize, T),
    stage: &str,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let shape = if lattice.counts[2] == 1 { [2 * CUBE, 2 * CUBE, 1] } else { [CUBE; 3] };
    let blocks = [0, 1, 2].map(|axis| lattice.counts[axis].div_ceil(shape[axis]));
    let total: usize = blocks.iter().product();
    let per_report = SAMPLES_PER_REPORT / BLOCK;
    for first in (0..total).step_by(per_report) {
        monitor.report(first as f64 / total as f64, stage)?;
        let results = map_tasks(per_report.min(total - first), |task| {
            let block = first + task;
            let at = [block % blocks[0], block / blocks[0] % blocks[1], block / (blocks[0] * blocks[1])];
            let samples = samples_of_block(lattice, at, shape);
            let points: Vec<Vec3> = samples.iter().map(|s| lattice.point(*s)).collect();
            let mut results = [T::default(); BLOCK];
            values(&points, &mut results[..points.len()], &mut S::default());
            (samples, results)
        });
        for (samples, results) in results {
            samples.iter().zip(results).for_each(|(sample, result)| store(lattice.index(*sample), result));
        }
    }
    monitor.report(1.0, stage)
}

/// The samples of a block in Morton order, so that the first four and eight lie close together too; cut at the lattice's
/// far sides.
fn samples_of_block(lattice: &Lattice, block: [usize; 3], shape: [usize; 3]) -> Vec<[usize; 3]> {
    let flat = shape[2] == 1;
    let bit = |place: usize, axis: usize| {
        // Bits of a place in the block go to x, y and z in turn; to x and y alone in a flat block.
        let step = if flat { 2 } else { 3 };
        (0..3).fold(0, |c, level| c | (place >> (step * level + axis) & 1) << level)
    };
    let at = |place: usize| {
        let within = [bit(place, 0), bit(place, 1), if flat { 0 } else { bit(place, 2) }];
        [0, 1, 2].map(|axis| block[axis] * shape[axis] + within[axis])
    };
    (0..BLOCK).map(at).filter(|s| (0..3).all(|axis| s[axis] < lattice.counts[axis])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;
    use std::cell::Cell;

    #[test]
    fn every_value_is_set_and_reports_rise() {
        let mut values = vec![0; 40_000];
        let last = Cell::new(0.0);
        let monitor = |fraction: f64, _: &str| last.replace(fraction) <= fraction;
        fill_in_blocks(&mut values, |i, ()| 3 * i, "test", &monitor).unwrap();
        assert!(values.iter().enumerate().all(|(i, v)| *v == 3 * i));
        assert_eq!(last.get(), 1.0);
    }

    #[test]
    fn cancelling_stops_before_the_next_block() {
        let mut values = vec![0; 40_000];
        let monitor = |fraction: f64, _: &str| fraction == 0.0;
        assert_eq!(fill_in_blocks(&mut values, |_, ()| 1, "test", &monitor), Err(Cancelled));
        assert_eq!(values.iter().sum::<usize>(), SAMPLES_PER_REPORT);
        assert!(zeroed::<u8>(usize::MAX / 2).is_err());
        assert!(fill_in_blocks(&mut Vec::<u8>::new(), |_, ()| 1, "test", &Silent).is_ok());
    }

    #[test]
    fn every_sample_of_a_lattice_is_in_one_block() {
        for counts in [[9, 5, 7], [17, 20, 1], [1, 1, 1], [3, 1, 40]] {
            let lattice = Lattice { origin: Vec3::ZERO, spacing: Vec3::ONE, counts };
            let mut seen = vec![0; lattice.len()];
            let values = |points: &[Vec3], results: &mut [Vec3], (): &mut ()| results.copy_from_slice(points);
            let store = |index: usize, value: Vec3| {
                assert_eq!(value, lattice.point(lattice.sample(index)));
                seen[index] += 1;
            };
            for_each_lattice_block(&lattice, values, store, "test", &Silent).unwrap();
            assert!(seen.iter().all(|s| *s == 1));
        }
    }
}
