//! The systematic parts of levels 1 and 2.
//!
//! Every part covers exactly what is selected. If one split order or one partitioning is selected,
//! the result is a whole level of its own, not the few cases that a larger selection has for it.

use super::choices::Choices;
use super::registers::registers;
use super::{boundary_factors, exceptional_factors, from_fixed, ordinary_factors, special_factors};
use crate::case::Case;
use tess_core::{Config, Domain, Partitioning, PatchFactors, QuadFactors};

/// Factors for the positions that a case does not test, small enough to keep its output short.
const PLAIN: [f32; 8] = [3.0, 1.0, 4.5, 2.0, 7.25, 5.0, 1.5, 6.0];

/// Factors whose split points differ between the split orders, and whose counts differ between all
/// partitionings. Integer and pow2 are the exception: a tessellator treats them the same.
const TELLING: [f32; 6] = [6.75, 10.25, 8.5, 12.75, 9.25, 7.5];

/// Every boundary once: special and boundary factors in rotating positions, special factors in
/// every position, every transition in each split order, small and large interiors, patches next to
/// minimum ones, both sides of every comparison, and every value of a configuration after every
/// other.
pub(super) fn one(choices: &Choices) -> Vec<Case> {
    let mut cases = Vec::new();
    for (domain, partitioning) in choices.combinations() {
        boundaries(&mut cases, choices, domain, partitioning);
        specials_everywhere(&mut cases, choices, domain, partitioning);
        all_equal(&mut cases, choices, domain, partitioning);
        beside_minimum(&mut cases, choices, domain, partitioning);
    }
    transitions(&mut cases, choices);
    interiors(&mut cases, choices, |u, v| u == v || u.max(v) <= 9 || (u % 15 < 3 && v % 15 < 3));
    every_configuration(&mut cases, choices);
    cases.extend(super::thresholds::of(choices).into_iter().map(|(_, case)| case));
    sequences(&mut cases, choices);
    cases
}

/// Every boundary in every position and both split orders, and every interior.
pub(super) fn two(choices: &Choices) -> Vec<Case> {
    let mut cases = one(choices);
    for (domain, partitioning) in choices.combinations() {
        let values = boundary_factors();
        for position in 0..domain.factors() {
            for (i, &value) in values.iter().enumerate() {
                // Turns that are four apart have different split orders.
                for turn in [i, i + 4].into_iter().take(choices.splits.len()) {
                    cases.push(one_value(choices, domain, partitioning, turn, position, value));
                }
            }
        }
    }
    interiors(&mut cases, choices, |_, _| true);
    cases
}

/// A case in which one factor is `value` and the others are plain.
fn one_value(
    choices: &Choices,
    domain: Domain,
    partitioning: Partitioning,
    turn: usize,
    position: usize,
    value: f32,
) -> Case {
    let factor = |p| if p == position { value } else { PLAIN[(turn + p) % PLAIN.len()] };
    let factors = PatchFactors::from_fn(domain, factor);
    Case { config: choices.config(partitioning, turn), factors }
}

/// Each boundary as an outer and as an inside factor, in rotating positions. For isolines: as the
/// density and as the detail.
fn boundaries(
    cases: &mut Vec<Case>,
    choices: &Choices,
    domain: Domain,
    partitioning: Partitioning,
) {
    let (outer, all) = (domain.outer_factors(), domain.factors());
    let values = [ordinary_factors(), exceptional_factors()].concat();
    for (i, &value) in values.iter().enumerate() {
        let inside = if outer == all { (i + 1) % outer } else { outer + i % (all - outer) };
        for (turn, position) in [(i, i % outer), (i + 1, inside)] {
            cases.push(one_value(choices, domain, partitioning, turn, position, value));
        }
    }
}

fn specials_everywhere(
    cases: &mut Vec<Case>,
    choices: &Choices,
    domain: Domain,
    partitioning: Partitioning,
) {
    for position in 0..domain.factors() {
        for (i, &value) in special_factors().iter().enumerate() {
            cases.push(one_value(choices, domain, partitioning, i, position, value));
        }
    }
}

