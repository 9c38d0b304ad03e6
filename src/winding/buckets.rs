use crate::data::map_tasks;

/// Inputs that one task distributes: their items stay in the cache of a core.
const CHUNK: usize = 1 << 16;

/// Items distributed over numbered buckets, in parallel; a bucket gives its items in the order of their inputs.
pub struct Buckets<T> {
    /// For each chunk of inputs: its items in the order of buckets, and where each bucket begins among them.
    chunks: Vec<(Vec<T>, Vec<u32>)>,
}

impl<T: Copy + Default + Send + Sync> Buckets<T> {
    /// Calls `items(input, put)` for every input below `inputs`; what it gives to `put(bucket, item)` is kept.
    pub fn collect<F>(inputs: usize, buckets: usize, items: F) -> Buckets<T>
    where
        F: Fn(usize, &mut dyn FnMut(usize, T)) + Sync,
    {
        let chunks = map_tasks(inputs.div_ceil(CHUNK), |chunk| {
            let start = chunk * CHUNK;
            let mut found: Vec<(u32, T)> = Vec::with_capacity(CHUNK.min(inputs - start));
            for input in start..inputs.min(start + CHUNK) {
                items(input, &mut |bucket, item| found.push((bucket as u32, item)));
            }
            counting_sort(&found, buckets)
        });
        Buckets { chunks }
    }

    pub fn bucket(&self, bucket: usize) -> impl Iterator<Item = T> + '_ {
        self.chunks.iter().flat_map(move |(items, starts)| {
            items[starts[bucket] as usize..starts[bucket + 1] as usize].iter().copied()
        })
    }

    /// Number of items in all buckets.
    pub fn len(&self) -> usize {
        self.chunks.iter().map(|(items, _)| items.len()).sum()
    }

    /// Number of items in a bucket.
    pub fn count(&self, bucket: usize) -> usize {
        self.chunks.iter().map(|(_, starts)| (starts[bucket + 1] - starts[bucket]) as usize).sum()
    }
}

/// The items in the order of their buckets, equal ones as they came, and where each bucket begins.
pub fn counting_sort<T: Copy + Default>(found: &[(u32, T)], buckets: usize) -> (Vec<T>, Vec<u32>) {
    let mut starts = vec![0u32; buckets + 1];
    found.iter().for_each(|(bucket, _)| starts[*bucket as usize + 1] += 1);
    for bucket in 0..buckets {
        starts[bucket + 1] += starts[bucket];
    }
    let mut next = starts.clone();
    let mut items = vec![T::default(); found.len()];
    for (bucket, item) in found {
        let place = &mut next[*bucket as usize];
        items[*place as usize] = *item;
        *place += 1;
    }
    (items, starts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buckets_keep_the_order_of_inputs() {
        let buckets: Buckets<u32> = Buckets::collect(200_000, 7, |i, put| {
            if i % 3 != 0 {
                put(i % 7, i as u32);
            }
        });
        for bucket in 0..7 {
            let expected = (0..200_000).filter(|i| i % 7 == bucket && i % 3 != 0).map(|i| i as u32);
            assert!(buckets.bucket(bucket).eq(expected.clone()));
            assert_eq!(buckets.count(bucket), expected.count());
        }
    }
}
