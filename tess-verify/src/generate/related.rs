//! Patches for the rules of the standards, which compare related ones.
//!
//! A fault in one number, one fraction or one role is found only by a question that has it. So the
//! systematic questions are products, and no two parts of a product share a counter:
//!
//! ```text
//! numbers    split order x domain x spacing x role x every number of segments    (numbers.rs)
//! classes    split order x domain x spacing x role x every class of value        (classes.rs)
//! families   split order x domain x spacing x role x a few levels, with a patch's relatives
//! registers  role x class of value, and then each domain                         (registers.rs)
//! stitches   split order x domain x number on an edge x number inside            (levels.rs)
//! ```
//!
//! A role is a position of a factor. `rules/asked.rs` counts what was asked.

use super::choices::Choices;
use super::classes::classes;
use super::levels::{interiors, transitions};
use super::numbers::{numbers, powers_of_two};
use super::registers::registers;
use super::{from_fixed, pick};
use crate::case::Case;
use crate::generate::SplitMix64;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};

/// Levels of a patch's relatives that discard: 0, below 0, or NaN.
const NOT_ABOVE_ZERO: [f32; 4] = [0.0, -1.0, f32::NAN, f32::NEG_INFINITY];
/// Inner levels of a patch's relatives: 1, below 1, or NaN.
const NOT_ABOVE_ONE: [f32; 5] = [1.0, 0.5, 0.0, -3.0, f32::NAN];
/// The other levels of a systematic family.
const PLAIN: [f32; 6] = [3.0, 2.5, 4.0, 1.0, 3.5, 5.0];

/// The levels of the systematic families: 1, levels at and just above 3, and fractions.
fn levels() -> [f32; 10] {
    let above_3 = from_fixed((3 << 16) + 1);
    [0.25, 1.0, 3.0, f32::from_bits(0x4040_0001), above_3, 4.0, 5.75, 6.5, 13.5, 30.001_083]
}

/// The systematic patches of a selection. Outputs are not considered.
pub(super) fn systematic(choices: &Choices) -> Vec<Case> {
    let mut cases = Vec::new();
    for &split in &choices.splits {
        for (domain, partitioning) in choices.combinations() {
            let config = Config { partitioning, output: surface(domain), split };
            if partitioning == Partitioning::Pow2 {
                powers_of_two(domain, config, &mut cases);
                families(domain, config, &[3.0, 5.0, 6.5, 13.0, 64.0], &mut cases);
                continue;
            }
            numbers(domain, config, &mut cases);
            classes(domain, config, &mut cases);
            families(domain, config, &levels(), &mut cases);
        }
        // A level that is barely above 1 decides whether there is an inside only if all other
        // levels are 1.
        let frames = super::thresholds().into_iter().filter(|(side, _)| side.starts_with("frame/"));
        let in_order = |case: Case| Case { config: Config { split, ..case.config }, ..case };
        cases.extend(frames.map(|(_, case)| in_order(case)));
        changing_state(split, &mut cases);
        registers(&choices.domains, choices.registers(split), &mut cases);
        stitches(split, choices, &mut cases);
    }
    cases
}

/// Every pair of a number on an edge and a number inside, and quads with every number of rings. A
/// device may have a table of the triangles between two rows of points, and one entry may be wrong.
///
/// The triangles depend on the numbers only, so one spacing is enough. Only triangles show them.
fn stitches(split: SplitOrder, choices: &Choices, cases: &mut Vec<Case>) {
    let is_triangles = |output: &OutputPrimitive| {
        matches!(output, OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw)
    };
    if !choices.outputs.iter().any(is_triangles) {
        return;
    }
    let partitionings = vec![choices.partitioning(&[Partitioning::Integer])];
    let own = Choices { partitionings, splits: vec![split], ..choices.clone() };
    transitions(cases, &own);
    // Triangles with every number of rings are among `numbers`.
    let domains = choices.domains.iter().copied().filter(|domain| *domain == Domain::Quad);
    let quads = Choices { domains: domains.collect(), ..own };
    interiors(cases, &quads, |u, v| u == v || u.max(v) <= 9);
}

