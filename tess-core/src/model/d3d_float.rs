//! The few binary32 operations that factors go through before they become integers.
//!
//! Comparisons use bit patterns, which have the order of the numbers as long as no number is
//! negative. A NaN is not greater than anything. Float comparisons would be wrong: compilers may
//! turn them into maximum instructions, and ARM's `fmaxnm` returns a signalling NaN where a
//! comparison takes the other number.

/// The bit pattern of infinity. Greater patterns are NaNs or have the sign bit set.
const INFINITY: u32 = f32::INFINITY.to_bits();

/// Whether a patch with these outer factors is culled, which it is if a factor is zero, negative or
/// NaN. Positive denormals are greater than zero.
pub(crate) fn is_culled(mut outer: impl Iterator<Item = f32>) -> bool {
    !outer.all(|factor| is_greater(factor, 0.0))
}

/// Whether `x > low`. `low` is not negative.
pub(crate) fn is_greater(x: f32, low: f32) -> bool {
    let bits = x.to_bits();
    low.to_bits() < bits && bits <= INFINITY
}

/// Clamps `x` to `low..=high`, neither of which is negative; NaN gives `low`.
pub(crate) fn clamp(x: f32, (low, high): (f32, f32)) -> f32 {
    let bits = x.to_bits();
    let bits = if bits > INFINITY { 0 } else { bits };
    f32::from_bits(bits.max(low.to_bits()).min(high.to_bits()))
}

/// The ceiling of a number of at least 1, infinity included.
///
/// Adding the mask of the fraction bits carries into the exponent where the ceiling is the next
/// power of two. No overflow: the largest number below 2^23 becomes 2^23.
pub(crate) fn ceil(x: f32) -> f32 {
    const INTEGERS_ONLY_FROM: f32 = 8_388_608.0; // 2^23
    debug_assert!(x >= 1.0, "rounding follows clamping or cleaning");
    if x >= INTEGERS_ONLY_FROM {
        return x;
    }
    let exponent = (x.to_bits() >> 23) - 127; // 0..=22
    let fraction_mask = (1 << (23 - exponent)) - 1;
    f32::from_bits((x.to_bits() + fraction_mask) & !fraction_mask)
}

/// The smallest power of two that is not below `x`, which is at least 1: adding the mask of the
/// mantissa carries into the exponent if the mantissa is not zero. Numbers above 2^127 give
/// infinity, and so does infinity.
pub(crate) fn next_power_of_two(x: f32) -> f32 {
    const MANTISSA: u32 = 0x007F_FFFF;
    debug_assert!(x >= 1.0, "rounding follows cleaning");
    f32::from_bits((x.to_bits() + MANTISSA) & !MANTISSA)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_up() {
        let cases = [
            (1.0, 1.0, 1.0),
            (f32::from_bits(0x3F80_0001), 2.0, 2.0),
            (2.5, 3.0, 4.0),
            (63.000_004, 64.0, 64.0),
            (64.0, 64.0, 64.0),
            (8_388_607.5, 8_388_608.0, 8_388_608.0),
            (16_777_217.0, 16_777_216.0, 16_777_216.0),
            (f32::MAX, f32::MAX, f32::INFINITY),
            (f32::INFINITY, f32::INFINITY, f32::INFINITY),
        ];
        for (x, integer, power) in cases {
            assert_eq!(ceil(x).to_bits(), integer.to_bits(), "ceil({x})");
            assert_eq!(next_power_of_two(x).to_bits(), power.to_bits(), "power of two of {x}");
        }
    }

    #[test]
    fn clamping_takes_nan_to_the_low_end() {
        // Hidden from the compiler, which would compute the results itself.
        let low_ones = [0x7FC0_0000, 0xFFC0_0000, 0x7F80_0001, 0xFF80_0000, 0x8000_0000, 1];
        for bits in core::hint::black_box(low_ones) {
            let clamped = clamp(f32::from_bits(bits), (2.0, 64.0));
            assert_eq!(clamped.to_bits(), 2.0f32.to_bits(), "binary32 {bits:#010x}");
        }
        assert_eq!(clamp(f32::INFINITY, (2.0, 64.0)).to_bits(), 64.0f32.to_bits(), "infinity");
    }
}
