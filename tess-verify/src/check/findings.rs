//! Findings record by record, and their sum.

use super::consistency::{Use, conflicts};
use super::report::Explained;
use super::{Difference, Report};
use crate::case::Case;
use crate::check::Known;
use crate::check::compare::{Element, Mismatch};
use crate::check::known::MISSING;
use crate::check::strength::Conversions;
use std::fmt::Display;

/// The finding on a record.
pub(super) enum Found {
    /// It is as it should be.
    Equal,
    /// So it is, if the device converts some values in one of these ways.
    Converted(Case, Conversions),
    /// Its fault, and the patch that shows it, if one does.
    Different(Mismatch, Option<Case>),
    /// The fault of a device's output for a case, and what explains it.
    Explained(Mismatch, Case, Explained),
    /// It differs, and that is known.
    Known,
}

impl Found {
    /// Whether the record differs, as far as it shows on its own.
    pub(super) const fn is_different(&self) -> bool {
        matches!(self, Self::Different(..) | Self::Explained(..))
    }

    /// The same, unless it is a difference that is known of this case.
    pub(super) fn unless_known(self, case: Option<Case>, known: &Known) -> Self {
        let difference: Option<&dyn Display> = match &self {
            Self::Different(mismatch, _) if mismatch.element == Element::Record => Some(&MISSING),
            Self::Different(mismatch, _) | Self::Explained(mismatch, ..) => Some(mismatch),
            _ => None,
        };
        let is_known = case.is_some_and(|case| known.excuses(&case, difference));
        if is_known { Self::Known } else { self }
    }

    pub(super) fn new(mismatch: Option<Mismatch>, case: Option<Case>) -> Self {
        mismatch.map_or(Self::Equal, |mismatch| Self::Different(mismatch, case))
    }
}

/// The findings of one worker, or of all.
#[derive(Debug, Default)]
pub(super) struct Findings {
    report: Report,
    uses: Vec<Use>,
}

impl Findings {
    /// Adds what was found of record `number`. Of one that is shown, `again` gives the record as a
    /// file, and whether it passes alone.
    pub(super) fn add(
        &mut self,
        number: u64,
        line: Option<u64>,
        found: Found,
        again: impl FnOnce() -> (Option<String>, bool),
    ) {
        self.report.cases += 1;
        match found {
            Found::Equal => {}
            Found::Known => self.report.known += 1,
            Found::Converted(case, conversions) => {
                self.uses.push(Use { number, line, case, conversions });
            }
            Found::Different(mismatch, case) => {
                self.differ((number, line), mismatch, case, Explained::default(), again);
            }
            Found::Explained(mismatch, case, explained) => {
                self.differ((number, line), mismatch, Some(case), explained, again);
            }
        }
    }

    fn differ(
        &mut self,
        (number, line): (u64, Option<u64>),
        mismatch: Mismatch,
        case: Option<Case>,
        explained: Explained,
        again: impl FnOnce() -> (Option<String>, bool),
    ) {
        self.report.explain(explained);
        let found = Difference::new(number, line, mismatch, case);
        let (file, passes_alone) = if self.report.shows(&found) { again() } else { (None, false) };
        self.report.differ(Difference { file, passes_alone, ..found });
    }

    /// Adds what another worker found.
    pub(super) fn join(&mut self, mut other: Self) {
        self.report.add(other.report);
        self.uses.append(&mut other.uses);
    }

    /// The verdict, when everything is in.
    pub(super) fn report(mut self) -> Report {
        self.report.add(conflicts(self.uses));
        self.report
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::MAX_DIFFERENCES;
    use crate::check::compare::SpecStage;

    /// A record is kept as a file for the first differences, and for one that is the smallest so
    /// far.
    #[test]
    fn files_are_made_for_what_is_shown() {
        let mut findings = Findings::default();
        let mut made = Vec::new();
        let first = u64::try_from(MAX_DIFFERENCES).expect("few");
        // Factor 2 and up, then 1.
        for number in 1..=first + 5 {
            let detail = if number == first + 3 { 1.0 } else { 1.0 + number as f32 };
            let line = format!("case isoline integer line ruler 3f800000 {:08x}", detail.to_bits());
            let mismatch = Mismatch::count("points", 1, 2).expect("they differ");
            assert_eq!(mismatch.stage, SpecStage::Counts);
            let found = Found::Different(mismatch, Some(line.parse().expect("a case")));
            findings.add(number, None, found, || {
                made.push(number);
                (Some(format!("file {number}")), false)
            });
        }
        let expected: Vec<u64> = (1..=first).chain([first + 3]).collect();
        assert_eq!(made, expected, "the first, and the smallest");
        let report = findings.report();
        assert_eq!((report.differences.len(), report.mismatches), (MAX_DIFFERENCES, first + 5));
        let smallest = &report.groups()[0].smallest;
        assert_eq!(smallest.file, Some(format!("file {}", first + 3)), "{smallest}");
    }
}
