//! Known differences: a baseline of documented deviations, which are not mismatches.
//!
//! ```text
//! # remarks, and cases that may differ in any way, forever
//! case isoline integer line ruler 3f800000 40000000
//! # SUBJECT | what is expected, * for anything | owner | last day | reason
//! case isoline integer line ruler 3f800000 40400000 | missing | ada | 2027-06-30 | culls density 1
//! rule segments | 1029 | ada | 2027-06-30 | levels are converted before they are rounded
//! ```

use crate::case::{Case, CaseError};
use crate::names::Named;
use crate::quote::quoted;
use crate::rules::{Rule, Specification};
use crate::vectors::{Cases, VectorError};
use std::collections::HashMap;
use std::fmt::{self, Display};
use std::io::BufRead;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// The expectation of a case that has no answer.
pub(super) const MISSING: &str = "missing";

/// The cases and rules that may differ, with the outcome of each. Threads may share it.
///
/// The default is empty and excuses nothing.
#[derive(Debug, Default)]
pub struct Known {
    /// The name of the file.
    file: String,
    /// Each subject once, in the order of the file.
    entries: Vec<Entry>,
    /// The index of each subject's entry.
    places: HashMap<KnownSubject, usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum KnownSubject {
    Case(Case),
    Rule(Rule),
}

/// A line, and what has been observed for it.
#[derive(Debug)]
struct Entry {
    subject: KnownSubject,
    /// The number of the line, from 1.
    line: u64,
    /// Without terms, the case may differ in any way, except by having no answer.
    terms: Option<Terms>,
    equal: AtomicBool,
    /// It differed as expected.
    different: AtomicBool,
    /// The first unexpected way in which it differed.
    other: OnceLock<String>,
}

/// How, until when and why something may differ, and who is responsible.
#[derive(Debug)]
struct Terms {
    expected: String,
    owner: String,
    until: String,
    reason: String,
    is_expired: bool,
}

impl Entry {
    fn new(subject: KnownSubject, line: u64, terms: Option<Terms>) -> Self {
        let (equal, different, other) = Default::default();
        Self { subject, line, terms, equal, different, other }
    }

    fn parse(text: &str, line: u64, today: &str) -> Result<Self, CaseError> {
        let error = |field, message| CaseError { field, message };
        let mut fields = text.splitn(5, '|').map(str::trim);
        let subject = fields.next().unwrap_or_default();
        let subject = match subject.strip_prefix("rule ") {
            Some(rule) => KnownSubject::Rule(
                Rule::from_name(rule).map_err(|e| error(Rule::WHAT, e.to_string()))?,
            ),
            None => KnownSubject::Case(subject.parse()?),
        };
        let fields: Vec<&str> = fields.collect();
        let [expected, owner, until, reason] = match fields[..] {
            [] if matches!(subject, KnownSubject::Case(_)) => {
                return Ok(Self::new(subject, line, None));
            }
            [a, b, c, d] if fields.iter().all(|field| !field.is_empty()) => [a, b, c, d],
            _ => {
                let form = "after a case or rule, write | EXPECTED | OWNER | UNTIL | REASON";
                return Err(error("terms", form.to_owned()));
            }
        };
        let is_rule = matches!(subject, KnownSubject::Rule(_));
        if is_rule && expected != "*" && expected.parse::<u64>().is_err() {
            let message = format!("{} is neither a number nor *", quoted(expected));
            return Err(error("expected", message));
        }
        if !is_date(until) {
            let message = format!("{} is not a date such as 2027-06-30", quoted(until));
            return Err(error("until", message));
        }
        let is_expired = until < today;
        let [expected, owner, until, reason] = [expected, owner, until, reason].map(str::to_owned);
        Ok(Self::new(subject, line, Some(Terms { expected, owner, until, reason, is_expired })))
    }

    fn is_for(&self, rules: Option<Specification>) -> bool {
        let is_missing = self.terms.as_ref().is_some_and(|terms| terms.expected == MISSING);
        match self.subject {
            KnownSubject::Rule(_) => rules.is_some(),
            KnownSubject::Case(_) => rules.is_none() || is_missing,
        }
    }

