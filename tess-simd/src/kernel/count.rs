//! Output sizes, without output.

use crate::batch::Batch;
use crate::block::Block;
use crate::chunk::Chunk;
use crate::counts::{BlockCounts, PartCounts};
use crate::kernel::front_end;
use crate::lanes::LANES;
use tess_core::Config;

/// Predicts the output sizes of patches.
#[inline(always)]
pub(crate) fn count(config: Config, batch: &Batch<'_>) -> PartCounts {
    let mut sums = Sums::default();
    let mut chunk = Chunk::EMPTY;
    let (patches, domain) = (batch.len(), batch.domain());
    for first in (0..patches).step_by(Chunk::PATCHES) {
        chunk.load(batch, first);
        for number in 0..(patches - first).div_ceil(LANES).min(Chunk::BLOCKS) {
            sums.add(&Block::new(config, domain, &chunk.block(number)).counts);
        }
    }
    sums.total()
}

/// Takes patches through the front end and predicts their output sizes. `kept` has room for them.
#[inline(always)]
pub(crate) fn count_and_keep(
    config: Config,
    batch: &Batch<'_>,
    kept: &mut [[Block; Chunk::BLOCKS]],
) -> PartCounts {
    let mut sums = Sums::default();
    let patches = batch.len();
    for (first, blocks) in (0..patches).step_by(Chunk::PATCHES).zip(kept) {
        front_end::process(config, batch, first, blocks);
        for block in blocks.iter().take((patches - first).div_ceil(LANES)) {
            sums.add(&block.counts);
        }
    }
    sums.total()
}

/// Sums lane by lane.
#[derive(Default)]
struct Sums {
    points: [u64; LANES],
    indices: [u64; LANES],
    largest: [u32; LANES],
}

impl Sums {
    #[inline(always)]
    fn add(&mut self, counts: &BlockCounts) {
        for lane in 0..LANES {
            self.points[lane] += u64::from(counts.points[lane]);
            self.indices[lane] += u64::from(counts.indices[lane]);
            self.largest[lane] = counts.points[lane].max(self.largest[lane]);
        }
    }

    #[inline(always)]
    fn total(self) -> PartCounts {
        PartCounts {
            points: self.points.into_iter().sum(),
            indices: self.indices.into_iter().sum(),
            largest: self.largest.into_iter().max().unwrap_or(0),
        }
    }
}
