//! Formats of points and indices in memory.

use tess_core::DomainPoint;

/// A type that points are written as: `[f32; 2]`, or [`DomainPoint`] with two 16.16 numbers. Both
/// are exact.
///
/// `tess-gpu` calls the first `PointFormat::F32`. C calls them `TESS_POINT_F32` and
/// `TESS_POINT_FIXED`. The shaders' packed format, in which each point has its patch's number, does
/// not exist here.
pub trait OutputPoint: sealed::Point + Copy + Default + Send + Sync + 'static {
    /// The point with these 16.16 coordinates. Exact if each is in `0..=ONE`, otherwise
    /// unspecified.
    #[must_use]
    fn from_bits(u: u32, v: u32) -> Self;
}

/// An index format: `u16` or `u32`.
///
/// `tess-gpu` calls them `IndexType::U16` and `IndexType::U32`; C calls them `TESS_INDEX_U16` and
/// `TESS_INDEX_U32`.
///
/// The largest index, 65535 or 2^32 - 1, restarts primitives in WebGL 2, and in other interfaces if
/// primitive restart is on. Batches write it like any other index. To avoid it with
/// [`Numbering::PerBatch`](crate::Numbering::PerBatch), keep `base_vertex` plus the batch's points
/// at or below [`IndexFormat::POINTS_WITHOUT_RESTART`]. A single patch never needs it.
pub trait IndexFormat: sealed::Index + Copy + Default + Send + Sync + 'static {
    /// The largest index.
    const LARGEST: u64;

    /// The number of points that can be numbered from 0 without the largest index: 65 535, or
    /// 2^32 - 1.
    const POINTS_WITHOUT_RESTART: u64 = Self::LARGEST;

    /// The index, modulo 2^16 or 2^32.
    #[must_use]
    fn wrapping_from(index: u32) -> Self;
}

/// Methods of the formats for the kernels. The module is private, so only formats that are compared
/// with the core implement them.
mod sealed {
    use tess_core::DomainPoint;

    #[expect(unnameable_types, reason = "keeps the formats to those compared with the core")]
    pub trait Point: Sized {
        /// The bits of one coordinate in this format, from a 16.16 number in `0..=ONE`.
        fn coordinate(bits: u32) -> u32;

        /// The point with these coordinates.
        fn from_coordinates(coordinates: [u32; 2]) -> Self;

        /// The same points, as a format that is known at run time.
        fn any(points: &mut [Self]) -> AnyPoints<'_>;
    }

    #[expect(unnameable_types, reason = "keeps the formats to those compared with the core")]
    pub trait Index: Sized {
        /// The same indices, as a format that is known at run time.
        fn any(indices: &mut [Self]) -> AnyIndices<'_>;

        /// A code from a stitch table, with its sign extended.
        fn from_code(code: i8) -> Self;

        /// The sum, modulo 2^16 or 2^32.
        fn wrapping_add(self, other: Self) -> Self;

        /// Bitwise exclusive or.
        fn xor(self, other: Self) -> Self;
    }

    /// Points of a format that is known at run time.
    #[derive(Debug)]
    #[expect(unnameable_types, reason = "for the kernels alone")]
    pub enum AnyPoints<'a> {
        F32(&'a mut [[f32; 2]]),
        Fixed(&'a mut [DomainPoint]),
        /// An array of u and an array of v, of equal length.
        #[cfg(feature = "apart")]
        F32Apart([&'a mut [f32]; 2]),
    }

    /// Indices of a format that is known at run time.
    #[derive(Debug)]
    #[expect(unnameable_types, reason = "for the kernels alone")]
    pub enum AnyIndices<'a> {
        U16(&'a mut [u16]),
        U32(&'a mut [u32]),
    }
}

pub(crate) use sealed::{AnyIndices, AnyPoints};

impl sealed::Point for [f32; 2] {
    /// The binary32 numbers from 128 to 256 are the multiples of 2^-16, so the mantissa of `128 +
    /// x` is `x` in 16.16.
    #[inline(always)]
    #[expect(
        clippy::float_arithmetic,
        reason = "a difference of multiples of 2^-16 below 2^8 is exact"
    )]
    fn coordinate(bits: u32) -> u32 {
        const FROM: f32 = 128.0;
        (f32::from_bits(FROM.to_bits() | bits) - FROM).to_bits()
    }

    #[inline(always)]
    fn from_coordinates([u, v]: [u32; 2]) -> Self {
        [f32::from_bits(u), f32::from_bits(v)]
    }

    fn any(points: &mut [Self]) -> AnyPoints<'_> {
        AnyPoints::F32(points)
    }
}

impl OutputPoint for [f32; 2] {
    #[inline(always)]
    fn from_bits(u: u32, v: u32) -> Self {
        let coordinate = <Self as sealed::Point>::coordinate;
        <Self as sealed::Point>::from_coordinates([coordinate(u), coordinate(v)])
    }
}

impl sealed::Point for DomainPoint {
    #[inline(always)]
    fn coordinate(bits: u32) -> u32 {
        bits
    }

    #[inline(always)]
    fn from_coordinates([u, v]: [u32; 2]) -> Self {
        Self::from_bits(u, v)
    }

    fn any(points: &mut [Self]) -> AnyPoints<'_> {
        AnyPoints::Fixed(points)
    }
}

impl OutputPoint for DomainPoint {
    #[inline(always)]
    fn from_bits(u: u32, v: u32) -> Self {
        Self::from_bits(u, v)
    }
}

macro_rules! index_format {
    ($format:ty, $any:ident) => {
        impl sealed::Index for $format {
            fn any(indices: &mut [Self]) -> AnyIndices<'_> {
                AnyIndices::$any(indices)
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
        }
    };
}
index_format!(u16, U16);
index_format!(u32, U32);
