//! Layouts of points in a caller's buffer: pairs of coordinates, or all u before all v.

use crate::boundary::{self, MemoryState};
use crate::status::{TESS_TOO_LARGE, TessStatus};
use std::ffi::c_void;
use std::fmt::Debug;
use std::mem::MaybeUninit;
use tess_core::{Counts, PatchFactors};
use tess_simd::{
    ApartBuffers, BatchCounts, Buffers, Counted, Error, IndexFormat, Numbering, OutputPoint,
    PatchRange, Tessellator,
};

/// A caller's memory for points, which need not be initialised.
pub(super) trait PointRoom<'a>: Debug + Sized {
    /// The coordinates of one point.
    type Point;

    /// Memory for `capacity` points.
    ///
    /// # Safety
    /// - As for [`boundary::room`], with the bytes of `capacity` points.
    unsafe fn new(pointer: *mut c_void, capacity: usize) -> Result<Self, TessStatus>;

    /// The number of points that it has room for.
    fn len(&self) -> usize;

    /// The room of the first `points` points, and the rest; `None` if there are fewer.
    fn split_at(self, points: usize) -> Option<(Self, Self)>;

    /// Writes a counted batch.
    ///
    /// # Errors
    /// Those of [`Counted::write`].
    fn batch<I: IndexFormat>(
        self,
        memory: MemoryState,
        counted: &mut Counted<'_>,
        numbering: Numbering,
        rest: (&mut [I], Option<&mut [PatchRange]>),
    ) -> Result<BatchCounts, Error>;

    /// Writes a patch.
    ///
    /// # Errors
    /// Those of [`Tessellator::patch`].
    fn patch<I: IndexFormat>(
        self,
        memory: MemoryState,
        tessellator: &mut Tessellator,
        factors: impl Into<PatchFactors>,
        indices: &mut [I],
    ) -> Result<Counts, Error>;
}

/// Points in pairs of coordinates.
#[derive(Debug)]
pub(super) struct Together<'a, P>(&'a mut [MaybeUninit<P>]);

impl<'a, P: OutputPoint + Debug> PointRoom<'a> for Together<'a, P> {
    type Point = P;

    unsafe fn new(pointer: *mut c_void, capacity: usize) -> Result<Self, TessStatus> {
        // SAFETY: as the caller promises.
        unsafe { boundary::room(pointer.cast(), capacity) }.map(Self)
    }

    fn len(&self) -> usize {
        self.0.len()
    }

    fn split_at(self, points: usize) -> Option<(Self, Self)> {
        self.0.split_at_mut_checked(points).map(|(first, rest)| (Self(first), Self(rest)))
    }

    fn batch<I: IndexFormat>(
        self,
        memory: MemoryState,
        counted: &mut Counted<'_>,
        numbering: Numbering,
        (indices, ranges): (&mut [I], Option<&mut [PatchRange]>),
    ) -> Result<BatchCounts, Error> {
        let points = boundary::initialised(self.0, memory, P::default());
        let mut buffers = Buffers::new(points, indices);
        buffers.ranges = ranges;
        counted.write(numbering, buffers)
    }

    #[inline(always)]
    fn patch<I: IndexFormat>(
        self,
        memory: MemoryState,
        tessellator: &mut Tessellator,
        factors: impl Into<PatchFactors>,
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        let points = boundary::initialised(self.0, memory, P::default());
        tessellator.patch(factors, points, indices)
    }
}

/// The coordinates of points in two arrays of equal length.
#[derive(Debug)]
pub(super) struct Apart<'a> {
    u: &'a mut [MaybeUninit<f32>],
    v: &'a mut [MaybeUninit<f32>],
}

impl<'a> Apart<'a> {
    fn initialised(self, memory: MemoryState) -> [&'a mut [f32]; 2] {
        [self.u, self.v].map(|array| boundary::initialised(array, memory, 0.0))
    }
}

impl<'a> PointRoom<'a> for Apart<'a> {
    type Point = [f32; 2];

    unsafe fn new(pointer: *mut c_void, capacity: usize) -> Result<Self, TessStatus> {
        let floats = capacity.checked_mul(2).ok_or(TESS_TOO_LARGE)?;
        // SAFETY: a point is two floats; the rest as the caller promises.
        let (u, v) = unsafe { boundary::room(pointer.cast(), floats) }?.split_at_mut(capacity);
        Ok(Self { u, v })
    }

    fn len(&self) -> usize {
        self.u.len()
    }

    fn split_at(self, points: usize) -> Option<(Self, Self)> {
        let (u, rest_u) = self.u.split_at_mut_checked(points)?;
        let (v, rest_v) = self.v.split_at_mut_checked(points)?;
        Some((Self { u, v }, Self { u: rest_u, v: rest_v }))
    }

    fn batch<I: IndexFormat>(
        self,
        memory: MemoryState,
        counted: &mut Counted<'_>,
        numbering: Numbering,
        (indices, ranges): (&mut [I], Option<&mut [PatchRange]>),
    ) -> Result<BatchCounts, Error> {
        let [u, v] = self.initialised(memory);
        let mut buffers = ApartBuffers::new(u, v, indices);
        buffers.ranges = ranges;
        counted.write_apart(numbering, buffers)
    }

    #[inline(always)]
    fn patch<I: IndexFormat>(
        self,
        memory: MemoryState,
        tessellator: &mut Tessellator,
        factors: impl Into<PatchFactors>,
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        let [u, v] = self.initialised(memory);
        tessellator.patch_apart(factors, u, v, indices)
    }
}