    /// Notes a difference, or that there is none. Returns true for an expected difference.
    fn excuses(&self, difference: Option<&dyn Display>) -> bool {
        let Some(text) = difference.map(ToString::to_string) else {
            self.equal.store(true, Ordering::Relaxed);
            return false;
        };
        let is_expected = match &self.terms {
            Some(terms) if terms.is_expired => false,
            Some(terms) if terms.expected != "*" => terms.expected == text,
            _ => text != MISSING,
        };
        if is_expected {
            self.different.store(true, Ordering::Relaxed);
        } else {
            _ = self.other.set(text);
        }
        is_expected
    }

    /// The fault in the line's terms. `whole` says whether all the work was done, or only a part.
    fn fault(&self, terms: &Terms, whole: bool) -> Option<String> {
        let Terms { expected, until, .. } = terms;
        let is = |flag: &AtomicBool| flag.load(Ordering::Relaxed);
        match self.other.get() {
            _ if terms.is_expired => Some(format!("expired on {until}")),
            Some(other) => Some(format!("expects {}, not {}", quoted(expected), quoted(other))),
            None if is(&self.different) => None,
            None if whole || is(&self.equal) => {
                Some("is unused: nothing differs this way".to_owned())
            }
            None => None,
        }
    }
}

/// Whether a text is a date such as 2027-06-30. Such dates compare as texts.
fn is_date(text: &str) -> bool {
    let numbers: Vec<&str> = text.split('-').collect();
    let is_number = |text: &str, digits, range: std::ops::RangeInclusive<u32>| {
        text.len() == digits
            && text.bytes().all(|byte| byte.is_ascii_digit())
            && text.parse().is_ok_and(|number: u32| range.contains(&number))
    };
    matches!(numbers[..], [year, month, day]
        if is_number(year, 4, 1..=9999) && is_number(month, 2, 1..=12) && is_number(day, 2, 1..=31))
}

/// The line in normal form, with single spaces around its separators.
impl Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.subject {
            KnownSubject::Case(case) => case.fmt(f)?,
            KnownSubject::Rule(rule) => write!(f, "rule {}", rule.name())?,
        }
        let Some(Terms { expected, owner, until, reason, .. }) = &self.terms else { return Ok(()) };
        write!(f, " | {expected} | {owner} | {until} | {reason}")
    }
}

impl Known {
    /// Reads a baseline: lines, or a vector file of cases. When outputs are judged by a standard
    /// (`rules`), only rules and cases without an answer are kept; otherwise, only cases. `today`
    /// is a date such as `2027-06-30`.
    ///
    /// # Errors
    /// - A line is malformed.
    /// - A subject is on two lines, and at least one of them has terms.
    /// - The file has neither a line nor a remark.
    pub fn read(
        name: &str,
        reader: impl BufRead,
        rules: Option<Specification>,
        today: &str,
    ) -> Result<Self, VectorError> {
        let mut cases = Cases::maybe_empty(name, reader)?;
        let mut known = Self { file: name.to_owned(), ..Self::default() };
        let of_record = |case| Entry::new(KnownSubject::Case(case), 0, None);
        while let Some(entry) = cases.read(of_record, |text, line| {
            let entry = Entry::parse(text, line, today)?;
            let first = known.places.get(&entry.subject).map(|&place| &known.entries[place]);
            match first.filter(|first| first.terms.is_some() || entry.terms.is_some()) {
                Some(first) => {
                    let message = format!("is also on line {}", first.line);
                    Err(CaseError { field: "subject", message })
                }
                None => Ok(entry),
            }
        })? {
            // Without terms, a repeated case counts once.
            let next = known.entries.len();
            if *known.places.entry(entry.subject).or_insert(next) == next {
                known.entries.push(entry);
            }
        }
        known.entries.retain(|entry| entry.is_for(rules));
        let subjects = known.entries.iter().map(|entry| entry.subject);
        known.places = subjects.zip(0..).collect();
        Ok(known)
    }

    /// Notes how a case differs, if it does. Returns true if it differs and may.
    pub fn excuses(&self, case: &Case, difference: Option<&dyn Display>) -> bool {
        self.note(KnownSubject::Case(*case), difference)
    }

