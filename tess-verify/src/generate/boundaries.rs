//! The factors at which the result changes.

use super::from_fixed;

/// Every factor at which the result changes: the boundaries of levels 1 and 2, exceptional factors
/// and special ones.
#[must_use]
pub fn boundary_factors() -> Vec<f32> {
    [ordinary_factors(), exceptional_factors(), special_factors()].concat()
}

/// Every integer and half-integer from 1 to 64, each with its neighbours at 2^-16 and at one unit
/// in the last place, and the ties of the fixed-point conversion next to every integer.
pub(super) fn ordinary_factors() -> Vec<f32> {
    let mut factors = Vec::new();
    for half in 2..=128 {
        let fixed = half << 15;
        let exact = from_fixed(fixed);
        factors.extend([
            from_fixed(fixed - 1),
            f32::from_bits(exact.to_bits() - 1),
            exact,
            f32::from_bits(exact.to_bits() + 1),
            from_fixed(fixed + 1),
        ]);
    }
    for integer in 1..=63 {
        // Half a unit above an even and above an odd multiple of 2^-16: ties that round down and
        // up.
        factors.extend([tie_above(integer << 16), tie_above((integer << 16) + 1)]);
    }
    factors
}

/// The number halfway between a 15.16 number and the next, both at least 1; it is exact in
/// binary32.
fn tie_above(fixed: u32) -> f32 {
    let low = from_fixed(fixed).to_bits();
    let high = from_fixed(fixed + 1).to_bits();
    f32::from_bits(low + (high - low) / 2)
}

/// Values that are not usable factors, and values at the limits of the format.
pub(super) fn special_factors() -> Vec<f32> {
    [
        0x0000_0000, // 0
        0x8000_0000, // -0
        0x0000_0001, // smallest denormal
        0x007F_FFFF, // largest denormal
        0x8000_0001, // negative denormal
        0x0080_0000, // smallest normal
        0x3F00_0000, // 0.5
        0x3F7F_FFFF, // just below 1
        0xBF80_0000, // -1
        0xC2C8_0000, // -100
        0x4282_0000, // 65
        0x4700_0000, // 2^15
        0x7F7F_FFFF, // largest finite
        0x7F80_0000, // infinity
        0xFF80_0000, // -infinity
        0x7FC0_0000, // NaN
        0xFFC0_0000, // NaN with a sign
        0x7F80_0001, // signalling NaN
    ]
    .map(f32::from_bits)
    .to_vec()
}

/// Factors just above an integer, where rounded reciprocals make neighbouring locations coincide
/// or, for larger factors, change places (spec section 12).
pub(super) fn exceptional_factors() -> Vec<f32> {
    let mut factors = Vec::new();
    for integer in 2..=62 {
        for excess in [1, 2, 5, 0x40, 0xB2, 0x19E, 0x300] {
            factors.push(from_fixed((integer << 16) + excess));
        }
    }
    factors
}
