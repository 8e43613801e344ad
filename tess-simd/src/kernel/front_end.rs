//! Patches through the front end: factors, contexts and counts.

use crate::batch::Batch;
use crate::block::Block;
use crate::chunk::Chunk;
use crate::lanes::LANES;
use tess_core::Config;

/// Takes patches from `first` on through the front end, as many as the blocks have room for. Patches
/// past the end of the batch count as culled; blocks that have none but those stay as they are.
#[inline(always)]
pub(crate) fn process(config: Config, batch: &Batch<'_>, first: usize, blocks: &mut [Block]) {
    let mut chunk = Chunk::EMPTY;
    let domain = batch.domain();
    let patches = batch.len().saturating_sub(first);
    let blocks = blocks.iter_mut().take(patches.div_ceil(LANES));
    for (number, block) in blocks.enumerate() {
        let of_chunk = number % Chunk::BLOCKS;
        if of_chunk == 0 {
            chunk.load(batch, first + number * LANES);
        }
        *block = Block::new(config, domain, &chunk.block(of_chunk));
    }
}