/// All factors equal: minimum patches, those next to them, and values in between.
fn all_equal(cases: &mut Vec<Case>, choices: &Choices, domain: Domain, partitioning: Partitioning) {
    let near_one = [0x3F80_0000u32, 0x3F80_0001, 0x3F80_0040, 0x3F80_0041, 0x3F80_0080];
    let near_one = near_one.map(f32::from_bits).into_iter();
    let others = special_factors().into_iter().chain([1.5, 2.0, 2.5, 3.0, 15.9, 16.0]);
    for (i, value) in near_one.chain(others).enumerate() {
        for turn in [i, i + 1] {
            let factors = PatchFactors::uniform(domain, value);
            cases.push(Case { config: choices.config(partitioning, turn), factors });
        }
    }
}

/// All factors 1 except one, which alone keeps the patch from being a minimum one.
fn beside_minimum(
    cases: &mut Vec<Case>,
    choices: &Choices,
    domain: Domain,
    partitioning: Partitioning,
) {
    for position in 0..domain.factors() {
        let factor = |p| if p == position { 2.5 } else { 1.0 };
        let factors = PatchFactors::from_fn(domain, factor);
        cases.push(Case { config: choices.config(partitioning, position), factors });
    }
}

/// Every pair of an outer and an inside number of points of a partitioning, in each split order. If
/// quads are selected too, triangles have each pair in only one of the orders.
pub(super) fn transitions(cases: &mut Vec<Case>, choices: &Choices) {
    let partitioning = choices.partitioning(&[Partitioning::Integer]);
    let counts = segments(partitioning);
    let [has_triangles, has_quads] =
        [Domain::Triangle, Domain::Quad].map(|domain| choices.domains.contains(&domain));
    for (order, &split) in choices.splits.iter().enumerate() {
        for (number, &inside) in counts.iter().enumerate() {
            let is_due =
                |turn: usize| !has_quads || (number + turn) % choices.splits.len() == order;
            let quads = has_quads.then(|| quad_transitions(&counts, inside));
            let triangles = has_triangles.then(|| triangle_transitions(&counts, inside, is_due));
            let patches = quads.into_iter().flatten().chain(triangles.into_iter().flatten());
            cases.extend(patches.map(|factors| choices.surface(partitioning, split, factors)));
        }
    }
}

/// Quads in which an inside factor meets each outer factor along both axes, four outer ones at a
/// time.
fn quad_transitions(outer: &[f32], inside: f32) -> impl Iterator<Item = PatchFactors> {
    let turns = outer.chunks(4).enumerate();
    turns.flat_map(move |(turn, outer)| quads_with(outer, inside, turn)).map(PatchFactors::Quad)
}

/// Triangles in which an inside factor meets each outer factor, three outer ones at a time; those
/// whose turn is due.
fn triangle_transitions(
    outer: &[f32],
    inside: f32,
    is_due: impl Fn(usize) -> bool,
) -> impl Iterator<Item = PatchFactors> {
    let turns = outer.chunks(3).enumerate().filter(move |(turn, _)| is_due(*turn));
    turns.map(move |(_, outer)| {
        let factor = |p| if p == 3 { inside } else { outer[p % outer.len()] };
        PatchFactors::from_fn(Domain::Triangle, factor)
    })
}

/// All factors that give different numbers of points, ascending. Fractional ones are between two
/// whole numbers.
fn segments(partitioning: Partitioning) -> Vec<f32> {
    let whole = |n: u32| from_fixed(n << 16);
    let below = |n: u32| from_fixed((n << 16) - 0x6000);
    match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => (1..=64).map(whole).collect(),
        Partitioning::FractionalOdd => (1..=63).step_by(2).map(below).collect(),
        Partitioning::FractionalEven => (2..=64).step_by(2).map(below).collect(),
    }
}

/// Quads in which these four outer factors meet an inside factor, each along both axes. A quad is
/// narrow along its other axis, which keeps its output short.
fn quads_with(outer: &[f32], inside: f32, turn: usize) -> [QuadFactors; 4] {
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| outer[k]);
    let (wide, narrow) = (inside, [1.0, 2.0, 3.0, 4.0][turn % 4]);
    // The edges v = 0 and v = 1 run along u, the others along v.
    [
        QuadFactors { u0: narrow, v0: a, u1: 2.0, v1: b, inside_u: wide, inside_v: narrow },
        QuadFactors { u0: c, v0: 1.0, u1: d, v1: narrow, inside_u: narrow, inside_v: wide },
        QuadFactors { u0: 1.0, v0: c, u1: 3.0, v1: d, inside_u: wide, inside_v: narrow },
        QuadFactors { u0: a, v0: 2.0, u1: b, v1: 1.0, inside_u: narrow, inside_v: wide },
    ]
}