    /// Notes how often a rule is broken. Returns true if it is broken and may be, this often.
    pub fn excuses_rule(&self, rule: Rule, broken: u64) -> bool {
        self.note(KnownSubject::Rule(rule), (broken > 0).then_some(&broken as _))
    }

    fn note(&self, subject: KnownSubject, difference: Option<&dyn Display>) -> bool {
        self.places.get(&subject).is_some_and(|&place| self.entries[place].excuses(difference))
    }

    /// The lines in normal form, without remarks.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        self.entries.iter().map(ToString::to_string)
    }

    /// The outcome of the lines. `whole` says that all the work was done: then a line with terms
    /// also counts as unused if its subject was not compared.
    #[must_use]
    pub fn outcome(&self, whole: bool) -> KnownOutcome {
        let KnownOutcome { mut met, mut gone, mut faults } = KnownOutcome::default();
        for entry in &self.entries {
            let is = |flag: &AtomicBool| flag.load(Ordering::Relaxed);
            met += u64::from(is(&entry.different));
            match &entry.terms {
                Some(terms) => faults.extend(
                    entry
                        .fault(terms, whole)
                        .map(|fault| format!("{}:{}: {fault}: {entry}", self.file, entry.line)),
                ),
                None if is(&entry.equal) && !is(&entry.different) => gone.push(entry.to_string()),
                None => {}
            }
        }
        KnownOutcome { met, gone, faults }
    }
}

/// The outcome of a baseline's lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct KnownOutcome {
    /// The number of lines that were met: something differed as they expect.
    pub met: u64,
    /// The lines without terms whose cases were compared and no longer differ.
    pub gone: Vec<String>,
    /// The lines with terms that have expired, or whose expectation was not met; each with its
    /// place and the reason.
    pub faults: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_of_digits() {
        assert!(["2027-06-30", "0001-01-01", "9999-12-31"].iter().all(|text| is_date(text)));
        let none = [
            "",
            "2027-6-30",
            "2027-13-01",
            "2027-06-32",
            "2027-06-00",
            "+027-06-30",
            "2027-+6-30",
            "2027-06-3O",
        ];
        assert!(!none.iter().any(|text| is_date(text)));
    }

    #[test]
    fn what_became_of_each_case() {
        let case = |factor: u32| -> Case {
            let line = format!("case isoline integer line ruler 3f800000 {factor:08x}");
            line.parse().expect("a case")
        };
        let [differs, gone, both, unasked, other] = [1, 2, 3, 4, 5].map(case);
        let text = [differs, both, gone, unasked, gone].map(|case| format!("{case}\n")).concat();
        let known = Known::read("known", text.as_bytes(), None, "").expect("a baseline");
        assert!(known.excuses(&differs, Some(&"so")), "it may differ");
        assert!(!known.excuses(&gone, None), "equal needs no excuse");
        assert!(!known.excuses(&both, None) && known.excuses(&both, Some(&1)), "asked twice");
        assert!(!known.excuses(&other, Some(&1)), "it may not differ");
        assert!(!known.excuses(&unasked, Some(&MISSING)), "that is to be said");
        assert_eq!(known.lines().count(), 4, "each case once");
        // A case that differed once is not gone, nor is one that was not compared. No line has
        // terms.
        let gone = vec![gone.to_string()];
        assert_eq!(known.outcome(true), KnownOutcome { met: 2, gone, faults: vec![] });
    }

    /// A line is valid through its last day.
    #[test]
    fn lines_end_after_their_last_day() {
        let case: Case = "case isoline integer line ruler 3f800000 40000000".parse().expect("one");
        let text = format!("{case} | * | ada | 2027-06-30 | rounds down\n");
        for (today, holds) in [("2027-06-29", true), ("2027-06-30", true), ("2027-07-01", false)] {
            let known = Known::read("known", text.as_bytes(), None, today).expect("a baseline");
            assert_eq!(known.excuses(&case, Some(&"so")), holds, "on {today}");
            let KnownOutcome { met, faults, .. } = known.outcome(true);
            assert_eq!((met, faults.len()), (u64::from(holds), usize::from(!holds)), "on {today}");
        }
    }
}
