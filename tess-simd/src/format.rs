//! What points and indices look like in memory.

use crate::reciprocal::to_f32;
use tess_core::DomainPoint;

/// A point format: [`DomainPoint`] (16.16 pairs) or `[f32; 2]`.
pub trait PointFormat: sealed::Sealed + Copy + Default + Send + Sync + 'static {
    /// The point with these 16.16 coordinates, each in `0..=ONE`. Exact; beyond that range
    /// unspecified.
    #[must_use]
    fn from_bits(u: u32, v: u32) -> Self;
}

/// An index format: `u16` or `u32`.
pub trait IndexFormat: sealed::Sealed + Copy + Default + Send + Sync + 'static {
    /// The largest index.
    const LARGEST: u64;

    /// The index, modulo 2^16 or 2^32.
    #[must_use]
    fn wrapping_from(index: u32) -> Self;

    /// A row position from a stitch table: its sign is extended.
    #[must_use]
    fn from_code(code: i8) -> Self;

    /// The sum, modulo 2^16 or 2^32.
    #[must_use]
    fn wrapping_add(self, other: Self) -> Self;

    /// Bitwise exclusive or.
    #[must_use]
    fn xor(self, other: Self) -> Self;
}

mod sealed {
    /// Keeps the formats to those that the kernels were compared with the core in.
    #[expect(unnameable_types, reason = "that is what seals them")]
    pub trait Sealed {}
    impl Sealed for tess_core::DomainPoint {}
    impl Sealed for [f32; 2] {}
    impl Sealed for u16 {}
    impl Sealed for u32 {}
}

impl PointFormat for DomainPoint {
    #[inline(always)]
    fn from_bits(u: u32, v: u32) -> Self {
        Self::from_bits(u, v)
    }
}

impl PointFormat for [f32; 2] {
    /// A product of a number of at most 17 bits and a power of two is exact.
    #[inline(always)]
    #[expect(clippy::float_arithmetic, reason = "an exact scaling by a power of two")]
    fn from_bits(u: u32, v: u32) -> Self {
        const TWO_POW_MINUS_16: f32 = 1.0 / 65536.0;
        [to_f32(u) * TWO_POW_MINUS_16, to_f32(v) * TWO_POW_MINUS_16]
    }
}

macro_rules! index_format {
    ($format:ty) => {
        impl IndexFormat for $format {
            const LARGEST: u64 = <$format>::MAX as u64;

            #[inline(always)]
            #[allow(
                clippy::cast_possible_truncation,
                trivial_numeric_casts,
                reason = "modulo, as documented; one of the two formats is u32 itself"
            )]
            fn wrapping_from(index: u32) -> Self {
                index as Self
            }

            #[inline(always)]
            #[expect(clippy::cast_sign_loss, reason = "the sign bits are wanted")]
            fn from_code(code: i8) -> Self {
                code as Self
            }

            #[inline(always)]
            fn wrapping_add(self, other: Self) -> Self {
                self.wrapping_add(other)
            }

            #[inline(always)]
            fn xor(self, other: Self) -> Self {
                self ^ other
            }
        }
    };
}
index_format!(u16);
index_format!(u32);
