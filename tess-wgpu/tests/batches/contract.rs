//! Promises besides equal bits: sizes, overflow, no silent failures.

use crate::common::device::{Machine, POISON};
use crate::common::expected::Expected;
use std::iter;
use tess_core::{
    Config, Domain, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning, Patch,
    PatchFactors, ProcessedPatch, SplitOrder,
};
use tess_gpu::layout::{Topology, unpack_context};
use tess_gpu::{IndexType, Numbering, Setup, Tap};
use tess_verify::generate::SplitMix64;

fn quads(partitioning: Partitioning) -> Setup {
    Setup::new(Domain::Quad, Config::new(partitioning, OutputPrimitive::TriangleCw))
}

fn uniform(factor: f32, count: usize) -> Vec<PatchFactors> {
    vec![PatchFactors::uniform(Domain::Quad, factor); count]
}

#[test]
fn formats_and_numberings() {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(3);
    for domain in Domain::ALL {
        let patches = crate::common::patches::random(domain, 200, &mut random);
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCcw);
        machine.assert_equal_in_every_format(Setup::new(domain, config), &patches);
    }
}

/// The result of [`tess_wgpu::Tessellator::tessellate`]: the outputs of patches, and the beginning
/// of each.
#[test]
fn whole_outputs_say_where_each_patch_begins() {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(9);
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    for (count, index_type) in [(1, IndexType::U16), (300, IndexType::U32), (3000, IndexType::U16)]
    {
        let patches = crate::common::patches::random(Domain::Triangle, count, &mut random);
        let numbering = Numbering::PerPatch;
        let setup = Setup { numbering, index_type, ..Setup::new(Domain::Triangle, config) };
        let output =
            machine.tessellator.tessellate(&machine.gpu, setup, &patches).expect("it fits");
        let awaited = machine.tessellator.tessellate_async(&machine.gpu, setup, &patches);
        let awaited = pollster::block_on(awaited).expect("it fits");
        assert_eq!(
            (&awaited.points, &awaited.indices),
            (&output.points, &output.indices),
            "{setup:?}: awaited"
        );
        let (mut begins, mut indices) = (Vec::new(), Vec::new());
        let mut points = 0;
        for &factors in &patches {
            begins.push([points, u32::try_from(indices.len() / 3).expect("few")]);
            let patch = Patch::new(config, factors).tessellate();
            points += u32::try_from(patch.points.len()).expect("few");
            indices.extend(patch.indices);
        }
        assert!(output.begins == begins, "{count} patches: where they begin");
        assert!(output.indices == indices, "{count} patches: {index_type:?} widened");
    }
}

/// Two 16-bit indices share a word, also across the boundary of two patches. Each domain with each
/// output, in one of the two numberings.
#[test]
fn indices_of_16_bits() {
    are_written_in_16_bits(|domain, output| [NUMBERINGS[(domain + output) % 2]].to_vec());
}

#[test]
#[ignore = "slow: every output in both numberings"]
fn indices_of_16_bits_in_every_numbering() {
    are_written_in_16_bits(|_, _| NUMBERINGS.to_vec());
}

const NUMBERINGS: [Numbering; 2] = [Numbering::PerPatch, Numbering::PerBatch];

/// Takes the numberings of a domain and an output, which are given by their numbers.
fn are_written_in_16_bits(numberings: impl Fn(usize, usize) -> Vec<Numbering>) {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(8);
    for (at, domain) in Domain::ALL.into_iter().enumerate() {
        for (by, output) in OutputPrimitive::ALL.into_iter().enumerate() {
            let config = Config::new(Partitioning::FractionalEven, output);
            let index_type = IndexType::U16;
            for numbering in numberings(at, by) {
                let setup = Setup { numbering, index_type, ..Setup::new(domain, config) };
                // A batch of more patches can have more points than 16 bits number.
                let most = if numbering == Numbering::PerBatch { 30 } else { 500 };
                for count in [1, 2, 7, most] {
                    let patches = crate::common::patches::random(domain, count, &mut random);
                    machine.assert_equal(setup, &patches);
                }
            }
        }
    }
}

