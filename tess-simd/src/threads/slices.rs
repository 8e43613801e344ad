//! A batch cut into slices, which threads share.
//!
//! The cut depends only on the batch's length and the number of threads, and every slice has its
//! own part of the buffers, so the output does not depend on which thread writes it.

use crate::data::batch::Batch;
#[cfg(feature = "rayon")]
use crate::data::point_writer::PointRoom;
#[cfg(feature = "rayon")]
use crate::kernels::emit::Offsets;
use crate::levels;
use crate::stages::counts::PartCounts;
use crate::threads::part::Part;
use tess_core::Config;
use tess_level::Level;

/// Consecutive slices of a batch to count.
#[derive(Debug)]
pub(crate) struct CountShare<'a> {
    pub(crate) batch: Batch<'a>,
    /// Patches of each slice; the last one may have fewer.
    pub(crate) slice: usize,
    /// Receives the counts of each slice.
    pub(crate) counts: &'a mut [PartCounts],
}

impl CountShare<'_> {
    /// Counts the slices one after another.
    pub(crate) fn count(self, level: Level, config: Config) {
        let patches = self.batch.len();
        for (number, counts) in self.counts.iter_mut().enumerate() {
            let first = number * self.slice;
            let slice = self.batch.slice(&(first..patches.min(first + self.slice)));
            *counts = levels::count(level, config, &slice);
        }
    }

    /// Divides the slices into two shares.
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
pub(crate) struct Share<'a, P, I> {
    pub(crate) part: Part<'a, P, I>,
    /// Patches of each slice; the last one may have fewer.
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) slice: usize,
    /// The counts of each slice.
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) counts: &'a [PartCounts],
}

#[cfg(feature = "rayon")]
impl<'a, P: PointRoom, I> Share<'a, P, I> {
    /// The slices, one part each.
    #[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
    pub(crate) fn into_parts(self) -> impl Iterator<Item = Part<'a, P, I>> {
        let Self { part, slice, counts } = self;
        let mut rest = Some(part);
        counts.iter().filter_map(move |counts| {
            let Part { batch, points, indices, ranges, first, .. } = rest.take()?;
            let (one, others) = cut(batch, slice);
            let (points, more_points) = points.split_at(counts.points as usize);
            let (indices, more_indices) = indices.split_at_mut(counts.indices as usize);
            let (ranges, more_ranges) = ranges.split_at(one.len());
            let next = Offsets {
                points: first.points + counts.points as u32,
                indices: first.indices + counts.indices as u32,
            };
            rest = Some(Part {
                batch: others,
                points: more_points,
                indices: more_indices,
                ranges: more_ranges,
                first: next,
                run: 0,
            });
            Some(Part { batch: one, points, indices, ranges, first, run: counts.run })
        })
    }
}

/// The patches before `patch`, and `patch` with those after it.
#[cfg(feature = "rayon")]
fn cut(batch: Batch<'_>, patch: usize) -> (Batch<'_>, Batch<'_>) {
    let patch = patch.min(batch.len());
    (batch.slice(&(0..patch)), batch.slice(&(patch..batch.len())))
}
