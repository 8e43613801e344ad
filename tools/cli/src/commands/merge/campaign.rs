//! Determines which reports belong together, which shards they prove, and their sums.

use super::read::FoundReport;
use crate::campaign::report::{KnownCases, Report, ReportPart, RunState};
use crate::failure::Failure;
use std::collections::{BTreeMap, BTreeSet};

/// The reports of one campaign, and those of others.
#[derive(Debug)]
pub(super) struct Campaign {
    /// By shard; a shard that ran several times has several.
    shards: BTreeMap<u64, Vec<FoundReport>>,
    /// The number of shards.
    pub(super) of: u64,
    /// The place of each report of another campaign, and how it differs from the first report.
    pub(super) strangers: Vec<(String, String)>,
    /// The sums over all shards that ended: cases and mismatches, also by stage and by part, and
    /// the time.
    pub(super) sum: Report,
}

/// A shard that is not proved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ShardFault {
    pub(super) shard: u64,
    /// For example `is missing`.
    pub(super) what: String,
    /// The places of its reports.
    pub(super) places: String,
}

/// Everything in which the reports of a campaign must agree, by name.
fn identity(report: &Report) -> BTreeMap<String, String> {
    let Report { version, commit, executable, command, seed, shards, known, options, .. } = report;
    // A build from changed or unknown sources is identified only by its file.
    let is_sure = commit != "unknown" && !commit.ends_with("+changes");
    let file = executable.as_ref().filter(|_| !is_sure);
    let file = file.map(|digest| format!(" (file {digest})")).unwrap_or_default();
    let baseline = if known.is_some() { "given" } else { "not given" };
    let own = [
        ("the version", version.clone()),
        ("the commit", commit.clone() + &file),
        ("the command", command.clone()),
        ("the seed", seed.map_or("none".to_owned(), |seed| seed.to_string())),
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

impl Campaign {
    /// The campaign to which the first report belongs.
    ///
    /// # Errors
    /// There are no reports.
    pub(super) fn of(reports: Vec<FoundReport>) -> Result<Self, Failure> {
        let mut reports = reports.into_iter();
        let Some(first) = reports.next() else {
            return Err(Failure::bad_input("there is no report to merge"));
        };
        let (mut strangers, mut own) = (Vec::new(), Vec::new());
        let mut baselines = BTreeMap::new();
        other_baseline(&mut baselines, &first);
        let usual = identity(&first.report);
        for found in reports {
            let why = strangeness(&found.report, &usual, &first.place)
                .or_else(|| other_baseline(&mut baselines, &found));
            match why {
                Some(why) => strangers.push((found.place, why)),
                None => own.push(found),
            }
        }
        let of = first.report.shards;
        let mut shards: BTreeMap<u64, Vec<FoundReport>> = BTreeMap::new();
        for found in std::iter::once(first).chain(own) {
            shards.entry(found.report.shard).or_default().push(found);
        }
        let mut campaign = Self { shards, of, strangers, sum: Report::default() };
        campaign.sum = campaign.added_up();
        Ok(campaign)
    }

    /// Any report of the campaign.
    pub(super) fn sample(&self) -> Option<&Report> {
        self.shards.values().flatten().next().map(|one| &one.report)
    }

    /// One report of each shard that ended.
    pub(super) fn done(&self) -> impl Iterator<Item = &FoundReport> {
        let done = |one: &&FoundReport| one.report.state == RunState::Done;
        self.shards.values().filter_map(move |found| found.iter().find(done))
    }

    /// The report of each shard that ran exactly once and ended.
    pub(super) fn once(&self) -> impl Iterator<Item = &FoundReport> {
        self.done().filter(|one| self.shards[&one.report.shard].len() == 1)
    }

    /// The faults of the shards, in the order of the shards.
    pub(super) fn faults(&self) -> impl Iterator<Item = ShardFault> {
        (1..=self.of).filter_map(|shard| self.fault(shard))
    }

    fn fault(&self, shard: u64) -> Option<ShardFault> {
        let found = self.shards.get(&shard).map_or(&[][..], Vec::as_slice);
        let what = match found {
            [] => "is missing".to_owned(),
            [one] => match one.report.state {
                RunState::Done => return None,
                RunState::Interrupted => "was interrupted".to_owned(),
                RunState::Failed => {
                    let why = one.report.message.as_deref();
                    format!("failed: {}", why.unwrap_or("for an unknown reason"))
                }
            },
            _ => "is duplicated".to_owned(),
        };
        let places: Vec<&str> = found.iter().map(|one| one.place.as_str()).collect();
        Some(ShardFault { shard, what, places: places.join(", ") })
    }

    /// Whether every shard ran exactly once, and at least one case was compared.
    pub(super) fn is_complete(&self) -> bool {
        self.strangers.is_empty() && self.faults().next().is_none() && self.sum.cases > 0
    }

    fn added_up(&self) -> Report {
        let mut sum = Report::default();
        let mut parts: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
        for FoundReport { report, .. } in self.done() {
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
        let part = |(name, (cases, mismatches)): (&str, _)| ReportPart {
            name: name.to_owned(),
            cases,
            mismatches,
            first: None,
        };
        sum.parts = parts.into_iter().map(part).collect();
        sum
    }

    /// The number of different baselines, and their outcome in all shards; `None` if there was no
    /// baseline.
    pub(super) fn known(&self) -> Option<(u64, KnownCases)> {
        let mut digests = BTreeSet::new();
        let mut gone = BTreeSet::new();
        let mut sum = KnownCases::default();
        for known in self.done().filter_map(|one| one.report.known.as_ref()) {
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

/// How the baseline of a report differs from an earlier one of the same name; `None` if it does
/// not.
fn other_baseline(
    baselines: &mut BTreeMap<String, Option<String>>,
    FoundReport { report, .. }: &FoundReport,
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
