//! Fixed-point numbers and the one conversion from floating point (spec section 2).
//!
//! What a user gets in 16.16, coordinates and locations, has the type `U16F16` of `fixed`, with its
//! arithmetic, conversions and printing. Computations are on plain `u32`, because the specification
//! is one of words: a factor has 31 bits and saturates, a product is rounded to nearest where `*`
//! of `fixed` truncates, and comparisons with shaders and circuits are of words.

use fixed::types::U16F16;

/// One, in 16.16 bits.
pub const ONE: u32 = 0x1_0000;
/// One half.
pub const HALF: u32 = 0x8000;
/// One third, rounded down.
pub const ONE_THIRD: u32 = 0x5555;
/// Two thirds, rounded down.
pub const TWO_THIRDS: u32 = 0xAAAA;

/// A tessellation factor as an unsigned 15.16 number.
///
/// Every binary32 converts to a value of this type; after clamping only 1..=64 occurs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct FixedFactor(u32);

impl FixedFactor {
    /// The factor 1.
    pub const ONE: Self = Self(ONE);
    /// All 31 bits set. Factors of 2^15 and more saturate to it.
    pub const MAX: Self = Self(0x7FFF_FFFF);

    /// The factor with these 15.16 bits. The top bit is ignored.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits & Self::MAX.0)
    }

    /// The 15.16 bits; the top bit is zero.
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }

    /// The same number in the type of the domain points.
    #[must_use]
    pub const fn to_fixed(self) -> U16F16 {
        U16F16::from_bits(self.0)
    }

    /// Rounds a binary32 to the nearest multiple of 2^-16, ties to even, using only its bits.
    ///
    /// NaN, negative numbers and -0 give 0; 2^15 and more give [`FixedFactor::MAX`]. Spec section
    /// 2.
    #[must_use]
    pub const fn from_f32(value: f32) -> Self {
        let bits = value.to_bits();
        const INFINITY: u32 = 0x7F80_0000;
        // As unsigned numbers, NaNs and all patterns with a sign bit are above positive infinity.
        if bits > INFINITY {
            return Self(0);
        }
        let exponent = bits >> 23;
        let mantissa = (bits & 0x007F_FFFF) | 0x0080_0000;
        // value = mantissa * 2^(exponent - 150), so in units of 2^-16 the shift is exponent - 134.
        match exponent {
            0..=109 => Self(0), // below 2^-17: rounds to zero
            110..=134 => Self(shift_right_nearest_even(mantissa, 134 - exponent)),
            135..=141 => Self(mantissa << (exponent - 134)), // below 2^15: fits 31 bits
            _ => Self::MAX,
        }
    }
}

/// `value >> shift`, rounded to nearest, ties to even. `value < 2^24`, `shift <= 24`: no overflow.
const fn shift_right_nearest_even(value: u32, shift: u32) -> u32 {
    if shift == 0 {
        return value;
    }
    let quotient = value >> shift;
    let remainder = value & ((1 << shift) - 1);
    let half = 1 << (shift - 1);
    let round_up = remainder > half || (remainder == half && quotient & 1 == 1);
    quotient + round_up as u32
}

/// The integer part, still in 16.16: `x & 0x7FFF0000`.
#[must_use]
pub const fn floor(x: u32) -> u32 {
    x & 0x7FFF_0000
}

/// The smallest integer that is not below `x`, still in 16.16. No overflow for `x <= 0x7FFF0000`.
#[must_use]
pub const fn ceil(x: u32) -> u32 {
    floor(x + 0xFFFF)
}

/// The binary32 value of a domain coordinate, `bits / 65536`, built from its bits.
///
/// Exact below 256, because a number of at most 24 bits fits a binary32 mantissa; coordinates are
/// at most one. Larger numbers are rounded toward zero.
#[must_use]
pub const fn coordinate_to_f32(coordinate: U16F16) -> f32 {
    let bits = coordinate.to_bits();
    if bits == 0 {
        return 0.0;
    }
    let top = 31 - bits.leading_zeros(); // 0..=16 for coordinates
    let mantissa = (bits << bits.leading_zeros() >> 8) & 0x007F_FFFF;
    f32::from_bits(((top + 127 - 16) << 23) | mantissa)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conversion_edge_cases() {
        let cases: &[(u32, u32)] = &[
            (0x7FC0_0000, 0),           // NaN
            (0xFFC0_0000, 0),           // negative NaN
            (0x7F80_0001, 0),           // signalling NaN
            (0x8000_0000, 0),           // -0
            (0xBF80_0000, 0),           // -1
            (0x0000_0001, 0),           // smallest denormal
            (0x36FF_FFFF, 0),           // just below 2^-17
            (0x3700_0000, 0),           // 2^-17: tie, to even
            (0x3700_0001, 1),           // just above 2^-17
            (0x3F80_0000, 0x1_0000),    // 1
            (0x3F80_0040, 0x1_0000),    // 1 + 2^-17: tie, to even
            (0x3F80_0041, 0x1_0001),    // above the tie
            (0x3F80_00C0, 0x1_0002),    // 1 + 3 * 2^-17: tie, to even
            (0x4280_0000, 0x40_0000),   // 64
            (0x46FF_FFFF, 0x7FFF_FF80), // just below 2^15
            (0x4700_0000, 0x7FFF_FFFF), // 2^15
            (0x7F80_0000, 0x7FFF_FFFF), // infinity
        ];
        for &(bits, expected) in cases {
            let fixed = FixedFactor::from_f32(f32::from_bits(bits)).to_bits();
            assert_eq!(fixed, expected, "binary32 {bits:#010x}: {fixed:#x}");
        }
    }

    /// Compares with exact arithmetic in binary64 and its own rounding.
    #[test]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the independent oracle is written in binary64"
    )]
    fn conversion_equals_exact_arithmetic() {
        for bits in (0x3000_0000u32..0x4800_0000).step_by(9973) {
            let scaled = f64::from(f32::from_bits(bits)) * 65536.0;
            let expected = scaled.round_ties_even().min(f64::from(0x7FFF_FFFFu32)) as u32;
            let fixed = FixedFactor::from_f32(f32::from_bits(bits)).to_bits();
            assert_eq!(fixed, expected, "binary32 {bits:#010x}");
        }
    }

    #[test]
    fn coordinates_convert_exactly() {
        for bits in 0..=ONE {
            let float = coordinate_to_f32(U16F16::from_bits(bits));
            let back = U16F16::from_num(float);
            assert_eq!(back.to_bits(), bits, "coordinate {bits:#x} became {float}");
        }
        for (bits, float) in [(0x1_0001, 1.000_015_3), (u32::MAX, 65536.0_f32.next_down())] {
            let found = coordinate_to_f32(U16F16::from_bits(bits));
            assert_eq!(found.to_bits(), f32::to_bits(float), "{bits:#x} is no coordinate");
        }
    }
}
