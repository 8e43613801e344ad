//! The number of segments that a standard derives from a level.

use super::standard::Specification;
use crate::case::Case;
use tess_core::{Domain, Partitioning};

/// The largest level. A Vulkan device may support larger ones, but is given no level above this.
const LARGEST: f32 = 64.0;

/// A level of a patch and the spacing that applies to it. The level is not NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    pub(super) raw: f32,
    pub(super) spacing: Partitioning,
    pub(super) is_inner: bool,
}

impl Level {
    /// Outer level `number`; `None` if it is NaN. The number of isolines always has equal
    /// spacing.
    pub(super) fn outer(case: &Case, number: usize) -> Option<Self> {
        let raw = case.factors.outer().nth(number).filter(|level| !level.is_nan())?;
        let is_density = case.domain() == Domain::Isoline && number == 0;
        let spacing = if is_density { Partitioning::Integer } else { case.config.partitioning };
        Some(Self { raw, spacing, is_inner: false })
    }

    /// Inner level `number`; `None` if it is NaN.
    pub(super) fn inner(case: &Case, number: usize) -> Option<Self> {
        let raw = case.factors.inside().nth(number).filter(|level| !level.is_nan())?;
        Some(Self { raw, spacing: case.config.partitioning, is_inner: true })
    }

    /// The level clamped to the spacing's range.
    pub(super) fn clamped(self) -> f32 {
        match self.spacing {
            Partitioning::Integer | Partitioning::Pow2 => self.raw.clamp(1.0, LARGEST),
            Partitioning::FractionalEven => self.raw.clamp(2.0, LARGEST),
            Partitioning::FractionalOdd => self.raw.clamp(1.0, LARGEST.next_down().floor()),
        }
    }

    /// The clamped level, rounded up to an integer of the spacing's parity, if it has one. An
    /// inner level of 1 counts as the next higher number, because the patch has an inside.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a ceiling from 1 to 64, exact in binary32"
    )]
    pub(super) fn segments(self) -> u32 {
        let n = self.clamped().ceil() as u32;
        let n = if self.is_inner { n.max(2) } else { n };
        match self.spacing {
            Partitioning::Integer | Partitioning::Pow2 => n,
            Partitioning::FractionalEven => n.next_multiple_of(2),
            Partitioning::FractionalOdd => n | 1,
        }
    }

    /// Whether two of the segments may be shorter than the others.
    pub(super) fn is_fractional(self) -> bool {
        !self.spacing.has_integer_factors()
    }

    /// The clamped level in units of 2^-16, rounded down.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::float_arithmetic,
        reason = "a level from 1 to 64, scaled by a power of two"
    )]
    pub(super) fn fixed(self) -> u32 {
        (self.clamped() * 65536.0) as u32
    }
}

/// Whether all levels are 1 after clamping, so that the patch has no inside.
pub(super) fn is_minimum(case: &Case) -> bool {
    case.domain() != Domain::Isoline
        && case.config.partitioning != Partitioning::FractionalEven
        && case.factors.iter().all(|level| level <= 1.0 || level.is_nan())
}

/// Whether vertices inside may be on the outline: with fractional odd spacing, if an inner level is
/// not above 1. In Direct3D, levels up to 1 + 8/65536 count too, because their locations round to
/// the outline.
pub(super) fn may_touch_outline(case: &Case, specification: Specification) -> bool {
    const ROUNDED: f32 = f32::from_bits(0x3F80_0400);
    let highest = if specification == Specification::D3d11 { ROUNDED } else { 1.0 };
    case.config.partitioning == Partitioning::FractionalOdd
        && case.factors.inside().any(|level| level <= highest || level.is_nan())
}

/// Whether Direct3D allows only one 15.16 number for each level (specification, section 13): the
/// nearest one must be the only one within 0.6 units.
pub(super) fn has_one_conversion(case: &Case) -> bool {
    let is_clear = |level: f32| {
        let bits = level.to_bits();
        let (exponent, mantissa) = (bits >> 23, bits & 0x7F_FFFF);
        match exponent {
            // From 1 to 64, 7 to 2 bits of the fraction are below 2^-16.
            127..=132 => {
                let below = 134 - exponent;
                let tenths = 10 * (mantissa & ((1 << below) - 1));
                !(4 << below..=6 << below).contains(&tenths)
            }
            _ => true,
        }
    };
    case.config.partitioning.has_integer_factors() || case.factors.iter().all(is_clear)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A level that is 0.4 to 0.6 units above a 15.16 number has two legal conversions; where
    /// levels are rounded to integers, each has one.
    #[test]
    fn conversions_are_counted() {
        let case = |spacing: &str, bits: u32| -> Case {
            let line = format!("case isoline {spacing} line ruler 3f800000 {bits:08x}");
            line.parse().expect("a case")
        };
        // 1 + k 2^-23 is k/128 units above 1: 0.4 is at 51.2, 0.6 at 76.8.
        for (k, is_clear) in
            [(0, true), (51, true), (52, false), (64, false), (76, false), (77, true)]
        {
            let bits = 0x3F80_0000 + k;
            assert_eq!(has_one_conversion(&case("fractional_odd", bits)), is_clear, "1 + {k} ulp");
            assert!(has_one_conversion(&case("integer", bits)), "{k}: rounded up");
        }
        // Above 32 an ulp is a quarter of a unit.
        let above_32 = |k: u32| has_one_conversion(&case("fractional_even", 0x4200_0000 + k));
        assert_eq!([0, 1, 2, 3, 4].map(above_32), [true, true, false, true, true]);
        assert!(has_one_conversion(&case("fractional_even", 0x4280_0020)), "clamped to 64");
    }
}
