//! Reciprocals without a table, so that a vector of them is a vector division (spec section 2).

use tess_core::fixed_point::ONE;

/// 1/n with 16 fraction bits, rounded to the nearest, for `n` in 1..=64: `(ONE + n / 2) / n`.
///
/// `ONE / n` is at least 1/128 away from the middle of two integers, and its binary32 value is
/// wrong by at most 2^-9. Adding 2^23 therefore rounds it to the right integer and leaves that in
/// the mantissa.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "the rounding of the sum is the one that is asked for")]
pub(crate) fn reciprocal(n: u32) -> u32 {
    let quotient = to_f32(ONE) / to_f32(n);
    (quotient + TWO_POW_23).to_bits() & MANTISSA
}

/// An integer below 2^24, exactly.
#[inline(always)]
#[expect(clippy::cast_possible_wrap, reason = "below 2^24; signed conversions are one instruction")]
pub(crate) const fn to_f32(x: u32) -> f32 {
    x as i32 as f32
}

/// From this number to twice this number, the binary32 numbers are exactly the integers.
pub(crate) const TWO_POW_23: f32 = 8_388_608.0;
/// The mantissa bits of a binary32.
pub(crate) const MANTISSA: u32 = 0x007F_FFFF;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reciprocal() {
        for n in 1..=64 {
            assert_eq!(Some(reciprocal(n)), tess_core::reciprocal::reciprocal(n), "1/{n}");
        }
    }
}
