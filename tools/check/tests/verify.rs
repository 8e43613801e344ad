//! Verification of backends: it compares what it says, in any number of shards, and sees faults.

use tess_check::backend::Backend;
use tess_check::core_backend::CoreBackend;
use tess_check::faults::{Fault, Faulty};
use tess_check::generate::Shard;
use tess_check::verify::{Plan, Row, Subject, units, verify};

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
fn the_model_equals_itself_on_any_number_of_threads() {
    let plan = without_factors(small_plan());
    let one = run(&mut [vec![Box::new(CoreBackend)]], &plan);
    assert_eq!(one.len(), plan.subjects.len(), "a row for each subject");
    for row in &one {
        assert!(row.compared > 0, "{row:?} compared something");
        assert_eq!(row.first, None, "{row:?}");
    }
    let two = run(&mut [vec![Box::new(CoreBackend)], vec![Box::new(CoreBackend)]], &plan);
    assert_eq!(one, two, "threads change nothing");
}

/// The fault that a subject's units must see, and a plan of few of them.
fn faulty_plan(subject: Subject) -> (Fault, Plan) {
    let (fault, of) = match subject {
        Subject::Factors => (Fault::InsideFactor, 16384),
        Subject::Locations => (Fault::LastLocation, 61),
        _ => (Fault::LastIndex, 5),
    };
    (fault, Plan { subjects: vec![subject], shard: Shard { part: 1, of } })
}

#[test]
fn every_subject_sees_a_wrong_bit() {
    for subject in Subject::ALL {
        let (fault, plan) = faulty_plan(subject);
        let faulty = Faulty::new(CoreBackend, fault, 0);
        let rows = run(&mut [vec![Box::new(faulty)]], &plan);
        let [row] = &rows[..] else { panic!("one row: {rows:?}") };
        assert!(row.mismatches > 0 && row.first.is_some(), "{fault:?}: {row:?}");
    }
}

#[test]
fn factors_cover_every_binary32() {
    assert_eq!(units(Subject::Factors).len(), 4 * 4096, "2^20 each, four partitionings");
    assert_eq!(units(Subject::Locations).len(), 252, "as many as golden/place.csv has rows");
}

#[test]
fn no_backend_is_an_error() {
    assert!(verify(&mut [], &Plan::levels(), &|_, _, _| {}).is_err(), "no worker");
    assert!(verify(&mut [vec![]], &Plan::levels(), &|_, _, _| {}).is_err(), "no backend");
}
