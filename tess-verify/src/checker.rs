//! Runs the records of a vector file through a backend.

mod device;
mod exhaustive;
mod patches;
mod report;
mod stages;

pub(crate) use patches::tessellate;
pub use report::{CheckError, Difference, MAX_DIFFERENCES, Report};

use crate::backend::{Backend, BackendError};
use crate::compare::Mismatch;
use crate::strength::Strength;
use crate::vectors::{Header, Kind, Record, VectorError, VectorFile};
use std::io::BufRead;
use std::sync::{Mutex, PoisonError};

/// Checks every record of a file: each result of the backend must equal the recorded one.
///
/// Takes one backend for each thread that is to be used; the report does not depend on how many
/// there are. `strength` says what counts as equal in the listings of a device under test.
/// `progress` is told, from any thread, how many more records are done.
///
/// # Errors
/// A file that is malformed, truncated or too long, which is known at its end: the report of a
/// file that is not whole is never given. A backend that could not run, or no backend at all.
pub fn check<R: BufRead + Send>(
    file: VectorFile<R>,
    backends: &mut [Box<dyn Backend>],
    strength: Strength,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Report, CheckError> {
    if backends.is_empty() {
        return Err(BackendError::new("no backend to check with").into());
    }
    let how = How { header: file.header().clone(), strength };
    let source = Mutex::new(Source { file, taken: 0, stopped: None });
    let run = |backend: &mut Box<dyn Backend>| {
        let result = run(&how, &source, backend.as_mut(), progress);
        if result.is_err() {
            lock(&source).stopped.get_or_insert(Ok(()));
        }
        result
    };
    let mut results = Vec::new();
    std::thread::scope(|scope| {
        let workers: Vec<_> = backends.iter_mut().map(|b| scope.spawn(|| run(b))).collect();
        for worker in workers {
            let panicked = |_| Err(BackendError::new("the backend panicked"));
            results.push(worker.join().unwrap_or_else(panicked));
        }
    });
    // A malformed file is reported as such, whatever a backend may have said meanwhile.
    if let Some(Err(error)) = lock(&source).stopped.take() {
        return Err(error.into());
    }
    let mut report = Report::default();
    for result in results {
        report.add(result?);
    }
    Ok(report)
}

/// What the comparison of a record depends on besides the record.
struct How {
    header: Header,
    strength: Strength,
}

/// The records that are still to be checked.
struct Source<R> {
    file: VectorFile<R>,
    taken: u64,
    /// Set when no more records are to be taken before the end, with the reason.
    stopped: Option<Result<(), VectorError>>,
}

/// Consecutive records that one worker checks together.
struct Unit {
    /// Number of the first record, from 1.
    first: u64,
    records: Vec<Record>,
}

impl<R: BufRead> Source<R> {
    fn next_unit(&mut self, kind: Kind) -> Option<Unit> {
        let mut unit = Unit { first: self.taken + 1, records: Vec::new() };
        while self.stopped.is_none() && unit.records.len() < unit_size(kind) {
            match self.file.next() {
                Some(Ok(record)) => unit.records.push(record),
                Some(Err(error)) => self.stopped = Some(Err(error)),
                None => break,
            }
        }
        self.taken += unit.records.len() as u64;
        (!unit.records.is_empty()).then_some(unit)
    }
}

/// Single patches are handed over in batches; a row of the other kinds is a batch of its own.
const fn unit_size(kind: Kind) -> usize {
    match kind {
        Kind::Listings | Kind::Patches | Kind::Preparation => 256,
        Kind::Sweep | Kind::Uniform | Kind::Locations | Kind::Factors => 1,
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// One worker: takes units until there are none.
fn run<R: BufRead>(
    how: &How,
    source: &Mutex<Source<R>>,
    backend: &mut dyn Backend,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Report, BackendError> {
    let mut report = Report::default();
    loop {
        let Some(unit) = lock(source).next_unit(how.header.kind) else { return Ok(report) };
        let found = check_unit(how, backend, &unit.records)?;
        for ((number, record), found) in (unit.first..).zip(&unit.records).zip(found) {
            report.cases += 1;
            if let Some((mismatch, case)) = found {
                report.mismatches += 1;
                let difference = Difference::new(&how.header, number, record, mismatch, case);
                report.differences.push(difference);
            }
        }
        report.differences.truncate(MAX_DIFFERENCES);
        progress(unit.records.len() as u64);
    }
}

/// What is wrong with a record, and the patch that shows it, if one does.
type Found = Option<(Mismatch, Option<crate::case::Case>)>;

/// The findings of each record, in order.
fn check_unit(
    how: &How,
    backend: &mut dyn Backend,
    records: &[Record],
) -> Result<Vec<Found>, BackendError> {
    let in_rows = |found: Option<Mismatch>| vec![found.map(|mismatch| (mismatch, None))];
    match records {
        [Record::Sweep(row)] => Ok(vec![patches::sweep(backend, row)?]),
        [Record::Uniform(row)] => Ok(vec![patches::uniform(backend, row)?]),
        [Record::Locations(row)] => exhaustive::locations(backend, row).map(in_rows),
        [Record::Factors(row)] => exhaustive::factors(backend, row).map(in_rows),
        records => patches::single(how, backend, records),
    }
}
