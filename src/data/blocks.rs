use super::{Cancelled, Monitor};
use rayon::prelude::*;

/// Samples between two reports to the monitor: some 5 ms of work on one thread.
const SAMPLES_PER_REPORT: usize = 4096;
/// Samples that one task takes: enough to make the cost of a task negligible.
const SAMPLES_PER_TASK: usize = 64;

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
pub fn fill_in_blocks<T: Send>(
    values: &mut [T],
    value: impl Fn(usize, &mut Vec<u32>) -> T + Sync,
    stage: &str,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let total = values.len();
    for (block, run) in values.chunks_mut(SAMPLES_PER_REPORT).enumerate() {
        let start = block * SAMPLES_PER_REPORT;
        monitor.report(start as f64 / total as f64, stage)?;
        run.par_chunks_mut(SAMPLES_PER_TASK).enumerate().for_each_init(Vec::new, |scratch, (task, chunk)| {
            for (offset, slot) in chunk.iter_mut().enumerate() {
                *slot = value(start + task * SAMPLES_PER_TASK + offset, scratch);
            }
        });
    }
    monitor.report(1.0, stage)
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
        fill_in_blocks(&mut values, |i, _| 3 * i, "test", &monitor).unwrap();
        assert!(values.iter().enumerate().all(|(i, v)| *v == 3 * i));
        assert_eq!(last.get(), 1.0);
    }

    #[test]
    fn cancelling_stops_before_the_next_block() {
        let mut values = vec![0; 40_000];
        let monitor = |fraction: f64, _: &str| fraction == 0.0;
        assert_eq!(fill_in_blocks(&mut values, |_, _| 1, "test", &monitor), Err(Cancelled));
        assert_eq!(values.iter().sum::<usize>(), SAMPLES_PER_REPORT);
        assert!(zeroed::<u8>(usize::MAX / 2).is_err());
        assert!(fill_in_blocks(&mut Vec::<u8>::new(), |_, _| 1, "test", &Silent).is_ok());
    }
}