/// 16-bit indices of the whole batch reach 65536 points.
#[test]
fn a_batch_that_16_bits_cannot_number_does_not_fit() {
    let mut machine = Machine::open();
    let setup = Setup { index_type: IndexType::U16, ..quads(Partitioning::Integer) };
    for (count, fits) in [(1 << 14, true), ((1 << 14) + 1, false)] {
        let patches = uniform(1.0, count); // four points each
        let expected = Expected::new(setup, &patches);
        let (points, indices) = expected.words();
        let written = machine.write(setup, &patches, points, indices);
        assert_eq!(written.status.points_overflow(), !fits, "{count} patches");
        assert_eq!(written.status.points(), 4 * count as u64, "points needed");
    }
}

#[test]
fn no_patches_and_culled_patches() {
    let mut machine = Machine::open();
    let setup = quads(Partitioning::FractionalEven);
    machine.assert_equal(setup, &[]);
    machine.assert_equal(setup, &uniform(0.0, 5000));
    // Long runs of culled patches between others, also at tile boundaries.
    let mut mixed = uniform(-1.0, 3000);
    for (number, patch) in mixed.iter_mut().enumerate() {
        if number % 997 == 500 || number > 2990 {
            *patch = PatchFactors::uniform(Domain::Quad, 17.5);
        }
    }
    machine.assert_equal(setup, &mixed);
}

/// Counts that are hard on prefix sums: nothing, everything at the ends, alternation, and numbers
/// of patches around the sizes of blocks and sections.
#[test]
fn adversarial_counts() {
    let mut machine = Machine::open();
    let setup = quads(Partitioning::Integer);
    let large = |number: usize, count: usize| number == 0 || number + 1 == count;
    for count in [1, 2, 255, 256, 257, 511, 512, 513, 65535, 65536, 65537] {
        let patches: Vec<PatchFactors> = (0..count)
            .map(|number| {
                let factor = if large(number, count) { 64.0 } else { [0.0, 1.0, 2.0][number % 3] };
                PatchFactors::uniform(Domain::Quad, factor)
            })
            .collect();
        machine.assert_equal(setup, &patches);
    }
}

/// Output that does not fit is not written, and the status holds the numbers that it needs.
#[test]
fn overflow_is_reported_and_nothing_is_written() {
    let mut machine = Machine::open();
    let setup = quads(Partitioning::Integer);
    let patches = uniform(16.0, 100);
    let expected = Expected::new(setup, &patches);
    let (points, indices) = expected.words();
    for (point_words, index_words, overflows) in [
        (points, indices, [false, false]),
        (points - 2, indices, [true, false]),
        (points, indices - 3, [false, true]),
        (2, 3, [true, true]),
    ] {
        let written = machine.write(setup, &patches, point_words, index_words);
        let status = written.status;
        assert_eq!([status.points_overflow(), status.indices_overflow()], overflows);
        assert_eq!(status.points(), u64::from(points / 2), "points needed");
        assert_eq!(status.primitives(), u64::from(indices / 3), "primitives needed");
        if overflows == [false, false] {
            expected.compare(&written).expect("what fits exactly is written");
        } else {
            assert_eq!(written.draw.index_count, 0, "nothing is drawn");
            let all = written.points.iter().chain(&written.indices);
            assert!(all.copied().all(|word| word == POISON), "nothing is written");
        }
    }
}

/// A batch that only counts, whose output would have more than 2^32 indices.
#[test]
fn counting_2_pow_20_patches() {
    let mut machine = Machine::open();
    let setup = quads(Partitioning::Integer);
    let batch = machine.counted(setup, &uniform(64.0, 1 << 20));
    let (status, _) = machine.status(&batch);
    assert_eq!(status.points(), 4225 << 20, "points");
    assert_eq!(status.primitives(), 8192 << 20, "triangles");
}

