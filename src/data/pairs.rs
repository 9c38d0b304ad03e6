/// The pairs in the order of their first and then their second number. Packed into one number each, they share the
/// machine code of one sort, whatever they stand for.
pub fn sorted_pairs(pairs: impl IntoIterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let mut packed: Vec<u64> =
        pairs.into_iter().map(|[first, second]| u64::from(first) << 32 | u64::from(second)).collect();
    packed.sort_unstable();
    packed.into_iter().map(|pair| [(pair >> 32) as u32, pair as u32]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_number_counts_most() {
        let pairs = [[2, 0], [1, u32::MAX], [0, 7], [1, 3], [1, 3]];
        assert_eq!(sorted_pairs(pairs), [[0, 7], [1, 3], [1, 3], [1, u32::MAX], [2, 0]]);
    }
}
