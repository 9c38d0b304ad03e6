//! Bits of bytes and of words, lowest first.

/// Whether a bit is set.
#[inline]
pub fn bit(bits: &[u8], index: usize) -> bool {
    bits[index / 8] >> (index % 8) & 1 == 1
}

/// Up to eight bits as a byte.
#[inline]
pub fn byte_of(bits: impl DoubleEndedIterator<Item = bool>) -> u8 {
    bits.rev().fold(0, |byte, bit| byte << 1 | u8::from(bit))
}

/// Sets or clears a bit.
pub fn set_bit(bits: &mut [u8], index: usize, value: bool) {
    let bit = 1 << (index % 8);
    bits[index / 8] = if value { bits[index / 8] | bit } else { bits[index / 8] & !bit };
}

/// The places of the bits that are set.
#[inline]
pub fn ones(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (mask != 0).then(|| mask.trailing_zeros() as usize);
        mask &= mask.wrapping_sub(1);
        lowest
    })
}
