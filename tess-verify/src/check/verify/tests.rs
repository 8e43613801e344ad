//! The units of each subject are complete, disjoint and reproducible.

use super::subject::Subject;
use super::units::{Units, Work, units};
use crate::case::Case;
use crate::generate::{GenLevel, Selection, Shard};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use tess_core::Partitioning;

fn all(units: &Units) -> impl Iterator<Item = Work> {
    (0..units.count()).filter_map(|number| units.get(number)).map(|unit| unit.0)
}

fn random_cases(patches: u64, seed: u64) -> Vec<Vec<Case>> {
    let units = Units::of(Subject::Random { patches, seed });
    let cases = all(&units).map(|unit| match unit {
        Work::Random(unit) => unit.cases(),
        other => panic!("random patches: {other:?}"),
    });
    cases.collect()
}

#[test]
fn as_many_random_patches_of_each_configuration_as_asked_for() {
    let mut counts = BTreeMap::<_, u64>::new();
    for case in random_cases(5000, 1).into_iter().flatten() {
        *counts.entry((case.domain(), case.config)).or_default() += 1;
    }
    assert_eq!(counts.len(), 96, "configurations");
    assert!(counts.values().all(|&count| count == 5000), "{counts:?}");
}

/// Patches differ between seeds and between units of one seed; a longer run begins with the patches
/// of a shorter one.
#[test]
fn random_patches_depend_on_the_seed_alone() {
    let factors = |cases: &[Case]| {
        cases.iter().map(|case| case.factors.map(f32::to_bits).iter().collect::<Vec<_>>()).collect()
    };
    let short: Vec<Vec<_>> = random_cases(20, 1).iter().map(|cases| factors(cases)).collect();
    let distinct: HashSet<_> = short.iter().collect();
    assert_eq!(distinct.len(), 96, "every configuration has patches of its own");
    for (longer, short) in random_cases(30, 1).iter().zip(&short) {
        let longer: Vec<_> = factors(longer);
        assert_eq!(&longer[..20], &short[..], "a longer run");
    }
    let two_units = random_cases(5000, 1);
    let [first, second] = [&two_units[0], &two_units[1]].map(|cases| factors(&cases[..20]));
    assert_eq!((first == short[0], second == short[0]), (true, false), "of two units");
    let other: Vec<Vec<_>> = random_cases(20, 2).iter().map(|cases| factors(cases)).collect();
    assert!(other.iter().zip(&short).all(|(other, short)| other != short), "another seed");
}

#[test]
fn factors_cover_every_binary32() {
    assert_eq!(Units::of(Subject::Factors).count(), 4 * 4096, "2^20 each, four partitionings");
    assert_eq!(Units::of(Subject::Locations).count(), 252, "as many as golden/place.csv has rows");
}

/// Every case of level 2 is in exactly one of the two subjects.
#[test]
fn levels_are_compared_once() {
    let texts = |subject| -> BTreeSet<String> {
        let units = Units::of(subject);
        let cases = all(&units).flat_map(|unit| match unit {
            Work::Patches(cases) => cases,
            other => panic!("levels are patches: {other:?}"),
        });
        cases.map(|case| case.to_string()).collect()
    };
    let [one, two] = [Subject::Level1, Subject::Level2].map(texts);
    assert!(one.is_disjoint(&two), "nothing is compared twice");
    let whole = Selection::level(GenLevel::Two, 1).cases().map(|case| case.to_string());
    assert_eq!(&one | &two, whole.collect(), "level 2");
}

/// A unit is made only when its turn comes, whatever the number of patches.
#[test]
fn as_many_random_patches_as_there_are_numbers() {
    let units = Units::of(Subject::Random { patches: u64::MAX, seed: 1 });
    assert_eq!(units.count(), 96 << 52, "4096 patches a unit");
    assert!(units.get(units.count()).is_none(), "no unit behind the last");
    let shard = Shard { part: 5, of: 96 << 51 };
    assert_eq!(shard.items(units.count()), 2, "units of a tiny shard");
    let mine: Vec<_> = (0..3).map(|n| shard.item(n).and_then(|n| units.get(n))).collect();
    assert!(matches!(mine[..], [Some(_), Some(_), None]), "{mine:?}");
}

/// The units of factors are contiguous and cover all bit patterns, one partitioning after another.
#[test]
fn factors_are_all_there() {
    let factors = Units::of(Subject::Factors);
    let mut units = all(&factors);
    for expected in Partitioning::ALL {
        for number in 0..1u64 << 12 {
            let Some(Work::Values { partitioning, first }) = units.next() else {
                panic!("unit {number} of {expected:?}")
            };
            assert_eq!((partitioning, u64::from(first)), (expected, number << 20));
        }
    }
    assert!(units.next().is_none(), "no more");
}

/// The lines of a subject's cases are distinct, also where a unit has no patches.
#[test]
fn cases_have_lines_of_their_own() {
    for (subject, cases) in [
        (Subject::Level1, 44_070),
        (Subject::Factors, 4 << 12),
        (Subject::Locations, 252),
        (Subject::Random { patches: 20, seed: 1 }, 96 * 20),
    ] {
        let lines: Vec<String> = units(subject).flat_map(|unit| unit.cases()).collect();
        assert_eq!(lines.len(), cases, "{subject:?}");
        // Level 1 repeats some of its cases.
        if subject != Subject::Level1 {
            assert_eq!(lines.iter().collect::<HashSet<_>>().len(), cases, "{subject:?}");
        }
    }
}
