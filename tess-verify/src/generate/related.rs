//! Families of related patches, which the rules of the standards compare.

use super::{from_fixed, pick};
use crate::case::Case;
use crate::generate::SplitMix64;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};

/// Levels of a patch's relatives that discard: 0, below 0, or NaN.
const NOT_ABOVE_ZERO: [f32; 4] = [0.0, -1.0, f32::NAN, f32::NEG_INFINITY];
/// Inner levels of a patch's relatives: 1, below 1, or NaN.
const NOT_ABOVE_ONE: [f32; 5] = [1.0, 0.5, 0.0, -3.0, f32::NAN];

/// The levels of the systematic families: integers, levels just above them, and fractions of both
/// parities.
fn levels() -> Vec<f32> {
    let just_above = |n: u32| {
        let exact = from_fixed(n << 16);
        [
            exact,
            f32::from_bits(exact.to_bits() + 1),
            from_fixed((n << 16) + 1),
            from_fixed((n << 16) + 8),
            from_fixed((n << 16) + 9),
        ]
    };
    let mut levels: Vec<f32> =
        [1, 2, 3, 4, 5, 8, 13, 30].into_iter().flat_map(just_above).collect();
    levels.extend((1..=8).map(|eighth| from_fixed((5 << 16) + (eighth << 14))));
    levels.extend([0.25, 30.001_083, 53.0, 62.5, 63.0, 63.5, 64.0, 100.0]);
    levels
}

/// A family for each level of each domain and spacing, and the patches next to the smallest one
/// with an inside.
pub(super) fn systematic() -> Vec<Case> {
    let levels = levels();
    let mut cases = Vec::new();
    for domain in Domain::ALL {
        for partitioning in
            [Partitioning::Integer, Partitioning::FractionalOdd, Partitioning::FractionalEven]
        {
            for (turn, &level) in levels.iter().enumerate() {
                let split = if turn % 5 == 4 { SplitOrder::Centre } else { SplitOrder::Ruler };
                let config = Config { partitioning, output: OutputPrimitive::TriangleCw, split };
                let plain = [3.0, 2.5, 4.0, 1.0, 3.5, 5.0];
                let at = |position| {
                    if position == turn % domain.factors() {
                        level
                    } else {
                        plain[(position + turn) % plain.len()]
                    }
                };
                family(
                    Case { config, factors: PatchFactors::from_fn(domain, at) },
                    turn,
                    &mut cases,
                );
                let uniform = PatchFactors::uniform(domain, level);
                family(Case { config, factors: uniform }, turn, &mut cases);
            }
        }
    }
    // A level that is barely above 1 decides whether there is an inside only if all other levels
    // are 1.
    let frames = super::thresholds().into_iter().filter(|(side, _)| side.starts_with("frame/"));
    cases.extend(frames.map(|(_, case)| case));
    powers_of_two(&mut cases);
    unusual_levels(&mut cases);
    changing_state(&mut cases);
    cases
}

/// Families with pow2, which a device might not treat like integer spacing.
fn powers_of_two(cases: &mut Vec<Case>) {
    let (output, split) = (OutputPrimitive::TriangleCw, SplitOrder::Ruler);
    let config = Config { partitioning: Partitioning::Pow2, output, split };
    for domain in Domain::ALL {
        for (turn, level) in [3.0, 5.0, 6.5, 13.0, 64.0].into_iter().enumerate() {
            let plain = [3.0, 2.5, 4.0, 1.0, 3.5, 5.0];
            let at = |position: usize| {
                if position == turn % domain.factors() { level } else { plain[position] }
            };
            family(Case { config, factors: PatchFactors::from_fn(domain, at) }, turn, cases);
        }
    }
}

/// Each position in turn with a level at the limits of positive numbers or beyond the spacing's
/// range; the other levels are ordinary.
fn unusual_levels(cases: &mut Vec<Case>) {
    let (output, split) = (OutputPrimitive::TriangleCw, SplitOrder::Ruler);
    let smallest = f32::from_bits(1);
    let outer = [0.0, -0.0, smallest, f32::MIN_POSITIVE, 1e-6, f32::INFINITY];
    let inner = [-0.0, smallest, 0.75, 100.0, f32::INFINITY, f32::NEG_INFINITY];
    for domain in Domain::ALL {
        for partitioning in
            [Partitioning::Integer, Partitioning::FractionalOdd, Partitioning::FractionalEven]
        {
            let config = Config { partitioning, output, split };
            for position in 0..domain.factors() {
                let levels = if position < domain.outer_factors() { outer } else { inner };
                let others = Case { config, factors: PatchFactors::uniform(domain, 3.5) };
                cases.extend(levels.map(|level| others.with_factor(position, level)));
            }
            // This patch differs from one whose levels are all 1 only in its inside.
            let inner = [2.5, 4.5];
            let level = |p: usize| p.checked_sub(domain.outer_factors()).map_or(1.0, |k| inner[k]);
            let factors = PatchFactors::from_fn(domain, level);
            cases.extend((domain != Domain::Isoline).then_some(Case { config, factors }));
        }
    }
}

