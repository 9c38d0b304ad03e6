//! Wider registers where the processor has them: the one place of the crate with `unsafe` code.
#![allow(unsafe_code)]

/// Runs `work` compiled for 256-bit registers, if the processor has them. It is to be `#[inline(always)]`, with loops over
/// small arrays of numbers that the compiler can keep in registers. No operation is fused or reordered: the results are
/// the same bits.
#[inline]
pub fn widest<R>(work: impl FnOnce() -> R) -> R {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx") {
        // Sound: the processor has the instructions that `with_avx` is compiled to.
        return unsafe { with_avx(work) };
    }
    work()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx")]
fn with_avx<R>(work: impl FnOnce() -> R) -> R {
    work()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_the_same_bits() {
        let values: [f64; 8] = std::array::from_fn(|k| 0.1 + 0.3 * k as f64);
        let plain = values.map(number);
        let wide = widest(
            #[inline(always)]
            || values.map(number),
        );
        assert_eq!(wide.map(f64::to_bits), plain.map(f64::to_bits));
    }

    #[inline(always)]
    fn number(v: f64) -> f64 {
        (v * v + 1.0 / v).sqrt() * v - v
    }
}
