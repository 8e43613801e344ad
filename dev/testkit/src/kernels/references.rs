//! The model's answers for each kernel, in the order in which `KernelTap::words` lists them:
//! numbers and the front end.

mod output;

pub(crate) use output::*;

use super::Case;
use super::inputs::is_compact;
use super::words::Words;
use tess_core::factors::process;
use tess_core::fixed_point::ONE;
use tess_core::place::place;
use tess_core::reciprocal::reciprocal;
use tess_core::{
    Config, FactorContext, FixedFactor, OutputPrimitive, Partitioning, Patch, PatchFactors,
    ProcessedFactor, ProcessedPatch, TriangleFactors,
};

pub(crate) fn reciprocals(case: &Case, words: &mut Words) {
    let of = |&n: &u32| reciprocal(n).unwrap_or(0);
    words.each(&["1/n"], case.input.numbers.iter().map(of));
}

/// The processed inside factor of a triangle whose other factors are 3.
fn inside(partitioning: Partitioning, bits: u32) -> ProcessedFactor {
    let raw = TriangleFactors { inside: f32::from_bits(bits), ..TriangleFactors::uniform(3.0) };
    let config = Config::new(partitioning, OutputPrimitive::Point);
    match process(config, raw.into()) {
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => factors.inside,
        other => panic!("a regular triangle, not {other:?}"),
    }
}

pub(crate) fn clamped(case: &Case, words: &mut Words) {
    let partitioning = case.input.config.partitioning;
    let of = |&bits: &u32| inside(partitioning, bits).clamped;
    words.each(&["clamped factor"], case.input.numbers.iter().map(of));
}

pub(crate) fn ceilings(case: &Case, words: &mut Words) {
    let of = |&bits: &u32| inside(Partitioning::Integer, bits).fixed.to_bits() >> 16;
    words.each(&["ceiling"], case.input.numbers.iter().map(of));
}

pub(crate) fn fixed(case: &Case, words: &mut Words) {
    let of = |&bits: &u32| FixedFactor::from_f32(f32::from_bits(bits)).to_bits();
    words.each(&["fixed-point factor"], case.input.numbers.iter().map(of));
}

pub(crate) fn factors(case: &Case, words: &mut Words) {
    for (number, &raw) in case.input.patches.iter().enumerate() {
        let processed = process(case.input.config, raw);
        let (none, zeros) = ([0; 2], [[0; 2]; 6]);
        let Some(factors) = processed.factors() else {
            words.add(number, &["is not culled", "is a minimum patch"], none);
            words.add(number, FACTOR, zeros.into_iter().flatten().take(2 * raw.iter().len()));
            continue;
        };
        let minimum = matches!(processed, ProcessedPatch::Minimum(_));
        words.add(number, &["is not culled", "is a minimum patch"], [1, minimum.into()]);
        let of = |factor: ProcessedFactor| [factor.fixed.to_bits(), factor.context.parity.odd()];
        words.add(number, FACTOR, factors.iter().flat_map(of));
    }
}

const FACTOR: &[&str] = &["fixed point of factor", "odd parity of factor"];

/// The contexts of numbers.
fn contexts_of(case: &Case) -> impl Iterator<Item = FactorContext> + Clone {
    let (parity, split) = (case.input.parity, case.input.config.split);
    let of = move |&bits: &u32| FactorContext::new(FixedFactor::from_bits(bits), parity, split);
    case.input.numbers.iter().map(of)
}

pub(crate) fn contexts(case: &Case, words: &mut Words) {
    let all: Vec<_> = contexts_of(case).collect();
    words.each(&["inv_floor"], all.iter().map(|context| context.inv_floor));
    words.each(&["inv_ceil"], all.iter().map(|context| context.inv_ceil));
    words.each(&["fraction"], all.iter().map(|context| context.fraction));
    words.each(&["half_points"], all.iter().map(|context| context.half_points));
    words.each(&["split"], all.iter().map(|context| context.split_position));
    words.each(&["points"], all.iter().map(|context| context.points));
}

