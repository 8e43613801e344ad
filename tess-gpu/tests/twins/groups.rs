//! The pass `groups`: the draw arguments of each group. A group can begin in one portion and end in
//! another, so each portion writes the values that it knows, and the last one makes them right.

use super::buffers::{Bound, PRIMITIVES, Pass};
use tess_gpu::Resource::{Draws, Groups};

pub(crate) fn groups(pass: &Pass<'_>, b: &mut Bound<'_>) {
    let count = b.size(Groups);
    for group in 0..count {
        let begin = b.word(Groups, group);
        // The last group ends with the batch.
        let end = if group + 1 < count { b.word(Groups, group + 1) } else { u32::MAX };
        if begin >= pass.job.first_patch {
            let draw = [0, 1, first_index(pass, begin, b), 0, 0];
            (5 * group..).zip(draw).for_each(|(word, value)| b.set(Draws, word, value));
        }
        if end >= pass.job.first_patch && !b.is_overflow() {
            let indices = first_index(pass, end, b).wrapping_sub(b.word(Draws, 5 * group + 2));
            b.set(Draws, 5 * group, indices);
        }
    }
}

/// The first index of a patch, or for a patch after the portion, the end of the portion's indices.
fn first_index(pass: &Pass<'_>, patch: u32, b: &Bound<'_>) -> u32 {
    let job = &pass.job;
    let in_portion = patch - job.first_patch;
    let primitive = match in_portion < job.patches {
        true => b.patch_offset(job, in_portion)[PRIMITIVES],
        false => b.ranges(job)[PRIMITIVES][1],
    };
    primitive.wrapping_mul(pass.setup.indices_per_primitive())
}
