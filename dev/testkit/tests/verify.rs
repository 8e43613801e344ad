//! The verification of backends detects every planted fault.

use std::sync::atomic::Ordering;
use tess_testkit::faults::{Fault, Faulty};
use tess_verify::check::{Known, Subject, SubjectRow, verify};
use tess_verify::generate::Shard;
use tess_verify::{Backend, CoreBackend};

fn run(backends: Vec<Box<dyn Backend>>, subject: Subject, shard: Shard) -> Vec<SubjectRow> {
    let known = Known::default();
    verify(&mut [backends], subject, shard, &known, &|_| {}).expect("the backends run")
}

/// The faults that a subject's units must detect, and a shard with few of the units.
fn faults_of(subject: Subject) -> (Vec<Fault>, Shard) {
    let (faults, of) = match subject {
        Subject::Factors => (Fault::OF_FACTORS.to_vec(), 16384),
        Subject::Locations => ([&Fault::OF_CONTEXTS[..], &Fault::OF_LOCATIONS].concat(), 252),
        _ => (Fault::of_patches(), 31),
    };
    (faults, Shard { part: 1, of })
}

#[test]
fn every_subject_sees_every_fault() {
    let random = Subject::Random { patches: 300, seed: 1 };
    for subject in Subject::ALL.into_iter().chain([random]) {
        let (faults, shard) = faults_of(subject);
        for fault in faults {
            let faulty = Faulty::new(CoreBackend, fault, 0);
            let committed = faulty.committed();
            let mut workers: [Vec<Box<dyn Backend>>; 1] = [vec![Box::new(faulty)]];
            let result = verify(&mut workers, subject, shard, &Known::default(), &|_| {});
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

/// A difference is counted for the backend that has it, not for the other one.
#[test]
fn differences_are_told_apart_by_backend() {
    let faulty = Faulty::new(CoreBackend, Fault::last_index(), 0);
    let backends: [Box<dyn Backend>; 2] = [Box::new(CoreBackend), Box::new(faulty)];
    let rows = run(backends.into(), Subject::Transitions, Shard { part: 1, of: 31 });
    let mismatches: Vec<u64> = rows.iter().map(|row| row.mismatches).collect();
    assert_eq!(mismatches, [0, 1], "{rows:?}");
}

/// A single bit of a single random patch, somewhere in the middle.
#[test]
fn one_bit_of_one_random_patch() {
    let subject = Subject::Random { patches: 5000, seed: 3 };
    for bit in ["first u", "last v"] {
        let fault = Fault::patch(&format!("a bit of a point is wrong: the lowest of the {bit}"));
        let faulty = Box::new(Faulty::new(CoreBackend, fault, 101));
        let rows = run(vec![faulty], subject, Shard::WHOLE);
        let [row] = &rows[..] else { panic!("one row: {rows:?}") };
        assert_eq!((row.compared, row.mismatches), (96 * 5000, 1), "{row:?}");
        let first = row.first.as_deref().unwrap_or_default();
        assert!(first.contains("point "), "the element is named: {first}");
        assert!(first.contains("\n  tess patch "), "it can be run again: {first}");
    }
}

/// Only the patch that differs and is listed is excused; the stage of a difference that is not
/// excused is counted.
#[test]
fn a_known_difference_is_no_mismatch() {
    let subject = Subject::Random { patches: 100, seed: 3 };
    let fault = Fault::patch("a bit of a point is wrong: the lowest of the first u");
    let faulty =
        || -> Vec<Box<dyn Backend>> { vec![Box::new(Faulty::new(CoreBackend, fault, 20))] };
    let row = run(faulty(), subject, Shard::WHOLE).remove(0);
    assert_eq!(row.stages.values().sum::<u64>(), 1, "{row:?}");
    let line = row.first.as_deref().and_then(|first| first.lines().next()).expect("a case line");
    let with = |line: &str| {
        let known = Known::read("known", line.as_bytes(), None, "2026-01-01").expect("a baseline");
        let rows = verify(&mut [faulty()], subject, Shard::WHOLE, &known, &|_| {});
        let row = rows.expect("the backend runs").remove(0);
        let outcome = known.outcome(true);
        (row.mismatches, row.known, outcome.gone.len() + outcome.faults.len())
    };
    assert_eq!(with(line), (0, 1, 0), "excused");
    let other = "case isoline integer point ruler 12345678 3f800000";
    assert_eq!(with(other), (1, 0, 0), "another case excuses nothing");
}
