//! All u in one array, all v in another.
//!
//! # The simpler forms
//!
//! Writing pairs and separating them afterwards goes through memory twice: a batch takes 1.2 to 1.4
//! times as long as with pairs only. Two passes over each run of points, one for each array, begin
//! and end two loops: 1.4 times as long at factor 16.

use super::{PointRoom, PointWriter};
use crate::data::error::{BatchBuffer, Error};
use crate::data::target::first;
use crate::data::writer::{Writer, separate_blocks};
use core::array;

/// An array of u and an array of v, of equal length.
impl PointRoom for [&mut [f32]; 2] {
    type Writer<'a>
        = ApartWriter<'a>
    where
        Self: 'a;

    fn writer(&mut self) -> ApartWriter<'_> {
        let [u, v] = self.each_mut().map(|array| Writer::new(array));
        ApartWriter { u, v }
    }

    #[inline]
    fn first(self, needed: usize, more: usize) -> Result<Self, Error> {
        let [u, v] = self.map(|array| first(array, BatchBuffer::Points, needed, more));
        Ok([u?, v?])
    }

    fn split_at(self, points: usize) -> (Self, Self) {
        let [(u, more_u), (v, more_v)] = self.map(|array| array.split_at_mut(points));
        ([u, v], [more_u, more_v])
    }

    fn len(&self) -> usize {
        let [u, v] = self;
        u.len().min(v.len())
    }
}

/// Writes all u to one array and all v to another.
#[derive(Debug)]
pub(crate) struct ApartWriter<'a> {
    u: Writer<'a, f32>,
    v: Writer<'a, f32>,
}

impl PointWriter for ApartWriter<'_> {
    type Point = [f32; 2];

    #[inline(always)]
    fn map<S: Copy, const N: usize>(
        &mut self,
        length: usize,
        source: &[S],
        point: impl Fn(S) -> [f32; 2],
    ) {
        self.map_least::<_, BLOCK, BLOCK>(length, source, point);
    }

    #[inline(always)]
    fn map_least<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        point: impl Fn(S) -> [f32; 2],
    ) {
        self.write::<_, N, LEAST>(length, source, |block| apart(block, &point));
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn blocks<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        make: impl Fn(&[S; N]) -> [[f32; 2]; N],
    ) {
        self.write::<_, N, LEAST>(length, source, |block| apart(&make(block), |point| point));
    }

    #[inline(always)]
    fn put<const N: usize>(&mut self, points: [[f32; 2]; N]) {
        self.u.put(points.map(|[u, _]| u));
        self.v.put(points.map(|[_, v]| v));
    }

    #[inline(always)]
    fn repeat(self, period: usize, times: usize) {
        self.u.copy(period, times);
        self.v.copy(period, times);
    }
}

/// Points of a run that are written at a time. In each array they fill as many bytes as eight
/// pairs.
const BLOCK: usize = 16;

impl ApartWriter<'_> {
    /// Writes the next `length` points; `make` makes the coordinates of a block. Runs of at most
    /// `LEAST` points are all written as `LEAST` if there is room, without a branch on the length.
    #[inline(always)]
    fn write<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        make: impl Fn(&[S; N]) -> [[f32; N]; 2],
    ) {
        let (u, v) = (self.u.take(length), self.v.take(length));
        if length <= LEAST
            && let (Some(u), Some(v)) = (u.first_chunk_mut::<LEAST>(), v.first_chunk_mut::<LEAST>())
            && let Some(source) = source.first_chunk::<LEAST>()
        {
            return write_blocks(u, v, source, make);
        }
        let padded = length.next_multiple_of(N);
        match (u.get_mut(..padded), v.get_mut(..padded), source.get(..padded)) {
            (Some(u), Some(v), Some(source)) => write_blocks(u, v, source, make),
            _ => write_cut(u, v, source, make),
        }
    }
}

/// Writes whole blocks.
#[inline(always)]
fn write_blocks<S: Copy, const N: usize>(
    u: &mut [f32],
    v: &mut [f32],
    source: &[S],
    make: impl Fn(&[S; N]) -> [[f32; N]; 2],
) {
    let arrays = u.as_chunks_mut().0.iter_mut().zip(v.as_chunks_mut().0);
    for ((u, v), block) in arrays.zip(source.as_chunks().0) {
        let [made_u, made_v] = make(block);
        (*u, *v) = (made_u, made_v);
        separate_blocks();
    }
}

/// The coordinates of the points that are made from a block: all u, all v.
#[inline(always)]
fn apart<S: Copy, const N: usize>(block: &[S; N], point: impl Fn(S) -> [f32; 2]) -> [[f32; N]; 2] {
    let [mut all_u, mut all_v] = [[0.0; N]; 2];
    for ((u, v), &from) in all_u.iter_mut().zip(&mut all_v).zip(block) {
        [*u, *v] = point(from);
    }
    [all_u, all_v]
}

/// Writes as many points as the arrays and the source have, and cuts the last block.
#[cold]
#[inline(never)]
fn write_cut<S: Copy, const N: usize>(
    u: &mut [f32],
    v: &mut [f32],
    source: &[S],
    make: impl Fn(&[S; N]) -> [[f32; N]; 2],
) {
    for ((u, v), source) in u.chunks_mut(N).zip(v.chunks_mut(N)).zip(source.chunks(N)) {
        let last = source.len() - 1;
        let [from_u, from_v] = make(&array::from_fn(|i| source[i.min(last)]));
        let points = from_u.into_iter().zip(from_v).take(source.len());
        for ((u, v), point) in u.iter_mut().zip(v).zip(points) {
            (*u, *v) = point;
        }
    }
}
