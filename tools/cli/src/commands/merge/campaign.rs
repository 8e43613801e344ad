//! Which reports belong together, which shards they prove, and their sums.

use super::again::quoted;
use super::read::FoundReport;
use crate::campaign::report::{KnownCases, Report, ReportPart, RunState};
use crate::failure::Failure;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use tess_verify::cover::Coverage;

/// How many shards of a kind are shown by number.
pub(super) const SHOWN: usize = 100;

/// How many faults a file lists: a report may speak of more shards than there is memory for.
pub(super) const LISTED: usize = 1_000_000;

/// The reports of one campaign, and those that are of others.
#[derive(Debug)]
pub(super) struct Campaign {
    /// By shard; more than one where a shard is double.
    shards: BTreeMap<u64, Vec<FoundReport>>,
    /// Number of shards.
    pub(super) of: u64,
    /// Where a report of another campaign stands, and why it is one.
    pub(super) strangers: Vec<(String, String)>,
    /// The sums of all shards: cases, mismatches, also by stage and by part, and the time.
    pub(super) sum: Report,
}

/// A fault of a shard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ShardFault {
    /// It has no report.
    Missing,
    /// It did not come to its end; where that is said, and why.
    Unfinished(String, String),
    /// It has several reports, here.
    Double(String),
}

