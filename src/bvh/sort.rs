use std::ops::Range;

/// Bits of a digit: the counts of one stay in the first-level cache.
const DIGIT: u32 = 11;
const DIGITS: usize = 1 << DIGIT;
/// The first bit of the three highest digits.
const HIGH: u32 = 31;
/// Longer runs are sorted by digits.
const SHORT: usize = 32;

/// `codes` in rising order, and the places they came from; equal ones stay in their order. Radix sort, lowest digit first:
/// linear, and one small loop, where a browser downloads a general sort.
pub fn sorted_codes(codes: Vec<u64>) -> (Vec<u64>, Vec<u32>) {
    let mut items: Vec<(u64, u32)> = codes.into_iter().zip(0..).collect();
    let mut other = vec![(0, 0); items.len()];
    sort_by_digits(&mut items, &mut other, HIGH..u64::BITS);
    // Few codes are equal in all of these: what is left costs less than passes over all.
    let mut rest = &mut items[..];
    while let Some(first) = rest.first() {
        let high = first.0 >> HIGH;
        let count = rest.iter().take_while(|item| item.0 >> HIGH == high).count();
        let (run, others) = rest.split_at_mut(count);
        sort_run(run, &mut other[..count]);
        rest = others;
    }
    items.into_iter().unzip()
}

/// Sorts items of which the high digits are equal.
fn sort_run(run: &mut [(u64, u32)], other: &mut [(u64, u32)]) {
    if run.len() > SHORT {
        return sort_by_digits(run, other, 0..HIGH);
    }
    for end in 1..run.len() {
        let place = run[..end].partition_point(|item| item.0 <= run[end].0);
        run[place..=end].rotate_right(1);
    }
}

/// Sorts by the digits that begin at some bits.
fn sort_by_digits(items: &mut [(u64, u32)], other: &mut [(u64, u32)], bits: Range<u32>) {
    // Digits in which no two codes differ need no pass.
    let (all, any) = items.iter().fold((!0, 0), |(all, any), item| (all & item.0, any | item.0));
    let (mut from, mut to, mut is_moved) = (items, other, false);
    for shift in bits.step_by(DIGIT as usize) {
        if ((all ^ any) >> shift) as usize & (DIGITS - 1) != 0 {
            sort_by_digit(from, to, shift);
            std::mem::swap(&mut from, &mut to);
            is_moved = !is_moved;
        }
    }
    if is_moved {
        to.copy_from_slice(from);
    }
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
        for (count, mask) in
            [(0, !0), (1, !0), (5000, !0), (5000, 7), (5000, 7 << 40), (5000, 0x3ff << 30), (9, 0)]
        {
            let codes: Vec<u64> =
                (0..count).map(|i: u64| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) & mask).collect();
            let mut expected: Vec<(u64, u32)> = codes.iter().copied().zip(0..).collect();
            expected.sort();
            assert_eq!(sorted_codes(codes), expected.into_iter().unzip());
        }
    }
}
