//! Decimal text to the nearest `f64`, as `f64::from_str` does it. That one brings 10 KiB of powers of five to the download
//! for WebAssembly, which no compression makes smaller.
//!
//! Nearly every number is decided by a quotient or product of twice the precision; the few that lie too close to the
//! middle of two floats, or to the ends of the range, by whole numbers of any length.

/// Digits that fit in a `u64`.
const MOST_DIGITS: i64 = 19;
/// No more digits than this can decide: the middle between two floats has at most 767.
const DECISIVE_DIGITS: usize = 770;
/// 10 to this is exact as `f64`.
const EXACT_POWER: i64 = 22;

/// A decimal number without its sign: `digits` × 10^`exponent`, with what else there may be after the digits.
struct Decimal<'a> {
    /// The first digits, leading zeros left out.
    digits: u64,
    exponent: i64,
    /// Whether digits other than 0 follow.
    is_cut: bool,
    /// All digits as they stand in the text, with the point.
    text: &'a [u8],
    /// Of the last of all digits.
    last_exponent: i64,
}

/// The number that `token` spells: digits with or without a point and an exponent, `inf`, `infinity` or `nan`.
pub(super) fn parse(token: &[u8]) -> Option<f64> {
    let (is_negative, rest) = match token {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    let is = |name: &str| rest.eq_ignore_ascii_case(name.as_bytes());
    let value = match Decimal::read(rest) {
        Some(decimal) => decimal.value(),
        None if is("inf") || is("infinity") => f64::INFINITY,
        None if is("nan") => f64::NAN,
        None => return None,
    };
    Some(if is_negative { -value } else { value })
}

impl Decimal<'_> {
    fn read(token: &[u8]) -> Option<Decimal<'_>> {
        let mut decimal = Decimal { digits: 0, exponent: 0, is_cut: false, text: token, last_exponent: 0 };
        let (mut kept, mut has_digits, mut after_point) = (0, false, false);
        let mut end = token.len();
        for (at, &byte) in token.iter().enumerate() {
            match byte {
                b'0'..=b'9' => {
                    let digit = u64::from(byte - b'0');
                    has_digits = true;
                    decimal.last_exponent -= i64::from(after_point);
                    if kept < MOST_DIGITS {
                        decimal.digits = 10 * decimal.digits + digit;
                        decimal.exponent -= i64::from(after_point);
                        kept += i64::from(decimal.digits > 0);
                    } else {
                        decimal.is_cut |= digit > 0;
                        decimal.exponent += i64::from(!after_point);
                    }
                }
                b'.' if !after_point => after_point = true,
                b'e' | b'E' if has_digits => {
                    let exponent = exponent(&token[at + 1..])?;
                    decimal.exponent += exponent;
                    decimal.last_exponent += exponent;
                    end = at;
                    break;
                }
                _ => return None,
            }
        }
        decimal.text = &token[..end];
        has_digits.then_some(decimal)
    }

    fn value(&self) -> f64 {
        let high = self.digits as f64;
        if self.digits >> f64::MANTISSA_DIGITS == 0 && self.exponent.abs() <= EXACT_POWER {
            // Both are exact, so is all but the last rounding; no digit was left out.
            let power = power_of_ten(self.exponent.abs());
            return if self.exponent < 0 { high / power } else { high * power };
        }
        // Beyond these ends an error bound of the quotient would not be relative to it.
        if self.digits == 0 || self.exponent.abs() > 250 {
            return self.value_exactly();
        }
        // Rounding up to 2⁶⁴ is undone by a negative remainder.
        let low = (i128::from(self.digits) - high as i128) as f64;
        let (mut high, mut low) = (high, low);
        let mut left = self.exponent.abs();
        while left > 0 {
            let step = left.min(EXACT_POWER);
            let power = power_of_ten(step);
            (high, low) =
                if self.exponent > 0 { times([high, low], power) } else { over([high, low], power) };
            left -= step;
        }
        // A step errs by less than 2⁻¹⁰⁰ of the value, and there are at most twelve; digits that were left out count for
        // less than 2⁻⁵⁹ of it.
        let bound = high * if self.is_cut { 2f64.powi(-58) } else { 2f64.powi(-90) };
        let (least, most) = (high + (low - bound), high + (low + bound));
        if least == most { least } else { self.value_exactly() }
    }

    #[cold]
    #[inline(never)]
    fn value_exactly(&self) -> f64 {
        let mut numerator = Natural(vec![]);
        let mut exponent = self.last_exponent;
        let mut taken = 0;
        for digit in self.text.iter().filter(|byte| **byte != b'.').map(|byte| u32::from(byte - b'0')) {
            taken += usize::from(taken > 0 || digit > 0);
            if taken <= DECISIVE_DIGITS {
                numerator.multiply_add(10, digit);
            } else {
                // Only whether it is zero matters.
                numerator.0[0] |= u32::from(digit > 0);
                exponent += 1;
            }
        }
        let places = taken.min(DECISIVE_DIGITS) as i64;
        if taken == 0 || exponent + places < -330 {
            return 0.0;
        }
        if exponent + places > 330 {
            return f64::INFINITY;
        }
        let mut denominator = Natural(vec![1]);
        let scaled = if exponent < 0 { &mut denominator } else { &mut numerator };
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            let step = left.min(9);
            scaled.multiply_add(10u32.pow(step as u32), 0);
            left -= step;
        }
        quotient(numerator, denominator)
    }
}

