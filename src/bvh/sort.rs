/// Bits of a digit: the counts of one stay in the first-level cache.
const DIGIT: u32 = 11;
const DIGITS: usize = 1 << DIGIT;

/// `codes` in rising order, and the places they came from; equal ones stay in their order. Radix sort, lowest digit first:
/// linear, and one small loop, where a browser downloads a general sort.
pub fn sorted_codes(codes: Vec<u64>) -> (Vec<u64>, Vec<u32>) {
    let mut items: Vec<(u64, u32)> = codes.into_iter().zip(0..).collect();
    let mut other = vec![(0, 0); items.len()];
    // Digits in which no two codes differ need no pass.
    let (all, any) = items.iter().fold((!0, 0), |(all, any), item| (all & item.0, any | item.0));
    for shift in (0..u64::BITS).step_by(DIGIT as usize) {
        if ((all ^ any) >> shift) as usize & (DIGITS - 1) != 0 {
            sort_by_digit(&items, &mut other, shift);
            std::mem::swap(&mut items, &mut other);
        }
    }
    items.into_iter().unzip()
}

fn sort_by_digit(items: &[(u64, u32)], sorted: &mut [(u64, u32)], shift: u32) {
    let digit = |item: &(u64, u32)| (item.0 >> shift) as usize & (DIGITS - 1);
    let mut next = [0; DIGITS];
    items.iter().for_each(|item| next[digit(item)] += 1);
    let mut start = 0;
    for place in &mut next {
        start += std::mem::replace(place, start);
    }
    for item in items {
        let place = &mut next[digit(item)];
        sorted[*place] = *item;
        *place += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_sorted_as_by_a_stable_sort() {
        for (count, mask) in [(0, !0), (1, !0), (5000, !0), (5000, 7), (5000, 7 << 40), (9, 0)] {
            let codes: Vec<u64> =
                (0..count).map(|i: u64| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) & mask).collect();
            let mut expected: Vec<(u64, u32)> = codes.iter().copied().zip(0..).collect();
            expected.sort();
            assert_eq!(sorted_codes(codes), expected.into_iter().unzip());
        }
    }
}
