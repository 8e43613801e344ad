//! Runs the records of a vector file through a backend.

mod alignment;
mod asked;
mod compare;
mod consistency;
mod device;
mod exhaustive;
mod explainer;
mod findings;
mod freedoms;
mod known;
mod patches;
mod report;
mod second;
mod sequences;
mod stages;
mod verify;
mod workers;

pub use crate::strength::{
    Conversion, Denormals, Elements, ListOrder, Strength, flushed, vertices,
};
pub use asked::Asked;
pub use compare::{Element, Mismatch, SpecStage};
pub use explainer::{Explainer, Explanation};
pub use freedoms::Freedoms;
pub use known::{Known, KnownOutcome};
pub use report::{CheckError, Difference, MAX_DIFFERENCES, MismatchGroup, Report};
pub use second::SecondFormulation;
pub use verify::{Progress, Subject, SubjectRow, Unit, units, verify};

use crate::backend::{Answers, Backend, BackendError, tessellate};
use crate::case::Case;
use crate::mistakes::{Request, Sequence};
use crate::vectors::{CsvRow, Header, Kind, Record, Values, VectorError, VectorFile};
use asked::Expected;
use findings::{Findings, Found};
use std::io::BufRead;
use std::sync::{Mutex, PoisonError};
use tess_core::Tessellation;

/// The side of a comparison that is under test; the other side counts as right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tested {
    /// The backend: each of its results must equal the recorded one exactly.
    Backend,
    /// The file: its listings are a device's output, and each must equal the model's as closely as
    /// the strength demands. The backends are not called.
    Listings(Strength),
    /// The file, but only whether its records answer the cases that were asked; their results are
    /// not compared.
    Answers,
}

/// A part of a file that was checked: consecutive records.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Checked<'a> {
    /// The number of the first record, from 1.
    pub first: u64,
    /// The case of the record that precedes the first.
    pub before: Option<Case>,
    /// The records.
    pub records: &'a [Record],
    /// For each record, whether it is wrong for the case that it states. Two kinds of fault count
    /// only in the report: a record that is right for its case but answers a case other than the
    /// one asked, and one that contradicts another record.
    pub different: &'a [bool],
}