/// 10 to `exponent`, at most [`EXACT_POWER`].
fn power_of_ten(exponent: i64) -> f64 {
    (0..exponent).fold(1.0, |power, _| 10.0 * power)
}

/// The exponent after the `e`; those too large for any use are cut.
fn exponent(text: &[u8]) -> Option<i64> {
    let (sign, digits) = match text {
        [b'-', digits @ ..] => (-1, digits),
        [b'+', digits @ ..] => (1, digits),
        digits => (1, digits),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let value = digits.iter().fold(0, |value: i64, b| (10 * value + i64::from(b - b'0')).min(1 << 40));
    Some(sign * value)
}

/// What a product of two numbers and its rounded value differ by (Dekker 1971, without fused operations).
fn product_error(a: f64, b: f64, product: f64) -> f64 {
    let split = |x: f64| {
        let shifted = 134_217_729.0 * x; // 2²⁷ + 1
        let high = shifted - (shifted - x);
        [high, x - high]
    };
    let ([a, a_low], [b, b_low]) = (split(a), split(b));
    a_low * b_low - (((product - a * b) - a_low * b) - a * b_low)
}

fn normalised(high: f64, low: f64) -> (f64, f64) {
    let sum = high + low;
    (sum, low - (sum - high))
}

fn times([high, low]: [f64; 2], factor: f64) -> (f64, f64) {
    let product = high * factor;
    normalised(product, product_error(high, factor, product) + low * factor)
}

fn over([high, low]: [f64; 2], divisor: f64) -> (f64, f64) {
    let quotient = high / divisor;
    let product = quotient * divisor;
    let rest = (high - product) - product_error(quotient, divisor, product) + low;
    normalised(quotient, rest / divisor)
}

/// A natural number, lowest 32 bits first; the highest are not all 0.
struct Natural(Vec<u32>);

impl Natural {
    fn multiply_add(&mut self, factor: u32, summand: u32) {
        let mut carry = u64::from(summand);
        for limb in &mut self.0 {
            carry += u64::from(*limb) * u64::from(factor);
            *limb = carry as u32;
            carry >>= 32;
        }
        if carry > 0 {
            self.0.push(carry as u32);
        }
    }

    fn bits(&self) -> i64 {
        32 * self.0.len() as i64 - self.0.last().map_or(0, |limb| i64::from(limb.leading_zeros()))
    }

    fn shift_up(&mut self, bits: i64) {
        self.multiply_add(1 << (bits % 32), 0);
        self.0.splice(0..0, std::iter::repeat_n(0, bits as usize / 32));
    }

    /// Takes `other` away if it is not greater; answers whether it was.
    fn take(&mut self, other: &Natural) -> bool {
        if self.0.len() != other.0.len() && self.bits() < other.bits()
            || self.0.len() == other.0.len() && self.0.iter().rev().lt(other.0.iter().rev())
        {
            return false;
        }
        let mut borrow = false;
        for (place, limb) in self.0.iter_mut().enumerate() {
            let taken = u64::from(other.0.get(place).copied().unwrap_or(0)) + u64::from(borrow);
            borrow = u64::from(*limb) < taken;
            *limb = limb.wrapping_sub(taken as u32);
        }
        while self.0.last() == Some(&0) {
            self.0.pop();
        }
        true
    }
}

/// The float nearest to a quotient, ties to even. Neither number is 0.
fn quotient(mut numerator: Natural, mut denominator: Natural) -> f64 {
    let bias = f64::MAX_EXP as i64 - 1;
    let mut exponent = numerator.bits() - denominator.bits();
    if exponent < 0 {
        numerator.shift_up(-exponent)
    } else {
        denominator.shift_up(exponent)
    }
    // As long as each other now: the quotient lies between 1/2 and 2.
    let mut mantissa = u64::from(numerator.take(&denominator));
    if mantissa == 0 {
        exponent -= 1;
        numerator.shift_up(1);
        mantissa = u64::from(numerator.take(&denominator));
    }
    if exponent > bias {
        return f64::INFINITY;
    }
    // The bits of a subnormal number are fewer.
    let bits = (exponent + bias + i64::from(f64::MANTISSA_DIGITS) - 1).min(i64::from(f64::MANTISSA_DIGITS));
    if bits < 0 {
        return 0.0;
    }
    for _ in 0..bits {
        numerator.shift_up(1);
        mantissa = mantissa << 1 | u64::from(numerator.take(&denominator));
    }
    // The last bit is below the float's own: it and what remains say whether to round up.
    let rounds_up = mantissa & 1 == 1 && (mantissa & 2 == 2 || !numerator.0.is_empty());
    let mantissa = (mantissa >> 1) + u64::from(rounds_up);
    // The highest bit of a normal number adds 1 to the exponent; so does a carry, up to infinity.
    let field = (exponent + bias - 1).max(0) as u64;
    f64::from_bits((field << (f64::MANTISSA_DIGITS - 1)) + mantissa)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As the standard library reads it.
    fn check(text: &str) {
        let (ours, theirs) = (parse(text.as_bytes()), text.parse::<f64>().ok());
        assert_eq!(ours.map(f64::to_bits), theirs.map(f64::to_bits), "{text}: {ours:?}, not {theirs:?}");
    }

    #[test]
    fn spellings_are_those_of_the_standard_library() {
        let spellings = "0 -0 1 +1. .5 -.5e1 1e5 1E+5 1e-5 00012.5000 inf -inf Infinity nan NAN 1e400 1e-400 \
             1e99999999999999999999 1e-99999999999999999999 0e99999999999 . e5 1e 1e+ + - 1.2.3 1,5 0x1 in \
             infinit 1_0 1e5.5 1d5 ٣";
        for text in spellings.split_whitespace().chain([""]) {
            check(text);
        }
    }

    #[test]
    fn hard_numbers_are_rounded_rightly() {
        for text in [
            "9007199254740993",
            "9007199254740993.00000000000000000000000000000000000000000000000000000001",
            "5e-324",
            "2.4703282292062327208e-324",
            "2.4703282292062328e-324",
            "2.2250738585072011e-308",
            "2.2250738585072012e-308",
            "1.7976931348623157e308",
            "1.7976931348623158e308",
            "1.7976931348623159e308",
            "18446744073709551615",
            "18446744073709551616",
            "9999999999999999999",
            "99999999999999999999",
            "0.1000000000000000055511151231257827021181583404541015625",
            "6.631236846766476e-316",
            "8.5e-322",
            "1e22",
            "1e23",
            "8.41e21",
            "9.109e-31",
            "179769313486231580793728971405301e276",
        ] {
            check(text);
        }
        // The middle of two floats, just below and just above it, in all its 767 digits.
        let middle = format!("{:.1074}", f64::from_bits(1 << 52)).replace("0.", ".");
        for tail in ["", "0", "1", "00000001"] {
            check(&format!("{middle}{tail}"));
            check(&format!("{}5{tail}", &middle[..middle.len() - 1]));
        }
    }

    #[test]
    fn random_numbers_of_every_length_and_size_are_rounded_rightly() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state ^ state >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) ^ state >> 40
        };
        for _ in 0..20_000 {
            let value = f64::from_bits(random());
            check(&format!("{value:e}"));
            check(&format!("{value:.25e}"));
            let (whole, part) = (random() >> (random() % 64), random() >> (random() % 64));
            check(&format!("{whole}.{part}e{}", random() as i64 % 330));
            check(&format!("{}", (whole as f64 / part as f64) as f32));
            check(&format!("0.{part:020}"));
            // The middle of two floats.
            let float = (whole >> 11 << 1 | 1) as u128;
            check(&format!("{}", float << (random() % 60)));
            check(&format!("{}e-1", (float * 5) << (random() % 60)));
        }
    }
}
