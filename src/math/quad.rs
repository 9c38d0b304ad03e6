//! Four numbers at once, in the widest registers that the processor has: the one place of the crate with `unsafe` code.
//! No operation is fused or reordered, so that the results are the same bits everywhere.
#![allow(unsafe_code)]
use wide::{f64x4, i64x4};

/// Four numbers, of one vector register or of two.
pub trait Quad: Copy {
    fn splat(value: f64) -> Self;
    fn new(values: [f64; 4]) -> Self;
    fn to_array(self) -> [f64; 4];
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The numbers of `magnitudes`, which are positive, with the signs of these.
    fn with_signs_on(self, magnitudes: Self) -> Self;
    /// 2⁻ᵉ for positive normal numbers with exponent e: what keeps products from overflowing and rounds nothing.
    fn reciprocal_power_of_two(self) -> Self;
}

/// Work on quads of any kind. `run` is to be `#[inline(always)]`.
pub trait QuadWork {
    fn run<Q: Quad>(self);
}

/// Does the work in the widest registers.
pub fn on_quads(work: impl QuadWork) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx") {
        // Sound: the processor has the instructions that it is compiled to.
        return unsafe { avx::run(work) };
    }
    work.run::<f64x4>();
}

const SIGN: f64 = -0.0;
const EXPONENT: i64 = 0x7ff0_0000_0000_0000;
const TWICE_BIAS: i64 = 0x7fe0_0000_0000_0000;

impl Quad for f64x4 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        f64x4::splat(value)
    }

    #[inline(always)]
    fn new(values: [f64; 4]) -> Self {
        f64x4::new(values)
    }

    #[inline(always)]
    fn to_array(self) -> [f64; 4] {
        f64x4::to_array(self)
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64x4::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64x4::abs(self)
    }

    #[inline(always)]
    fn with_signs_on(self, magnitudes: Self) -> Self {
        (self & f64x4::splat(SIGN)) | magnitudes
    }

    #[inline(always)]
    fn reciprocal_power_of_two(self) -> Self {
        let bits: i64x4 = wide::bytemuck::cast(self);
        wide::bytemuck::cast(i64x4::splat(TWICE_BIAS) - (bits & i64x4::splat(EXPONENT)))
    }
}

#[cfg(target_arch = "x86_64")]
mod avx {
    use super::{EXPONENT, Quad, QuadWork, SIGN, TWICE_BIAS};
    use std::arch::x86_64::*;

    // Made in `run` alone, of which the methods become part.
    #[derive(Clone, Copy)]
    struct Avx(__m256d);

    #[target_feature(enable = "avx")]
    pub fn run(work: impl QuadWork) {
        work.run::<Avx>();
    }

    impl Quad for Avx {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            unsafe { Avx(_mm256_set1_pd(value)) }
        }

        #[inline(always)]
        fn new(values: [f64; 4]) -> Self {
            let [a, b, c, d] = values;
            unsafe { Avx(_mm256_set_pd(d, c, b, a)) }
        }

        #[inline(always)]
        fn to_array(self) -> [f64; 4] {
            let mut values = [0.0; 4];
            unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) };
            values
        }

        #[inline(always)]
        fn plus(self, other: Self) -> Self {
            unsafe { Avx(_mm256_add_pd(self.0, other.0)) }
        }

        #[inline(always)]
        fn minus(self, other: Self) -> Self {
            unsafe { Avx(_mm256_sub_pd(self.0, other.0)) }
        }

        #[inline(always)]
        fn times(self, other: Self) -> Self {
            unsafe { Avx(_mm256_mul_pd(self.0, other.0)) }
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            unsafe { Avx(_mm256_sqrt_pd(self.0)) }
        }

        #[inline(always)]
        fn abs(self) -> Self {
            unsafe { Avx(_mm256_andnot_pd(_mm256_set1_pd(SIGN), self.0)) }
        }

        #[inline(always)]
        fn with_signs_on(self, magnitudes: Self) -> Self {
            unsafe { Avx(_mm256_or_pd(_mm256_and_pd(self.0, _mm256_set1_pd(SIGN)), magnitudes.0)) }
        }

        #[inline(always)]
        fn reciprocal_power_of_two(self) -> Self {
            // 256-bit registers of integers came later than those of numbers.
            let half = |bits: __m128i| unsafe {
                _mm_sub_epi64(_mm_set1_epi64x(TWICE_BIAS), _mm_and_si128(bits, _mm_set1_epi64x(EXPONENT)))
            };
            unsafe {
                let bits = _mm256_castpd_si256(self.0);
                let [low, high] =
                    [_mm256_castsi256_si128(bits), _mm256_extractf128_si256::<1>(bits)].map(half);
                Avx(_mm256_castsi256_pd(_mm256_set_m128i(high, low)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sample<'a>(&'a mut Vec<u64>);

    impl QuadWork for Sample<'_> {
        #[inline(always)]
        fn run<Q: Quad>(self) {
            for k in 0..100 {
                let a = Q::new([0.1, -2.5e30, 3.0, -0.0]).times(Q::splat(f64::from(k) - 50.5));
                let b = a.minus(Q::splat(1.25)).times(a).plus(Q::splat(f64::from(k)));
                let root = b.abs().sqrt();
                for quad in [a, b, root, b.with_signs_on(Q::splat(0.25)), root.reciprocal_power_of_two()] {
                    self.0.extend(quad.to_array().map(f64::to_bits));
                }
            }
        }
    }

    #[test]
    fn all_registers_give_the_same_bits() {
        let (mut widest, mut plain) = (Vec::new(), Vec::new());
        on_quads(Sample(&mut widest));
        Sample(&mut plain).run::<f64x4>();
        assert_eq!(widest, plain);
        assert_eq!(f64x4::splat(12.0).reciprocal_power_of_two().to_array(), [0.125; 4]);
    }
}