/// Output of more than 2^32 points, whose low word by itself would fit.
#[test]
fn overflow_beyond_32_bits() {
    let mut machine = Machine::open();
    let patches = uniform(64.0, 1_016_561);
    let written = machine.write(quads(Partitioning::Integer), &patches, 2 * 4096, 3);
    assert_eq!(written.status.points(), (1 << 32) + 2929, "points");
    assert!(written.status.points_overflow(), "they do not fit 4096");
}

/// More patches than one portion has with default limits.
#[test]
fn counting_in_several_portions() {
    let mut machine = Machine::open();
    let setup = quads(Partitioning::Integer);
    let batch = machine.counted(setup, &uniform(2.0, 1 << 22));
    assert!(batch.plan().portions() > 1, "{:?}", batch.plan());
    let (status, _) = machine.status(&batch);
    assert_eq!(status.points(), 9 << 22, "points");
    assert_eq!(status.primitives(), 8 << 22, "triangles");
}

/// No batch stores contexts of integer factors, but the tap computes them, also that of a factor 1
/// that counts as even.
#[test]
fn contexts_of_integers() {
    let mut machine = Machine::open();
    let mut factors: Vec<(u32, Parity)> = vec![(1, Parity::Even)];
    factors.extend((1..=64).map(|n| (n, if n % 2 == 0 { Parity::Even } else { Parity::Odd })));
    let input: Vec<u32> =
        factors.iter().flat_map(|&(factor, parity)| [factor << 16, parity.odd()]).collect();
    for split in SplitOrder::ALL {
        let mut setup = quads(Partitioning::Integer);
        setup.config.split = split;
        let found = machine.tessellator.tap(&machine.gpu, Tap::Contexts, setup, &input);
        let (found, _) = found.as_deref().expect("the device answers").as_chunks();
        let expected = factors.iter().map(|&(factor, parity)| {
            FactorContext::new(FixedFactor::from_bits(factor << 16), parity, split)
        });
        assert!(found.iter().map(|&words| unpack_context(words)).eq(expected), "{split:?}");
    }
}

/// A quad whose factors are halfway between two 15.16 numbers, up to factors of 64.
fn of_ties(random: &mut SplitMix64) -> PatchFactors {
    PatchFactors::from_fn(Domain::Quad, |_| {
        let exponent = 127 + random.below(6);
        // The number of bits of the mantissa that are below 2^-16.
        let below = 134 - exponent;
        let mantissa = random.below(1 << 23) >> below << below | 1 << (below - 1);
        f32::from_bits(exponent << 23 | mantissa)
    })
}

/// Every stage's intermediate values: topologies, contexts and counts of each patch.
#[test]
fn intermediate_buffers() {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(4);
    for partitioning in Partitioning::ALL {
        let setup = quads(partitioning);
        let mut patches = crate::common::patches::random(Domain::Quad, 1000, &mut random);
        patches.extend(iter::repeat_with(|| of_ties(&mut random)).take(200));
        let batch = machine.counted(setup, &patches);
        let contexts = machine.words(batch.contexts());
        let topologies = machine.words(batch.topologies());
        let stride = contexts.len() / 12;
        for (number, &raw) in patches.iter().enumerate() {
            let patch = Patch::new(setup.config, raw);
            let topology = Topology([topologies[2 * number], topologies[2 * number + 1]]);
            let (state, factors) = match patch.processed() {
                ProcessedPatch::Culled => (0, None),
                ProcessedPatch::Minimum(_) => (1, None),
                ProcessedPatch::Regular(factors) => (2, Some(factors)),
            };
            assert_eq!(topology.state(), state, "state of {raw:?}");
            let Some(factors) = factors else { continue };
            let edges = [0, 1, 2, 3].map(|edge| topology.outer_points(edge));
            let points = edges.into_iter().chain(topology.inside_points());
            assert!(points.eq(factors.iter().map(|f| f.context.points)), "points of {raw:?}");
            if setup.has_integer_factors() {
                continue; // no contexts are stored
            }
            for (factor, expected) in factors.iter().enumerate() {
                let at = 2 * (factor * stride + number);
                let observed = unpack_context([contexts[at], contexts[at + 1]]);
                assert_eq!(observed, expected.context, "factor {factor} of {raw:?}");
            }
        }
    }
}
