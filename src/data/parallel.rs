//! The crate's parallel loops. All of them run through one instance of rayon's, on a closure behind a reference: each
//! instance is some 5 KiB of machine code, and a browser downloads them all. So a task is to be worth at least some
//! microseconds. The WebAssembly build without threads does without rayon, which would be a twentieth of it.
use std::sync::Mutex;

/// Items of [`map_items`] that make a task.
const ITEMS_PER_TASK: usize = 1024;

#[cfg(any(not(target_arch = "wasm32"), target_feature = "atomics"))]
mod backend {
    use rayon::prelude::*;

    pub fn run(tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        (0..tasks).into_par_iter().for_each(task);
    }

    pub fn threads() -> usize {
        rayon::current_num_threads()
    }

    pub fn sort(values: &mut [(u64, u32)]) {
        values.par_sort_unstable();
    }
}

#[cfg(all(target_arch = "wasm32", not(target_feature = "atomics")))]
mod backend {
    pub fn run(tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        (0..tasks).for_each(task);
    }

    pub fn threads() -> usize {
        1
    }

    pub fn sort(values: &mut [(u64, u32)]) {
        values.sort_unstable();
    }
}

use backend::run;
pub use backend::threads;

/// Sorts by keys, and by numbers where keys are equal, in parallel.
pub fn sort_keyed(values: &mut [(u64, u32)]) {
    backend::sort(values);
}

/// What `task` gives for each number below `tasks`, in order; run in parallel.
pub fn map_tasks<R: Send>(tasks: usize, task: impl Fn(usize) -> R + Sync) -> Vec<R> {
    collect(tasks, &task)
}

// Generic over the result alone: one instance for each type, not for each call.
fn collect<R: Send>(tasks: usize, task: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
    let results: Vec<Mutex<Option<R>>> = (0..tasks).map(|_| Mutex::new(None)).collect();
    run(tasks, &|index| {
        let result = task(index);
        *results[index].lock().expect("a task that panics ends them all") = Some(result);
    });
    let taken = |slot: Mutex<Option<R>>| slot.into_inner().ok().flatten();
    results.into_iter().map(|slot| taken(slot).expect("every task has run")).collect()
}

/// What `item` gives for each number below `items`, in order; for work too small to be a task of its own.
pub fn map_items<R: Send>(items: usize, item: impl Fn(usize) -> R + Sync) -> Vec<R> {
    collect_items(items, &item)
}

fn collect_items<R: Send>(items: usize, item: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
    if threads() == 1 {
        return (0..items).map(item).collect();
    }
    let tasks = map_tasks(items.div_ceil(ITEMS_PER_TASK), |task| {
        let first = task * ITEMS_PER_TASK;
        (first..items.min(first + ITEMS_PER_TASK)).map(item).collect::<Vec<R>>()
    });
    let mut all = Vec::with_capacity(items);
    tasks.into_iter().for_each(|some| all.extend(some));
    all
}

/// Hands `values`, cut into parts of `size`, to `part(its number, values)` in parallel; gives what it gave, in order.
pub fn map_parts<T: Send, R: Send>(
    values: &mut [T],
    size: usize,
    part: impl Fn(usize, &mut [T]) -> R + Sync,
) -> Vec<R> {
    collect_parts(values, size, &part)
}

fn collect_parts<T: Send, R: Send>(
    values: &mut [T],
    size: usize,
    part: &(dyn Fn(usize, &mut [T]) -> R + Sync),
) -> Vec<R> {
    let parts: Vec<Mutex<&mut [T]>> = values.chunks_mut(size).map(Mutex::new).collect();
    map_tasks(parts.len(), |index| {
        // Never waits: each part is locked once.
        let mut values = parts[index].lock().expect("a task that panics ends them all");
        part(index, &mut values)
    })
}

/// Sets each of `values` by `set(its index, value)`, in parallel, `size` of them to a task.
pub fn set_each<T: Send>(values: &mut [T], size: usize, set: impl Fn(usize, &mut T) + Sync) {
    map_parts(values, size, |part, values| {
        values.iter_mut().enumerate().for_each(|(offset, value)| set(part * size + offset, value));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_keep_their_order() {
        assert_eq!(map_tasks(1000, |i| 3 * i), (0..1000).map(|i| 3 * i).collect::<Vec<_>>());
        assert_eq!(map_items(5000, |i| i as u8), (0..5000).map(|i| i as u8).collect::<Vec<_>>());
        assert!(map_items(0, |i| i).is_empty());
        let mut values = vec![0; 1003];
        let firsts = map_parts(&mut values, 10, |part, values| {
            values.fill(part);
            values.len()
        });
        assert_eq!((firsts.len(), firsts[100]), (101, 3));
        set_each(&mut values, 7, |i, value| *value += i);
        assert!(values.iter().enumerate().all(|(i, v)| *v == i / 10 + i));
    }

    #[test]
    fn a_panic_reaches_the_caller() {
        let caught = std::panic::catch_unwind(|| map_tasks(100, |i| assert!(i != 50, "task {i}")));
        assert!(caught.is_err());
    }
}