pub(crate) fn point_counts(case: &Case, words: &mut Words) {
    words.each(&["points"], contexts_of(case).map(|context| context.points));
}

pub(crate) fn locations(case: &Case, words: &mut Words) {
    for (number, context) in contexts_of(case).enumerate() {
        words.add(number, &["location of point"], places(&context, context.points));
    }
}

pub(crate) fn half_locations(case: &Case, words: &mut Words) {
    for (number, context) in contexts_of(case).enumerate() {
        words.add(number, &["location of point"], places(&context, context.points.div_ceil(2)));
    }
}

fn places(context: &FactorContext, points: u32) -> impl Iterator<Item = u32> {
    (0..points).map(|p| place(context, p).to_bits())
}

pub(crate) fn counts(case: &Case, words: &mut Words) {
    for (number, &factors) in case.input.patches.iter().enumerate() {
        let counts = Patch::new(case.input.config, factors).counts();
        words.add(number, &["points, number", "indices, number"], [counts.points, counts.indices]);
    }
}

pub(crate) fn counts_of_each(case: &Case, words: &mut Words) {
    const NAMES: &[&str] = &["points, number", "primitives, number", "indices, number"];
    for (number, &factors) in case.input.patches.iter().enumerate() {
        let counts = Patch::new(case.input.config, factors).counts();
        words.add(number, NAMES, [counts.points, counts.primitives, counts.indices]);
    }
}

pub(crate) fn packets(case: &Case, words: &mut Words) {
    const NAMES: &[&str] =
        &["points", "indices", "is minimum", "is compact", "topology, upper", "topology, lower"];
    const SPACING: &[&str] =
        &["points of factor", "split of factor", "step of factor", "lag of factor"];
    for (number, &raw) in case.input.patches.iter().enumerate() {
        let patch = Patch::new(case.input.config, raw);
        let count = raw.iter().len();
        let Some(factors) = patch.processed().factors() else {
            words.add(number, NAMES, [0; 6]);
            words.add(number, SPACING, [0; 24].into_iter().take(4 * count));
            continue;
        };
        let minimum = matches!(patch.processed(), ProcessedPatch::Minimum(_));
        let points = |i| factors.iter().nth(i).map_or(0, |factor| factor.context.points);
        let all = (0..6).fold(1, |all, i| (all << 7) | u64::from(points(i)));
        let topology = (all << 1) | u64::from(minimum);
        let halves =
            [topology >> 32, topology & 0xFFFF_FFFF].map(|half| u32::try_from(half).unwrap_or(0));
        let sizes = [patch.counts().points, patch.counts().indices];
        let flags = [minimum, is_compact(&patch, raw.domain())].map(u32::from);
        words.add(number, NAMES, sizes.into_iter().chain(flags).chain(halves));
        words.add(number, SPACING, factors.iter().flat_map(|factor| spacing(&factor.context)));
    }
}

/// The point count, and the coefficients of the sum that [`place`] rounds, as a function of the
/// position.
fn spacing(context: &FactorContext) -> [u32; 4] {
    let FactorContext { inv_floor, inv_ceil, fraction, split_position, points, .. } = *context;
    // Both modulo 2^32: positions are small enough for the rest.
    let lag = inv_floor.wrapping_mul(ONE - fraction);
    [points, split_position, lag.wrapping_add(inv_ceil.wrapping_mul(fraction)), lag]
}

pub(crate) fn totals(case: &Case, words: &mut Words) {
    let sum = case.input.patches.iter().fold([0; 3], |[points, indices, largest], &factors| {
        let counts = Patch::new(case.input.config, factors).counts();
        [points + counts.points, indices + counts.indices, largest.max(counts.points)]
    });
    words.add(0, &["all points", "all indices", "largest patch"], sum);
}

pub(crate) fn packets_and_totals(case: &Case, words: &mut Words) {
    packets(case, words);
    totals(case, words);
}
