//! The report of a comparison.

mod group;

pub use group::MismatchGroup;

use crate::backend::BackendError;
use crate::case::Case;
use crate::check::compare::{Element, Mismatch};
use crate::check::explainer::Explanation;
use crate::check::freedoms::Freedoms;
use crate::names::Named;
use crate::vectors::{Header, Kind, Record, VectorError};
use group::Groups;
use std::fmt;

/// The number of differences that a report shows in full.
pub const MAX_DIFFERENCES: usize = 20;

/// The verdict on a vector file.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Report {
    /// Records that were checked, plus asked cases that have no record.
    pub cases: u64,
    /// Those that differ, and are not [`Known`](crate::check::Known).
    pub mismatches: u64,
    /// Those that differ in a known way.
    pub known: u64,
    /// The first differences, at most [`MAX_DIFFERENCES`], in the order of the file.
    pub differences: Vec<Difference>,
    groups: Groups,
    numbers: Numbers,
    /// The explanations of a device that each account for every difference and that no right record
    /// refutes: freedoms that were not granted, or else mistakes, the shortest first.
    pub explanations: Vec<Explanation>,
}

impl Report {
    /// The freedoms that would make every difference count as equal, if they were granted.
    #[must_use]
    pub fn freedoms(&self) -> Option<Freedoms> {
        self.explanations.iter().find_map(|explanation| match explanation {
            Explanation::Freedoms(freedoms) => Some(*freedoms),
            Explanation::Mistake(..) => None,
        })
    }

    /// The shortest mistake that explains every difference, unless freedoms do.
    #[must_use]
    pub fn mistake(&self) -> Option<&Explanation> {
        self.explanations.iter().find(|explanation| !explanation.is_allowed())
    }

    /// The differences by stage and configuration; the group with the smallest case comes first.
    #[must_use]
    pub fn groups(&self) -> Vec<MismatchGroup> {
        self.groups.sorted()
    }

    /// The greatest common divisor of the distances between the records that differ, if it is 8 or
    /// more and at least three records differ. A device that keeps state between patches may fail
    /// at such a period.
    #[must_use]
    pub const fn period(&self) -> Option<u64> {
        let Numbers { gap, .. } = self.numbers;
        if self.mismatches >= 3 && gap >= 8 { Some(gap) } else { None }
    }

    /// Whether a difference is shown in full: it is one of the first, or the smallest of its group.
    pub(super) fn shows(&self, difference: &Difference) -> bool {
        self.differences.len() < MAX_DIFFERENCES || self.groups.has_smallest(difference)
    }

    /// Adds a difference.
    pub(super) fn differ(&mut self, difference: Difference) {
        self.mismatches += 1;
        self.numbers.add(Numbers { first: difference.number, gap: 0 });
        self.groups.add(&difference);
        if self.differences.len() < MAX_DIFFERENCES {
            self.differences.push(difference);
        }
    }

    /// Adds another worker's findings.
    pub(super) fn add(&mut self, other: Self) {
        self.cases += other.cases;
        self.mismatches += other.mismatches;
        if other.mismatches > 0 {
            self.numbers.add(other.numbers);
        }
        self.known += other.known;
        self.groups.join(other.groups);
        self.differences.extend(other.differences);
        self.differences.sort_by_key(|difference| difference.number);
        self.differences.truncate(MAX_DIFFERENCES);
    }
}

/// The numbers of the records that differ: one of them, and the greatest common divisor of their
/// distances.
#[derive(Clone, Copy, Debug, Default)]
struct Numbers {
    /// A number from 1; 0 if no record differs.
    first: u64,
    gap: u64,
}

impl Numbers {
    fn add(&mut self, other: Self) {
        let apart = if self.first == 0 { 0 } else { self.first.abs_diff(other.first) };
        self.first = other.first;
        for mut rest in [apart, other.gap] {
            while rest > 0 {
                (self.gap, rest) = (rest, self.gap % rest);
            }
        }
    }
}

/// The summary line.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} cases, {} mismatches", self.cases, self.mismatches)?;
        if self.known > 0 { write!(f, ", {} known", self.known) } else { Ok(()) }
    }
}

