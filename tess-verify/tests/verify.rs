//! Verification of backends: it compares what it says, in any number of shards and threads.

use tess_core::{Config, PatchFactors, Tessellation};
use tess_verify::check::{
    Known, SecondFormulation, Subject, SubjectRow, Tested, VerifyPlan, check, verify,
};
use tess_verify::generate::Shard;
use tess_verify::vectors::{Listing, VectorFile};
use tess_verify::{Backend, BackendError, CoreBackend};

/// One part in 61 of every subject (and far less of the largest).
fn small_plan() -> VerifyPlan {
    VerifyPlan { subjects: Subject::ALL.to_vec(), shard: Shard { part: 3, of: 61 } }
}

fn run(workers: &mut [Vec<Box<dyn Backend>>], plan: &VerifyPlan) -> Vec<SubjectRow> {
    verify(workers, plan, &Known::default(), &|_, _, _| {}).expect("the backends run")
}

fn without_factors(mut plan: VerifyPlan) -> VerifyPlan {
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
    let plan = VerifyPlan { subjects, shard: Shard { part: 1, of: 4 } };
    let calls = std::sync::Mutex::new(Vec::new());
    let note = |subject, done, all| calls.lock().expect("no panic").push((subject, done, all));
    verify(&mut [vec![Box::new(SecondFormulation)]], &plan, &Known::default(), &note)
        .expect("it runs");
    let mut calls = calls.into_inner().expect("no panic").into_iter().peekable();
    for subject in plan.subjects {
        let &(_, _, all) = calls.peek().expect("a unit");
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
        &VerifyPlan { subjects: vec![Subject::Factors], shard },
    );
    assert_eq!((rows[0].compared, rows[0].first.as_deref()), (4 << 20, None), "four units");
}

/// The model, but that one of so many patches in a row has a point too many.
struct Stateful {
    every: u64,
    asked: u64,
}

impl Backend for Stateful {
    fn name(&self) -> &'static str {
        "stateful"
    }

    fn device(&self) -> String {
        String::new()
    }

    fn tessellate(
        &mut self,
        config: Config,
        patches: &[PatchFactors],
    ) -> Result<Vec<Tessellation>, BackendError> {
        let mut outputs = CoreBackend.tessellate(config, patches)?;
        for output in &mut outputs {
            self.asked += 1;
            if self.asked.is_multiple_of(self.every) {
                output.points.push(Default::default());
            }
        }
        Ok(outputs)
    }
}

/// A patch that differs is asked for again: right by itself if every thousandth fails, wrong if each does.
#[test]
fn what_came_before_is_told_from_the_patch() {
    for (every, passes_alone) in [(1000, true), (1, false)] {
        let plan = VerifyPlan { subjects: vec![Subject::Interiors], shard: Shard::WHOLE };
        let [row] = &run(&mut [vec![Box::new(Stateful { every, asked: 0 })]], &plan)[..] else {
            panic!("one row")
        };
        assert!(row.mismatches > 7, "{row:?}");
        assert_eq!(row.passes_alone, passes_alone, "{row:?}");
        let case = "case tri integer line ruler 3f800000 3f800000 3f800000 3f800000";
        let one = Listing::of_model(case.parse().expect("a case")).to_file("model");
        let (header, listing) = one.split_once('\n').expect("a header");
        let text = header.replace("count=1", "count=3000") + "\n" + &listing.repeat(3000);
        let file = VectorFile::new("model", text.as_bytes()).expect("a file");
        let mut backends: [Box<dyn Backend>; 1] = [Box::new(Stateful { every, asked: 0 })];
        let report = check(file, &mut backends, Tested::Backend, &|_| ()).expect("it runs");
        assert_eq!(report.mismatches, if passes_alone { 3 } else { 3000 });
        assert!(report.differences.iter().all(|one| one.passes_alone == passes_alone), "{every}");
    }
}

#[test]
fn no_backend_is_an_error() {
    let (plan, known) = (small_plan(), Known::default());
    assert!(verify(&mut [], &plan, &known, &|_, _, _| {}).is_err(), "no worker");
    assert!(verify(&mut [vec![]], &plan, &known, &|_, _, _| {}).is_err(), "no backend");
}

/// However many patches are asked for, a unit is made when it is its turn, and not before.
#[test]
fn as_many_random_patches_as_there_are_numbers() {
    let subjects = vec![Subject::Random { patches: u64::MAX, seed: 1 }];
    let plan = VerifyPlan { subjects, shard: Shard { part: 5, of: 96 << 51 } };
    let rows = run(&mut [vec![Box::new(SecondFormulation)]], &plan);
    assert_eq!((rows[0].compared, rows[0].first.as_deref()), (2 * 4096, None), "two units");
}

/// An implementation says what it does not have, and a caller can tell that from a failure.
#[test]
fn what_is_unsupported_is_told_from_failures() {
    assert!(BackendError::unsupported("no isolines").is_unsupported(), "there is none");
    assert!(!BackendError::new("the device is lost").is_unsupported(), "a failure");
}
