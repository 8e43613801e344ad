//! A batch cut into slices, and the slices shared among threads.
//!
//! The cut depends on the batch's length and the number of threads alone, and every slice has its
//! own part of the buffers, so the output does not depend on which thread writes it.

use crate::batch::Batch;
use crate::dispatch;
use crate::lanes::LANES;
use crate::level::Level;
use crate::output::{Buffers, Numbering};
use crate::part::PartCounts;
use crate::stitch::Stitches;
use crate::threads::join;
use tess_core::Config;

/// Slices for each thread: so many that shares of equal output can be made of them.
const SLICES_PER_THREAD: usize = 4;

/// Patches that are counted in a few microseconds.
const SOON_COUNTED: usize = 1024;

/// What every thread needs to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan<'a> {
    pub(crate) level: Level,
    pub(crate) config: Config,
    pub(crate) stitches: &'a Stitches,
    pub(crate) numbering: Numbering,
    /// Patches of each slice but the last.
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) slice: usize,
}

/// Patches of each slice of a batch, and how many slices there are, for a number of threads. Slices
/// are whole blocks where there are enough patches.
pub(crate) fn slices(patches: usize, threads: usize) -> (usize, usize) {
    let wanted = if threads == 1 { 1 } else { threads * SLICES_PER_THREAD };
    let slice = patches.div_ceil(wanted).max(1);
    let slice = if slice < LANES { slice } else { slice.next_multiple_of(LANES) };
    (slice, patches.div_ceil(slice))
}

/// Counts each slice of a batch on a number of threads, unless that takes less than waking them.
pub(crate) fn count(
    (level, config): (Level, Config),
    batch: Batch<'_>,
    slice: usize,
    counts: &mut [PartCounts],
    threads: usize,
) {
    if threads > 1 && batch.len() > SOON_COUNTED && counts.len() > 1 {
        let (left, right) = counts.split_at_mut(counts.len() / 2);
        let (first, second) = cut(batch, left.len() * slice);
        join(
            || count((level, config), first, slice, left, threads / 2),
            || count((level, config), second, slice, right, threads - threads / 2),
        );
    } else {
        for (number, counts) in counts.iter_mut().enumerate() {
            let first = number * slice;
            let patches = batch.slice(&(first..batch.len().min(first + slice)));
            *counts = dispatch::count(level, config, &patches);
        }
    }
}

/// Consecutive slices of a batch and where their output goes.
#[derive(Debug)]
pub(crate) struct Share<'a, P, I> {
    pub(crate) batch: Batch<'a>,
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) counts: &'a [PartCounts],
    pub(crate) buffers: Buffers<'a, P, I>,
    /// Points and indices of the batch before this share.
    pub(crate) first: (u32, u32),
}

/// Cuts a share of at least two slices in two of about the same output.
#[cfg(feature = "rayon")]
#[expect(clippy::cast_possible_truncation, reason = "a checked batch's sizes fit 32 bits")]
pub(crate) fn halve<'a, P, I>(
    plan: Plan<'_>,
    share: Share<'a, P, I>,
) -> (Share<'a, P, I>, Share<'a, P, I>) {
    let Share { batch, counts, buffers, first } = share;
    let weight = |counts: &[PartCounts]| counts.iter().map(PartCounts::weight).sum::<u64>();
    let half = weight(counts) / 2;
    let nearest = (1..counts.len()).min_by_key(|&n| weight(&counts[..n]).abs_diff(half));
    let (left, right) = counts.split_at(nearest.unwrap_or(1));
    let total = left.iter().copied().fold(PartCounts::default(), PartCounts::and);
    let (points, indices) = (total.points as usize, total.indices as usize);
    let (one, other) = cut(batch, left.len() * plan.slice);
    let (points, more_points) = buffers.points.split_at_mut(points);
    let (indices, more_indices) = buffers.indices.split_at_mut(indices);
    let (ranges, more_ranges) = buffers.ranges.split_at_mut(one.len());
    let next = (first.0 + points.len() as u32, first.1 + indices.len() as u32);
    let more = Buffers { points: more_points, indices: more_indices, ranges: more_ranges };
    (
        Share { batch: one, counts: left, buffers: Buffers { points, indices, ranges }, first },
        Share { batch: other, counts: right, buffers: more, first: next },
    )
}

/// The patches before `patch` and those from it on.
fn cut(batch: Batch<'_>, patch: usize) -> (Batch<'_>, Batch<'_>) {
    let patch = patch.min(batch.len());
    (batch.slice(&(0..patch)), batch.slice(&(patch..batch.len())))
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// Slices of these points and indices, cut in two: how many are in the first half.
    #[cfg(feature = "rayon")]
    #[expect(clippy::cast_possible_truncation, reason = "at most hundreds")]
    fn halved(counts: &[(u64, u64)]) -> usize {
        use crate::output::PatchRange;
        use tess_core::{DomainPoint, OutputPrimitive, Partitioning, QuadFactors};
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let stitches = &Stitches::new(config);
        let (level, numbering) = (Level::Baseline, Numbering::PerPatch);
        let plan = Plan { level, config, stitches, numbering, slice: 2 };
        let part = |&(points, indices)| PartCounts { points, indices, largest: 0 };
        let counts: Vec<PartCounts> = counts.iter().map(part).collect();
        let sum = |counts: &[PartCounts]| {
            counts.iter().copied().fold(PartCounts::default(), PartCounts::and)
        };
        let all = sum(&counts);
        let one = QuadFactors { u0: 1.0, v0: 1.0, u1: 1.0, v1: 1.0, inside_u: 1.0, inside_v: 1.0 };
        let quads = alloc::vec![one; 2 * counts.len()];
        let mut points = alloc::vec![DomainPoint::default(); all.points as usize];
        let mut indices = alloc::vec![0_u32; all.indices as usize];
        let mut ranges = alloc::vec![PatchRange::default(); quads.len()];
        let buffers =
            Buffers { points: &mut points[..], indices: &mut indices[..], ranges: &mut ranges[..] };
        let share = Share { batch: Batch::Quads(&quads), counts: &counts, buffers, first: (7, 9) };
        let (one, other) = halve(plan, share);
        let sizes = |share: &Share<'_, DomainPoint, u32>| {
            let Buffers { points, indices, ranges } = &share.buffers;
            let sum = sum(share.counts);
            assert_eq!((points.len() as u64, indices.len() as u64), (sum.points, sum.indices));
            assert_eq!((ranges.len(), share.batch.len()), (2 * share.counts.len(), ranges.len()));
            (points.len() as u32, indices.len() as u32)
        };
        let of_one = sizes(&one);
        sizes(&other);
        assert_eq!((one.first, other.first), ((7, 9), (7 + of_one.0, 9 + of_one.1)), "begins");
        assert_eq!(one.counts.len() + other.counts.len(), counts.len(), "every slice");
        one.counts.len()
    }

    #[cfg(feature = "rayon")]
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
