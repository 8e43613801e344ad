//! Tests of the list of thresholds: each case is exactly next to its comparison, level 1 contains
//! it, and a neighbouring threshold, as `dev/faults/rust.faults` plants it, changes its
//! answer.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use tess_core::{Domain, Partitioning, Tessellation};
use tess_verify::Case;
use tess_verify::cover::Coverage;
use tess_verify::generate::{GenLevel, Selection, thresholds};
use tess_verify::rules::{Checker, Specification, Verdict};
use tess_verify::vectors::Fnv1a;

#[test]
fn cases_lie_exactly_beside_their_thresholds() {
    for (side, case) in thresholds() {
        let mut coverage = Coverage::default();
        coverage.record_stream(None, [case]);
        let bin = format!("boundary/{side}");
        assert!(coverage.bins().any(|(hit, times)| hit == bin && times > 0), "{side}: {case}");
    }
}

/// Every comparison that coverage knows has cases on both of its sides.
#[test]
fn every_side_has_cases() {
    let sides: BTreeSet<_> =
        thresholds().iter().map(|(side, _)| format!("boundary/{side}")).collect();
    let coverage = Coverage::default();
    let bins = coverage.bins().map(|(bin, _)| bin.to_owned());
    assert_eq!(sides, bins.filter(|bin| bin.starts_with("boundary/")).collect());
}

#[test]
fn level_1_has_the_cases() {
    let level: HashSet<_> = Selection::level(GenLevel::One, 1).cases().collect();
    for (side, case) in thresholds() {
        assert!(level.contains(&case), "{side}: {case}");
    }
}

/// Digests of the outputs, by comparison.
const ANSWERS: [(&str, &str); 14] = [
    ("clamp_high", "b4fd3782aeba0a21"),
    ("clamp_low", "0f4f5479772e3872"),
    ("conversion", "dc4eef7008f615a9"),
    ("cull", "b57a7467f171fac7"),
    ("frame", "166b58aa0535bbb4"),
    ("location", "1ccf68454f941e16"),
    ("minimum", "4e1614c0d362984d"),
    ("number", "02df4a5bbdae560c"),
    ("one", "a0bf4b4f78370a54"),
    ("ring", "f2bc6930b4d4906c"),
    ("round", "dc9f02b6708941a5"),
    ("sign", "19548317764904f6"),
    ("whole", "5c56ea447ccfbfd9"),
    ("wider", "96e7d106ea11289e"),
];

#[test]
fn answers_are_the_recorded_ones() {
    let mut digests: BTreeMap<&str, Fnv1a> = BTreeMap::new();
    for (side, case) in thresholds() {
        let comparison = side.split('/').next().unwrap_or(side);
        digests.entry(comparison).or_default().patch(&case.patch().tessellate());
    }
    let answers =
        digests.into_iter().map(|(name, digest)| (name, format!("{:016x}", digest.finish())));
    let expected = ANSWERS.map(|(name, digest)| (name, digest.to_owned()));
    assert_eq!(answers.collect::<Vec<_>>(), expected);
}

/// The output of a device that makes picture frames only if a factor is above `highest`, where this
/// differs from the model's output: where an inside factor should be raised, it has no inside.
fn late(case: &Case, highest: u32) -> Option<Tessellation> {
    const LOWEST: u32 = 0x3F80_0041;
    let is_late = case.domain() != Domain::Isoline
        && case.config.partitioning == Partitioning::FractionalOdd
        && case.factors.outer().all(|factor| factor > 0.0)
        && case.factors.iter().all(|factor| !(factor.to_bits() > highest && factor > 1.0))
        && case.factors.iter().any(|factor| factor.to_bits() >= LOWEST && factor > 1.0)
        && case.factors.inside().any(|inside| !(inside.to_bits() >= LOWEST && inside > 1.0));
    is_late.then(|| {
        let points = case.patch().tessellate().points.into_iter().take(5).collect();
        Tessellation { points, indices: vec![0, 1, 2] }
    })
}

/// A picture frame one pattern late, and at 1.25: only the thresholds show either.
#[test]
fn level_1_sees_late_picture_frames() {
    let only: HashSet<_> = thresholds().into_iter().map(|(_, case)| case).collect();
    for highest in [0x3F80_0041, 1.25f32.to_bits()] {
        let differs = |case: &Case| {
            late(case, highest).is_some_and(|output| output != case.patch().tessellate())
        };
        let different: Vec<Case> =
            Selection::level(GenLevel::One, 1).cases().filter(differs).collect();
        assert_eq!(different.len(), 9, "{highest:#x}");
        assert!(different.iter().all(|case| only.contains(case)), "{highest:#x}");
    }
}

#[test]
fn rules_see_late_picture_frames() {
    let broken = |highest| {
        let mut checker = Checker::new(Specification::D3d11);
        let (domain, partitioning) = (Some(Domain::Triangle), Some(Partitioning::FractionalOdd));
        let all = Selection::level(GenLevel::Rules, 1);
        for case in (Selection { domain, partitioning, ..all }).cases() {
            let output = late(&case, highest).unwrap_or_else(|| case.patch().tessellate());
            checker.add(&case, &output);
        }
        let rows = checker.report().rows.into_iter();
        rows.filter(|row| row.verdict() == Verdict::Broken).map(|row| row.rule).collect::<Vec<_>>()
    };
    assert_eq!(broken(0x3F80_0040), [], "right");
    assert_ne!(broken(0x3F80_0041), [], "a pattern late");
}