/// Checks every record of a file.
///
/// `tested` decides which side is right; the file has no say in it. Pass one backend per thread;
/// the report does not depend on their number. `checked` is called from any thread, in no
/// particular order, with records that no earlier call had; each record is passed once.
///
/// # Errors
/// - The file is malformed, truncated or too long. The error holds the report of the records before
///   that point; it is not a verdict.
/// - [`Tested::Listings`] or [`Tested::Answers`], and the file does not hold listings.
/// - A backend could not run, or `backends` is empty.
pub fn check<R: BufRead + Send>(
    file: VectorFile<R>,
    backends: &mut [Box<dyn Backend>],
    tested: Tested,
    checked: &(dyn Fn(Checked<'_>) + Sync),
) -> Result<Report, CheckError> {
    check_asked(file, None, &Known::default(), backends, tested, checked)
}

/// Does what [`check`] does, with two additions.
///
/// - A record that is wrong for its case is not a mismatch if that difference is `known`.
/// - The records must answer the `asked` cases one for one, in this order. A record that answers
///   another case is a difference, and so is a case without a record. The smallest number of
///   differences that explains the file is counted. The comparison is in step again after a gap of
///   fewer than 4096 cases in a row without a record.
///
/// # Errors
/// The errors of [`check`] and of reading `asked`.
pub fn check_asked<R: BufRead + Send>(
    file: VectorFile<R>,
    asked: Option<Asked<'_>>,
    known: &Known,
    backends: &mut [Box<dyn Backend>],
    tested: Tested,
    checked: &(dyn Fn(Checked<'_>) + Sync),
) -> Result<Report, CheckError> {
    if backends.is_empty() {
        return Err(BackendError::new("no backend to check with").into());
    }
    let header = file.header().clone();
    if tested != Tested::Backend && header.kind != Kind::Listings {
        return Err(CheckError::NoListings(header.kind));
    }
    let how = How { header, tested };
    let expected = asked.map(|asked| Expected::new(asked, known));
    let source = Source {
        file,
        expected,
        taken: 0,
        last: None,
        ahead: None,
        sequence: Sequence::default(),
        stopped: false,
        malformed: None,
    };
    let source = Mutex::new(source);
    let run = |backend: &mut Box<dyn Backend>| {
        let result = run(&how, &source, known, backend.as_mut(), checked);
        if result.is_err() {
            lock(&source).stop();
        }
        result
    };
    let results = workers::run(backends, run);
    let source = source.into_inner().unwrap_or_else(PoisonError::into_inner);
    let (findings, malformed) = source.finish()?;
    let report = sum(findings, results);
    match malformed {
        None => Ok(report?),
        // The file is reported as malformed, whatever a backend answered meanwhile.
        Some(error) => Err(CheckError::malformed(error, report.unwrap_or_default())),
    }
}

/// The report of all workers' findings; `None` stands for a worker that panicked.
fn sum(
    mut findings: Findings,
    results: Vec<Option<Result<Findings, BackendError>>>,
) -> Result<Report, BackendError> {
    for result in results {
        findings.join(result.ok_or_else(|| BackendError::new("the backend panicked"))??);
    }
    Ok(findings.report())
}

/// Checks a device's answers for cases at a strength: [`check`] without a file.
#[must_use]
pub fn check_device(
    answers: impl IntoIterator<Item = (Case, Tessellation)>,
    strength: Strength,
) -> Report {
    let mut findings = Findings::default();
    let mut answers = answers.into_iter().peekable();
    let mut sequence = Sequence::default();
    for number in 1.. {
        let Some((case, answer)) = answers.next() else { break };
        let request = sequence.next(case, answers.peek().map(|(case, _)| *case));
        let found = device::check(&case, &answer, strength);
        findings.explain(&request, &answer, strength, &found);
        findings.add(number, None, found, Default::default);
    }
    findings.report()
}

/// The first fault of a backend's output for one case at a strength; `None` if there is none.
///
/// This is the oracle of a fuzz target.
///
/// # Errors
/// The backend could not run, or returned a number of patches other than one.
pub fn check_case(
    backend: &mut dyn Backend,
    case: &Case,
    strength: Strength,
) -> Result<Option<Mismatch>, BackendError> {
    let outputs = tessellate(backend, &[*case])?;
    let report = check_device(outputs.into_iter().map(|output| (*case, output)), strength);
    Ok(report.differences.into_iter().next().map(|difference| difference.mismatch))
}

/// The settings of a comparison, shared by all records.
struct How {
    header: Header,
    tested: Tested,
}

/// The records that are still to be checked.
struct Source<'a, R> {
    file: VectorFile<R>,
    expected: Option<Expected<'a>>,
    taken: u64,
    /// The case of the record taken last.
    last: Option<Case>,
    /// The next record, which is read one ahead: a device's mistake may depend on it.
    ahead: Option<Answered>,
    sequence: Sequence,
    /// Set when no more records may be taken: a backend failed, or the next record is malformed.
    stopped: bool,
    malformed: Option<VectorError>,
}

/// A record, and how its case differs from the one asked.
type Answered = (Record, Option<Mismatch>);

/// Records that one worker checks together.
#[derive(Default)]
struct Work {
    /// Number of the first record, from 1.
    first: u64,
    before: Option<Case>,
    /// For each record, its fault if it answers a case other than the one asked.
    astray: Vec<Option<Mismatch>>,
    records: Vec<Record>,
    /// For each record of a case, what was asked.
    requests: Vec<Option<Request>>,
}

impl<R: BufRead> Source<'_, R> {
    fn next_unit(&mut self, how: &How) -> Option<Work> {
        let mut unit = Work { first: self.taken + 1, before: self.last, ..Work::default() };
        while unit.records.len() < unit_size(how.header.kind) {
            let Some((record, astray)) = self.ahead.take().or_else(|| self.read(how.tested)) else {
                break;
            };
            self.ahead = self.read(how.tested);
            (self.taken, self.last) = (self.taken + 1, record.case());
            let after = self.ahead.as_ref().and_then(|(record, _)| record.case());
            unit.requests.push(record.case().map(|case| self.sequence.next(case, after)));
            unit.astray.push(astray);
            unit.records.push(record);
        }
        (!unit.records.is_empty()).then_some(unit)
    }

    /// Reads a record, until one is malformed or no more may be taken.
    fn read(&mut self, tested: Tested) -> Option<Answered> {
        if self.stopped {
            return None;
        }
        let next = self.next_record(tested);
        next.unwrap_or_else(|error| {
            (self.stopped, self.malformed) = (true, Some(error));
            None
        })
    }

    fn stop(&mut self) {
        (self.stopped, self.ahead) = (true, None);
    }

    fn next_record(&mut self, tested: Tested) -> Result<Option<Answered>, VectorError> {
        let next = match &mut self.expected {
            Some(expected) => expected.answer(&mut self.file)?,
            None => self.file.next().transpose()?.map(|record| (record, None)),
        };
        let Some((record, astray)) = next else { return Ok(None) };
        if let (Record::Coordinates(_), Tested::Listings(strength)) = (&record, tested)
            && strength.elements == Elements::Points
            && strength.order != ListOrder::Any
        {
            let message = "vertices by coordinates do not show the order of points: compare \
                           primitives, or points in any order";
            return Err(self.file.error_at(record.line(), "coordinates", message));
        }
        Ok(Some((record, astray)))
    }

    /// The cases that no record answers, and the error if the records end at a malformed one.
    fn finish(self) -> Result<(Findings, Option<VectorError>), VectorError> {
        let Some(expected) = self.expected else {
            return Ok((Findings::default(), self.malformed));
        };
        let findings = match self.malformed {
            None => expected.finish()?,
            Some(_) => expected.so_far(),
        };
        Ok((findings, self.malformed))
    }
}

/// Records per unit of work. Single patches are handed over in batches; a row of the other kinds is
/// a batch by itself.
const fn unit_size(kind: Kind) -> usize {
    match kind {
        Kind::Listings | Kind::Patches | Kind::Preparation => 256,
        Kind::Sweep | Kind::Uniform | Kind::Locations | Kind::Factors => 1,
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The loop of one worker: takes units until none are left.
fn run<R: BufRead>(
    how: &How,
    source: &Mutex<Source<'_, R>>,
    known: &Known,
    backend: &mut dyn Backend,
    checked: &(dyn Fn(Checked<'_>) + Sync),
) -> Result<Findings, BackendError> {
    let mut findings = Findings::default();
    loop {
        let unit = lock(source).next_unit(how);
        let Some(Work { first, before, astray, records, requests }) = unit else {
            return Ok(findings);
        };
        let found = check_unit(how, backend, &records)?;
        let found: Vec<Found> = found
            .into_iter()
            .zip(&records)
            .map(|(found, record)| found.unless_known(record.case(), known))
            .collect();
        let different: Vec<bool> = found.iter().map(Found::is_different).collect();
        let asked = requests.iter().zip(astray);
        let answers = (first..).zip(&records).zip(asked.zip(found));
        for ((number, record), ((request, astray), found)) in answers {
            let (line, is_astray) = (Some(record.line()), astray.is_some());
            let found = astray.map_or(found, |mismatch| Found::new(Some(mismatch), None));
            if let (Some(request), Tested::Listings(strength)) = (request, how.tested) {
                findings.explain_record(request, record, strength, &found);
            }
            // A record that answers another case is not written out to be run again: only its case
            // is wrong.
            let again = || {
                if is_astray {
                    return (None, false);
                }
                let mut alone = || check_unit(how, backend, std::slice::from_ref(record));
                let is_right = |found: Vec<Found>| !found.iter().any(Found::is_different);
                let passes = how.tested == Tested::Backend && alone().is_ok_and(is_right);
                (report::file_of(&how.header, record), passes)
            };
            findings.add(number, line, found, again);
        }
        checked(Checked { first, before, records: &records, different: &different });
    }
}

/// The findings of each record, in order.
fn check_unit(how: &How, backend: &mut dyn Backend, records: &[Record]) -> Answers<Found> {
    let [Record::Row(CsvRow { values, .. })] = records else {
        return patches::single(how, backend, records);
    };
    match values {
        Values::Sweep(row) => Ok(vec![patches::sweep(backend, row)?]),
        Values::Uniform(row) => Ok(vec![patches::uniform(backend, row)?]),
        Values::Locations(row) => Ok(vec![Found::new(exhaustive::locations(backend, row)?, None)]),
        Values::Factors(row) => Ok(vec![Found::new(exhaustive::factors(backend, row)?, None)]),
        Values::Patch(_) | Values::Preparation(_) => patches::single(how, backend, records),
    }
}
