//! Output: points, indices, and each patch's ranges of them.

use crate::data::format::{IndexFormat, OutputPoint};
use alloc::vec::Vec;
use tess_core::DomainPoint;

/// The point that indices count from.
///
/// `tess-gpu` has the same names; its batches count from 0. C calls them
/// `TESS_NUMBERING_PER_PATCH` and `TESS_NUMBERING_PER_BATCH`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Numbering {
    /// Indices count from each patch's first point, as in the core. 16 bits are always enough.
    PerPatch,
    /// Indices count from the batch's first point, so that all patches share one vertex buffer.
    /// Where primitive restart is on, see [`IndexFormat`] for the number of points.
    PerBatch {
        /// Number of the first point of the batch.
        base_vertex: u32,
    },
}

impl Numbering {
    /// The numbering of the part of a batch that begins at this point.
    #[must_use]
    pub const fn behind(self, first_point: u32) -> Self {
        match self {
            Self::PerPatch => self,
            Self::PerBatch { .. } => Self::PerBatch { base_vertex: self.base(first_point) },
        }
    }

    /// The index of a patch's first point, which is point `first_point` of the batch.
    #[inline(always)]
    pub(crate) const fn base(self, first_point: u32) -> u32 {
        match self {
            Self::PerPatch => 0,
            Self::PerBatch { base_vertex } => base_vertex.wrapping_add(first_point),
        }
    }
}

/// The place of one patch's output. A culled patch has no points and no indices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(C)]
pub struct PatchRange {
    /// Number of the patch's first point in the batch's points.
    pub first_point: u32,
    /// Number of its points, at most 4225.
    pub points: u32,
    /// Number of the patch's first index in the batch's indices.
    pub first_index: u32,
    /// Number of its indices, at most 24576.
    pub indices: u32,
}

/// Output sizes of a batch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BatchCounts {
    /// Patches, culled ones included: elements of the range buffer.
    pub patches: usize,
    /// Elements of the point buffer.
    pub points: usize,
    /// Elements of the index buffer.
    pub indices: usize,
}

/// The caller's buffers. They may be larger than needed; elements after the output keep their
/// values.
#[derive(Debug)]
#[non_exhaustive]
pub struct Buffers<'a, P = [f32; 2], I = u32> {
    /// Receives the points of all patches, one patch after another.
    pub points: &'a mut [P],
    /// Receives the indices of all patches, one patch after another.
    pub indices: &'a mut [I],
    /// Receives one range for each patch, if ranges are wanted.
    pub ranges: Option<&'a mut [PatchRange]>,
}

impl<'a, P: OutputPoint, I: IndexFormat> Buffers<'a, P, I> {
    /// Buffers for points and indices; ranges are not written.
    #[must_use]
    pub const fn new(points: &'a mut [P], indices: &'a mut [I]) -> Self {
        Self { points, indices, ranges: None }
    }

    /// The same buffers and one for ranges.
    #[must_use]
    pub const fn with_ranges(self, ranges: &'a mut [PatchRange]) -> Self {
        Self { ranges: Some(ranges), ..self }
    }
}

/// [`Buffers`] whose points are in two arrays, all u and all v, as binary32. The points are the
/// same as with [`Buffers`] of `[f32; 2]`.
///
/// C calls the format `TESS_POINT_F32_APART`. It needs the feature `apart`.
#[cfg(feature = "apart")]
#[derive(Debug)]
#[non_exhaustive]
pub struct ApartBuffers<'a, I = u32> {
    /// Receives the u of all points, one patch after another.
    pub u: &'a mut [f32],
    /// Receives the v of the same points.
    pub v: &'a mut [f32],
    /// Receives the indices of all patches, one patch after another.
    pub indices: &'a mut [I],
    /// Receives one range for each patch, if ranges are wanted.
    pub ranges: Option<&'a mut [PatchRange]>,
}

#[cfg(feature = "apart")]
impl<'a, I: IndexFormat> ApartBuffers<'a, I> {
    /// Buffers for points and indices; ranges are not written.
    #[must_use]
    pub const fn new(u: &'a mut [f32], v: &'a mut [f32], indices: &'a mut [I]) -> Self {
        Self { u, v, indices, ranges: None }
    }

    /// The same buffers and one for ranges.
    #[must_use]
    pub const fn with_ranges(self, ranges: &'a mut [PatchRange]) -> Self {
        Self { ranges: Some(ranges), ..self }
    }
}

/// Buffers that grow as needed and keep their memory. Batches no larger than earlier ones allocate
/// nothing.
///
/// Points and indices begin on cache lines, which makes AVX-512 write batches up to a fourth
/// faster.
#[derive(Clone, Debug)]
pub struct Output<P = [f32; 2], I = u32> {
    points: Aligned<P>,
    indices: Aligned<I>,
    ranges: Aligned<PatchRange>,
}

/// An output of 16.16 points and 32-bit indices, the core's formats.
pub type ExactOutput = Output<DomainPoint, u32>;

impl<P: OutputPoint, I: IndexFormat> Output<P, I> {
    /// An empty output that has no memory yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { points: Aligned::new(), indices: Aligned::new(), ranges: Aligned::new() }
    }

    /// The points of all patches of the last batch, one patch after another.
    #[must_use]
    pub fn points(&self) -> &[P] {
        self.points.get()
    }

    /// The indices of all patches of the last batch, one patch after another.
    #[must_use]
    pub fn indices(&self) -> &[I] {
        self.indices.get()
    }

    /// The range of each patch of the last batch.
    #[must_use]
    pub fn ranges(&self) -> &[PatchRange] {
        self.ranges.get()
    }

    /// The points and the indices of patch `i` of the last batch; `None` if it has no such patch.
    #[must_use]
    pub fn patch(&self, i: usize) -> Option<(&[P], &[I])> {
        let range = self.ranges().get(i)?;
        let points = self.points().get(range.first_point as usize..)?;
        let indices = self.indices().get(range.first_index as usize..)?;
        let points = points.get(..range.points as usize)?;
        let indices = indices.get(..range.indices as usize)?;
        Some((points, indices))
    }

    /// Room for a batch of these sizes.
    pub(crate) fn make_room(&mut self, counts: BatchCounts) -> Buffers<'_, P, I> {
        Buffers {
            points: self.points.make_room(counts.points),
            indices: self.indices.make_room(counts.indices),
            ranges: Some(self.ranges.make_room(counts.patches)),
        }
    }
}

impl<P: OutputPoint, I: IndexFormat> Default for Output<P, I> {
    fn default() -> Self {
        Self::new()
    }
}

/// Elements that begin on a cache line if possible, in a vector that never shrinks.
#[derive(Clone, Debug)]
struct Aligned<T> {
    all: Vec<T>,
    first: usize,
    length: usize,
}

impl<T: Copy + Default> Aligned<T> {
    const fn new() -> Self {
        Self { all: Vec::new(), first: 0, length: 0 }
    }

    fn get(&self) -> &[T] {
        self.all.get(self.first..self.first + self.length).unwrap_or_default()
    }

    /// Room for this many elements.
    fn make_room(&mut self, length: usize) -> &mut [T] {
        const CACHE_LINE: usize = 64;
        let spare = CACHE_LINE / size_of::<T>();
        if self.all.len() < length + spare {
            self.all.resize(length + spare, T::default());
        }
        let first = self.all.as_ptr().align_offset(CACHE_LINE);
        self.first = if first <= spare { first } else { 0 };
        self.length = length;
        &mut self.all[self.first..self.first + length]
    }
}
