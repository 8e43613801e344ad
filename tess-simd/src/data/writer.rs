//! Writing by whole blocks.
//!
//! Runs of points or indices are written in blocks of a fixed size, so that they compile to vector
//! stores. A run's last block may reach past the run; the next run overwrites those elements.
//! Nothing is ever written past the slice: a block that would reach past it is cut.

use core::sync::atomic::{Ordering, compiler_fence};

/// Bytes that are copied at a time: few enough to be read from the first-level cache.
const COPIED: usize = 4096;

/// At this many bytes and above, output leaves the caches and is copied by `memcpy`, which can
/// avoid reading the memory that it overwrites. Both sides of a copy of [`LARGE_COPIED`] bytes fit
/// the first-level cache.
const LARGE: usize = 1 << 20;
const LARGE_COPIED: usize = 16 << 10;

/// A slice that is written from front to back.
#[derive(Debug)]
pub(crate) struct Writer<'a, T> {
    out: &'a mut [T],
    at: usize,
}

impl<'a, T: Copy + Default> Writer<'a, T> {
    /// Writes from the start of `out`.
    #[inline(always)]
    pub(crate) fn new(out: &'a mut [T]) -> Self {
        Self { out, at: 0 }
    }

    /// Writes the next `length` elements in blocks of `N`, each made from the element of `source`
    /// with the same number. If `source` is shorter, the rest stays unwritten.
    #[inline(always)]
    pub(crate) fn map<S: Copy, const N: usize>(
        &mut self,
        length: usize,
        source: &[S],
        element: impl Fn(S) -> T,
    ) {
        self.map_least::<_, N, N>(length, source, element);
    }

    /// [`Self::map`], with one branch for all lengths up to `LEAST`, a multiple of `N`: for these
    /// it writes `LEAST` elements if there is room.
    #[inline(always)]
    pub(crate) fn map_least<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        element: impl Fn(S) -> T,
    ) {
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        // The position moves by the true length: what is written past it belongs to the next run.
        self.at += length;
        // Lengths are hard to predict, but nearly all are at most `LEAST`: then this branch always
        // goes the same way, and a block too many costs less than a misprediction.
        if length <= LEAST
            && let (Some(target), Some(source)) =
                (room.first_chunk_mut::<LEAST>(), source.first_chunk::<LEAST>())
        {
            write_blocks::<_, _, N>(target, source, element);
            return;
        }
        // One check for the whole run. After it, both sides are whole blocks and no loop has a
        // bounds check.
        let padded = length.next_multiple_of(N);
        match (room.get_mut(..padded), source.get(..padded)) {
            (Some(target), Some(source)) => write_blocks::<_, _, N>(target, source, element),
            _ => write_cut(room, source, element),
        }
    }

    /// Writes the next `length` elements, each block made from a block of `source`. Writes
    /// multiples of `LEAST` elements if there is room, so that most patches need no branch on their
    /// length.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(crate) fn blocks<S: Copy, const N: usize, const LEAST: usize>(
        &mut self,
        length: usize,
        source: &[S],
        make: impl Fn(&[S; N]) -> [T; N],
    ) {
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        self.at += length;
        let padded = length.next_multiple_of(LEAST);
        let (Some(whole), Some(source)) = (room.get_mut(..padded), source.get(..padded)) else {
            write_cut_blocks(room, source, make);
            return;
        };
        let groups = source.as_chunks::<LEAST>().0;
        for (target, group) in whole.as_chunks_mut::<LEAST>().0.iter_mut().zip(groups) {
            let blocks = group.as_chunks::<N>().0;
            for (target, block) in target.as_chunks_mut::<N>().0.iter_mut().zip(blocks) {
                *target = make(block);
            }
            separate_blocks();
        }
    }

    /// Writes the next `length` elements in blocks of `N`, each made from its number.
    #[inline(always)]
    pub(crate) fn count<const N: usize>(&mut self, length: usize, element: impl Fn(u32) -> T) {
        let padded = length.next_multiple_of(N);
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        self.at += length;
        let mut number = 0;
        if room.len() < padded {
            for target in room {
                *target = element(number);
                number += 1;
            }
            return;
        }
        for target in room[..padded].as_chunks_mut::<N>().0 {
            let mut made = [T::default(); N];
            for made in &mut made {
                *made = element(number);
                number += 1;
            }
            *target = made;
            separate_blocks();
        }
    }

    /// Writes the next `N` elements.
    #[inline(always)]
    pub(crate) fn put<const N: usize>(&mut self, values: [T; N]) {
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        self.at += N;
        if let Some(target) = room.first_chunk_mut() {
            *target = values;
        }
    }
}

