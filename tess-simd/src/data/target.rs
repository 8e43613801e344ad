//! The caller's buffers, in formats that are known at run time.
//!
//! Below the public interface nothing depends on the formats' types, so that everything is compiled
//! once, in this crate, for each pair of formats. [`AnyBuffers::give`] makes them types again, once a call.

use crate::data::error::{Buffer, Error};
use crate::data::format::{AnyIndices, AnyPoints, IndexFormat, OutputPoint};
#[cfg(feature = "apart")]
use crate::data::output::ApartBuffers;
use crate::data::output::{Buffers, PatchRange};
use crate::data::point_writer::PointRoom;

/// Buffers as the caller gives them.
#[derive(Debug)]
pub(crate) struct AnyBuffers<'a> {
    points: AnyPoints<'a>,
    indices: AnyIndices<'a>,
    ranges: Option<&'a mut [PatchRange]>,
}

/// Takes buffers of any formats.
pub(crate) trait Taker {
    type Done;

    fn take<P: PointRoom, I: IndexFormat>(
        self,
        points: P,
        indices: &mut [I],
        ranges: Option<&mut [PatchRange]>,
    ) -> Self::Done;
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

impl AnyBuffers<'_> {
    /// Gives the buffers away.
    #[inline]
    pub(crate) fn give<T: Taker>(self, to: T) -> T::Done {
        let Self { points, indices, ranges } = self;
        match (points, indices) {
            (AnyPoints::F32(points), AnyIndices::U16(indices)) => to.take(points, indices, ranges),
            (AnyPoints::F32(points), AnyIndices::U32(indices)) => to.take(points, indices, ranges),
            (AnyPoints::Fixed(points), AnyIndices::U16(indices)) => {
                to.take(points, indices, ranges)
            }
            (AnyPoints::Fixed(points), AnyIndices::U32(indices)) => {
                to.take(points, indices, ranges)
            }
            #[cfg(feature = "apart")]
            (AnyPoints::F32Apart(points), AnyIndices::U16(indices)) => {
                to.take(points, indices, ranges)
            }
            #[cfg(feature = "apart")]
            (AnyPoints::F32Apart(points), AnyIndices::U32(indices)) => {
                to.take(points, indices, ranges)
            }
        }
    }
}

/// The first `needed` elements of a caller's buffer and up to `more` behind them.
///
/// # Errors
/// [`Error::BufferTooSmall`].
pub(crate) fn first<T>(
    all: &mut [T],
    buffer: Buffer,
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
