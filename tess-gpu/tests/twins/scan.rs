//! The pass `scan`: the start of each block in its section of 256 blocks, and each section's
//! counts. The pass `factors` has left the counts of the blocks.

use super::buffers::{Bound, Pass, sum};
use tess_gpu::Resource::Offsets;
use tess_gpu::sizes::{BLOCK, SECTION};

pub(crate) fn scan(pass: &Pass<'_>, b: &mut Bound<'_>) {
    let job = &pass.job;
    let blocks = job.patches.div_ceil(BLOCK);
    for section in 0..job.patches.div_ceil(SECTION) {
        let mut all = [0; 2];
        let first = section * (SECTION / BLOCK);
        for block in first..blocks.min(first + SECTION / BLOCK) {
            let own = b.pair(Offsets, job.blocks_at + block);
            b.set_pair(Offsets, job.blocks_at + block, all);
            all = sum(all, own);
        }
        b.set_pair(Offsets, job.sections_at + section, all);
    }
}
