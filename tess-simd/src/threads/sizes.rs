//! The sizes of slices, and the outputs that are large enough for another thread.

use crate::data::lanes::LANES;

/// Slices for each thread: several, so that threads that are done can help the others.
const SLICES_PER_THREAD: usize = 4;

/// The cut of a batch into slices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slicing {
    /// Patches of each slice; the last one may have fewer. A whole number of packets if there are
    /// enough patches.
    pub(crate) patches: usize,
    /// The number of slices.
    pub(crate) slices: usize,
}

impl Slicing {
    /// The most slices of a batch on this many threads.
    pub(crate) const fn most(threads: usize) -> usize {
        if threads == 1 { 1 } else { threads * SLICES_PER_THREAD }
    }

    /// The cut of this many patches for this many threads.
    pub(crate) fn new(patches: usize, threads: usize) -> Self {
        let slice = patches.div_ceil(Self::most(threads)).max(1);
        let slice = if slice < LANES { slice } else { slice.next_multiple_of(LANES) };
        Self { patches: slice, slices: patches.div_ceil(slice) }
    }
}

/// The least output per thread. A thread writes this much in about 8 microseconds and takes 4 to
/// wake, so two threads are never slower than one.
#[cfg(any(test, feature = "rayon"))]
const BYTES_PER_THREAD: u64 = 256 << 10;

/// How many of `threads` threads write an output of this size: at least one.
#[cfg(any(test, feature = "rayon"))]
pub(crate) fn worth_waking(bytes: u64, threads: usize) -> usize {
    let most = usize::try_from(bytes / BYTES_PER_THREAD).unwrap_or(usize::MAX);
    most.clamp(1, threads)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slices(patches: usize, threads: usize) -> (usize, usize) {
        let slicing = Slicing::new(patches, threads);
        (slicing.patches, slicing.slices)
    }

    #[test]
    fn slices_are_whole_blocks_and_several_a_thread() {
        assert_eq!(slices(0, 1), (1, 0), "nothing");
        assert_eq!(slices(5, 1), (5, 1), "one thread takes all");
        assert_eq!(slices(1000, 1), (1008, 1), "rounded up to packets");
        assert_eq!(slices(1000, 2), (128, 8), "four slices for each thread");
        assert_eq!(slices(96, 2), (12, 8), "fewer than a packet each");
        assert_eq!(slices(128, 2), (16, 8), "a packet each");
        assert_eq!(slices(3, 4), (1, 3), "a patch each");
    }

    /// The second thread joins at 512 KiB; all threads run at 256 KiB for each.
    #[test]
    fn threads_follow_the_size() {
        let threads = |kib: u64, most| worth_waking(kib << 10, most);
        assert_eq!([threads(0, 2), threads(511, 2), threads(512, 2)], [1, 1, 2], "two threads");
        assert_eq!([threads(1024, 16), threads(4095, 16)], [4, 15], "some of sixteen");
        assert_eq!([threads(4096, 16), threads(65_536, 16)], [16, 16], "all of sixteen");
        assert_eq!(worth_waking(u64::MAX, 1), 1, "no more than there are");
    }
}
