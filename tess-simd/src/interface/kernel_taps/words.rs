//! The output of taps, as words that can be compared.

use super::KernelTap;
use crate::data::lanes::LANES;
use crate::kernels::kernel_taps::Kernel;
use crate::stages::counts::{PacketCounts, PartCounts};
use crate::stages::factors::Processed;
use crate::stages::packet::PacketPatch;
use crate::stages::place::Spacing;
use alloc::vec::Vec;
use tess_core::Counts;

impl KernelTap {
    /// The output of the last run as words, one type of output after another.
    #[must_use]
    pub fn words(&self) -> Vec<u32> {
        let Self { made, .. } = self;
        let mut words = made.words.clone();
        self.add_front_end(&mut words);
        words.extend(made.codes.as_flattened().iter().map(|&code| u32::from(code)));
        words.extend(made.points.iter().flat_map(|point| [point.u.to_bits(), point.v.to_bits()]));
        words.extend(made.floats.as_flattened().iter().map(|x| x.to_bits()));
        let [u, v] = &made.apart;
        words.extend(u.iter().zip(v).flat_map(|(u, v)| [u.to_bits(), v.to_bits()]));
        words.extend(&made.indices);
        words.extend(made.narrow.iter().map(|&index| u32::from(index)));
        if matches!(self.kernel, Kernel::Emit | Kernel::Repeat) {
            words.extend(made.ranges.iter().flat_map(|range| {
                [range.first_point, range.points, range.first_index, range.indices]
            }));
        }
        words
    }
    /// Adds the output of the front end, patch by patch, then totals.
    fn add_front_end(&self, words: &mut Vec<u32>) {
        let Self { work, made, .. } = self;
        let (patches, factors) = (work.patches.len(), work.domain.factors());
        let lanes = (0..patches).map(|patch| (patch / LANES, patch % LANES));
        match self.kernel {
            Kernel::Factors | Kernel::FactorsByEight => words.extend(
                lanes.flat_map(|(packet, lane)| record(&made.processed[packet], lane, factors)),
            ),
            Kernel::FactorsOfOne => {
                words.extend(made.ones.iter().flat_map(|one| record(one, 0, factors)));
            }
            Kernel::Counts | Kernel::CountsByEight => {
                words.extend(lanes.flat_map(|(packet, lane)| {
                    let PacketCounts { points, indices } = &made.counts[packet];
                    [points[lane], indices[lane]]
                }))
            }
            Kernel::Packet | Kernel::PacketByEight | Kernel::PacketOfOne => {
                let patch = |(packet, lane): (usize, usize)| made.packets[packet].patch(lane);
                words.extend(lanes.flat_map(|at| patch_words(patch(at))));
            }
            Kernel::Process | Kernel::CountAndKeep => {
                let patch = |(packet, lane): (usize, usize)| self.kept[packet].patch(lane);
                words.extend(lanes.flat_map(|at| patch_words(patch(at))));
            }
            Kernel::ProcessOne => {
                let sizes = |counts: &Counts| [counts.points, counts.primitives, counts.indices];
                words.extend(self.ones.iter().flat_map(sizes));
            }
            _ => {}
        }
        if matches!(self.kernel, Kernel::Count | Kernel::CountAndKeep) {
            let PartCounts { points, indices, largest, .. } = self.part;
            words.extend([points, indices, largest.into()].map(|n| u32::try_from(n).unwrap_or(!0)));
        }
    }
}

/// The processed factors of a patch; zeros if it is culled.
fn record<const L: usize, const F: usize>(
    Processed { fixed, odd, alive, minimum }: &Processed<L, F>,
    lane: usize,
    factors: usize,
) -> Vec<u32> {
    let alive = alive[lane];
    let mut words = alloc::vec![alive, alive * minimum[lane]];
    let rows = fixed.iter().zip(odd).take(factors);
    words.extend(rows.flat_map(|(fixed, odd)| [alive * fixed[lane], alive * odd[lane]]));
    words
}

/// The values that a packet stores for a patch; zeros if it is culled.
fn patch_words(patch: PacketPatch<'_>) -> Vec<u32> {
    let shown = patch.points() != 0;
    let flags = [patch.is_minimum(), patch.is_compact()].map(u32::from);
    let topology = patch.topology();
    let halves = [topology >> 32, topology & 0xFFFF_FFFF];
    let halves = halves.map(|half| u32::try_from(half).unwrap_or_default());
    let mut words = alloc::vec![patch.points(), patch.indices()];
    words.extend(flags.into_iter().chain(halves));
    for factor in 0..patch.domain().factors() {
        words.push(patch.edge_points(factor));
        let Spacing { split_position, step, lag, .. } = patch.spacing(factor);
        words.extend([split_position, step, lag]);
    }
    words.iter_mut().for_each(|word| *word *= u32::from(shown));
    words
}
