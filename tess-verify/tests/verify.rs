//! Verification of backends: it compares what it says, in any number of shards and threads.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use tess_verify::check::{Plan, Random, Row, SecondFormulation, Subject, Unit, Units, verify};
use tess_verify::generate::{GenLevel, Selection, Shard};
use tess_verify::{Backend, BackendError, Case};

/// One part in 61 of every subject (and far less of the largest).
fn small_plan() -> Plan {
    Plan { shard: Shard { part: 3, of: 61 }, ..Plan::exhaustive() }
}

fn run(workers: &mut [Vec<Box<dyn Backend>>], plan: &Plan) -> Vec<Row> {
    verify(workers, plan, &|_, _, _| {}).expect("the backends run")
}

fn without_factors(mut plan: Plan) -> Plan {
    plan.subjects.retain(|subject| *subject != Subject::Factors);
    plan
}

#[test]
fn both_formulations_agree_on_any_number_of_threads() {
    let plan = without_factors(small_plan());
    let one = run(&mut [vec![Box::new(SecondFormulation)]], &plan);
    assert_eq!(one.len(), plan.subjects.len(), "a row for each subject");
    for row in &one {
        assert!(row.compared > 0, "{row:?} compared something");
        assert_eq!(row.first, None, "{row:?}");
    }
    let two =
        run(&mut [vec![Box::new(SecondFormulation)], vec![Box::new(SecondFormulation)]], &plan);
    assert_eq!(one, two, "threads change nothing");
}

/// The units of a shard are counted from 1 to all of them, subject by subject.
#[test]
fn progress_ends_with_the_last_unit() {
    let subjects = vec![Subject::Transitions, Subject::Interiors];
    let plan = Plan { subjects, shard: Shard { part: 1, of: 4 } };
    let calls = std::sync::Mutex::new(Vec::new());
    let note = |subject, done, all| calls.lock().expect("no panic").push((subject, done, all));
    verify(&mut [vec![Box::new(SecondFormulation)]], &plan, &note).expect("it runs");
    let mut calls = calls.into_inner().expect("no panic").into_iter();
    for subject in plan.subjects {
        let all = plan.shard.items(Units::of(subject).count());
        assert!(all > 1, "{subject:?}: {all} units");
        for done in 1..=all {
            assert_eq!(calls.next(), Some((subject, done, all)));
        }
    }
    assert_eq!(calls.next(), None, "no more");
}

/// The 2^20 numbers from 1 on, in every partitioning.
#[test]
fn factors_agree_with_binary64() {
    let shard = Shard { part: 1016, of: 4096 };
    let rows = run(
        &mut [vec![Box::new(SecondFormulation)]],
        &Plan { subjects: vec![Subject::Factors], shard },
    );
    assert_eq!((rows[0].compared, rows[0].first.as_deref()), (4 << 20, None), "four units");
}

fn random_cases(patches: u64, seed: u64) -> Vec<Vec<Case>> {
    let units = Units::of(Subject::Random(Random { patches, seed }));
    let cases = units.iter().map(|unit| match unit {
        Unit::Random(unit) => unit.cases(),
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

/// Seeds tell apart, and so do the units of one seed; a longer run begins with a shorter one's.
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

/// Every case of level 2 is in one of the two subjects, and none is in both.
#[test]
fn levels_are_compared_once() {
    let texts = |subject| -> BTreeSet<String> {
        let units = Units::of(subject);
        let cases = units.iter().flat_map(|unit| match unit {
            Unit::Patches(cases) => cases,
            other => panic!("levels are patches: {other:?}"),
        });
        cases.map(|case| case.to_string()).collect()
    };
    let [one, two] = [Subject::Level1, Subject::Level2].map(texts);
    assert!(one.is_disjoint(&two), "nothing is compared twice");
    let whole = Selection::level(GenLevel::Two, 1).cases().map(|case| case.to_string());
    assert_eq!(&one | &two, whole.collect(), "level 2");
}

/// However many patches are asked for, a unit is made when it is its turn, and not before.
#[test]
fn as_many_random_patches_as_there_are_numbers() {
    let random = Random { patches: u64::MAX, seed: 1 };
    let units = Units::of(Subject::Random(random));
    assert_eq!(units.count(), 96 << 52, "4096 patches a unit");
    assert!(units.get(units.count()).is_none(), "no unit behind the last");
    let shard = Shard { part: 5, of: 96 << 51 };
    assert_eq!(shard.items(units.count()), 2, "units of a tiny shard");
    let mine: Vec<_> = (0..3).map(|n| shard.item(n).and_then(|n| units.get(n))).collect();
    assert!(matches!(mine[..], [Some(_), Some(_), None]), "{mine:?}");
    let rows =
        run(&mut [vec![Box::new(SecondFormulation)]], &Plan { shard, ..Plan::random(random) });
    assert_eq!((rows[0].compared, rows[0].first.as_deref()), (2 * 4096, None), "two units");
}

#[test]
fn no_backend_is_an_error() {
    assert!(verify(&mut [], &Plan::levels(), &|_, _, _| {}).is_err(), "no worker");
    assert!(verify(&mut [vec![]], &Plan::levels(), &|_, _, _| {}).is_err(), "no backend");
}

/// An implementation says what it does not have, and a caller can tell that from a failure.
#[test]
fn what_is_unsupported_is_told_from_failures() {
    let error = BackendError::unsupported("no isolines");
    assert!(error.is_unsupported() && error.to_string().contains("no isolines"), "{error}");
    assert!(!BackendError::new("the device is lost").is_unsupported(), "a failure");
}
