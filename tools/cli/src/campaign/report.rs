//! The report of one run: a line of JSON. docs/campaigns.md explains each entry.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The name of a report's form.
pub(crate) const FORMAT: &str = "tess-report 1";

/// One run of a command on one shard.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Report {
    /// [`FORMAT`].
    pub(crate) format: String,
    /// Version of the program.
    pub(crate) version: String,
    /// Commit of the program, perhaps with `+changes`, or `unknown`.
    pub(crate) commit: String,
    /// Digest of the program's file.
    #[serde(default)]
    pub(crate) executable: Option<String>,
    /// Name of the command.
    pub(crate) command: String,
    /// The words of the command line, the program first.
    pub(crate) words: Vec<String>,
    /// The options that decide what is compared.
    pub(crate) options: BTreeMap<String, Vec<String>>,
    #[serde(default)]
    pub(crate) seed: Option<u64>,
    /// Number of the shard, from 1.
    pub(crate) shard: u64,
    /// Number of shards.
    pub(crate) shards: u64,
    /// The option or variable that says the shard.
    #[serde(default)]
    pub(crate) shard_from: Option<String>,
    /// How the run ended.
    pub(crate) state: RunState,
    /// Why it failed.
    #[serde(default)]
    pub(crate) message: Option<String>,
    pub(crate) cases: u64,
    pub(crate) mismatches: u64,
    /// Mismatches by the stage that they point to.
    #[serde(default)]
    pub(crate) stages: BTreeMap<String, u64>,
    #[serde(default)]
    pub(crate) first: Option<First>,
    /// The distance whose multiples lie between the numbers of all records that differ.
    #[serde(default)]
    pub(crate) period: Option<u64>,
    /// The fate of the baseline, if there is one.
    #[serde(default)]
    pub(crate) known: Option<KnownCases>,
    /// The cases and mismatches again, in parts.
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
    /// A signal ended it, or the reader of stdout left.
    #[default]
    Interrupted,
    /// It could not do what it was asked for.
    Failed,
}

/// A difference.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct First {
    /// The case line, if one patch shows it.
    pub(crate) case: Option<String>,
    /// The difference.
    pub(crate) difference: String,
    /// Whether the case is known to be right by itself.
    #[serde(default)]
    pub(crate) passes_alone: bool,
}

/// The words on a case that differs and passes alone.
pub(crate) const PASSES_ALONE: &str = "passes alone: asked again, or in another record, the same case is right, so what came before matters";

/// The words on the numbers of all records that differ.
pub(crate) fn period_text(period: u64) -> String {
    format!("the numbers of all records that differ are multiples of {period} apart")
}

impl First {
    /// The case, the difference, and whether it passes alone, with this between them.
    pub(crate) fn text(&self, between: &str) -> String {
        let Self { case, difference, passes_alone } = self;
        let alone = passes_alone.then_some(PASSES_ALONE);
        let parts = [case.as_deref(), Some(difference), alone].into_iter().flatten();
        parts.collect::<Vec<_>>().join(between)
    }
}

/// The baseline, and what became of the known differences.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct KnownCases {
    /// The file, as the command line names it.
    #[serde(default)]
    pub(crate) file: Option<String>,
    /// Digest of its cases, in alphabetical order.
    #[serde(default)]
    pub(crate) digest: Option<String>,
    /// How many cases may differ.
    pub(crate) entries: u64,
    /// How many of them differed.
    pub(crate) different: u64,
    /// The lines of those that were asked and no longer differ.
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
    /// Adds parts to the report and to its sums.
    pub(crate) fn add_parts(&mut self, parts: impl IntoIterator<Item = ReportPart>) {
        for part in parts {
            self.add(&part);
            if self.first.is_none() {
                self.first.clone_from(&part.first);
            }
            self.parts.push(part);
        }
    }

    /// Adds to the sums. A report of others may be at their end.
    fn add(&mut self, part: &ReportPart) {
        self.cases = self.cases.saturating_add(part.cases);
        self.mismatches = self.mismatches.saturating_add(part.mismatches);
    }

    /// Adds to the part of this name and to the sums.
    pub(crate) fn add_to_part(&mut self, name: &str, more: ReportPart) {
        self.add(&more);
        let known = self.parts.iter_mut().find(|part| part.name == name);
        match known {
            Some(part) => {
                part.cases = part.cases.saturating_add(more.cases);
                part.mismatches = part.mismatches.saturating_add(more.mismatches);
                part.first = part.first.take().or(more.first);
            }
            None => self.parts.push(ReportPart { name: name.to_owned(), ..more }),
        }
    }

    /// Adds mismatches of stages.
    pub(crate) fn add_stages<S: ToString>(&mut self, stages: impl IntoIterator<Item = (S, u64)>) {
        for (stage, more) in stages {
            let stage = self.stages.entry(stage.to_string()).or_default();
            *stage = stage.saturating_add(more);
        }
    }

    /// The report as a line.
    ///
    /// # Panics
    /// Never: the keys of its maps are text.
    pub(crate) fn line(&self) -> String {
        serde_json::to_string(self).expect("keys are text") + "\n"
    }

    /// The report of a line. Errors: it is no report of this form, or contradicts itself; why.
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
        if mismatches > cases && self.command != "check" {
            return Some(format!("{mismatches} mismatches of {cases} cases"));
        }
        let sum = |number: fn(&ReportPart) -> u64| {
            self.parts.iter().map(number).fold(0, u64::saturating_add)
        };
        let sums = (sum(|part| part.cases), sum(|part| part.mismatches));
        (!self.parts.is_empty() && sums != (*cases, *mismatches)).then(|| {
            let (of_cases, of_mismatches) = sums;
            format!(
                "{cases} cases and {mismatches} mismatches, but the parts add up to {of_cases} and \
                 {of_mismatches}"
            )
        })
    }
}
