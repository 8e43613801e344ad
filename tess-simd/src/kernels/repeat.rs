//! Runs of equal patches: the first one's output again and again.

use crate::data::format::{IndexFormat, OutputPoint};
use crate::data::output::{Numbering, PatchRange};
use crate::kernels::emit::{Offsets, Room};

/// Bytes that are copied at a time: so few that they are read from the first cache.
const COPIED: usize = 4096;

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
pub(crate) fn repeat<P: OutputPoint, I: IndexFormat>(
    repeat: Repeat,
    room: Room<'_, P, I>,
) -> Offsets {
    let Repeat { range, times, numbering } = repeat;
    let (points, indices) = (range.points as usize, range.indices as usize);
    let step = match numbering {
        Numbering::PerPatch => 0,
        Numbering::PerBatch { .. } => range.points,
    };
    fill(room.points, points, times, |point, _| point);
    fill(room.indices, indices, times, |index, patches| {
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

/// Fills `times` times `period` elements from the first `period` of them. `moved` makes an element
/// from the one that stands this many periods before it.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
fn fill<T: Copy>(all: &mut [T], period: usize, times: usize, moved: impl Fn(T, u32) -> T) {
    let Some(all) = all.get_mut(..period * times) else { return };
    let most = (COPIED / size_of::<T>()).max(period);
    let mut made = period;
    while made < all.len() {
        let (source, rest) = all.split_at_mut(made);
        let periods = made.min(most) / period;
        let patches = (made / period) as u32;
        for (to, &from) in rest.iter_mut().zip(&source[..periods * period]) {
            *to = moved(from, patches);
        }
        made += rest.len().min(periods * period);
    }
}
