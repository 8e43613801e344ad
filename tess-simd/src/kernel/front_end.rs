//! Patches through the front end: factors, contexts and counts.

use crate::batch::Batch;
use crate::block::Block;
use crate::chunk::Chunk;
use crate::lanes::LANES;
use tess_core::Config;

/// Takes the patches of a batch, at most those of a chunk, through the front end. Patches past its end
/// count as culled; blocks that have none but those stay as they are.
#[inline(always)]
pub(crate) fn process(config: Config, batch: &Batch<'_>, blocks: &mut [Block; Chunk::BLOCKS]) {
    let mut chunk = Chunk::EMPTY;
    chunk.load(batch);
    let (patches, domain) = (batch.len(), batch.domain());
    for (number, block) in blocks.iter_mut().enumerate() {
        if number * LANES >= patches {
            break;
        }
        block.process(config, domain, &chunk.block(number));
    }
}
