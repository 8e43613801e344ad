//! How points lie in a caller's buffer: in pairs of coordinates, or with all u before all v.

use crate::boundary::{self, Memory};
use crate::status::{TESS_TOO_LARGE, TessStatus};
use std::ffi::c_void;
use std::fmt::Debug;
use std::mem::MaybeUninit;
use tess_simd::{Level, OutputPoint, at_each_level};

/// A caller's memory for points, which need not be initialised.
pub(super) trait PointRoom<'a>: Debug + Sized {
    /// What the batch backend writes.
    type Point: OutputPoint;
    /// Whether it writes them to the caller's memory itself.
    const IS_DIRECT: bool;

    /// Memory for `capacity` points.
    ///
    /// # Safety
    /// - As for [`boundary::room`], with the bytes of `capacity` points.
    unsafe fn new(pointer: *mut c_void, capacity: usize) -> Result<Self, TessStatus>;

    /// The points that it has room for.
    fn len(&self) -> usize;

    /// The room of the first points and the rest; `None` if it is smaller.
    fn split_at(self, points: usize) -> Option<(Self, Self)>;

    /// Has `write` write `points` points, and gives what it gives. It gets up to `overrun` more, which it may
    /// overwrite. A room of fewer points gets as many as it has.
    fn write<R>(
        self,
        points: usize,
        overrun: usize,
        memory: Memory,
        pairs: &mut Pairs,
        write: impl FnOnce(&mut [Self::Point]) -> R,
    ) -> R;
}

/// Points in pairs of coordinates.
#[derive(Debug)]
pub(super) struct Together<'a, P>(&'a mut [MaybeUninit<P>]);

impl<'a, P: OutputPoint + Debug> PointRoom<'a> for Together<'a, P> {
    type Point = P;
    const IS_DIRECT: bool = true;

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

    fn write<R>(
        self,
        points: usize,
        overrun: usize,
        memory: Memory,
        _: &mut Pairs,
        write: impl FnOnce(&mut [P]) -> R,
    ) -> R {
        let end = self.0.len().min(points + overrun);
        write(boundary::initialised(&mut self.0[..end], memory, P::default()))
    }
}

/// The coordinates of points in two arrays of one length.
#[derive(Debug)]
pub(super) struct Apart<'a> {
    u: &'a mut [MaybeUninit<f32>],
    v: &'a mut [MaybeUninit<f32>],
}

impl<'a> PointRoom<'a> for Apart<'a> {
    type Point = [f32; 2];
    const IS_DIRECT: bool = false;

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

    fn write<R>(
        self,
        points: usize,
        overrun: usize,
        _: Memory,
        pairs: &mut Pairs,
        write: impl FnOnce(&mut [[f32; 2]]) -> R,
    ) -> R {
        let written = write(pairs.room(points + overrun));
        let end = self.u.len().min(points.next_multiple_of(BLOCK).min(points + overrun));
        take_apart(pairs.level, pairs.room(end), &mut self.u[..end], &mut self.v[..end]);
        written
    }
}

/// Memory for points that are then taken apart. It grows to the most points that were asked for.
#[derive(Debug)]
pub(super) struct Pairs {
    level: Level,
    memory: Vec<[f32; 2]>,
}

impl Pairs {
    /// None yet; they are taken apart at a CPU level that this machine can run.
    pub(super) const fn new(level: Level) -> Self {
        Self { level, memory: Vec::new() }
    }

    /// Takes memory for as many, which is not touched before it is used.
    pub(super) fn reserve(&mut self, points: usize) {
        self.memory.reserve(points.saturating_sub(self.memory.len()));
    }

    fn room(&mut self, points: usize) -> &mut [[f32; 2]] {
        if self.memory.len() < points {
            self.memory.resize(points, [0.0; 2]);
        }
        &mut self.memory[..points]
    }
}

/// Points that are taken apart at once.
const BLOCK: usize = 16;

at_each_level! {
    /// Writes the coordinates of points, as many as all three have, to two arrays.
    fn take_apart(
        pairs: &[[f32; 2]],
        u: &mut [MaybeUninit<f32>],
        v: &mut [MaybeUninit<f32>],
    ) = blocks_apart;
}

#[inline(always)]
fn blocks_apart(pairs: &[[f32; 2]], u: &mut [MaybeUninit<f32>], v: &mut [MaybeUninit<f32>]) {
    let (blocks, rest) = pairs.as_chunks::<BLOCK>();
    let (u_blocks, u_rest) = u.as_chunks_mut::<BLOCK>();
    let (v_blocks, v_rest) = v.as_chunks_mut::<BLOCK>();
    for ((block, u), v) in blocks.iter().zip(u_blocks).zip(v_blocks) {
        *u = block.map(|[u, _]| MaybeUninit::new(u));
        *v = block.map(|[_, v]| MaybeUninit::new(v));
    }
    for ((&[from_u, from_v], u), v) in rest.iter().zip(u_rest).zip(v_rest) {
        u.write(from_u);
        v.write(from_v);
    }
}
