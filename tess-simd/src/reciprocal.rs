//! Reciprocals without a table, so that a vector of them is a vector division (spec section 2).

use tess_core::fixed_point::ONE;

/// 1/n with 16 fraction bits, rounded half up, for `n` in 1..=64: `(ONE + n / 2) / n`.
///
/// The quotient of two integers below 2^17 and 2^7 lies at least 1/64 below the next integer or
/// on it; binary32 keeps it to 2^-8, so the truncated quotient is exact.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "exact after truncation, as shown above")]
pub(crate) fn reciprocal(n: u32) -> u32 {
    let quotient = to_f32(ONE + n / 2) / to_f32(n);
    truncate(quotient)
}

/// An integer below 2^24, exactly.
#[inline(always)]
#[expect(clippy::cast_possible_wrap, reason = "below 2^24; signed conversions are one instruction")]
pub(crate) const fn to_f32(x: u32) -> f32 {
    x as i32 as f32
}

/// The integer part of a number in 0..2^23.
///
/// Adding 2^23 rounds to an integer, which then stands in the mantissa; where that rounded up, one
/// is taken off again.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "sums below 2^24 round to the nearest integer")]
fn truncate(x: f32) -> u32 {
    let rounded = x + TWO_POW_23;
    let integer = rounded.to_bits() & MANTISSA;
    integer - u32::from(rounded - TWO_POW_23 > x)
}

/// From here on to its double, binary32 numbers are exactly the integers.
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