/// Pairs of inside factors on quads, and each inside factor on triangles. In fractional
/// partitionings the factors are slightly lower. The split orders take turns.
pub(super) fn interiors(cases: &mut Vec<Case>, choices: &Choices, wanted: impl Fn(u8, u8) -> bool) {
    for partitioning in choices.distinct_partitionings() {
        let shift = if partitioning.has_integer_factors() { 0 } else { 0x6000 };
        let factor = |n: u8| from_fixed((u32::from(n) << 16) - shift);
        let mut add = |turn: u8, factors| {
            let split = choices.splits[usize::from(turn / 2) % choices.splits.len()];
            cases.push(choices.surface(partitioning, split, factors));
        };
        for u in 1..=64 {
            if choices.domains.contains(&Domain::Triangle) {
                let inside = |p| if p == 3 { factor(u) } else { 3.0 };
                add(u, PatchFactors::from_fn(Domain::Triangle, inside));
            }
            if choices.domains.contains(&Domain::Quad) {
                for v in (1..=64).filter(|&v| wanted(u, v)) {
                    let quad = PatchFactors::from_fn(Domain::Quad, |p| match p {
                        4 => factor(u),
                        5 => factor(v),
                        _ => PLAIN[p],
                    });
                    add(u + v, quad);
                }
            }
        }
    }
}

/// Each configuration of each domain, with an ordinary patch, a minimum one and a culled one.
fn every_configuration(cases: &mut Vec<Case>, choices: &Choices) {
    for (domain, config) in choices.configurations() {
        let ordinary = PatchFactors::from_fn(domain, |p| PLAIN[p]);
        let [minimum, culled] = [1.0, 0.0].map(|factor| PatchFactors::uniform(domain, factor));
        cases.extend([ordinary, minimum, culled].map(|factors| Case { config, factors }));
    }
}

/// Pairs of patches in which the first may leave its state to the second: every kind after every
/// kind, an ordinary patch after each class of value in each position, and each value of a
/// configuration after each other one while everything else stays the same.
fn sequences(cases: &mut Vec<Case>, choices: &Choices) {
    kinds(cases, choices);
    registers(&choices.domains, choices.registers(choices.splits[0]), cases);
    for &domain in &choices.domains {
        let case = |config| {
            // An isoline's first factor is its density.
            let factors = PatchFactors::from_fn(domain, |p| TELLING[p]);
            Case { config, factors }
        };
        let fractional = [Partitioning::FractionalOdd, Partitioning::FractionalEven];
        let partitioning = choices.partitioning(&fractional);
        let base = choices.surface_config(partitioning, choices.splits[0]);
        let mut add = |pair: [Config; 2]| cases.extend(pair.map(case));
        pairs(&choices.splits).for_each(|pair| add(pair.map(|split| Config { split, ..base })));
        pairs(&choices.outputs).for_each(|pair| add(pair.map(|output| Config { output, ..base })));
        pairs(&choices.partitionings)
            .for_each(|pair| add(pair.map(|partitioning| Config { partitioning, ..base })));
    }
}

/// Every kind of patch after every kind. Each domain has a culled one, a minimum one and one that
/// is neither.
fn kinds(cases: &mut Vec<Case>, choices: &Choices) {
    // The partitioning that has picture frames.
    let partitioning = choices.partitioning(&[Partitioning::FractionalOdd]);
    let mut kinds = Vec::new();
    for &domain in &choices.domains {
        let uniform = |factor| PatchFactors::uniform(domain, factor);
        kinds.extend([uniform(0.0), PatchFactors::from_fn(domain, |p| PLAIN[p])]);
        kinds.extend((domain != Domain::Isoline).then(|| uniform(1.0)));
    }
    let split = choices.splits[0];
    for [first, then] in pairs(&kinds) {
        cases.extend([first, then].map(|factors| choices.surface(partitioning, split, factors)));
    }
}

/// Every ordered pair, including each value with itself.
fn pairs<T: Copy>(values: &[T]) -> impl Iterator<Item = [T; 2]> {
    values.iter().flat_map(|&first| values.iter().map(move |&then| [first, then]))
}
