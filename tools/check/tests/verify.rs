//! Verification of backends: it compares what it says, in any number of shards, and sees faults.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::atomic::Ordering;
use tess_check::backend::Backend;
use tess_check::case::{Case, factor_bits};
use tess_check::core_backend::CoreBackend;
use tess_check::faults::{Fault, Faulty};
use tess_check::generate::{Level, Selection, Shard};
use tess_check::second::SecondFormulation;
use tess_check::verify::{Plan, Random, Row, Subject, Unit, units, verify};

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

/// The faults that a subject's units must see, and a plan of few of them.
fn faulty_plan(subject: Subject) -> (Vec<Fault>, Plan) {
    let (faults, of) = match subject {
        Subject::Factors => (Fault::OF_FACTORS.to_vec(), 16384),
        Subject::Locations => ([&Fault::OF_CONTEXTS[..], &Fault::OF_LOCATIONS].concat(), 252),
        _ => (Fault::OF_PATCHES.to_vec(), 31),
    };
    (faults, Plan { subjects: vec![subject], shard: Shard { part: 1, of } })
}

#[test]
fn every_subject_sees_every_fault() {
    let random = Subject::Random(Random { patches: 300, seed: 1 });
    for subject in Subject::ALL.into_iter().chain([random]) {
        let (faults, plan) = faulty_plan(subject);
        for fault in faults {
            let faulty = Faulty::new(CoreBackend, fault, 0);
            let committed = faulty.committed();
            let result = verify(&mut [vec![Box::new(faulty)]], &plan, &|_, _, _| {});
            assert!(committed.load(Ordering::Relaxed), "{fault:?} was committed");
            if fault == Fault::ShortAnswer {
                assert!(result.is_err(), "{subject:?}: an answer too few");
                continue;
            }
            let rows = result.expect("the backend runs");
            let [row] = &rows[..] else { panic!("one row: {rows:?}") };
            assert!(row.mismatches > 0 && row.first.is_some(), "{fault:?}: {row:?}");
        }
    }
}

/// A difference is counted for the backend that has it, not for the one beside it.
#[test]
fn differences_are_told_apart_by_backend() {
    let plan = Plan { subjects: vec![Subject::Transitions], shard: Shard { part: 1, of: 31 } };
    let faulty = Faulty::new(CoreBackend, Fault::LastIndex, 0);
    let rows = run(&mut [vec![Box::new(CoreBackend), Box::new(faulty)]], &plan);
    let mismatches: Vec<u64> = rows.iter().map(|row| row.mismatches).collect();
    assert_eq!(mismatches, [0, 1], "{rows:?}");
}

/// A single bit of a single random patch, somewhere in the middle.
#[test]
fn one_bit_of_one_random_patch() {
    let plan = Plan::random(Random { patches: 5000, seed: 3 });
    for fault in [Fault::PointU, Fault::LastPoint] {
        let rows = run(&mut [vec![Box::new(Faulty::new(CoreBackend, fault, 101))]], &plan);
        let [row] = &rows[..] else { panic!("one row: {rows:?}") };
        assert_eq!((row.compared, row.mismatches), (96 * 5000, 1), "{row:?}");
        let first = row.first.as_deref().unwrap_or_default();
        assert!(first.contains("point "), "the element is named: {first}");
        assert!(first.contains("\n  tess patch "), "it can be run again: {first}");
    }
}

fn random_cases(patches: u64, seed: u64) -> Vec<Vec<Case>> {
    let units = units(Subject::Random(Random { patches, seed })).into_iter();
    let cases = units.map(|unit| match unit {
        Unit::Random(unit) => unit.cases(),
        other => panic!("random patches: {other:?}"),
    });
    cases.collect()
}

#[test]
fn as_many_random_patches_of_each_configuration_as_asked_for() {
    let mut counts = HashMap::<_, u64>::new();
    for case in random_cases(5000, 1).into_iter().flatten() {
        *counts.entry((case.domain(), case.config)).or_default() += 1;
    }
    assert_eq!(counts.len(), 96, "configurations");
    assert!(counts.values().all(|&count| count == 5000), "{counts:?}");
}

/// Seeds tell apart, and so do the units of one seed; a longer run begins with a shorter one's.
#[test]
fn random_patches_depend_on_the_seed_alone() {
    let factors = |cases: &[Case]| cases.iter().map(|case| factor_bits(&case.factors)).collect();
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
    assert_eq!(units(Subject::Factors).len(), 4 * 4096, "2^20 each, four partitionings");
    assert_eq!(units(Subject::Locations).len(), 252, "as many as golden/place.csv has rows");
}

/// Every case of level 2 is in one of the two subjects, and none is in both.
#[test]
fn levels_are_compared_once() {
    let texts = |subject| -> BTreeSet<String> {
        let cases = units(subject).into_iter().flat_map(|unit| match unit {
            Unit::Patches(cases) => cases,
            other => panic!("levels are patches: {other:?}"),
        });
        cases.map(|case| case.to_string()).collect()
    };
    let [one, two] = [Subject::Level1, Subject::Level2].map(texts);
    assert!(one.is_disjoint(&two), "nothing is compared twice");
    let whole = Selection::level(Level::Two, 1).cases().map(|case| case.to_string());
    assert_eq!(&one | &two, whole.collect(), "level 2");
}

#[test]
fn no_backend_is_an_error() {
    assert!(verify(&mut [], &Plan::levels(), &|_, _, _| {}).is_err(), "no worker");
    assert!(verify(&mut [vec![]], &Plan::levels(), &|_, _, _| {}).is_err(), "no backend");
}
