//! Writing by whole blocks.
//!
//! Runs of points or indices are written in blocks of a fixed size, so that they compile to
//! vector stores. A run's last block may reach past its end: what it leaves there is overwritten
//! by whatever comes next, and nothing is ever written past the slice. Only where the slice ends
//! within a block is that block cut.

/// A slice that is written from front to back.
#[derive(Debug)]
pub(crate) struct Writer<'a, T> {
    out: &'a mut [T],
    at: usize,
}

impl<'a, T: Copy> Writer<'a, T> {
    /// Writes from the start of `out`.
    #[inline(always)]
    pub(crate) fn new(out: &'a mut [T]) -> Self {
        Self { out, at: 0 }
    }

    /// How much has been written.
    #[inline(always)]
    pub(crate) fn written(&self) -> usize {
        self.at
    }

    /// How much can be written.
    #[inline(always)]
    pub(crate) fn capacity(&self) -> usize {
        self.out.len()
    }

    /// The next `length` elements, in blocks made from the blocks of `source`, which must be long
    /// enough: elements it has no block for stay unwritten.
    #[inline(always)]
    pub(crate) fn map<S, const N: usize>(
        &mut self,
        length: usize,
        source: &[S],
        block: impl Fn(&[S; N]) -> [T; N],
    ) {
        let padded = length.next_multiple_of(N);
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        self.at += length;
        if let Some(room) = room.get_mut(..padded) {
            let sources = source.as_chunks::<N>().0;
            for (target, source) in room.as_chunks_mut::<N>().0.iter_mut().zip(sources) {
                *target = block(source);
            }
        } else {
            write_cut(room, length, source, block);
        }
    }

    /// The next `length` elements, in blocks made from the number of their first element.
    #[inline(always)]
    pub(crate) fn count<const N: usize>(&mut self, length: usize, block: impl Fn(u32) -> [T; N]) {
        let padded = length.next_multiple_of(N);
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        self.at += length;
        let mut first = 0;
        if let Some(room) = room.get_mut(..padded) {
            for target in room.as_chunks_mut::<N>().0 {
                *target = block(first);
                first += N as u32;
            }
        } else {
            for target in room.chunks_mut(N) {
                target.copy_from_slice(&block(first)[..target.len()]);
                first += N as u32;
            }
        }
    }

    /// The next `N` elements.
    #[inline(always)]
    pub(crate) fn put<const N: usize>(&mut self, values: [T; N]) {
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        self.at += N;
        if let Some(target) = room.first_chunk_mut() {
            *target = values;
        }
    }
}

/// A run whose last block reaches past the end of the slice: that block is cut.
#[cold]
#[inline(never)]
fn write_cut<T: Copy, S, const N: usize>(
    room: &mut [T],
    length: usize,
    source: &[S],
    block: impl Fn(&[S; N]) -> [T; N],
) {
    debug_assert!(length <= room.len(), "the output was counted");
    for (target, source) in room.chunks_mut(N).zip(source.as_chunks::<N>().0) {
        target.copy_from_slice(&block(source)[..target.len()]);
    }
}