/// One record that differs.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Difference {
    /// The number of the record, from 1.
    pub number: u64,
    /// The line of the file on which it starts, if there is a file.
    pub line: Option<u64>,
    /// The first wrong element.
    pub mismatch: Mismatch,
    /// The patch that shows the difference, if there is one.
    pub case: Option<Case>,
    /// The record by itself as a vector file; `None` for a listing, which may be long.
    pub file: Option<String>,
    /// Whether the backend is right when it repeats the record by itself, so that earlier work
    /// matters. False for a device that only supplied a file, because it cannot be asked.
    pub passes_alone: bool,
}

impl Difference {
    pub(super) const fn new(
        number: u64,
        line: Option<u64>,
        mismatch: Mismatch,
        case: Option<Case>,
    ) -> Self {
        Self { number, line, mismatch, case, file: None, passes_alone: false }
    }

    /// Shell commands that reproduce the difference: the record by itself through `tess check`, and
    /// the patch through `tess patch`.
    #[must_use]
    pub fn commands(&self, backend: &str) -> Vec<String> {
        let check = self.file.as_ref().map(|file| {
            let quoted = |line: &str| format!("'{}'", line.replace('\'', r"'\''"));
            let lines: Vec<_> = file.lines().map(quoted).collect();
            format!("printf '%s\\n' {} | tess check - --backend {backend}", lines.join(" "))
        });
        let patch = self.case.map(|case| format!("{} --backend {backend}", case.command()));
        check.into_iter().chain(patch).collect()
    }
}

/// A record by itself as a vector file, without notes, which describe the cases of the whole file;
/// `None` for a listing, which may be long.
pub(super) fn file_of(header: &Header, record: &Record) -> Option<String> {
    let header = Header { count: Some(1), notes: Vec::new(), ..header.clone() };
    record.text().map(|row| format!("{}{row}\n", header.head()))
}

/// The number, line and patch, and the first wrong element.
impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "record {}", self.number)?;
        if self.mismatch.element == Element::Record {
            write!(f, " is missing")?;
        }
        if let Some(line) = self.line {
            write!(f, " (line {line})")?;
        }
        if let Some(case) = &self.case {
            write!(f, ": {case}")?;
        }
        write!(f, "\n  {}", self.mismatch)
    }
}

impl CheckError {
    /// The error of a file that is malformed after the records of this report.
    pub(super) fn malformed(error: VectorError, before: Report) -> Self {
        match before.cases {
            0 => Self::Vectors(error),
            _ => Self::Malformed { error, before: Box::new(before) },
        }
    }
}

/// The reason why there is no verdict.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// The file is malformed at its first record or before, truncated, too long or empty.
    #[error("{0}")]
    Vectors(#[from] VectorError),
    /// The file is malformed after some records. Those were checked; the report of them is not a
    /// verdict.
    #[error("{error}")]
    Malformed {
        /// The fault and its place.
        error: VectorError,
        /// The report of the earlier records.
        before: Box<Report>,
    },
    /// Listings were to be tested, but the file's records are of another kind.
    #[error("a device is tested by its listings; this file's kind is {}", .0.name())]
    NoListings(Kind),
    /// The backend could not run.
    #[error("{0}")]
    Backend(#[from] BackendError),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::SpecStage;

    /// Workers finish in any order.
    #[test]
    fn differences_of_workers_are_in_the_order_of_the_file() {
        let found = |numbers: &[u64]| {
            let mut report = Report::default();
            for &number in numbers {
                let (element, stage) = (Element::Record, SpecStage::Answer);
                let (observed, expected) = ("none".to_owned(), "an answer".to_owned());
                let mismatch = Mismatch { element, observed, expected, stage };
                report.differ(Difference::new(number, None, mismatch, None));
            }
            report
        };
        let mut report = found(&[7, 12]);
        report.add(found(&[3, 30]));
        report.add(found(&(8..11).collect::<Vec<_>>()));
        let numbers = |report: &Report| -> Vec<u64> {
            report.differences.iter().map(|difference| difference.number).collect()
        };
        assert_eq!(numbers(&report), [3, 7, 8, 9, 10, 12, 30]);
        report.add(found(&(100..130).collect::<Vec<_>>()));
        report.add(found(&[1]));
        assert_eq!(report.mismatches, 38);
        let first = [1, 3, 7, 8, 9, 10, 12, 30].into_iter().chain(100..112);
        assert!(numbers(&report).into_iter().eq(first), "the first {MAX_DIFFERENCES}");
    }
}
