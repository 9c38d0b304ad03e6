//! Numbers in vector registers, the widest that the processor has: the one place of the crate with `unsafe` code.
//! No operation is fused or reordered, and what is done in one lane does not depend on the others, so that the results are
//! the same bits however wide the registers are.
#![allow(unsafe_code)]
use std::ops::{Add, Div, Mul, Sub};
use wide::{f32x4, f64x4, i32x4, i64x4};

/// Numbers that are treated together, in one vector register or in two.
pub trait Floats:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    type Number: Copy;
    const COUNT: usize;
    fn splat(value: Self::Number) -> Self;
    /// The first [`Floats::COUNT`] numbers of a slice.
    fn load(from: &[Self::Number]) -> Self;
    /// Puts them into the first places of a slice.
    fn store(self, to: &mut [Self::Number]);
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The larger of each two; both are numbers.
    fn max(self, other: Self) -> Self;
    /// The numbers of `magnitudes`, which are positive, with the signs of these.
    fn with_signs_on(self, magnitudes: Self) -> Self;
    /// 2⁻ᵉ for positive normal numbers with exponent e: what keeps products from overflowing and rounds nothing.
    fn reciprocal_power_of_two(self) -> Self;
    /// One bit for each lane in which this is greater.
    fn greater(self, other: Self) -> u32;
}

/// The kinds of registers of a processor.
pub trait Registers {
    /// Four or eight 32-bit numbers.
    type Singles: Floats<Number = f32>;
    /// Four 64-bit numbers.
    type Doubles: Floats<Number = f64>;
}

/// Work on registers of any kind. `run` is to be `#[inline(always)]`, and so is what it calls with them.
pub trait Work {
    fn run<R: Registers>(self);
}

/// Does the work in the widest registers.
pub fn in_widest_registers(work: impl Work) {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx") {
        // Sound: the processor has the instructions that it is compiled to.
        return unsafe { avx::run(work) };
    }
    work.run::<Plain>();
}

/// Registers that every processor of the target has.
pub struct Plain;

impl Registers for Plain {
    type Singles = f32x4;
    type Doubles = f64x4;
}

/// What tells sign and exponent of a kind of number apart.
trait Bits {
    const SIGN: Self;
    type Integer;
    const EXPONENT: Self::Integer;
    const TWICE_BIAS: Self::Integer;
}

impl Bits for f32 {
    const SIGN: f32 = -0.0;
    type Integer = i32;
    const EXPONENT: i32 = 0x7f80_0000;
    const TWICE_BIAS: i32 = 0x7f00_0000;
}

impl Bits for f64 {
    const SIGN: f64 = -0.0;
    type Integer = i64;
    const EXPONENT: i64 = 0x7ff0_0000_0000_0000;
    const TWICE_BIAS: i64 = 0x7fe0_0000_0000_0000;
}

macro_rules! plain {
    ($name:ident, $number:ident, $integers:ident) => {
        impl Floats for $name {
            type Number = $number;
            const COUNT: usize = 4;

            #[inline(always)]
            fn splat(value: $number) -> Self {
                $name::splat(value)
            }

            #[inline(always)]
            fn load(from: &[$number]) -> Self {
                $name::new([from[0], from[1], from[2], from[3]])
            }

            #[inline(always)]
            fn store(self, to: &mut [$number]) {
                to[..4].copy_from_slice(&self.to_array());
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $name::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $name::abs(self)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.fast_max(other)
            }

            #[inline(always)]
            fn with_signs_on(self, magnitudes: Self) -> Self {
                (self & $name::splat($number::SIGN)) | magnitudes
            }

            #[inline(always)]
            fn reciprocal_power_of_two(self) -> Self {
                let bits: $integers = wide::bytemuck::cast(self);
                let exponent = bits & $integers::splat($number::EXPONENT);
                wide::bytemuck::cast($integers::splat($number::TWICE_BIAS) - exponent)
            }

            #[inline(always)]
            fn greater(self, other: Self) -> u32 {
                self.simd_gt(other).to_bitmask() as u32
            }
        }
    };
}

plain!(f32x4, f32, i32x4);
plain!(f64x4, f64, i64x4);

#[cfg(target_arch = "x86_64")]
mod avx {
    use super::{Bits, Floats, Registers, Work};
    use std::arch::x86_64::*;
    use std::ops::{Add, Div, Mul, Sub};

    struct Avx;

    impl Registers for Avx {
        type Singles = Singles;
        type Doubles = Doubles;
    }

    #[target_feature(enable = "avx")]
    pub fn run(work: impl Work) {
        work.run::<Avx>();
    }

