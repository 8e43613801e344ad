//! Tests of the verification of backends: it compares what it states, in any number of shards and
//! threads.

use tess_core::{Config, PatchFactors, Tessellation};
use tess_verify::check::{
    Known, Progress, SecondFormulation, Subject, SubjectRow, Tested, check, verify,
};
use tess_verify::generate::Shard;
use tess_verify::vectors::{Listing, VectorFile};
use tess_verify::{Answers, Backend, BackendError, CoreBackend};

fn run(backends: Vec<Box<dyn Backend>>, subject: Subject, shard: Shard) -> SubjectRow {
    let mut workers: Vec<_> = backends.into_iter().map(|backend| vec![backend]).collect();
    let rows = verify(&mut workers, subject, shard, &Known::default(), &|_| {});
    let [row] = &rows.expect("the backends run")[..] else { panic!("one row") };
    row.clone()
}

#[test]
fn both_formulations_agree_on_any_number_of_threads() {
    let shard = Shard { part: 3, of: 61 };
    for subject in Subject::ALL.into_iter().filter(|subject| *subject != Subject::Factors) {
        let row = run(vec![Box::new(SecondFormulation)], subject, shard);
        assert!(row.compared > 0, "{row:?} compared something");
        assert_eq!((row.subject, &row.first), (subject, &None), "{row:?}");
        let two: [Box<dyn Backend>; 2] = [Box::new(SecondFormulation), Box::new(SecondFormulation)];
        assert_eq!(row, run(two.into(), subject, shard), "threads change nothing");
    }
}

/// The units of a shard are counted from 1 up to the last one.
#[test]
fn progress_ends_with_the_last_unit() {
    for subject in [Subject::Transitions, Subject::Interiors] {
        let calls = std::sync::Mutex::new(Vec::new());
        let note = |progress: Progress<'_>| {
            calls.lock().expect("no panic").push((progress.done, progress.all));
        };
        let mut workers: [Vec<Box<dyn Backend>>; 1] = [vec![Box::new(SecondFormulation)]];
        let shard = Shard { part: 1, of: 4 };
        verify(&mut workers, subject, shard, &Known::default(), &note).expect("it runs");
        let calls = calls.into_inner().expect("no panic");
        let all = calls.len() as u64;
        assert!(all > 1, "{subject:?}: {all} units");
        assert!(calls.into_iter().eq((1..=all).map(|done| (done, all))), "{subject:?}");
    }
}

/// The 2^20 numbers from 1 on, in every partitioning.
#[test]
fn factors_agree_with_binary64() {
    let shard = Shard { part: 1016, of: 4096 };
    let row = run(vec![Box::new(SecondFormulation)], Subject::Factors, shard);
    assert_eq!((row.compared, row.first.as_deref()), (4 << 20, None), "four units");
}

/// The model, except that one out of every `every` patches has a point too many.
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

    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation> {
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

/// A patch that differs is asked again: it is correct by itself if every thousandth patch fails,
/// and wrong if every patch does.
#[test]
fn what_came_before_is_told_from_the_patch() {
    for (every, passes_alone) in [(1000, true), (1, false)] {
        let stateful = Box::new(Stateful { every, asked: 0 });
        let row = run(vec![stateful], Subject::Interiors, Shard::WHOLE);
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
    for (workers, why) in [(&mut [][..], "no worker"), (&mut [vec![]], "no backend")] {
        let known = Known::default();
        let verified = verify(workers, Subject::Level1, Shard::WHOLE, &known, &|_| {});
        assert!(verified.is_err(), "{why}");
    }
}

/// However many patches are asked for, a unit is generated when its turn comes, not before.
#[test]
fn as_many_random_patches_as_there_are_numbers() {
    let subject = Subject::Random { patches: u64::MAX, seed: 1 };
    let shard = Shard { part: 5, of: 96 << 51 };
    let row = run(vec![Box::new(SecondFormulation)], subject, shard);
    assert_eq!((row.compared, row.first.as_deref()), (2 * 4096, None), "two units");
}

/// An implementation reports what it does not support, and a caller can distinguish that from a
/// failure.
#[test]
fn what_is_unsupported_is_told_from_failures() {
    assert!(BackendError::unsupported("no isolines").is_unsupported(), "there is none");
    assert!(!BackendError::new("the device is lost").is_unsupported(), "a failure");
}
