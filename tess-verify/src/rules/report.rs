//! The report on the rules of one standard.

use super::Judgement;
use super::asked::Asked;
use super::rule::{Row, Rule};
use super::standard::Specification;
use crate::case::Case;
use crate::names::{Named, named};
use std::fmt;

named! {
    /// The result of a rule.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Verdict: "verdict" {
        /// Every judged patch or pair meets the demand, and all levels were asked that can show a
        /// fault.
        Held = "held",
        /// Every judged patch or pair meets the demand, and some levels were not asked.
        HeldAsFarAsAsked = "held as far as asked",
        /// Some judged patches or pairs do not.
        Broken = "broken",
        /// No patch or pair could show a fault.
        NotExercised = "not exercised",
    }
}

/// The smallest example that breaks a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Example {
    /// The patch or the two patches that show it; each prints as a line that can be run again.
    pub cases: Vec<Case>,
    /// A description of the fault.
    pub what: String,
}

/// A rule and its judgements.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct RuleRow {
    /// The rule.
    pub rule: Rule,
    /// The section of the standard that states it, by number and title.
    pub source: &'static str,
    /// The number of judgements: of patches, or of pairs of a patch and an earlier one.
    pub judged: u64,
    /// The number of judgements that found it broken.
    pub broken: u64,
    /// The levels that the judgements were about.
    pub asked: Asked,
    /// The broken example with the fewest vertices; the first one, if several have as few.
    pub smallest: Option<Example>,
}

impl RuleRow {
    /// The rule's verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match (self.judged, self.broken) {
            (0, _) => Verdict::NotExercised,
            (_, 0) if self.asked.is_complete() => Verdict::Held,
            (_, 0) => Verdict::HeldAsFarAsAsked,
            _ => Verdict::Broken,
        }
    }
}

/// The verdicts of all rules of one standard.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RulesReport {
    /// The standard.
    pub specification: Specification,
    /// The number of judged patches.
    pub patches: u64,
    /// The rules that the standard states, in the order of [`Rule`].
    pub rows: Vec<RuleRow>,
}

impl RulesReport {
    /// The number of rules with this verdict.
    fn count(&self, verdict: Verdict) -> usize {
        self.rows.iter().filter(|row| row.verdict() == verdict).count()
    }
}

/// A table of the rules: verdict, broken judgements of all, levels asked of those that can show a
/// fault, and source. Below a rule that is held as far as asked, what was not asked; below a broken
/// one, the smallest example. A summary line ends it.
impl fmt::Display for RulesReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for row in &self.rows {
            let (rule, verdict) = (row.rule.name(), row.verdict());
            let RuleRow { source, judged, broken, asked, .. } = row;
            let (name, [levels, wanted]) = (verdict.name(), asked.levels());
            write!(f, "{rule:<13} {name:<20} {broken:>7} of {judged:>8}")?;
            writeln!(f, "  {levels:>5} of {wanted:>5} levels  {source}")?;
            if verdict == Verdict::HeldAsFarAsAsked {
                writeln!(f, "  not asked: {asked}")?;
            }
            if let Some(example) = &row.smallest {
                writeln!(f, "  {}", example.what)?;
                example.cases.iter().try_for_each(|case| writeln!(f, "  {case}"))?;
            }
        }
        let [held, partly, broken, not] =
            [Verdict::Held, Verdict::HeldAsFarAsAsked, Verdict::Broken, Verdict::NotExercised]
                .map(|verdict| self.count(verdict));
        let (patches, name) = (self.patches, self.specification.name());
        writeln!(
            f,
            "{patches} patches, {name}: {held} rules held, {partly} held as far as asked, \
             {broken} broken, {not} not exercised"
        )
    }
}

/// The judgements of one rule so far.
#[derive(Debug)]
pub(super) struct Tally {
    row: RuleRow,
    /// The number of vertices of the smallest example.
    size: usize,
}

impl Tally {
    pub(super) fn new(row: &Row, specification: Specification) -> Option<Self> {
        let (rule, source) = (row.rule, row.source(specification)?);
        let asked = Asked::new(rule, specification);
        let row = RuleRow { rule, source, judged: 0, broken: 0, asked, smallest: None };
        Some(Self { row, size: usize::MAX })
    }

    pub(super) fn row(&self) -> RuleRow {
        self.row.clone()
    }

    pub(super) const fn rule(&self) -> Rule {
        self.row.rule
    }

    pub(super) const fn broken(&self) -> u64 {
        self.row.broken
    }

    /// Counts a judgement of a case with `size` vertices, and of an earlier case if there is one.
    pub(super) fn add(&mut self, case: &Case, size: usize, judgement: Judgement) {
        let Judgement { other, positions, result } = judgement;
        self.row.judged += 1;
        self.row.asked.add(case, positions);
        let Err(what) = result else { return };
        self.row.broken += 1;
        if size < self.size {
            self.size = size;
            let cases = other.into_iter().chain([*case]).collect();
            self.row.smallest = Some(Example { cases, what });
        }
    }
}
