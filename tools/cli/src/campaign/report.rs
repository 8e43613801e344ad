//! The report of one run: a line of JSON. docs/campaigns.md explains each entry.

use super::cases::{CaseSet, CaseSum};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The name and version of the report's format.
pub(crate) const FORMAT: &str = "tess-report 2";

/// The largest number of shards of a campaign. `tess merge` has an entry for each.
const MAX_SHARDS: u64 = 1_000_000;

/// A run of a command on one shard.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Report {
    /// [`FORMAT`].
    pub(crate) format: String,
    /// The version of the program.
    pub(crate) version: String,
    /// The commit of the program, possibly with `+changes`, or `unknown`.
    pub(crate) commit: String,
    /// The digest of the program's file.
    #[serde(default)]
    pub(crate) executable: Option<String>,
    /// The name of the command.
    pub(crate) command: String,
    /// The words of the command line; the first is the program's name.
    pub(crate) words: Vec<String>,
    /// The options that decide what is compared.
    pub(crate) options: BTreeMap<String, Vec<String>>,
    /// How the cases of all shards are made, if that is known.
    #[serde(default)]
    pub(crate) set: Option<CaseSet>,
    /// The cases that this run accounts for, if they are single ones.
    #[serde(default)]
    pub(crate) asked: Option<CaseSum>,
    /// The number of the shard, from 1.
    pub(crate) shard: u64,
    /// The number of shards.
    pub(crate) shards: u64,
    /// The option or variable that selected the shard.
    #[serde(default)]
    pub(crate) shard_from: Option<String>,
    /// How the run ended.
    pub(crate) state: RunState,
    /// The reason of a failure.
    #[serde(default)]
    pub(crate) message: Option<String>,
    pub(crate) cases: u64,
    pub(crate) mismatches: u64,
    /// Mismatches by the stage that they point to.
    #[serde(default)]
    pub(crate) stages: BTreeMap<String, u64>,
    #[serde(default)]
    pub(crate) first: Option<First>,
    /// The greatest common divisor of the distances between the records that differ.
    #[serde(default)]
    pub(crate) period: Option<u64>,
    /// The outcome of the baseline, if there is one.
    #[serde(default)]
    pub(crate) known: Option<KnownCases>,
    /// The same cases and mismatches, by part.
    #[serde(default)]
    pub(crate) parts: Vec<ReportPart>,
    pub(crate) milliseconds: u64,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RunState {
    /// Everything was compared.
    Done,
    /// It has not ended: it still goes on, or it was killed.
    Running,
    /// A signal ended it, or the reader of stdout left.
    #[default]
    Interrupted,
    /// The run could not do what was asked.
    Failed,
}

/// A difference.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct First {
    /// The case line, if a single patch shows the difference.
    pub(crate) case: Option<String>,
    /// The difference.
    pub(crate) difference: String,
    /// Whether the case is known to pass by itself.
    #[serde(default)]
    pub(crate) passes_alone: bool,
}

/// The explanation of a case that differs but passes by itself.
pub(crate) const PASSES_ALONE: &str = "passes alone: when it is repeated, or in another record, the same case is right, so earlier work matters";

/// The explanation of a period in the numbers of the records that differ.
pub(crate) fn period_text(period: u64) -> String {
    format!("the numbers of all records that differ are multiples of {period} apart")
}

impl First {
    /// The case, the difference, and whether the case passes by itself, separated by `between`.
    pub(crate) fn text(&self, between: &str) -> String {
        let Self { case, difference, passes_alone } = self;
        let alone = passes_alone.then_some(PASSES_ALONE);
        let parts = [case.as_deref(), Some(difference), alone].into_iter().flatten();
        parts.collect::<Vec<_>>().join(between)
    }
}

/// The baseline, and the outcome of the known differences.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct KnownCases {
    /// The file's name on the command line.
    #[serde(default)]
    pub(crate) file: Option<String>,
    /// The digest of its lines, in alphabetical order.
    #[serde(default)]
    pub(crate) digest: Option<String>,
    /// The number of lines.
    pub(crate) entries: u64,
    /// The number of lines that were met.
    pub(crate) different: u64,
    /// The lines whose cases were compared and no longer differ.
    pub(crate) gone: Vec<String>,
}

/// Some of the cases, under a name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReportPart {
    pub(crate) name: String,
    pub(crate) cases: u64,
    pub(crate) mismatches: u64,
    #[serde(default)]
    pub(crate) first: Option<First>,
}

impl Report {
    /// Adds to the part with this name, which may be new, and to the report's own sums. They
    /// saturate, because another program's report may hold any numbers.
    pub(crate) fn add_part(&mut self, more: ReportPart) {
        self.cases = self.cases.saturating_add(more.cases);
        self.mismatches = self.mismatches.saturating_add(more.mismatches);
        if self.first.is_none() {
            self.first.clone_from(&more.first);
        }
        match self.parts.iter_mut().find(|part| part.name == more.name) {
            Some(part) => {
                part.cases = part.cases.saturating_add(more.cases);
                part.mismatches = part.mismatches.saturating_add(more.mismatches);
                part.first = part.first.take().or(more.first);
            }
            None => self.parts.push(more),
        }
    }

    /// Adds mismatches by stage.
    pub(crate) fn add_stages<S: ToString>(&mut self, stages: impl IntoIterator<Item = (S, u64)>) {
        for (stage, more) in stages {
            let stage = self.stages.entry(stage.to_string()).or_default();
            *stage = stage.saturating_add(more);
        }
    }

    /// The report as a line of JSON.
    ///
    /// # Panics
    /// Never: the keys of its maps are text.
    pub(crate) fn line(&self) -> String {
        serde_json::to_string(self).expect("keys are text") + "\n"
    }

    /// Parses a report from a line. Errors, in words: the line is not a report of this format, or
    /// contradicts itself.
    pub(crate) fn parse(line: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct FormatOnly {
            format: String,
        }
        let form: FormatOnly =
            serde_json::from_str(line).map_err(|error| format!("no report: {error}"))?;
        if form.format != FORMAT {
            let format = form.format.escape_debug();
            return Err(format!("the format is `{format}`, this program reads `{FORMAT}`"));
        }
        let report: Self = serde_json::from_str(line).map_err(|error| error.to_string())?;
        report.contradiction().map_or(Ok(report), Err)
    }

    fn contradiction(&self) -> Option<String> {
        let Self { shard, shards, cases, mismatches, .. } = self;
        if *shard == 0 || shard > shards {
            return Some(format!("shard {shard} of {shards}: shards are counted from 1"));
        }
        if *shards > MAX_SHARDS {
            return Some(format!("{shards} shards: a campaign has at most {MAX_SHARDS}"));
        }
        if mismatches > cases && self.command != "check" {
            return Some(format!("{mismatches} mismatches of {cases} cases"));
        }
        let sum = |number: fn(&ReportPart) -> u64| {
            self.parts.iter().map(number).fold(0, u64::saturating_add)
        };
        let (of_cases, of_mismatches) = (sum(|part| part.cases), sum(|part| part.mismatches));
        let is_sum = (of_cases, of_mismatches) == (*cases, *mismatches);
        (!self.parts.is_empty() && !is_sum).then(|| {
            format!(
                "{cases} cases and {mismatches} mismatches, but the parts add up to {of_cases} and \
                 {of_mismatches}"
            )
        })
    }
}
