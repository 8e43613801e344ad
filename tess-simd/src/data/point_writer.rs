//! Writing the points of a format to memory.
//!
//! The kernels write points without knowing their layout: pairs of coordinates, or all u in one
//! array and all v in another.
//!
//! ```text
//! pairs    [ u0 v0 | u1 v1 | u2 v2 | ...          Writer
//! apart    [ u0 | u1 | u2 | ...  [ v0 | v1 | v2   ApartWriter, two writers of numbers
//! ```

#[cfg(feature = "apart")]
mod apart;

use crate::data::error::{BatchBuffer, Error};
use crate::data::format::OutputPoint;
use crate::data::target::first;
use crate::data::writer::Writer;

/// Memory for the points of patches, one after another.
pub(crate) trait PointRoom: Sized + Send {
    type Writer<'a>: PointWriter
    where
        Self: 'a;

    /// A writer that begins at the start.
    fn writer(&mut self) -> Self::Writer<'_>;

    /// [`first`], applied to each array.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`].
    fn first(self, needed: usize, more: usize) -> Result<Self, Error>;

    /// The first `points` points, which must exist, and those after them.
    fn split_at(self, points: usize) -> (Self, Self);

    fn len(&self) -> usize;
}

impl<P: OutputPoint> PointRoom for &mut [P] {
    type Writer<'a>
        = Writer<'a, P>
    where
        Self: 'a;

    fn writer(&mut self) -> Writer<'_, P> {
        Writer::new(self)
    }

    #[inline]
    fn first(self, needed: usize, more: usize) -> Result<Self, Error> {
        first(self, BatchBuffer::Points, needed, more)
    }

    fn split_at(self, points: usize) -> (Self, Self) {
        self.split_at_mut(points)
    }

    fn len(&self) -> usize {
        (**self).len()
    }
}

/// Memory for points that is written from front to back. Its methods are those of [`Writer`].
pub(crate) trait PointWriter {
    type Point: OutputPoint;

    /// [`Writer::map`]; `point` may be called twice for the same element.
    fn map<S: Copy, const N: usize>(
        &mut self,
        length: usize,
        source: &[S],
        point: impl Fn(S) -> Self::Point,
    );

    /// [`Writer::map_least`]; `point` may be called twice for the same element.
    fn map_least<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        point: impl Fn(S) -> Self::Point,
    );

    /// [`Writer::blocks`].
    #[cfg(target_arch = "x86_64")]
    fn blocks<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        make: impl Fn(&[S; N]) -> [Self::Point; N],
    );

    /// [`Writer::put`].
    fn put<const N: usize>(&mut self, points: [Self::Point; N]);

    /// Copies the first `period` points until `times` times `period` points are filled. The
    /// writer's position does not matter.
    fn repeat(self, period: usize, times: usize);
}

impl<P: OutputPoint> PointWriter for Writer<'_, P> {
    type Point = P;

    #[inline(always)]
    fn map<S: Copy, const N: usize>(
        &mut self,
        length: usize,
        source: &[S],
        point: impl Fn(S) -> P,
    ) {
        Writer::map::<_, N>(self, length, source, point);
    }

    #[inline(always)]
    fn map_least<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        point: impl Fn(S) -> P,
    ) {
        Writer::map_least::<_, N, LEAST>(self, length, source, point);
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn blocks<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        make: impl Fn(&[S; N]) -> [P; N],
    ) {
        Writer::blocks::<_, N, LEAST>(self, length, source, make);
    }

    #[inline(always)]
    fn put<const N: usize>(&mut self, points: [P; N]) {
        Writer::put(self, points);
    }

    #[inline(always)]
    fn repeat(self, period: usize, times: usize) {
        Writer::copy(self, period, times);
    }
}
