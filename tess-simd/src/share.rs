//! A batch cut into slices, and the slices shared among threads.
//!
//! The cut depends on the batch's length and the number of threads alone, and every thread writes
//! its own part of the buffers, so the output does not depend on the threads.

use crate::batch::Batch;
use crate::dispatch;
use crate::format::{IndexFormat, PointFormat};
use crate::lanes::LANES;
use crate::level::Level;
use crate::output::{Buffers, Numbering};
use crate::part::{self, Part, PartCounts, Workspace};
use crate::stitch::Stitches;
use tess_core::Config;

/// Slices for each thread: so many that shares of equal output can be made of them.
const SLICES_PER_THREAD: usize = 8;

/// What every thread needs to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan<'a> {
    pub(crate) level: Level,
    pub(crate) config: Config,
    pub(crate) stitches: &'a Stitches,
    pub(crate) numbering: Numbering,
    /// Patches of each slice but the last: a multiple of [`LANES`].
    pub(crate) slice: usize,
}

/// Patches of each slice of a batch, and how many slices there are, for a number of threads.
pub(crate) fn slices(patches: usize, threads: usize) -> (usize, usize) {
    let wanted = if threads == 1 { 1 } else { threads * SLICES_PER_THREAD };
    let slice = patches.div_ceil(wanted).next_multiple_of(LANES).max(LANES);
    (slice, patches.div_ceil(slice))
}

/// Counts each slice of a batch.
pub(crate) fn count(
    (level, config): (Level, Config),
    batch: Batch<'_>,
    slice: usize,
    counts: &mut [PartCounts],
) {
    match counts {
        [] => {}
        [one] => *one = dispatch::count(level, config, &batch),
        _ => {
            let (left, right) = counts.split_at_mut(counts.len() / 2);
            let (first, second) = cut(batch, left.len() * slice);
            join(
                || count((level, config), first, slice, left),
                || count((level, config), second, slice, right),
            );
        }
    }
}

/// Consecutive slices of a batch and where their output goes.
#[derive(Debug)]
pub(crate) struct Share<'a, P, I> {
    pub(crate) batch: Batch<'a>,
    pub(crate) counts: &'a [PartCounts],
    pub(crate) buffers: Buffers<'a, P, I>,
    /// Points and indices of the batch before this share.
    pub(crate) first: (u32, u32),
}

/// Emits a share on as many threads as there are workspaces.
pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
    plan: Plan<'_>,
    share: Share<'_, P, I>,
    workspaces: &mut [Workspace],
) {
    let Share { batch, counts, buffers, first } = share;
    let threads = workspaces.len();
    if threads > 1 && counts.len() > 1 {
        let (left, right) = workspaces.split_at_mut(threads / 2);
        let (one, other) = halve(plan, Share { batch, counts, buffers, first }, threads);
        join(|| emit(plan, one, left), || emit(plan, other, right));
    } else if let Some(workspace) = workspaces.first_mut() {
        let part = Part { batch, buffers, first, numbering: plan.numbering };
        part::emit((plan.level, plan.config), plan.stitches, part, workspace);
    }
}

/// Cuts a share of at least two slices in two, the first with the output of half the threads.
#[expect(clippy::cast_possible_truncation, reason = "a checked batch's sizes fit 32 bits")]
fn halve<'a, P, I>(
    plan: Plan<'_>,
    share: Share<'a, P, I>,
    threads: usize,
) -> (Share<'a, P, I>, Share<'a, P, I>) {
    let Share { batch, counts, buffers, first } = share;
    let weight = |counts: &[PartCounts]| counts.iter().map(PartCounts::weight).sum::<u64>();
    let wanted = weight(counts) / threads as u64 * (threads / 2) as u64;
    let nearest = (1..counts.len()).min_by_key(|&n| weight(&counts[..n]).abs_diff(wanted));
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

/// Runs both, on two threads if there are.
#[cfg(feature = "rayon")]
fn join(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    rayon::join(one, other);
}

/// Runs both.
#[cfg(not(feature = "rayon"))]
fn join(one: impl FnOnce(), other: impl FnOnce()) {
    one();
    other();
}