    // Made in `run` alone, of which the methods become part.
    macro_rules! floats {
        (
            $name:ident, $register:ident, $number:ident, $count:literal, $splat:ident, $load:ident, $store:ident,
            $operators:tt, $sqrt:ident, $max:ident, $and:ident, $or:ident, $and_not:ident, $compare:ident, $mask:ident,
            $to_integers:ident, $from_integers:ident, $splat_half:ident, $subtract_half:ident
        ) => {
            #[derive(Clone, Copy)]
            pub struct $name($register);

            floats!(@operators $name $operators);

            impl Floats for $name {
                type Number = $number;
                const COUNT: usize = $count;

                #[inline(always)]
                fn splat(value: $number) -> Self {
                    unsafe { $name($splat(value)) }
                }

                #[inline(always)]
                fn load(from: &[$number]) -> Self {
                    unsafe { $name($load(from[..$count].as_ptr())) }
                }

                #[inline(always)]
                fn store(self, to: &mut [$number]) {
                    unsafe { $store(to[..$count].as_mut_ptr(), self.0) };
                }

                #[inline(always)]
                fn sqrt(self) -> Self {
                    unsafe { $name($sqrt(self.0)) }
                }

                #[inline(always)]
                fn abs(self) -> Self {
                    unsafe { $name($and_not($splat($number::SIGN), self.0)) }
                }

                #[inline(always)]
                fn max(self, other: Self) -> Self {
                    unsafe { $name($max(self.0, other.0)) }
                }

                #[inline(always)]
                fn with_signs_on(self, magnitudes: Self) -> Self {
                    unsafe { $name($or($and(self.0, $splat($number::SIGN)), magnitudes.0)) }
                }

                #[inline(always)]
                fn reciprocal_power_of_two(self) -> Self {
                    // 256-bit registers of integers came later than those of numbers.
                    let half = |bits: __m128i| unsafe {
                        let exponent = _mm_and_si128(bits, $splat_half($number::EXPONENT));
                        $subtract_half($splat_half($number::TWICE_BIAS), exponent)
                    };
                    unsafe {
                        let bits = $to_integers(self.0);
                        let [low, high] =
                            [_mm256_castsi256_si128(bits), _mm256_extractf128_si256::<1>(bits)].map(half);
                        $name($from_integers(_mm256_set_m128i(high, low)))
                    }
                }

                #[inline(always)]
                fn greater(self, other: Self) -> u32 {
                    unsafe { $mask($compare::<_CMP_GT_OQ>(self.0, other.0)) as u32 }
                }
            }
        };
        (@operators $name:ident { $($operator:ident $method:ident $instruction:ident)* }) => {
            $(impl $operator for $name {
                type Output = Self;

                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    unsafe { $name($instruction(self.0, other.0)) }
                }
            })*
        };
    }

    floats!(
        Singles, __m256, f32, 8, _mm256_set1_ps, _mm256_loadu_ps, _mm256_storeu_ps,
        { Add add _mm256_add_ps Sub sub _mm256_sub_ps Mul mul _mm256_mul_ps Div div _mm256_div_ps },
        _mm256_sqrt_ps, _mm256_max_ps, _mm256_and_ps, _mm256_or_ps, _mm256_andnot_ps, _mm256_cmp_ps, _mm256_movemask_ps,
        _mm256_castps_si256, _mm256_castsi256_ps, _mm_set1_epi32, _mm_sub_epi32
    );
    floats!(
        Doubles, __m256d, f64, 4, _mm256_set1_pd, _mm256_loadu_pd, _mm256_storeu_pd,
        { Add add _mm256_add_pd Sub sub _mm256_sub_pd Mul mul _mm256_mul_pd Div div _mm256_div_pd },
        _mm256_sqrt_pd, _mm256_max_pd, _mm256_and_pd, _mm256_or_pd, _mm256_andnot_pd, _mm256_cmp_pd, _mm256_movemask_pd,
        _mm256_castpd_si256, _mm256_castsi256_pd, _mm_set1_epi64x, _mm_sub_epi64
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEN: usize = 8;

    #[derive(Default)]
    struct Results {
        singles: Vec<u32>,
        doubles: Vec<u64>,
    }

    /// All operations on eight numbers, as many at a time as the registers hold.
    fn each<F: Floats>(
        numbers: &[F::Number; LEN],
        zero: F::Number,
        mut give: impl FnMut(&[F::Number]),
    ) -> u32 {
        let mut greater = 0;
        for start in (0..LEN).step_by(F::COUNT) {
            let a = F::load(&numbers[start..]);
            let b = (a - F::splat(numbers[1])) * a + F::splat(numbers[5]);
            let root = b.abs().sqrt();
            let mut stored = [zero; LEN];
            let scale = root.reciprocal_power_of_two();
            for floats in [a, b, root, b / root, a.max(b), b.with_signs_on(root), scale] {
                floats.store(&mut stored);
                give(&stored[..F::COUNT]);
            }
            greater |= b.greater(a) << start;
        }
        greater
    }

    struct Sample<'a>(&'a mut Results);

    impl Work for Sample<'_> {
        #[inline(always)]
        fn run<R: Registers>(self) {
            for k in 0..100 {
                let numbers: [f64; LEN] = [0.1, -2.5e13, 3.0, -0.0, 1e-9, 77.7, -1.5, 2e5];
                let doubles = numbers.map(|x| x * (f64::from(k) - 50.5));
                let singles = doubles.map(|x| x as f32);
                let mut of = Results::default();
                let narrow =
                    each::<R::Singles>(&singles, 0.0, |x| of.singles.extend(x.iter().map(|x| x.to_bits())));
                let wide =
                    each::<R::Doubles>(&doubles, 0.0, |x| of.doubles.extend(x.iter().map(|x| x.to_bits())));
                of.singles.sort_unstable();
                self.0.singles.extend(of.singles);
                self.0.singles.extend([narrow, wide]);
                self.0.doubles.extend(of.doubles);
            }
        }
    }

    #[test]
    fn all_registers_give_the_same_bits() {
        let (mut widest, mut plain) = (Results::default(), Results::default());
        in_widest_registers(Sample(&mut widest));
        Sample(&mut plain).run::<Plain>();
        assert_eq!(widest.singles, plain.singles);
        assert_eq!(widest.doubles, plain.doubles);
    }

    #[test]
    fn exponents_signs_and_comparisons_are_right() {
        let numbers = f32x4::new([12.0, -0.25, 0.0, 1e30]);
        let of = |floats: f32x4| {
            let mut stored = [0.0; 4];
            Floats::store(floats, &mut stored);
            stored
        };
        assert_eq!(of(Floats::reciprocal_power_of_two(numbers))[0], 0.125);
        assert_eq!(of(numbers.with_signs_on(Floats::splat(2.0))), [2.0, -2.0, 2.0, 2.0]);
        assert_eq!(numbers.greater(Floats::splat(0.0)), 0b1001);
    }
}
