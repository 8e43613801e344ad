//! The pass `factors`: each patch's topology, contexts and place in its block; each block's counts.

use super::block::process_block;
use super::buffers::{Bound, Pass};
use super::catalogue::Catalogue;
use tess_gpu::Resource;
use tess_gpu::sizes::BLOCK;

pub(crate) fn factors(pass: &Pass<'_>, b: &mut Bound<'_>) {
    let job = &pass.job;
    let has_catalogue = job.has_catalogue == 1 && pass.setup.has_triangles();
    let catalogue = has_catalogue.then(|| Catalogue::new(pass.setup));
    if let Some(it) = catalogue.as_ref().filter(|_| job.first_patch == 0) {
        b.set(Resource::Catalogue, it.used_at, 0);
        b.set(Resource::Catalogue, it.used_at + 1, 0);
    }
    for block in 0..job.patches.div_ceil(BLOCK) {
        let all = process_block(pass, block, catalogue.as_ref(), b);
        b.set_pair(Resource::Offsets, job.blocks_at + block, all);
    }
}
