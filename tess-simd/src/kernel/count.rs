//! Output sizes, without output.

use crate::batch::Batch;
use crate::block::{Block, block_counts};
use crate::chunk::{Chunk, Stretch};
use crate::counts::{BlockCounts, PartCounts};
use crate::kernel::front_end;
use crate::lanes::LANES;
use tess_core::Config;

/// Predicts the output sizes of patches.
#[inline(always)]
pub(crate) fn count(config: Config, batch: &Batch<'_>) -> PartCounts {
    let mut sums = Sums::default();
    let mut chunk = Chunk::EMPTY;
    let (mut first, domain) = (0, batch.domain());
    while first < batch.len() {
        let Stretch { patches, times } = Stretch::new(batch, first);
        chunk.load(&batch.slice(&(first..first + patches)));
        for number in 0..patches.div_ceil(LANES) {
            sums.add(&block_counts(config, domain, &chunk.block(number)), times);
        }
        first += patches * times;
    }
    sums.total()
}

/// Takes the patches of a batch, at most those of a chunk, through the front end and predicts their
/// output sizes.
#[inline(always)]
pub(crate) fn count_and_keep(
    config: Config,
    batch: &Batch<'_>,
    kept: &mut [Block; Chunk::BLOCKS],
) -> PartCounts {
    let mut sums = Sums::default();
    front_end::process(config, batch, kept);
    for block in kept.iter().take(batch.len().div_ceil(LANES)) {
        sums.add(&block.counts, 1);
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
    fn add(&mut self, counts: &BlockCounts, times: usize) {
        let times = times as u64;
        for lane in 0..LANES {
            self.points[lane] += times * u64::from(counts.points[lane]);
            self.indices[lane] += times * u64::from(counts.indices[lane]);
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
