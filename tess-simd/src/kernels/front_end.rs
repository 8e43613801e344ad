//! The front end over a batch: raw factors to packets, and output sizes without output.

use crate::data::batch::Batch;
use crate::data::chunk::{Chunk, Stretch};
use crate::data::lanes::LANES;
use crate::stages::counts::{PacketCounts, PartCounts};
use crate::stages::packet::{Packet, packet_counts};
use tess_core::Config;

/// Takes up to a chunk of patches through the front end. Lanes past the end count as culled; packets past the end
/// stay as they are.
#[inline(always)]
pub(crate) fn process(config: Config, batch: &Batch<'_>, packets: &mut [Packet; Chunk::PACKETS]) {
    let mut chunk = Chunk::EMPTY;
    chunk.load(batch);
    let (patches, domain) = (batch.len(), batch.domain());
    for (number, packet) in packets.iter_mut().enumerate() {
        if number * LANES >= patches {
            break;
        }
        packet.process(config, domain, &chunk.packet(number));
    }
}

/// Predicts the output sizes of patches.
#[inline(always)]
pub(crate) fn count(config: Config, batch: &Batch<'_>) -> PartCounts {
    let mut sums = Sums::default();
    let mut chunk = Chunk::EMPTY;
    let (mut first, mut run, domain) = (0, 0, batch.domain());
    while first < batch.len() {
        let Stretch { patches, times } = Stretch::new(batch, first);
        if first == 0 {
            run = times;
        }
        chunk.load(&batch.slice(&(first..first + patches)));
        for number in 0..patches.div_ceil(LANES) {
            sums.add(&packet_counts(config, domain, &chunk.packet(number)), times);
        }
        first += patches * times;
    }
    PartCounts { run, ..sums.total() }
}

/// [`process`], then the output sizes of these patches together.
#[inline(always)]
pub(crate) fn count_and_keep(
    config: Config,
    batch: &Batch<'_>,
    kept: &mut [Packet; Chunk::PACKETS],
) -> PartCounts {
    if batch.len() <= FEW {
        return count_and_keep_few(config, batch, &mut kept[0]);
    }
    let mut sums = Sums::default();
    process(config, batch, kept);
    for packet in kept.iter().take(batch.len().div_ceil(LANES)) {
        sums.add(&packet.counts, 1);
    }
    sums.total()
}

/// As many patches are processed one by one: that takes less than a whole packet.
const FEW: usize = 4;

/// [`count_and_keep`] of at most [`FEW`] patches.
#[inline(always)]
fn count_and_keep_few(config: Config, batch: &Batch<'_>, kept: &mut Packet) -> PartCounts {
    let mut total = PartCounts::default();
    for lane in 0..FEW {
        let Some(factors) = batch.patch(lane) else { break };
        let counts = kept.process_one(config, lane, factors);
        total.points += u64::from(counts.points);
        total.indices += u64::from(counts.indices);
        total.largest = total.largest.max(counts.points);
    }
    total
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
    fn add(&mut self, counts: &PacketCounts, times: usize) {
        // A product of 64 bits would not become vectors.
        if times == 1 {
            self.add_times(counts, |n| n)
        } else {
            self.add_times(counts, |n| times as u64 * n)
        }
    }

    #[inline(always)]
    fn add_times(&mut self, counts: &PacketCounts, times: impl Fn(u64) -> u64) {
        for lane in 0..LANES {
            self.points[lane] += times(u64::from(counts.points[lane]));
            self.indices[lane] += times(u64::from(counts.indices[lane]));
            self.largest[lane] = counts.points[lane].max(self.largest[lane]);
        }
    }

    #[inline(always)]
    fn total(self) -> PartCounts {
        PartCounts {
            points: self.points.into_iter().sum(),
            indices: self.indices.into_iter().sum(),
            largest: self.largest.into_iter().max().unwrap_or(0),
            run: 0,
        }
    }
}
