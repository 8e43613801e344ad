//! Numbers of 32 bits: one, or eight side by side.
//!
//! Factor processing is written once over [`Numbers`]. At the levels that are chosen at run time it
//! works on one number in a loop, which the compiler turns into the level's vectors. At the
//! baseline it works on the vectors of `wide`, which choose their instructions when the crate is
//! compiled: they are shorter code there, and would be the baseline's instructions at any level.

use crate::data::lanes::{at, at_mut};
use bytemuck::{Pod, must_cast};
use core::ops::{BitAnd, Not, Shl};
use wide::{f32x8, i32x8};

/// One number or several. A number is a signed integer or, under the operations on floats, the bits
/// of a binary32. No operation overflows.
pub(crate) trait Numbers:
    Copy + BitAnd<Output = Self> + Not<Output = Self> + Shl<i32, Output = Self>
{
    /// How many numbers these are. The sizes of rows are multiples of it.
    const COUNT: usize;

    /// The same number in each place.
    fn splat(number: i32) -> Self;

    /// The bits of elements `i` and following of all rows, counted through them.
    fn load<T: Pod, const L: usize, const F: usize>(rows: &[[T; L]; F], i: usize) -> Self;

    /// Writes to elements `i` and following of all rows, counted through them.
    fn store<const L: usize, const F: usize>(self, rows: &mut [[u32; L]; F], i: usize);

    /// All bits where `self > other`, otherwise none.
    fn exceeds(self, other: Self) -> Self;

    /// The greater of both.
    fn or_more(self, other: Self) -> Self;

    /// The smaller of both.
    fn or_less(self, other: Self) -> Self;

    /// The difference of integers.
    fn minus(self, other: Self) -> Self;

    /// The sum of floats, rounded once to the nearest.
    fn float_sum(self, other: f32) -> Self;

    /// The product of floats, rounded once to the nearest.
    fn float_product(self, other: f32) -> Self;
}

#[expect(clippy::float_arithmetic, reason = "each operation is rounded once, the same everywhere")]
impl Numbers for i32 {
    const COUNT: usize = 1;

    #[inline(always)]
    fn splat(number: i32) -> Self {
        number
    }

    #[inline(always)]
    fn load<T: Pod, const L: usize, const F: usize>(rows: &[[T; L]; F], i: usize) -> Self {
        must_cast(at(rows, i))
    }

    #[inline(always)]
    fn store<const L: usize, const F: usize>(self, rows: &mut [[u32; L]; F], i: usize) {
        *at_mut(rows, i) = self.cast_unsigned();
    }

    #[inline(always)]
    fn exceeds(self, other: Self) -> Self {
        -Self::from(self > other)
    }

    #[inline(always)]
    fn or_more(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn or_less(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline(always)]
    fn float_sum(self, other: f32) -> Self {
        (f32::from_bits(self.cast_unsigned()) + other).to_bits().cast_signed()
    }

    #[inline(always)]
    fn float_product(self, other: f32) -> Self {
        (f32::from_bits(self.cast_unsigned()) * other).to_bits().cast_signed()
    }
}

impl Numbers for i32x8 {
    const COUNT: usize = 8;

    #[inline(always)]
    fn splat(number: i32) -> Self {
        Self::splat(number)
    }

    #[inline(always)]
    fn load<T: Pod, const L: usize, const F: usize>(rows: &[[T; L]; F], i: usize) -> Self {
        must_cast(rows.as_flattened().as_chunks::<8>().0[i / 8])
    }

    #[inline(always)]
    fn store<const L: usize, const F: usize>(self, rows: &mut [[u32; L]; F], i: usize) {
        rows.as_flattened_mut().as_chunks_mut::<8>().0[i / 8] = must_cast(self);
    }

    #[inline(always)]
    fn exceeds(self, other: Self) -> Self {
        self.simd_gt(other)
    }

    #[inline(always)]
    fn or_more(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn or_less(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline(always)]
    fn float_sum(self, other: f32) -> Self {
        must_cast(must_cast::<_, f32x8>(self) + f32x8::splat(other))
    }

    #[inline(always)]
    fn float_product(self, other: f32) -> Self {
        must_cast(must_cast::<_, f32x8>(self) * f32x8::splat(other))
    }
}
