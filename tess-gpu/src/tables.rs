//! The constants that shaders look up: reciprocals, and the steps of every stitch.

use tess_core::reciprocal::reciprocal;
use tess_core::stitch::{Diagonals, ring, strip, transition};
use tess_core::{Side, SplitOrder, Step};

/// The word of the first reciprocal; those of 1..=64 follow one another.
pub(crate) const RECIPROCALS_AT: u32 = 0;
/// The word where the stitches begin. Each stitch that exists has [`STITCH_WORDS`] words: word `n`
/// holds step `n` in its low half and step `n + 1` in its high half.
///
/// Bits 0..=6 of a step are its entry of the outer row ([`Step::outer`]); the step's number minus
/// that is its entry of the inner row. Bit 7 is set if the step advances along the inner row, bit 8
/// if its triangle begins on the inner row.
pub(crate) const STITCHES_AT: u32 = 64;
/// Words of a stitch: at most 126 steps, and 2 unused ones.
pub(crate) const STITCH_WORDS: u32 = 128;
/// The transition between an outer edge of `outer` points and `inner` points of ring 1 is stitch
/// number `TRANSITION_STRIDE * (outer - 2) + inner`.
pub(crate) const TRANSITION_STRIDE: u32 = 64;
/// The number of the stitch around one inner vertex: the transition from 3 points to 1.
pub(crate) const FAN_STITCH: u32 = TRANSITION_STRIDE + 1;
/// The ring stitch with `inner` points on the inner row is number `RING_STITCH + inner`.
pub(crate) const RING_STITCH: u32 = 64 * TRANSITION_STRIDE;
/// The centre strip of `quads` quads whose middle diagonal is mirrored is number `MIRRORED_STRIP +
/// quads`.
pub(crate) const MIRRORED_STRIP: u32 = RING_STITCH + 64;
/// The number of the strip of 63 quads whose diagonals are all forward. All other centre strips are
/// beginnings of it.
pub(crate) const PLAIN_STRIP: u32 = MIRRORED_STRIP + 64;
/// Words of the whole table.
pub(crate) const WORDS: u32 = STITCHES_AT + STITCH_WORDS * (PLAIN_STRIP + 1);

/// All tables of a split order, as words: the contents of
/// [`Resource::Tables`](crate::Resource::Tables).
#[must_use]
pub fn tables(split: SplitOrder) -> Vec<u32> {
    let mut words: Vec<u32> = (1..=64).filter_map(reciprocal).collect();
    for outer_points in 2..=65 {
        add_stitch(&mut words, |_| {});
        for inner_points in 1..=63 {
            add_stitch(&mut words, |to| transition(split, outer_points, inner_points + 2, to));
        }
    }
    add_stitch(&mut words, |_| {});
    (1..=63).for_each(|inner_points| add_stitch(&mut words, |to| ring(inner_points, to)));
    for quads in 0..=63 {
        add_stitch(&mut words, |to| strip(quads, Diagonals::ForwardExceptMiddle, to));
    }
    add_stitch(&mut words, |to| strip(63, Diagonals::Forward, to));
    words
}

/// Adds the words of the stitch whose steps `stitch` sends.
fn add_stitch(words: &mut Vec<u32>, stitch: impl FnOnce(&mut dyn FnMut(Step))) {
    let mut steps = Vec::new();
    stitch(&mut |step| steps.push(step_bits(step)));
    steps.resize(STITCH_WORDS as usize + 1, 0);
    words.extend(steps.windows(2).map(|pair| pair[0] | pair[1] << 16));
}

/// The bits of a step: see [`STITCHES_AT`].
fn step_bits(step: Step) -> u32 {
    let bit = |side: Side, number: u32| if matches!(side, Side::Inner) { 1 << number } else { 0 };
    step.outer | bit(step.advances, 7) | bit(step.begins, 8)
}
