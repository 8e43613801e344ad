//! What points and indices look like in memory.

use crate::dispatch;
use crate::level::Level;
use crate::part::Blocks;
use crate::reciprocal::to_f32;
use crate::stitch::Stitches;
use tess_core::{Config, DomainPoint};

/// A point format: [`DomainPoint`] (16.16 pairs) or `[f32; 2]`.
pub trait PointFormat: sealed::PointKernels + Copy + Default + Send + Sync + 'static {
    /// The point with these 16.16 coordinates, each in `0..=ONE`. Exact; beyond that range
    /// unspecified.
    #[must_use]
    fn from_bits(u: u32, v: u32) -> Self;
}

/// An index format: `u16` or `u32`.
pub trait IndexFormat: sealed::IndexKernels + Copy + Default + Send + Sync + 'static {
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

/// [`dispatch::emit`] for each pair of formats. Whoever calls it for formats of its own choice uses
/// the instances of this crate, where generic ones would be compiled anew in every crate.
mod sealed {
    use super::{Blocks, Config, Level, PointFormat, Stitches};

    /// A call of a kernel.
    #[derive(Debug)]
    #[expect(unnameable_types, reason = "keeps its private parts from the public traits")]
    pub struct Call<'a, P, I> {
        pub(crate) level: Level,
        pub(crate) config: Config,
        pub(crate) stitches: &'a Stitches,
        pub(crate) blocks: Blocks<'a, P, I>,
    }

    #[expect(unnameable_types, reason = "keeps the formats to those compared with the core")]
    pub trait PointKernels: Sized {
        fn emit_u16(call: Call<'_, Self, u16>) -> (u32, u32);
        fn emit_u32(call: Call<'_, Self, u32>) -> (u32, u32);
    }

    #[expect(unnameable_types, reason = "keeps the formats to those compared with the core")]
    pub trait IndexKernels: Sized {
        fn emit<P: PointFormat>(call: Call<'_, P, Self>) -> (u32, u32);
    }
}

pub(crate) use sealed::Call;

macro_rules! point_kernels {
    ($format:ty) => {
        impl sealed::PointKernels for $format {
            fn emit_u16(call: Call<'_, Self, u16>) -> (u32, u32) {
                dispatch::emit(call.level, call.config, call.stitches, call.blocks)
            }

            fn emit_u32(call: Call<'_, Self, u32>) -> (u32, u32) {
                dispatch::emit(call.level, call.config, call.stitches, call.blocks)
            }
        }
    };
}
point_kernels!(DomainPoint);
point_kernels!([f32; 2]);

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
    ($format:ty, $emit:ident) => {
        impl sealed::IndexKernels for $format {
            fn emit<P: PointFormat>(call: Call<'_, P, Self>) -> (u32, u32) {
                P::$emit(call)
            }
        }

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
index_format!(u16, emit_u16);
index_format!(u32, emit_u32);
