//! Coordinates as a device gives them, and as 16.16 numbers.

use tess_core::fixed_point::ONE;

/// The 16.16 number that a binary32 of these bits is, if it is one in 0..=1.
#[must_use]
pub const fn fixed(bits: u32) -> Option<u32> {
    let exponent = bits >> 23;
    let mantissa = bits & 0x7F_FFFF | 1 << 23;
    match exponent {
        0 if bits == 0 => Some(0),
        // 2^-16 has exponent 111, 1 has 127.
        111..=127 => {
            let below = 134 - exponent;
            let number = mantissa >> below;
            if number << below == mantissa && number <= ONE { Some(number) } else { None }
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::DomainPoint;
    use tess_core::fixed_point::coordinate_to_f32;

    #[test]
    fn every_coordinate_is_its_own_number() {
        for number in 0..=ONE {
            let float = coordinate_to_f32(DomainPoint::from_bits(number, 0).u);
            assert_eq!(fixed(float.to_bits()), Some(number));
        }
    }

    #[test]
    fn other_numbers_are_none() {
        for float in [-0.0, -1.0, 1.000_001, 0.5 + 1e-7, 1e-6, f32::NAN, f32::INFINITY, 2.0] {
            assert_eq!(fixed(float.to_bits()), None, "{float}");
        }
    }
}