/// The output that shows a patch's primitives.
const fn surface(domain: Domain) -> OutputPrimitive {
    match domain {
        Domain::Isoline => OutputPrimitive::Line,
        Domain::Triangle | Domain::Quad => OutputPrimitive::TriangleCw,
    }
}

/// A family for each level in each position, and with the level in all positions.
fn families(domain: Domain, config: Config, levels: &[f32], cases: &mut Vec<Case>) {
    for &level in levels {
        for position in 0..domain.factors() {
            let at = |p: usize| if p == position { level } else { PLAIN[p] };
            family(Case { config, factors: PatchFactors::from_fn(domain, at) }, cases);
        }
        family(Case { config, factors: PatchFactors::uniform(domain, level) }, cases);
    }
}

/// Patches that each have another domain than the one before; the output changes every three
/// patches, and the spacing every nine.
fn changing_state(split: SplitOrder, cases: &mut Vec<Case>) {
    let outputs =
        [OutputPrimitive::TriangleCcw, OutputPrimitive::TriangleCw, OutputPrimitive::Point];
    let spacings =
        [Partitioning::FractionalEven, Partitioning::Integer, Partitioning::FractionalOdd];
    for levels in [[2.5, 3.5, 4.25, 5.5, 6.5, 3.25], [4.5, 2.25, 3.0, 6.25, 2.75, 5.0]] {
        for partitioning in spacings {
            for output in outputs {
                let config = Config { partitioning, output, split };
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
            let domain = pick(&mut random, &domains);
            let config = Config {
                partitioning: pick(&mut random, &partitionings),
                output: surface(domain),
                split: pick(&mut random, &splits),
            };
            // One level of every second family is from the whole range, which keeps patches small.
            let positions = u32::try_from(domain.factors()).unwrap_or(u32::MAX);
            let wide = random.below(2 * positions) as usize;
            let level = |p| random_level(if p == wide { 6 } else { 3 }, &mut random);
            let base = Case { config, factors: PatchFactors::from_fn(domain, level) };
            family(base, &mut cases);
            low_and_discarding(base, &mut random, &mut cases);
            cases.reverse();
        }
        cases.pop()
    })
}

/// A level from 1 to 2^`binades`, evenly among the binades: an integer, near one, or anywhere.
fn random_level(binades: u32, random: &mut SplitMix64) -> f32 {
    let (exponent, mantissa) = (127 + random.below(binades), random.below(1 << 23));
    let level = f32::from_bits(exponent << 23 | mantissa);
    match random.below(4) {
        0 => level.ceil(),
        1 => f32::from_bits(level.floor().to_bits() + random.below(2048)),
        _ => level,
    }
}

/// A patch and its relatives: the same patch again, with the other winding, as points and as lines;
/// with one level changed; and with the outer levels rotated.
fn family(base: Case, cases: &mut Vec<Case>) {
    let (outer, all) = (base.domain().outer_factors(), base.domain().factors());
    let raised = |position: usize| {
        let bits = base.factors.iter().nth(position).unwrap_or_default();
        if bits < 8.0 { 9.0 } else { 2.0 }
    };
    cases.extend([base, base]);
    let others = OutputPrimitive::ALL.into_iter().filter(|own| *own != base.config.output);
    cases.extend(others.map(|output| base.with_output(output)));
    cases.extend((0..all).map(|position| base.with_factor(position, raised(position))));
    let levels: Vec<f32> = base.factors.iter().collect();
    cases.extend((1..outer).map(|by| {
        let level = |p: usize| levels[if p < outer { (p + by) % outer } else { p }];
        Case { factors: PatchFactors::from_fn(base.domain(), level), ..base }
    }));
}

/// A patch with each outer level in turn at a value that discards, and each inner one at a value
/// that is not above 1.
fn low_and_discarding(base: Case, random: &mut SplitMix64, cases: &mut Vec<Case>) {
    let (outer, all) = (base.domain().outer_factors(), base.domain().factors());
    let discards = pick(random, &NOT_ABOVE_ZERO);
    cases.extend((0..outer).map(|position| base.with_factor(position, discards)));
    let low = pick(random, &NOT_ABOVE_ONE);
    cases.extend((outer..all).map(|position| base.with_factor(position, low)));
}
