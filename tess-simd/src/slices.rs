//! A batch cut into slices, and the slices shared among threads.
//!
//! The cut depends on the batch's length and the number of threads alone, and every slice has its
//! own part of the buffers, so the output does not depend on which thread writes it.

use crate::batch::Batch;
use crate::counts::PartCounts;
use crate::dispatch;
use crate::lanes::LANES;
use crate::part::Part;
use crate::setup::Setup;

/// Slices for each thread: so many that shares of equal output can be made of them.
const SLICES_PER_THREAD: usize = 4;

/// How a batch is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slicing {
    /// Patches of each slice but the last, which may have fewer. Whole blocks where there are enough
    /// patches.
    pub(crate) patches: usize,
    /// The number of slices.
    pub(crate) slices: usize,
}

impl Slicing {
    /// The slices of this many patches for a number of threads.
    pub(crate) fn new(patches: usize, threads: usize) -> Self {
        let wanted = if threads == 1 { 1 } else { threads * SLICES_PER_THREAD };
        let slice = patches.div_ceil(wanted).max(1);
        let slice = if slice < LANES { slice } else { slice.next_multiple_of(LANES) };
        Self { patches: slice, slices: patches.div_ceil(slice) }
    }
}

/// Consecutive slices of a batch to count.
#[derive(Debug)]
pub(crate) struct CountShare<'a> {
    pub(crate) batch: Batch<'a>,
    /// Patches of each slice but the last.
    pub(crate) slice: usize,
    /// Receives the counts of each slice.
    pub(crate) counts: &'a mut [PartCounts],
}

impl CountShare<'_> {
    /// Counts them, slice by slice.
    pub(crate) fn count(self, setup: &Setup) {
        let patches = self.batch.len();
        for (number, counts) in self.counts.iter_mut().enumerate() {
            let first = number * self.slice;
            let slice = self.batch.slice(&(first..patches.min(first + self.slice)));
            *counts = dispatch::count(setup.level, setup.config, &slice);
        }
    }

    /// Cuts them in two.
    #[cfg(feature = "rayon")]
    pub(crate) fn halve(self) -> (Self, Self) {
        let Self { batch, slice, counts } = self;
        let (left, right) = counts.split_at_mut(counts.len() / 2);
        let (first, second) = cut(batch, left.len() * slice);
        (Self { batch: first, slice, counts: left }, Self { batch: second, slice, counts: right })
    }
}

/// Consecutive slices of a batch to write.
#[derive(Debug)]
pub(crate) struct Share<'a> {
    pub(crate) part: Part<'a>,
    /// Patches of each slice but the last.
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) slice: usize,
    /// The counts of each slice.
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) counts: &'a [PartCounts],
}

#[cfg(feature = "rayon")]
impl Share<'_> {
    /// Cuts at least two slices in two shares of about the same output.
    #[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
    pub(crate) fn halve(self) -> (Self, Self) {
        use crate::kernel::emit::Offsets;
        use crate::output::BatchCounts;
        let Self { part: Part { batch, target, first }, slice, counts } = self;
        let half = bytes(counts) / 2;
        let nearest = (1..counts.len()).min_by_key(|&n| bytes(&counts[..n]).abs_diff(half));
        let (left, right) = counts.split_at(nearest.unwrap_or(1));
        let PartCounts { points, indices, .. } = PartCounts::sum(left);
        let (one, other) = cut(batch, left.len() * slice);
        let (points, indices) = (points as usize, indices as usize);
        let (target, other_target) =
            target.split_at(BatchCounts { patches: one.len(), points, indices });
        let second = Offsets {
            points: first.points + points as u32,
            indices: first.indices + indices as u32,
        };
        (
            Self { part: Part { batch: one, target, first }, slice, counts: left },
            Self {
                part: Part { batch: other, target: other_target, first: second },
                slice,
                counts: right,
            },
        )
    }
}

/// The size of an output in the widest formats.
#[cfg(feature = "rayon")]
fn bytes(counts: &[PartCounts]) -> u64 {
    let PartCounts { points, indices, .. } = PartCounts::sum(counts);
    8 * points + 4 * indices
}

