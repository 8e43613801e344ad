//! Runs of equal patches: copies of the first one's output.

use crate::data::format::IndexFormat;
use crate::data::output::{Numbering, PatchRange};
use crate::data::point_writer::PointWriter;
use crate::data::ranges::Ranges;
use crate::data::writer::Writer;
use crate::kernels::emit::Offsets;

/// A patch that was written, and the number of equal patches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repeat {
    /// The place of the patch's output.
    pub(crate) range: PatchRange,
    /// How many patches have these factors, including this one.
    pub(crate) times: usize,
    pub(crate) numbering: Numbering,
}

/// Writes the patches of a run after its first one, whose output is at the beginning of the
/// buffers, and their ranges. Returns where their output ends in the batch.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
pub(crate) fn repeat<W: PointWriter, I: IndexFormat>(
    repeat: Repeat,
    (points, indices): (W, &mut [I]),
    ranges: &mut Ranges<'_>,
) -> Offsets {
    let Repeat { range, times, numbering } = repeat;
    let (point_count, index_count) = (range.points as usize, range.indices as usize);
    points.repeat(point_count, times);
    let indices = Writer::new(indices);
    match numbering {
        Numbering::PerPatch => indices.copy(index_count, times),
        Numbering::PerBatch { .. } => indices.repeat(index_count, times, |index, patches| {
            index.wrapping_add(I::wrapping_from(range.points.wrapping_mul(patches)))
        }),
    }
    ranges.repeat(range, times - 1);
    let end = |first: u32, period: usize| first + (period * times) as u32;
    Offsets {
        points: end(range.first_point, point_count),
        indices: end(range.first_index, index_count),
    }
}
