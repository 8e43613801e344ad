//! The pass `partition`: for each tile of the portion's output, the patch of its first element in
//! the portion; then the patch of the portion's last element. No workgroup runs if the output does
//! not fit.

use super::buffers::{Bound, Pass};
use tess_gpu::Resource::Tiles;

pub(crate) fn partition(pass: &Pass<'_>, b: &mut Bound<'_>) {
    if b.is_overflow() {
        return;
    }
    let job = &pass.job;
    let tables = [0, job.primitive_tiles_at];
    for (kind, [begin, end]) in b.ranges(job).into_iter().enumerate() {
        if begin == end {
            continue;
        }
        let begins: Vec<u32> =
            (0..job.patches).map(|patch| b.patch_offset(job, patch)[kind]).collect();
        let first = begin >> job.tile_bits;
        let entries = end.div_ceil(1 << job.tile_bits) - first + 1;
        for entry in 0..entries {
            let element = ((first + entry) << job.tile_bits).clamp(begin, end - 1);
            // Of several patches that begin at one place, only the last has elements.
            let patch = begins.partition_point(|&begin| begin <= element) - 1;
            b.set(Tiles, tables[kind] + entry, u32::try_from(patch).expect("below 2^30"));
        }
    }
}
