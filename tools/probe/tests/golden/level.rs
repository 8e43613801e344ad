//! The cases that the recorded devices were asked: level 1 in its first version. `tess gen` makes a
//! later version, so these cases are frozen here until the devices are asked again.

use tess_core::{
    Config, Domain, OutputPrimitive, Partitioning, PatchFactors, QuadFactors, SplitOrder,
};
use tess_verify::Case;
use tess_verify::generate::{GenLevel, Selection, boundary_factors, configurations};

/// Factors for the positions that a case does not test, small enough to keep its output short.
const PLAIN: [f32; 8] = [3.0, 1.0, 4.5, 2.0, 7.25, 5.0, 1.5, 6.0];

/// The number of [`boundary_factors`] that precede the special ones.
const ORDINARY: usize = 1188;

/// The systematic cases, and 500 random ones.
pub(crate) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let boundaries = boundary_factors();
    for (domain, partitioning) in combinations() {
        let factors = domain.factors();
        for (i, &value) in boundaries[..ORDINARY].iter().enumerate() {
            cases.push(one_value(domain, partitioning, i, i % factors, value));
            cases.push(one_value(domain, partitioning, i + 1, (i + factors / 2) % factors, value));
        }
        specials_everywhere(&mut cases, domain, partitioning);
        all_equal(&mut cases, domain, partitioning);
    }
    transitions(&mut cases);
    interiors(&mut cases);
    every_configuration(&mut cases);
    beside_minimum(&mut cases);
    cases.extend(Selection { random: Some(500), ..Selection::level(GenLevel::Three, 1) }.cases());
    cases
}

/// The binary32 of a 15.16 number that is not 0: that of the integer, with the exponent lowered by
/// 16.
const fn from_fixed(bits: u32) -> f32 {
    f32::from_bits((bits as f32).to_bits() - (16 << 23))
}

fn combinations() -> impl Iterator<Item = (Domain, Partitioning)> {
    Domain::ALL.into_iter().flat_map(|domain| Partitioning::ALL.map(|p| (domain, p)))
}

/// A configuration that varies with `turn`: three of five have triangles, and both split orders
/// occur.
fn config(partitioning: Partitioning, turn: usize) -> Config {
    let output = match turn % 5 {
        0 | 3 => OutputPrimitive::TriangleCw,
        1 => OutputPrimitive::TriangleCcw,
        2 => OutputPrimitive::Line,
        _ => OutputPrimitive::Point,
    };
    let split = if (turn / 4).is_multiple_of(2) { SplitOrder::Ruler } else { SplitOrder::Centre };
    Config { partitioning, output, split }
}

/// A case in which one factor is `value` and the others are plain.
fn one_value(
    domain: Domain,
    partitioning: Partitioning,
    turn: usize,
    position: usize,
    value: f32,
) -> Case {
    let factor = |p| if p == position { value } else { PLAIN[(turn + p) % PLAIN.len()] };
    Case { config: config(partitioning, turn), factors: PatchFactors::from_fn(domain, factor) }
}

fn specials_everywhere(cases: &mut Vec<Case>, domain: Domain, partitioning: Partitioning) {
    let boundaries = boundary_factors();
    for position in 0..domain.factors() {
        for (i, &value) in boundaries[ORDINARY..].iter().enumerate() {
            cases.push(one_value(domain, partitioning, i, position, value));
        }
    }
}

/// All factors equal: minimum patches, those next to them, and values in between.
fn all_equal(cases: &mut Vec<Case>, domain: Domain, partitioning: Partitioning) {
    let near_one = [0x3F80_0000u32, 0x3F80_0001, 0x3F80_0040, 0x3F80_0041, 0x3F80_0080];
    let near_one = near_one.map(f32::from_bits).into_iter();
    let special = boundary_factors().split_off(ORDINARY);
    let others = special.into_iter().chain([1.5, 2.0, 2.5, 3.0, 15.9, 16.0]);
    for (i, value) in near_one.chain(others).enumerate() {
        for turn in [i, i + 1] {
            let factors = PatchFactors::uniform(domain, value);
            cases.push(Case { config: config(partitioning, turn), factors });
        }
    }
}

/// Every pair of an outer and an inside factor, with four outer ones at a time. A quad is narrow
/// along its other axis, which keeps its output short. The split orders take turns.
fn transitions(cases: &mut Vec<Case>) {
    for inside in 1..=64u8 {
        for group in 0..16u8 {
            let turn = usize::from(inside) * 4 + usize::from(group % 2) * 4;
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| f32::from(group * 4 + k + 1));
            let (wide, narrow) = (f32::from(inside), f32::from(1 + group % 4));
            // The edges v = 0 and v = 1 run along u, the others along v.
            for quad in [
                QuadFactors { u0: narrow, v0: a, u1: 2.0, v1: b, inside_u: wide, inside_v: narrow },
                QuadFactors { u0: c, v0: 1.0, u1: d, v1: narrow, inside_u: narrow, inside_v: wide },
                QuadFactors { u0: 1.0, v0: c, u1: 3.0, v1: d, inside_u: wide, inside_v: narrow },
                QuadFactors { u0: a, v0: 2.0, u1: b, v1: 1.0, inside_u: narrow, inside_v: wide },
            ] {
                let split = config(Partitioning::Integer, turn).split;
                cases.push(triangles(Partitioning::Integer, split, PatchFactors::Quad(quad)));
            }
        }
    }
}

/// Pairs of inside factors on quads, and each inside factor on triangles. In fractional
/// partitionings the factors are slightly lower.
fn interiors(cases: &mut Vec<Case>) {
    let wanted = |u: u8, v: u8| u == v || u.max(v) <= 9 || (u % 15 < 3 && v % 15 < 3);
    let partitionings =
        [Partitioning::Integer, Partitioning::FractionalOdd, Partitioning::FractionalEven];
    for partitioning in partitionings {
        let shift = if partitioning == Partitioning::Integer { 0 } else { 0x6000 };
        let factor = |n: u8| from_fixed((u32::from(n) << 16) - shift);
        for u in 1..=64 {
            let triangle =
                PatchFactors::from_fn(Domain::Triangle, |p| if p == 3 { factor(u) } else { 3.0 });
            cases.push(triangles(partitioning, SplitOrder::Ruler, triangle));
            for v in (1..=64).filter(|&v| wanted(u, v)) {
                let quad = PatchFactors::from_fn(Domain::Quad, |p| match p {
                    4 => factor(u),
                    5 => factor(v),
                    _ => PLAIN[p],
                });
                cases.push(triangles(partitioning, SplitOrder::Ruler, quad));
            }
        }
    }
}

fn triangles(partitioning: Partitioning, split: SplitOrder, factors: PatchFactors) -> Case {
    let config = Config { partitioning, output: OutputPrimitive::TriangleCw, split };
    Case { config, factors }
}

/// Each configuration of each domain, with one ordinary patch.
fn every_configuration(cases: &mut Vec<Case>) {
    cases.extend(configurations().map(|(domain, config)| {
        let factors = PatchFactors::from_fn(domain, |p| PLAIN[p]);
        Case { config, factors }
    }));
}

/// All factors 1 except one, which alone keeps the patch from being a minimum one.
fn beside_minimum(cases: &mut Vec<Case>) {
    for (domain, partitioning) in combinations() {
        for position in 0..domain.factors() {
            let factor = |p| if p == position { 2.5 } else { 1.0 };
            let factors = PatchFactors::from_fn(domain, factor);
            cases.push(Case { config: config(partitioning, position), factors });
        }
    }
}
