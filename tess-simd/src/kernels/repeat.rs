//! Runs of equal patches: the first one's output again and again.

use crate::data::format::IndexFormat;
use crate::data::output::{Numbering, PatchRange};
use crate::data::point_writer::PointWriter;
use crate::data::writer::Writer;
use crate::kernels::emit::{Offsets, Room};

/// A patch that was written, and what is known of those after it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repeat {
    /// Where its output lies.
    pub(crate) range: PatchRange,
    /// How many patches have its factors, itself included.
    pub(crate) times: usize,
    pub(crate) numbering: Numbering,
}

/// Writes the patches of a run after its first one, which stands at the beginning of the buffers.
/// Returns where their output ends in the batch.
#[inline(always)]
pub(crate) fn repeat<W: PointWriter, I: IndexFormat>(
    repeat: Repeat,
    room: Room<'_, W, I>,
) -> Offsets {
    let Repeat { range, times, numbering } = repeat;
    let (points, indices) = (range.points as usize, range.indices as usize);
    let step = match numbering {
        Numbering::PerPatch => 0,
        Numbering::PerBatch { .. } => range.points,
    };
    room.points.repeat(points, times);
    Writer::new(room.indices).repeat(indices, times, |index, patches| {
        index.wrapping_add(I::wrapping_from(step.wrapping_mul(patches)))
    });
    let mut next = range;
    for range in room.ranges.iter_mut().take(times) {
        *range = next;
        next.first_point = next.first_point.wrapping_add(next.points);
        next.first_index = next.first_index.wrapping_add(next.indices);
    }
    Offsets { points: next.first_point, indices: next.first_index }
}
