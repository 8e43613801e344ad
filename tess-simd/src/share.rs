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