/// The entries that all reports of a campaign have in common, by name, in words that are equal only if they are; the
/// options are left out.
fn identity(report: &Report) -> [(&'static str, String); 6] {
    let Report { version, commit, executable, command, seed, shards, known, .. } = report;
    // A build of changed or unknown sources is known by its file alone.
    let is_sure = commit != "unknown" && !commit.ends_with("+changes");
    let file = executable.as_ref().filter(|_| !is_sure);
    let file = file.map(|digest| format!(" (file {digest})")).unwrap_or_default();
    let baseline = if known.is_some() { "given" } else { "not given" };
    [
        ("the version", version.clone()),
        ("the commit", commit.clone() + &file),
        ("the command", command.clone()),
        ("the seed", seed.map_or("none".to_owned(), |seed| seed.to_string())),
        ("the number of shards", shards.to_string()),
        ("the baseline", baseline.to_owned()),
    ]
}

/// Options as words: each value with its name, so that `a,b` is not `a` and `b`.
pub(super) fn option_words(report: &Report) -> Vec<String> {
    let words = |(name, values): (&String, &Vec<String>)| {
        let words = values.iter().map(|value| format!("{name}={}", quoted(value)));
        words.collect::<Vec<_>>().join(" ")
    };
    report.options.iter().map(words).collect()
}

/// How a report differs from one of another campaign.
fn strangeness(report: &Report, usual: &FoundReport) -> String {
    let (own, other) = (identity(report), identity(&usual.report));
    let differing = own.into_iter().zip(other).find(|(own, other)| own != other);
    let (what, own, other) = match differing {
        Some(((what, own), (_, other))) => (what, own, other),
        None => {
            let (own, other) = (option_words(report), option_words(&usual.report));
            // Of options, only those that differ.
            let words = |of: &[String], than: &[String]| {
                let of: Vec<&str> =
                    of.iter().filter(|word| !than.contains(word)).map(String::as_str).collect();
                if of.is_empty() { "not given".to_owned() } else { of.join(" ") }
            };
            ("an option", words(&own, &other), words(&other, &own))
        }
    };
    format!("{what} is {own}; in {} it is {other}", usual.place)
}

/// The reports of the campaign that most of them are of, the first of several with as many; and the others, each
/// with why it is another. Both in the order of the reports.
fn largest(reports: Vec<FoundReport>) -> (Vec<FoundReport>, Vec<(String, String)>) {
    let of = |found: &FoundReport| (identity(&found.report), found.report.options.clone());
    let identities: Vec<_> = reports.iter().map(of).collect();
    let own = most(&identities);
    split(reports, |number, _| identities[number] == own, strangeness)
}

/// Those reports among them that have another baseline of the same name than most are of another campaign.
fn of_one_baseline(reports: Vec<FoundReport>) -> (Vec<FoundReport>, Vec<(String, String)>) {
    let of = |found: &FoundReport| {
        let known = found.report.known.clone()?;
        Some((known.file?, known.digest.unwrap_or_default()))
    };
    let mut by_name: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (name, digest) in reports.iter().filter_map(of) {
        by_name.entry(name).or_default().push(digest);
    }
    let usual: BTreeMap<&String, String> =
        by_name.iter().map(|(name, digests)| (name, most(digests))).collect();
    let is_usual =
        |_, found: &FoundReport| of(found).is_none_or(|(name, digest)| usual[&name] == digest);
    let why = |report: &Report, _: &FoundReport| {
        let known = report.known.clone().unwrap_or_default();
        let (name, digest) = (known.file.unwrap_or_default(), known.digest.unwrap_or_default());
        let usual = usual.get(&name).map(String::as_str).unwrap_or_default();
        format!(
            "the cases of {name} have the digest {digest}; most reports have {usual} for this name"
        )
    };
    split(reports, is_usual, why)
}

/// The item that occurs most often, the first of equals.
///
/// # Panics
/// There is nothing.
fn most<T: Ord + Clone>(all: &[T]) -> T {
    let mut counts: BTreeMap<&T, (usize, Reverse<usize>)> = BTreeMap::new();
    for (number, one) in all.iter().enumerate() {
        counts.entry(one).or_insert((0, Reverse(number))).0 += 1;
    }
    let most = counts.into_iter().max_by_key(|(_, rank)| *rank);
    most.map(|(one, _)| one.clone()).expect("there is one")
}

/// The reports that are the campaign's own, and where each other one stands with why it is none.
fn split(
    reports: Vec<FoundReport>,
    is_own: impl Fn(usize, &FoundReport) -> bool,
    why: impl Fn(&Report, &FoundReport) -> String,
) -> (Vec<FoundReport>, Vec<(String, String)>) {
    let (own, others): (Vec<_>, Vec<_>) =
        reports.into_iter().enumerate().partition(|(number, found)| is_own(*number, found));
    let own: Vec<FoundReport> = own.into_iter().map(|(_, found)| found).collect();
    let stranger =
        |(_, found): (usize, FoundReport)| (found.place.clone(), why(&found.report, &own[0]));
    let strangers = others.into_iter().map(stranger).collect();
    (own, strangers)
}

impl Campaign {
    /// The majority campaign; of several with as many reports, the first. Errors: no report.
    pub(super) fn of(reports: Vec<FoundReport>) -> Result<Self, Failure> {
        if reports.is_empty() {
            return Err(Failure::bad_input("there is no report to merge"));
        }
        let (own, mut strangers) = largest(reports);
        let (own, others) = of_one_baseline(own);
        strangers.extend(others);
        let of = own[0].report.shards;
        let mut shards: BTreeMap<u64, Vec<FoundReport>> = BTreeMap::new();
        for found in own {
            shards.entry(found.report.shard).or_default().push(found);
        }
        let mut campaign = Self { shards, of, strangers, sum: Report::default() };
        campaign.sum = campaign.added_up();
        Ok(campaign)
    }

    /// Every report of the campaign, by shard.
    pub(super) fn all(&self) -> impl Iterator<Item = &FoundReport> {
        self.shards.values().flatten()
    }

    /// One report of each shard that came to its end.
    pub(super) fn done(&self) -> impl Iterator<Item = &FoundReport> {
        let done = |one: &&FoundReport| one.report.state == RunState::Done;
        self.shards.values().filter_map(move |found| found.iter().find(done))
    }

    /// One report of each shard that ran once.
    pub(super) fn once(&self) -> impl Iterator<Item = &FoundReport> {
        self.shards.values().filter_map(|found| match &found[..] {
            [one] if one.report.state == RunState::Done => Some(one),
            _ => None,
        })
    }

    /// A report of a shard.
    pub(super) fn report_of(&self, shard: u64) -> Option<&Report> {
        self.shards.get(&shard)?.first().map(|one| &one.report)
    }

    /// The faults of the shards, in their order.
    pub(super) fn faults(&self) -> impl Iterator<Item = (u64, ShardFault)> {
        (1..=self.of).filter_map(|shard| Some((shard, self.fault(shard)?)))
    }

    fn fault(&self, shard: u64) -> Option<ShardFault> {
        let Some(found) = self.shards.get(&shard) else { return Some(ShardFault::Missing) };
        if let [_, _, ..] = &found[..] {
            let places: Vec<&str> = found.iter().map(|one| one.place.as_str()).collect();
            return Some(ShardFault::Double(places.join(", ")));
        }
        let one = &found[0];
        let why = match one.report.state {
            RunState::Done => return None,
            RunState::Interrupted => "was interrupted".to_owned(),
            RunState::Failed => {
                format!("failed: {}", one.report.message.as_deref().unwrap_or("nothing said why"))
            }
        };
        Some(ShardFault::Unfinished(one.place.clone(), why))
    }

    /// Whether every shard ran once, and some case was compared.
    pub(super) fn is_complete(&self) -> bool {
        self.strangers.is_empty() && self.faults().next().is_none() && self.sum.cases > 0
    }

    fn added_up(&self) -> Report {
        let mut sum = Report::default();
        for FoundReport { report, .. } in self.done() {
            for part in &report.parts {
                sum.add_to_part(&part.name, ReportPart { first: None, ..part.clone() });
            }
            sum.add_stages(report.stages.iter().map(|(stage, more)| (stage, *more)));
        }
        let total = |number: fn(&Report) -> u64| {
            self.done().map(|one| number(&one.report)).fold(0, u64::saturating_add)
        };
        // A report may have no parts.
        sum.cases = total(|report| report.cases);
        sum.mismatches = total(|report| report.mismatches);
        sum.milliseconds = total(|report| report.milliseconds);
        sum
    }

    /// How many different baselines there are, and what became of them in all shards; `None` if there was none.
    pub(super) fn known(&self) -> Option<(u64, KnownCases)> {
        let mut digests = BTreeSet::new();
        let mut sum = KnownCases::default();
        for known in self.done().filter_map(|one| one.report.known.as_ref()) {
            if digests.insert(&known.digest) {
                sum.entries = sum.entries.saturating_add(known.entries);
            }
            sum.different = sum.different.saturating_add(known.different);
            sum.gone.extend(known.gone.iter().cloned());
        }
        sum.gone.sort();
        sum.gone.dedup();
        (!digests.is_empty()).then_some((digests.len() as u64, sum))
    }

    /// The hits of all shards. Errors: a report without hits, or with those of other bins.
    pub(super) fn coverage(&self) -> Result<Coverage, Failure> {
        let mut sum = Coverage::default();
        for FoundReport { place, report } in self.done() {
            let hits = report.coverage.as_deref().unwrap_or_default();
            let bins: Vec<String> = sum.bins().map(|(bin, _)| bin.to_owned()).collect();
            if bins.len() != hits.len() {
                return Err(Failure::bad_input(format!(
                    "{place}: it has the hits of {} coverage bins, not of {}; run the shards with \
                     --coverage FILE",
                    hits.len(),
                    bins.len()
                )));
            }
            bins.iter().zip(hits).for_each(|(bin, &hits)| _ = sum.add(bin, hits));
        }
        Ok(sum)
    }
}