/// Methods that do not need a default element.
impl<'a, T: Copy> Writer<'a, T> {
    /// The rest of the slice; its first `length` elements then count as written.
    #[cfg(feature = "apart")]
    #[inline(always)]
    pub(crate) fn take(&mut self, length: usize) -> &mut [T] {
        let room = self.out.get_mut(self.at..).unwrap_or_default();
        self.at += length;
        room
    }

    /// Fills `times` times `period` elements of the slice from its first `period` elements.
    /// `moved(x, n)` makes an element from the element `x` that is `n` periods before it.
    #[inline(always)]
    pub(crate) fn repeat(self, period: usize, times: usize, moved: impl Fn(T, u32) -> T) {
        fill(self.out, period, times, COPIED, |to, from, patches| {
            for (to, &from) in to.iter_mut().zip(from) {
                *to = moved(from, patches);
            }
        });
    }

    /// [`Self::repeat`] with unchanged elements.
    #[inline(always)]
    pub(crate) fn copy(self, period: usize, times: usize) {
        if period * times * size_of::<T>() < LARGE {
            self.repeat(period, times, |element, _| element);
        } else {
            fill(self.out, period, times, LARGE_COPIED, |to, from, _| to.copy_from_slice(from));
        }
    }
}

/// Writes whole blocks.
#[inline(always)]
fn write_blocks<S: Copy, T: Copy + Default, const N: usize>(
    target: &mut [T],
    source: &[S],
    element: impl Fn(S) -> T,
) {
    for (target, block) in target.as_chunks_mut::<N>().0.iter_mut().zip(source.as_chunks().0) {
        *target = make(block, &element);
        separate_blocks();
    }
}

/// A block made from another, element by element.
#[inline(always)]
fn make<S: Copy, T: Copy + Default, const N: usize>(
    block: &[S; N],
    element: impl Fn(S) -> T,
) -> [T; N] {
    let mut made = [T::default(); N];
    for (made, &from) in made.iter_mut().zip(block) {
        *made = element(from);
    }
    made
}

/// Writes the last elements of a slice that ends within a block.
#[cold]
#[inline(never)]
fn write_cut<S: Copy, T>(room: &mut [T], source: &[S], element: impl Fn(S) -> T) {
    for (target, &from) in room.iter_mut().zip(source) {
        *target = element(from);
    }
}

/// The last blocks of a slice that ends within one.
#[cfg(target_arch = "x86_64")]
#[cold]
#[inline(never)]
fn write_cut_blocks<S: Copy, T: Copy, const N: usize>(
    room: &mut [T],
    source: &[S],
    make: impl Fn(&[S; N]) -> [T; N],
) {
    for (room, block) in room.chunks_mut(N).zip(source.as_chunks::<N>().0) {
        room.copy_from_slice(&make(block)[..room.len()]);
    }
}

/// [`Writer::repeat`], at most `copied` bytes or one period at a time. `copy` gets the elements to
/// fill, the elements to make them from, and the distance between the two in periods.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
fn fill<T>(
    all: &mut [T],
    period: usize,
    times: usize,
    copied: usize,
    copy: impl Fn(&mut [T], &[T], u32),
) {
    // In each turn: `made` elements are right, a whole number of periods. The next ones are made
    // from the first `periods` of them, so what is copied doubles until it is `most`, and the
    // source stays in the first-level cache.
    let Some(all) = all.get_mut(..period * times) else { return };
    let most = (copied / size_of::<T>()).max(period);
    let mut made = period;
    while made < all.len() {
        let (source, rest) = all.split_at_mut(made);
        let periods = made.min(most) / period;
        let patches = (made / period) as u32;
        let length = rest.len().min(periods * period);
        copy(&mut rest[..length], &source[..length], patches);
        made += length;
    }
}

/// Makes the compiler turn each block into vectors rather than the loop over blocks: it does not
/// vectorise loops that contain a fence. The fence compiles to no instruction.
#[inline(always)]
pub(crate) fn separate_blocks() {
    compiler_fence(Ordering::AcqRel);
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// A period of which several are copied at a time, and one that is copied singly.
    #[test]
    fn large_copies() {
        for period in [7, LARGE_COPIED / 8 + 1] {
            let times = LARGE / 8 / period + 1;
            let mut all: Vec<u64> = (0..=period * times).map(|i| i as u64).collect();
            Writer::new(&mut all).copy(period, times);
            let last = all.pop();
            assert!((0..).zip(&all).all(|(i, &made)| made == i % period as u64), "{period}");
            assert_eq!(last, Some((period * times) as u64), "what is behind them");
        }
    }
}