/// The patches before `patch` and those from it on.
#[cfg(feature = "rayon")]
fn cut(batch: Batch<'_>, patch: usize) -> (Batch<'_>, Batch<'_>) {
    let patch = patch.min(batch.len());
    (batch.slice(&(0..patch)), batch.slice(&(patch..batch.len())))
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
        assert_eq!(slices(1000, 1), (1008, 1), "rounded up to blocks");
        assert_eq!(slices(1000, 2), (128, 8), "four slices for each thread");
        assert_eq!(slices(96, 2), (12, 8), "fewer than a block each");
        assert_eq!(slices(128, 2), (16, 8), "a block each");
        assert_eq!(slices(3, 4), (1, 3), "a patch each");
    }
}

#[cfg(all(test, feature = "rayon"))]
mod halves {
    use super::*;
    use crate::format::{AnyIndices, AnyPoints};
    use crate::kernel::emit::Offsets;
    use crate::output::{Buffers, PatchRange};
    use crate::target::Target;
    use alloc::vec::Vec;
    use tess_core::{DomainPoint, QuadFactors};

    /// The lengths of points, indices and ranges.
    fn lengths(target: &Target<'_>) -> (usize, usize, usize) {
        let (AnyPoints::Fixed(points), AnyIndices::U32(indices)) =
            (&target.points, &target.indices)
        else {
            panic!("other formats than there were");
        };
        (points.len(), indices.len(), target.ranges.as_ref().map_or(0, |ranges| ranges.len()))
    }

    /// Slices of two patches with these points and indices, cut in two: how many are in the first
    /// half.
    #[expect(clippy::cast_possible_truncation, reason = "at most hundreds")]
    fn halved(sizes: &[(u64, u64)]) -> usize {
        let part = |&(points, indices)| PartCounts { points, indices, largest: 0 };
        let counts: Vec<PartCounts> = sizes.iter().map(part).collect();
        let all = PartCounts::sum(&counts);
        let one = QuadFactors { u0: 1.0, v0: 1.0, u1: 1.0, v1: 1.0, inside_u: 1.0, inside_v: 1.0 };
        let quads = alloc::vec![one; 2 * counts.len()];
        let mut points = alloc::vec![DomainPoint::default(); all.points as usize];
        let mut indices = alloc::vec![0_u32; all.indices as usize];
        let mut ranges = alloc::vec![PatchRange::default(); quads.len()];
        let target = Buffers::new(&mut points, &mut indices).with_ranges(&mut ranges).into();
        let part =
            Part { batch: Batch::Quads(&quads), target, first: Offsets { points: 7, indices: 9 } };
        let (one, other) = Share { part, slice: 2, counts: &counts }.halve();
        for share in [&one, &other] {
            let sum = PartCounts::sum(share.counts);
            let patches = 2 * share.counts.len();
            let expected = (sum.points as usize, sum.indices as usize, patches);
            assert_eq!(lengths(&share.part.target), expected, "buffers");
            assert_eq!((share.part.batch.len(), share.slice), (patches, 2), "patches");
        }
        let (points, indices, _) = lengths(&one.part.target);
        let second = Offsets { points: 7 + points as u32, indices: 9 + indices as u32 };
        assert_eq!(one.part.first, Offsets { points: 7, indices: 9 }, "the first one's place");
        assert_eq!(other.part.first, second, "the second one's place");
        assert_eq!(one.counts.len() + other.counts.len(), counts.len(), "every slice");
        one.counts.len()
    }

    #[test]
    fn halves_have_about_the_same_output() {
        assert_eq!(halved(&[(10, 10); 8]), 4, "equal slices");
        assert_eq!(halved(&[(0, 100), (0, 100), (100, 0)]), 2, "a point is 8 bytes, an index 4");
        assert_eq!(halved(&[(0, 300), (100, 0), (50, 0)]), 1, "as many bytes as the others");
        assert_eq!(halved(&[(900, 0), (1, 1), (1, 1), (1, 1)]), 1, "a large one");
        assert_eq!(halved(&[(1, 1), (1, 1), (1, 1), (900, 0)]), 3, "and behind the others");
        assert_eq!(halved(&[(0, 0), (0, 0)]), 1, "no output");
    }
}
