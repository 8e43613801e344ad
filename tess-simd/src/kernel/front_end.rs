//! Patches through the front end: factors, contexts and counts.

use crate::batch::Batch;
use crate::block::Block;
use crate::chunk::Chunk;
use crate::lanes::LANES;
use tess_core::Config;

/// Takes the patches of a chunk, from `first` on, through the front end. Patches past the end of the
/// batch count as culled; blocks that have none but those stay as they are.
#[inline(always)]
pub(crate) fn process(
    config: Config,
    batch: &Batch<'_>,
    first: usize,
    blocks: &mut [Block; Chunk::BLOCKS],
) {
    let mut chunk = Chunk::EMPTY;
    chunk.load(batch, first);
    let (patches, domain) = (batch.len(), batch.domain());
    for (number, block) in blocks.iter_mut().enumerate() {
        if first + number * LANES >= patches {
            break;
        }
        *block = Block::new(config, domain, &chunk.block(number));
    }
}