/// Patches that each have another domain than the one before; the output changes every three
/// patches, and the spacing every nine.
fn changing_state(cases: &mut Vec<Case>) {
    let outputs =
        [OutputPrimitive::TriangleCcw, OutputPrimitive::TriangleCw, OutputPrimitive::Point];
    let spacings =
        [Partitioning::FractionalEven, Partitioning::Integer, Partitioning::FractionalOdd];
    for levels in [[2.5, 3.5, 4.25, 5.5, 6.5, 3.25], [4.5, 2.25, 3.0, 6.25, 2.75, 5.0]] {
        for partitioning in spacings {
            for output in outputs {
                let config = Config { partitioning, output, split: SplitOrder::Ruler };
                let patch = |domain| Case {
                    config,
                    factors: PatchFactors::from_fn(domain, |position| levels[position]),
                };
                cases.extend([Domain::Quad, Domain::Isoline, Domain::Triangle].map(patch));
            }
        }
    }
}

/// An endless sequence of random families in these domains, partitionings and split orders.
pub(super) fn random(
    mut random: SplitMix64,
    domains: Vec<Domain>,
    partitionings: Vec<Partitioning>,
    splits: Vec<SplitOrder>,
) -> impl Iterator<Item = Case> {
    let mut cases = Vec::new();
    std::iter::from_fn(move || {
        if cases.is_empty() {
            let config = Config {
                partitioning: pick(&mut random, &partitionings),
                output: OutputPrimitive::TriangleCw,
                split: pick(&mut random, &splits),
            };
            let domain = pick(&mut random, &domains);
            let factors = PatchFactors::from_fn(domain, |_| random_level(&mut random));
            family(Case { config, factors }, random.next_u32() as usize, &mut cases);
            cases.reverse();
        }
        cases.pop()
    })
}

/// A level that is usually small: near an integer, or anywhere.
fn random_level(random: &mut SplitMix64) -> f32 {
    let top = if random.below(16) == 0 { 64 } else { 9 };
    match random.below(4) {
        0 => from_fixed((random.below(top) + 1) << 16),
        1 => from_fixed(((random.below(top) + 1) << 16) + random.below(16)),
        _ => from_fixed((1 << 16) + random.below(top << 16)),
    }
}

/// A patch and its relatives: the same patch again, with the other winding, as points and as lines;
/// with one level changed; with the outer levels rotated; with an inner level that is not above 1;
/// and with an outer level that discards.
fn family(base: Case, turn: usize, cases: &mut Vec<Case>) {
    let with_output = |output| Case { config: Config { output, ..base.config }, ..base };
    let (outer, all) = (base.domain().outer_factors(), base.domain().factors());
    let raised = |position: usize| {
        let bits = base.factors.iter().nth(position).unwrap_or_default();
        if bits < 8.0 { 9.0 } else { 2.0 }
    };
    cases.extend([base, base, with_output(OutputPrimitive::TriangleCcw)]);
    cases.extend([OutputPrimitive::Point, OutputPrimitive::Line].map(with_output));
    cases.extend((0..all).map(|position| base.with_factor(position, raised(position))));
    let levels: Vec<f32> = base.factors.iter().collect();
    cases.extend((1..outer).map(|by| {
        let level = |p: usize| levels[if p < outer { (p + by) % outer } else { p }];
        Case { factors: PatchFactors::from_fn(base.domain(), level), ..base }
    }));
    let discards = NOT_ABOVE_ZERO[turn % NOT_ABOVE_ZERO.len()];
    cases.extend((0..outer).map(|position| base.with_factor(position, discards)));
    let low = NOT_ABOVE_ONE[turn % NOT_ABOVE_ONE.len()];
    cases.extend((outer..all).map(|position| base.with_factor(position, low)));
}
