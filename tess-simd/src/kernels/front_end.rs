//! The front end over a batch: raw factors to packets, or only to output sizes.
//!
//! `V` are the numbers with which whole packets are processed: see [`Numbers`].

use crate::data::batch::Batch;
use crate::data::chunk::{Chunk, Stretch};
use crate::data::lanes::LANES;
use crate::data::numbers::Numbers;
use crate::stages::counts::{PacketCounts, PartCounts};
use crate::stages::packet::{Packet, one_counts, packet_counts};
use tess_core::Config;

/// Takes up to a chunk of patches through the front end. Packets past the end keep their contents.
/// So do the lanes past the end if there are at most [`FEW`] patches; otherwise they are culled.
#[inline(always)]
pub(crate) fn process<V: Numbers>(
    config: Config,
    batch: &Batch<'_>,
    packets: &mut [Packet; Chunk::PACKETS],
) {
    if batch.len() <= FEW {
        process_few(config, batch, batch.len(), &mut packets[0]);
    } else {
        process_many::<V>(config, batch, packets);
    }
}

/// Takes up to a chunk of patches through the front end, a packet at a time.
#[inline(always)]
fn process_many<V: Numbers>(
    config: Config,
    batch: &Batch<'_>,
    packets: &mut [Packet; Chunk::PACKETS],
) {
    let mut chunk = Chunk::EMPTY;
    chunk.load(batch);
    let (patches, domain) = (batch.len(), batch.domain());
    for (number, packet) in packets.iter_mut().enumerate() {
        if number * LANES >= patches {
            break;
        }
        packet.process::<V>(config, domain, &chunk.packet(number));
    }
}

/// Predicts the output sizes of patches.
#[inline(always)]
pub(crate) fn count<V: Numbers>(config: Config, batch: &Batch<'_>) -> PartCounts {
    let mut sums = Sums::default();
    let mut chunk = Chunk::EMPTY;
    let (mut first, mut run, domain) = (0, 0, batch.domain());
    while first < batch.len() {
        let Stretch { patches, times } = Stretch::new(batch, first);
        if first == 0 {
            run = times;
        }
        // A patch that repeats, or the last one: a packet of one patch would cost as much as one of
        // sixteen.
        if patches == 1
            && let Some(factors) = batch.patch(first)
        {
            sums.add_one(one_counts(config, &factors), times);
        } else {
            chunk.load(&batch.slice(&(first..first + patches)));
            for number in 0..patches.div_ceil(LANES) {
                sums.add(&packet_counts::<V>(config, domain, &chunk.packet(number)));
            }
        }
        first += patches * times;
    }
    PartCounts { run, ..sums.total() }
}

/// [`process`], then the total output sizes of these patches.
///
/// Of a batch of equal patches, one is kept. Returns `None`, and keeps nothing, if a batch begins
/// with a run and has other patches after it: [`count`] is for those.
#[inline(always)]
pub(crate) fn count_and_keep<V: Numbers>(
    config: Config,
    batch: &Batch<'_>,
    kept: &mut [Packet; Chunk::PACKETS],
) -> Option<PartCounts> {
    let (patches, run) = (batch.len(), batch.run(0));
    let all_equal = run == patches;
    // A run at the beginning is worth repeating, but packets have no place for its length.
    if run >= Stretch::WORTH_REPEATING && !all_equal {
        return None;
    }
    let unlike = if all_equal { 1 } else { patches };
    if unlike <= FEW {
        let counts = process_few(config, batch, unlike, &mut kept[0]);
        return Some(if all_equal { counts.times(run) } else { counts });
    }
    process_many::<V>(config, batch, kept);
    let mut sums = Sums::default();
    for packet in kept.iter().take(patches.div_ceil(LANES)) {
        sums.add(&packet.counts);
    }
    Some(sums.total())
}

/// Up to this many patches are processed one by one, which takes less time than a whole packet.
const FEW: usize = 4;

/// Takes the first patches of a batch, at most [`FEW`], through the front end. The other lanes keep
/// their contents.
#[inline(always)]
fn process_few(
    config: Config,
    batch: &Batch<'_>,
    patches: usize,
    packet: &mut Packet,
) -> PartCounts {
    let mut total = PartCounts::default();
    for lane in 0..patches.min(FEW) {
        let Some(factors) = batch.patch(lane) else { break };
        let counts = packet.process_one(config, lane, factors);
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
    /// Adds the patches of a packet.
    #[inline(always)]
    fn add(&mut self, counts: &PacketCounts) {
        for lane in 0..LANES {
            self.points[lane] += u64::from(counts.points[lane]);
            self.indices[lane] += u64::from(counts.indices[lane]);
            self.largest[lane] = counts.points[lane].max(self.largest[lane]);
        }
    }

    /// Adds a patch that comes `times` times.
    #[inline(always)]
    fn add_one(
        &mut self,
        PacketCounts { points: [points], indices: [indices] }: PacketCounts<1>,
        times: usize,
    ) {
        self.points[0] += times as u64 * u64::from(points);
        self.indices[0] += times as u64 * u64::from(indices);
        self.largest[0] = points.max(self.largest[0]);
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
