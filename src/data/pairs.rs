use super::sort_keyed;

/// The pairs in the order of their first and then their second number. Packed into one number each, they share the
/// machine code of one sort, whatever they stand for.
pub fn sorted_pairs(pairs: impl IntoIterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let mut packed: Vec<u64> =
        pairs.into_iter().map(|[first, second]| u64::from(first) << 32 | u64::from(second)).collect();
    packed.sort_unstable();
    packed.into_iter().map(|pair| [(pair >> 32) as u32, pair as u32]).collect()
}

/// The places of `values` in ascending order; equal ones in the order they stand in. For a NaN, see `f64::total_cmp`.
pub fn ascending(values: impl IntoIterator<Item = f64>) -> Vec<u32> {
    let mut keyed: Vec<(u64, u32)> = values.into_iter().map(ordered_bits).zip(0..).collect();
    sort_keyed(&mut keyed);
    keyed.into_iter().map(|(_, place)| place).collect()
}

/// Numbers as integers of the same order.
fn ordered_bits(x: f64) -> u64 {
    let bits = x.to_bits();
    if x.is_sign_negative() { !bits } else { bits | 1 << 63 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_in_the_order_of_their_values() {
        let values = [0.5, -2.0, f64::INFINITY, -0.0, -1e-300, 0.5, 0.0, f64::NEG_INFINITY, 1e9];
        assert_eq!(ascending(values), [7, 1, 4, 3, 6, 0, 5, 8, 2]);
    }

    #[test]
    fn the_first_number_counts_most() {
        let pairs = [[2, 0], [1, u32::MAX], [0, 7], [1, 3], [1, 3]];
        assert_eq!(sorted_pairs(pairs), [[0, 7], [1, 3], [1, 3], [1, u32::MAX], [2, 0]]);
    }
}
