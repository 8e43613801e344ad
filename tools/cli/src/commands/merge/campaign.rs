//! Determines which reports belong together, which shards they prove, and their sums.

use super::read::FoundReport;
use crate::campaign::report::{KnownCases, Report, ReportPart, RunState};
use crate::failure::Failure;
use std::collections::{BTreeMap, BTreeSet};

/// The reports of one campaign, and those of others.
#[derive(Debug)]
pub(super) struct Campaign {
    /// The first report, with which all others must agree.
    pub(super) sample: Report,
    /// Every shard by its number, from 1. It is proved by a single report, of a run that ended.
    pub(super) shards: BTreeMap<u64, ShardReports>,
    /// The place of each report of another campaign, and how it differs from the first report.
    pub(super) strangers: Vec<(String, String)>,
    /// The sums over all shards that ended: cases and mismatches, also by stage and by part, and
    /// the time.
    pub(super) sum: Report,
}

/// The reports of a shard.
#[derive(Clone, Debug, Default)]
pub(super) struct ShardReports(Vec<FoundReport>);

/// Everything in which the reports of a campaign must agree, by name.
fn identity(report: &Report) -> BTreeMap<String, String> {
    let Report { version, commit, executable, command, shards, known, options, .. } = report;
    // A build from changed or unknown sources is identified only by its file.
    let is_sure = commit != "unknown" && !commit.ends_with("+changes");
    let file = executable.as_ref().filter(|_| !is_sure);
    let file = file.map(|digest| format!(" (file {digest})")).unwrap_or_default();
    let baseline = if known.is_some() { "given" } else { "not given" };
    let own = [
        ("the version", version.clone()),
        ("the commit", commit.clone() + &file),
        ("the command", command.clone()),
        ("the number of shards", shards.to_string()),
        ("the baseline", baseline.to_owned()),
    ];
    let own = own.map(|(name, value)| (name.to_owned(), value));
    // The values are printed as lists, so that "a,b" differs from "a" and "b".
    let options = options.iter().map(|(name, values)| (option(name), format!("{values:?}")));
    own.into_iter().chain(options).collect()
}

fn option(name: &str) -> String {
    format!("the option {name}")
}

/// How a report differs from the `usual` identity, which is that of the report at `place`; `None`
/// if it does not.
fn strangeness(report: &Report, usual: &BTreeMap<String, String>, place: &str) -> Option<String> {
    let own = identity(report);
    let mut names = usual.keys().chain(own.keys());
    let name = names.find(|name| own.get(*name) != usual.get(*name))?;
    let [own, usual] = [&own, usual].map(|of| of.get(name).map_or("not given", String::as_str));
    Some(format!("{name} is {own}; in {place} it is {usual}"))
}

impl ShardReports {
    /// The report, if it proves the shard. Errors: why it does not, such as `is missing`.
    pub(super) fn proof(&self) -> Result<&FoundReport, String> {
        let [one] = &*self.0 else {
            return Err(if self.0.is_empty() { "is missing" } else { "is duplicated" }.to_owned());
        };
        match one.report.state {
            RunState::Done => Ok(one),
            RunState::Running => Err("has not ended: it still runs, or was killed".to_owned()),
            RunState::Interrupted => Err("was interrupted".to_owned()),
            RunState::Failed => {
                let why = one.report.message.as_deref().unwrap_or("for an unknown reason");
                Err(format!("failed: {why}"))
            }
        }
    }

    /// The places of its reports.
    pub(super) fn places(&self) -> String {
        self.0.iter().map(|one| &*one.place).collect::<Vec<_>>().join(", ")
    }

    /// A report of a run that ended.
    pub(super) fn ended(&self) -> Option<&FoundReport> {
        self.0.iter().find(|one| one.report.state == RunState::Done)
    }
}

impl Campaign {
    /// The campaign to which the first report belongs.
    ///
    /// # Errors
    /// There are no reports.
    pub(super) fn of(reports: Vec<FoundReport>) -> Result<Self, Failure> {
        let Some(FoundReport { place, report: sample }) = reports.first().cloned() else {
            return Err(Failure::bad_input("there is no report to merge"));
        };
        let usual = identity(&sample);
        let mut shards: BTreeMap<u64, ShardReports> =
            (1..=sample.shards).map(|number| (number, ShardReports::default())).collect();
        let mut strangers = Vec::new();
        let mut baselines = BTreeMap::new();
        for found in reports {
            let why = strangeness(&found.report, &usual, &place)
                .or_else(|| other_baseline(&mut baselines, &found.report));
            match why {
                Some(why) => strangers.push((found.place, why)),
                None => shards.entry(found.report.shard).or_default().0.push(found),
            }
        }
        let sum = added_up(shards.values().filter_map(ShardReports::ended).map(|one| &one.report));
        Ok(Self { sample, shards, strangers, sum })
    }

    /// Whether every shard ran exactly once, and at least one case was compared.
    pub(super) fn is_complete(&self) -> bool {
        let all = self.shards.values().all(|shard| shard.proof().is_ok());
        all && self.strangers.is_empty() && self.sum.cases > 0
    }

    /// The number of different baselines, and their outcome in all shards; `None` if there was no
    /// baseline.
    pub(super) fn known(&self) -> Option<(u64, KnownCases)> {
        let mut digests = BTreeSet::new();
        let mut gone = BTreeSet::new();
        let mut sum = KnownCases::default();
        let ended = self.shards.values().filter_map(ShardReports::ended);
        for known in ended.filter_map(|one| one.report.known.as_ref()) {
            if digests.insert(&known.digest) {
                sum.entries = sum.entries.saturating_add(known.entries);
            }
            sum.different = sum.different.saturating_add(known.different);
            gone.extend(&known.gone);
        }
        sum.gone = gone.into_iter().cloned().collect();
        (!digests.is_empty()).then_some((digests.len() as u64, sum))
    }
}

fn added_up<'a>(reports: impl Iterator<Item = &'a Report>) -> Report {
    let mut sum = Report::default();
    let mut parts: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
    for report in reports {
        // Sums saturate instead of wrapping around.
        sum.cases = sum.cases.saturating_add(report.cases);
        sum.mismatches = sum.mismatches.saturating_add(report.mismatches);
        sum.milliseconds = sum.milliseconds.saturating_add(report.milliseconds);
        sum.add_stages(report.stages.iter().map(|(stage, more)| (stage, *more)));
        for part in &report.parts {
            let (cases, mismatches) = parts.entry(&part.name).or_default();
            *cases = cases.saturating_add(part.cases);
            *mismatches = mismatches.saturating_add(part.mismatches);
        }
    }
    let parts = parts.into_iter().map(|(name, (cases, mismatches))| ReportPart {
        name: name.to_owned(),
        cases,
        mismatches,
        first: None,
    });
    Report { parts: parts.collect(), ..sum }
}

/// How the baseline of a report differs from an earlier one of the same name; `None` if it does
/// not.
fn other_baseline(
    baselines: &mut BTreeMap<String, Option<String>>,
    report: &Report,
) -> Option<String> {
    let KnownCases { file, digest, .. } = report.known.clone()?;
    let file = file?;
    let usual = baselines.entry(file.clone()).or_insert_with(|| digest.clone());
    let shown = |digest: &Option<String>| digest.clone().unwrap_or_default();
    (*usual != digest).then(|| {
        let (own, usual) = (shown(&digest), shown(usual));
        format!("the lines of {file} have the digest {own}; elsewhere it is {usual}")
    })
}
