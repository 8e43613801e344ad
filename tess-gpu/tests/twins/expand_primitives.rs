//! The pass `expand_primitives`: the indices of the portion's primitives that are in the window.

use super::buffers::{Bound, POINTS, PRIMITIVES, Pass};
use super::expand_points::window;
use tess_gpu::Resource::Indices;
use tess_gpu::{IndexType, Numbering};

pub(crate) fn expand_primitives(pass: &Pass<'_>, b: &mut Bound<'_>) {
    if b.is_overflow() {
        return;
    }
    let window = window(&pass.job);
    let each = pass.setup.indices_per_primitive();
    for (number, patch) in (0..).zip(pass.patches) {
        let begin = b.patch_offset(&pass.job, number);
        let first = u64::from(begin[PRIMITIVES]);
        let elements = first..first + u64::from(patch.counts().primitives);
        if elements.end <= window.start || window.end <= elements.start {
            continue;
        }
        let base = if pass.setup.numbering == Numbering::PerBatch { begin[POINTS] } else { 0 };
        let indices = patch.tessellate_in(pass.setup.order).indices;
        for (element, primitive) in elements.zip(indices.chunks(each as usize)) {
            if window.contains(&element) {
                let at = each * u32::try_from(element - window.start).expect("below 2^32");
                (at..).zip(primitive).for_each(|(at, index)| set_index(pass, at, base + index, b));
            }
        }
    }
}

/// `variants/indices_u32.wgsl` and `indices_u16.wgsl`: index `at` of the window.
fn set_index(pass: &Pass<'_>, at: u32, index: u32, b: &mut Bound<'_>) {
    match pass.setup.index_type {
        IndexType::U32 => b.set(Indices, at, index),
        IndexType::U16 => {
            let shift = 16 * (at % 2);
            let others = b.word(Indices, at / 2) & !(0xFFFF << shift);
            b.set(Indices, at / 2, others | (index & 0xFFFF) << shift);
        }
    }
}
