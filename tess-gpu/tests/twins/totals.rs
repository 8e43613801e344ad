//! The pass `totals`: the start of each section in the output, the portion's range, and the size
//! that the batch needs so far. Totals have a second word; offsets and ranges wrap, but only where
//! the output could not fit anyway.

use super::buffers::{Bound, POINTS, PRIMITIVES, Pass, STATUS_RANGES};
use super::finish::finish;
use tess_gpu::Resource::{Offsets, Status};
use tess_gpu::sizes::SECTION;

pub(crate) fn totals(pass: &Pass<'_>, b: &mut Bound<'_>) {
    let job = &pass.job;
    let so_far = |kind: u32| {
        u64::from(b.word(Status, 2 * kind)) | u64::from(b.word(Status, 2 * kind + 1)) << 32
    };
    let begin = if job.portion == 0 { [0; 2] } else { [0, 1].map(so_far) };
    let mut end = begin;
    for section in 0..job.patches.div_ceil(SECTION) {
        let own = b.pair(Offsets, job.sections_at + section);
        b.set_pair(Offsets, job.sections_at + section, end.map(low));
        end = [0, 1].map(|kind| end[kind] + u64::from(own[kind]));
    }
    write_status(pass, begin, end, b);
    if job.portion + 1 >= job.portions {
        finish(pass, end, b);
    }
}

/// The totals and the range of a portion.
pub(crate) fn write_status(pass: &Pass<'_>, begin: [u64; 2], end: [u64; 2], b: &mut Bound<'_>) {
    let ranges = [begin[POINTS], end[POINTS], begin[PRIMITIVES], end[PRIMITIVES]];
    let at = STATUS_RANGES + 4 * pass.job.portion;
    (at..).zip(ranges).for_each(|(word, range)| b.set(Status, word, low(range)));
    for (word, total) in [(0, end[POINTS]), (2, end[PRIMITIVES])] {
        b.set(Status, word, low(total));
        b.set(Status, word + 1, low(total >> 32));
    }
}

/// The low word.
#[expect(clippy::cast_possible_truncation, reason = "the low word")]
pub(crate) const fn low(number: u64) -> u32 {
    number as u32
}
