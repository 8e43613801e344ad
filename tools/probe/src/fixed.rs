//! Coordinates as a device gives them, and as 16.16 numbers.

use crate::capture::Captured;
use tess_core::fixed_point::ONE;
use tess_core::{DomainPoint, Tessellation};

/// The 16.16 number that a binary32 of these bits is, if it is one in 0..=1.
pub(crate) fn fixed(bits: u32) -> Option<u32> {
    let exponent = bits >> 23;
    let mantissa = bits & 0x7F_FFFF | 1 << 23;
    match exponent {
        0 if bits == 0 => Some(0),
        // 2^-16 has exponent 111, 1 has 127.
        111..=127 => {
            let below = 134 - exponent;
            let number = mantissa >> below;
            (number << below == mantissa && number <= ONE).then_some(number)
        }
        _ => None,
    }
}

/// A captured patch as an output: each vertex a point of its own, in the order of the primitives;
/// `None` if a coordinate is no 16.16 number in 0..=1.
pub(crate) fn output(captured: &Captured) -> Option<Tessellation> {
    let point = |&[u, v, _]: &[u32; 3]| Some(DomainPoint::from_bits(fixed(u)?, fixed(v)?));
    let points: Vec<_> = captured.vertices.iter().map(point).collect::<Option<_>>()?;
    let indices = (0..).take(points.len()).collect();
    Some(Tessellation { points, indices })
}

#[cfg(test)]
mod tests {
    use super::*;
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
