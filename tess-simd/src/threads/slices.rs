//! A batch cut into slices, and the slices shared among threads.
//!
//! The cut depends on the batch's length and the number of threads alone, and every slice has its
//! own part of the buffers, so the output does not depend on which thread writes it.

use crate::cpu::level::Level;
use crate::data::batch::Batch;
use crate::data::lanes::LANES;
#[cfg(feature = "rayon")]
use crate::data::point_writer::PointRoom;
#[cfg(feature = "rayon")]
use crate::kernels::emit::Offsets;
use crate::levels;
use crate::stages::counts::PartCounts;
use crate::threads::part::Part;
use tess_core::Config;

/// Slices for each thread. With several, threads that are done can help the others.
const SLICES_PER_THREAD: usize = 4;

/// How a batch is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slicing {
    /// Patches of each slice but the last, which may have fewer. Whole packets where there are enough
    /// patches.
    pub(crate) patches: usize,
    /// The number of slices.
    pub(crate) slices: usize,
}

impl Slicing {
    /// The most slices of a batch for a number of threads.
    pub(crate) const fn most(threads: usize) -> usize {
        if threads == 1 { 1 } else { threads * SLICES_PER_THREAD }
    }

    /// The slices of this many patches for a number of threads.
    pub(crate) fn new(patches: usize, threads: usize) -> Self {
        let slice = patches.div_ceil(Self::most(threads)).max(1);
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
    pub(crate) fn count(self, level: Level, config: Config) {
        let patches = self.batch.len();
        for (number, counts) in self.counts.iter_mut().enumerate() {
            let first = number * self.slice;
            let slice = self.batch.slice(&(first..patches.min(first + self.slice)));
            *counts = levels::count(level, config, &slice);
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
pub(crate) struct Share<'a, P, I> {
    pub(crate) part: Part<'a, P, I>,
    /// Patches of each slice but the last.
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) slice: usize,
    /// The counts of each slice.
    #[cfg_attr(not(feature = "rayon"), expect(dead_code, reason = "one thread writes all slices"))]
    pub(crate) counts: &'a [PartCounts],
}

#[cfg(feature = "rayon")]
impl<'a, P: PointRoom, I> Share<'a, P, I> {
    /// Its slices, one part each.
    #[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
    pub(crate) fn into_parts(self) -> impl Iterator<Item = Part<'a, P, I>> {
        let Self { part, slice, counts } = self;
        let mut rest = Some(part);
        counts.iter().filter_map(move |counts| {
            let Part { batch, points, indices, ranges, first } = rest.take()?;
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
            });
            Some(Part { batch: one, points, indices, ranges, first })
        })
    }
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
        assert_eq!(slices(1000, 1), (1008, 1), "rounded up to packets");
        assert_eq!(slices(1000, 2), (128, 8), "four slices for each thread");
        assert_eq!(slices(96, 2), (12, 8), "fewer than a packet each");
        assert_eq!(slices(128, 2), (16, 8), "a packet each");
        assert_eq!(slices(3, 4), (1, 3), "a patch each");
    }
}

#[cfg(all(test, feature = "rayon"))]
mod parts {
    use super::*;
    use crate::data::output::PatchRange;
    use crate::data::ranges::Ranges;
    use alloc::vec::Vec;
    use tess_core::{DomainPoint, QuadFactors};

    /// Slices of two patches, the last of one, whose points and indices are given.
    #[test]
    fn each_slice_has_its_own_part() {
        let sizes = [(3, 5), (0, 0), (7, 11), (2, 1)];
        let part = |(points, indices)| PartCounts { points, indices, largest: 0 };
        let counts: Vec<PartCounts> = sizes.into_iter().map(part).collect();
        let quads = alloc::vec![QuadFactors::uniform(1.0); 7];
        let mut points = alloc::vec![DomainPoint::default(); 12];
        let mut indices = alloc::vec![0_u32; 17];
        let mut ranges = alloc::vec![PatchRange::default(); 7];
        let part = Part {
            batch: Batch::Quads(&quads),
            points: &mut points[..],
            indices: &mut indices[..],
            ranges: Ranges::new(Some(&mut ranges)),
            first: Offsets { points: 7, indices: 9 },
        };
        let lengths = |part: &Part<'_, &mut [DomainPoint], u32>| {
            [part.batch.len(), part.points.len(), part.indices.len(), part.ranges.len()]
        };
        let parts = Share { part, slice: 2, counts: &counts }.into_parts();
        let found: Vec<_> = parts.map(|part| (lengths(&part), part.first)).collect();
        let at = |points, indices| Offsets { points, indices };
        let expected = [
            ([2, 3, 5, 2], at(7, 9)),
            ([2, 0, 0, 2], at(10, 14)),
            ([2, 7, 11, 2], at(10, 14)),
            ([1, 2, 1, 1], at(17, 25)),
        ];
        assert_eq!(found, expected, "patches, buffers and where the output begins");
    }
}
