//! Stages of numbers, and of packets' raw factors.

use super::Kernel;
use super::{TapInput, TapOutput};
use crate::data::format::OutputPoint;
use crate::data::lanes::LANES;
use crate::data::numbers::Numbers;
use crate::kernels::taps::locations;
use crate::stages::counts::PacketCounts;
use crate::stages::factor_context::{PlainContext, point_count};
use crate::stages::factors::{self, Processed};
use crate::stages::packet::{Packet, ROWS, packet_counts};
use crate::stages::place::{Spacing, place_in_half};
use crate::stages::reciprocal::reciprocal;
use crate::stages::stitch::Codes;
use alloc::vec::Vec;
use tess_core::Partitioning;
use tess_core::fixed_point::ONE;
use tess_core::stitch::Diagonals;
use wide::i32x8;

/// Runs a stage whose input is numbers or raw factors; returns whether the kernel is such a stage.
#[inline(always)]
pub(crate) fn of_numbers(kernel: Kernel, work: &TapInput, made: &mut TapOutput) -> bool {
    let (numbers, words) = (&work.numbers[..], &mut made.words);
    words.clear();
    let (odd, split) = (work.parity.odd(), work.settings.config.split);
    match kernel {
        Kernel::Reciprocal => columns(numbers, words, |n| [reciprocal(n)]),
        Kernel::Clamp => {
            let (low, high) = bounds(work.settings.config.partitioning);
            let [low, high] = [low, high].map(|bound| bound.to_bits().cast_signed());
            columns(numbers, words, |x| signed(x, |x| factors::clamp(x, low, high)));
        }
        Kernel::Ceil => columns(numbers, words, |x| signed(x, factors::ceil)),
        Kernel::ToFixed => columns(numbers, words, |x| signed(x, factors::to_fixed)),
        Kernel::PointCount => columns(numbers, words, |fixed| [point_count(fixed, odd)]),
        Kernel::Context => columns(numbers, words, |fixed| {
            let made = PlainContext::new(fixed, odd, split);
            let PlainContext {
                inv_floor,
                inv_ceil,
                fraction,
                half_points,
                split_position,
                points,
                ..
            } = made;
            [inv_floor, inv_ceil, fraction, half_points, split_position, points]
        }),
        Kernel::Place => locations(&work.contexts, words),
        Kernel::PlaceInHalf => {
            for context in &work.contexts {
                let spacing = Spacing::new(&PlainContext::from(context));
                let half = 0..context.points.div_ceil(2);
                words.extend(half.map(|position| place_in_half(&spacing, position)));
            }
        }
        Kernel::Float => {
            columns(numbers, words, |x| <[f32; 2]>::from_bits(x, ONE - x).map(f32::to_bits));
        }
        Kernel::Stitches => {
            for &number in numbers {
                let Codes { codes, length } = stitch(work, number);
                words.extend(codes[..length].iter().map(|&code| i32::from(code).cast_unsigned()));
            }
        }
        _ => return of_raw(kernel, work, made),
    }
    true
}

/// Runs a stage whose input is raw factors; returns whether the kernel is such a stage. It has
/// loops because a closure in `extend` would not get the level's instructions.
#[inline(always)]
fn of_raw(kernel: Kernel, work: &TapInput, made: &mut TapOutput) -> bool {
    let config = work.settings.config;
    match kernel {
        Kernel::Factors => process::<i32>(work, &mut made.processed),
        Kernel::FactorsByEight => process::<i32x8>(work, &mut made.processed),
        Kernel::FactorsOfOne => {
            made.ones.clear();
            for factors in &work.patches {
                let mut raw = [[0.0]; ROWS];
                raw.iter_mut().zip(factors.iter()).for_each(|(raw, factor)| *raw = [factor]);
                made.ones.push(factors::process::<i32, _, _>(
                    config.partitioning,
                    work.domain,
                    &raw,
                ));
            }
        }
        Kernel::Counts => counts::<i32>(work, &mut made.counts),
        Kernel::CountsByEight => counts::<i32x8>(work, &mut made.counts),
        Kernel::Packet => packets::<i32>(work, &mut made.packets),
        Kernel::PacketByEight => packets::<i32x8>(work, &mut made.packets),
        Kernel::PacketOfOne => {
            made.packets.resize(work.raw.len(), Packet::EMPTY);
            for (packet, patches) in made.packets.iter_mut().zip(work.patches.chunks(LANES)) {
                for (lane, &factors) in patches.iter().enumerate() {
                    packet.process_one(config, lane, factors);
                }
            }
        }
        _ => return false,
    }
    true
}

#[inline(always)]
fn process<V: Numbers>(work: &TapInput, processed: &mut Vec<Processed>) {
    let partitioning = work.settings.config.partitioning;
    processed.clear();
    for raw in &work.raw {
        processed.push(factors::process::<V, _, _>(partitioning, work.domain, raw));
    }
}

#[inline(always)]
fn counts<V: Numbers>(work: &TapInput, counts: &mut Vec<PacketCounts>) {
    counts.clear();
    for raw in &work.raw {
        counts.push(packet_counts::<V>(work.settings.config, work.domain, raw));
    }
}

#[inline(always)]
fn packets<V: Numbers>(work: &TapInput, packets: &mut Vec<Packet>) {
    packets.resize(work.raw.len(), Packet::EMPTY);
    for (packet, raw) in packets.iter_mut().zip(&work.raw) {
        packet.process::<V>(work.settings.config, work.domain, raw);
    }
}

/// The result of a formula over signed numbers.
#[inline(always)]
fn signed(x: u32, formula: impl Fn(i32) -> i32) -> [u32; 1] {
    [formula(x.cast_signed()).cast_unsigned()]
}

/// The bounds of an inside factor if all other factors are 3.
const fn bounds(partitioning: Partitioning) -> (f32, f32) {
    let (low, high) = partitioning.range();
    let odd = matches!(partitioning, Partitioning::FractionalOdd);
    (if odd { f32::from_bits(0x3F80_0080) } else { low }, high)
}

/// The results of `f` for each number, a vector at a time: all first results, then all second ones.
#[inline(always)]
fn columns<const N: usize>(numbers: &[u32], words: &mut Vec<u32>, f: impl Fn(u32) -> [u32; N]) {
    let all = numbers.len();
    words.resize(N * all, 0);
    for (block, numbers) in numbers.as_chunks::<LANES>().0.iter().enumerate() {
        let mut made = [[0; LANES]; N];
        for lane in 0..LANES {
            let results = f(numbers[lane]);
            for k in 0..N {
                made[k][lane] = results[k];
            }
        }
        for (k, made) in made.iter().enumerate() {
            words[k * all + block * LANES..][..LANES].copy_from_slice(made);
        }
    }
}

/// The stitch that a number describes: see [`crate::Input::numbers`].
#[inline(always)]
pub(super) fn stitch(work: &TapInput, number: u32) -> Codes<'_> {
    let [kind, outer, inner, _] = number.to_be_bytes().map(u32::from);
    let stitches = &work.settings.stitches;
    match kind {
        0 => stitches.transition(outer, inner),
        1 => stitches.ring(inner),
        2 => stitches.strip(inner, Diagonals::Forward),
        _ => stitches.strip(inner, Diagonals::ForwardExceptMiddle),
    }
}
