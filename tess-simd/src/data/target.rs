//! The caller's buffers, in formats that are known at run time.
//!
//! The public interface turns the formats' types into values, so that this crate compiles the code
//! below it once for each pair of formats. [`with_types`] turns them into types again, once per
//! call.

use crate::data::error::{BatchBuffer, Error};
use crate::data::format::{AnyIndices, AnyPoints, IndexFormat, OutputPoint};
#[cfg(feature = "apart")]
use crate::data::output::ApartBuffers;
use crate::data::output::{Buffers, PatchRange};

/// The buffers that the caller gave.
#[derive(Debug)]
pub(crate) struct AnyBuffers<'a> {
    pub(crate) points: AnyPoints<'a>,
    pub(crate) indices: AnyIndices<'a>,
    pub(crate) ranges: Option<&'a mut [PatchRange]>,
}

impl<'a, P: OutputPoint, I: IndexFormat> From<Buffers<'a, P, I>> for AnyBuffers<'a> {
    fn from(Buffers { points, indices, ranges }: Buffers<'a, P, I>) -> Self {
        Self { points: P::any(points), indices: I::any(indices), ranges }
    }
}

#[cfg(feature = "apart")]
impl<'a, I: IndexFormat> From<ApartBuffers<'a, I>> for AnyBuffers<'a> {
    fn from(ApartBuffers { u, v, indices, ranges }: ApartBuffers<'a, I>) -> Self {
        Self { points: AnyPoints::F32Apart([u, v]), indices: I::any(indices), ranges }
    }
}

/// Runs an expression with the points, indices and optional ranges of [`AnyBuffers`], in their
/// types.
macro_rules! with_types {
    ($buffers:expr, |$points:ident, $indices:ident, $ranges:ident| $run:expr) => {{
        use $crate::data::format::{AnyIndices::*, AnyPoints::*};
        let $crate::data::target::AnyBuffers { points, indices, ranges: $ranges } = $buffers;
        match (points, indices) {
            (F32($points), U16($indices)) => $run,
            (F32($points), U32($indices)) => $run,
            (Fixed($points), U16($indices)) => $run,
            (Fixed($points), U32($indices)) => $run,
            #[cfg(feature = "apart")]
            (F32Apart($points), U16($indices)) => $run,
            #[cfg(feature = "apart")]
            (F32Apart($points), U32($indices)) => $run,
        }
    }};
}
pub(crate) use with_types;

/// The first `needed` elements of a caller's buffer, and up to `more` elements after them.
///
/// # Errors
/// [`Error::BufferTooSmall`].
pub(crate) fn first<T>(
    all: &mut [T],
    buffer: BatchBuffer,
    needed: usize,
    more: usize,
) -> Result<&mut [T], Error> {
    let got = all.len();
    let end = got.min(needed + more);
    if got < needed {
        Err(Error::BufferTooSmall { buffer, needed, got })
    } else {
        Ok(&mut all[..end])
    }
}
