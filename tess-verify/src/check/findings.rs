//! Findings, record by record, and their sum.

use super::consistency::{Use, conflicts};
use super::{Difference, Explainer, Report, device};
use crate::case::Case;
use crate::check::Known;
use crate::check::compare::{Element, Mismatch};
use crate::check::known::MISSING;
use crate::mistakes::Request;
use crate::strength::{Conversions, Strength};
use crate::vectors::Record;
use std::fmt::Display;
use tess_core::Tessellation;

/// The finding for one record.
pub(super) enum Found {
    /// It is right.
    Equal,
    /// It is right if the device converts some values in one of these ways.
    Converted(Case, Conversions),
    /// It is wrong: the fault, and the patch that shows it, if there is one.
    Different(Mismatch, Option<Case>),
    /// A device's output for a case is wrong. A mistake of the device may explain that.
    Device(Mismatch, Case),
    /// It is wrong, and the difference is known.
    Known,
}

impl Found {
    /// Whether the record is wrong by itself.
    pub(super) const fn is_different(&self) -> bool {
        matches!(self, Self::Different(..) | Self::Device(..))
    }

    /// This finding, unless it is a difference that is known for this case.
    pub(super) fn unless_known(self, case: Option<Case>, known: &Known) -> Self {
        let difference: Option<&dyn Display> = match &self {
            Self::Different(mismatch, _) if mismatch.element == Element::Record => Some(&MISSING),
            Self::Different(mismatch, _) | Self::Device(mismatch, _) => Some(mismatch),
            _ => None,
        };
        let is_known = case.is_some_and(|case| known.excuses(&case, difference));
        if is_known { Self::Known } else { self }
    }

    pub(super) fn new(mismatch: Option<Mismatch>, case: Option<Case>) -> Self {
        mismatch.map_or(Self::Equal, |mismatch| Self::Different(mismatch, case))
    }
}

/// The findings of one worker, or of all of them.
#[derive(Debug, Default)]
pub(super) struct Findings {
    report: Report,
    uses: Vec<Use>,
    explainer: Explainer,
}

impl Findings {
    /// Adds the finding for record `number`. `again` is called only for a difference that is shown:
    /// it returns the record as a file, and whether the record passes by itself.
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
                self.explainer.unexplained();
                self.differ((number, line), mismatch, case, again);
            }
            Found::Device(mismatch, case) => {
                self.differ((number, line), mismatch, Some(case), again);
            }
        }
    }

    /// Tells the explainer of a finding: a device's output, compared at a strength.
    pub(super) fn explain(
        &mut self,
        request: &Request,
        output: &Tessellation,
        strength: Strength,
        found: &Found,
    ) {
        let explainer = &mut self.explainer;
        match found {
            Found::Equal | Found::Converted(..) => explainer.right(request, strength),
            Found::Device(..) => explainer.different(request, output, strength),
            Found::Known | Found::Different(..) => explainer.skip(request, strength),
        }
    }

    /// The same for a record of a file.
    pub(super) fn explain_record(
        &mut self,
        request: &Request,
        record: &Record,
        strength: Strength,
        found: &Found,
    ) {
        match record {
            Record::Listing(listing) => self.explain(request, &listing.output, strength, found),
            Record::Coordinates(coordinates) => {
                let strength = device::strength_of_coordinates(strength);
                self.explain(request, &coordinates.output(), strength, found);
            }
            Record::Row(_) => {}
        }
    }

    fn differ(
        &mut self,
        (number, line): (u64, Option<u64>),
        mismatch: Mismatch,
        case: Option<Case>,
        again: impl FnOnce() -> (Option<String>, bool),
    ) {
        let found = Difference::new(number, line, mismatch, case);
        let (file, passes_alone) = if self.report.shows(&found) { again() } else { (None, false) };
        self.report.differ(Difference { file, passes_alone, ..found });
    }

    /// Adds another worker's findings.
    pub(super) fn join(&mut self, mut other: Self) {
        self.report.add(other.report);
        self.uses.append(&mut other.uses);
        self.explainer.join(other.explainer);
    }

    /// The report, once everything has been added.
    pub(super) fn report(mut self) -> Report {
        let conflicts = conflicts(self.uses);
        if conflicts.mismatches > 0 {
            self.explainer.unexplained();
        }
        self.report.add(conflicts);
        self.report.explanations = self.explainer.explanations();
        self.report
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::MAX_DIFFERENCES;
    use crate::check::compare::SpecStage;

    /// A record is kept as a file if it is among the first differences, or the smallest so far.
    #[test]
    fn files_are_made_for_what_is_shown() {
        let mut findings = Findings::default();
        let mut made = Vec::new();
        let first = u64::try_from(MAX_DIFFERENCES).expect("few");
        // The factors are 2 and up, and once 1.
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
