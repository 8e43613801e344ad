//! Which reports belong together, which shards they prove, and their sums.

use super::read::Found;
use crate::campaign::report::{Baseline, Part, Report, State};
use crate::failure::Failure;
use std::collections::BTreeMap;
use tess_verify::coverage::Coverage;

/// How many shards of a kind are shown by number.
pub(super) const SHOWN: usize = 100;

/// The reports of one campaign, and those that are of others.
#[derive(Debug)]
pub(super) struct Campaign {
    /// By shard; more than one where a shard is double.
    shards: BTreeMap<u64, Vec<Found>>,
    /// Number of shards.
    pub(super) of: u64,
    /// Where a report of another campaign stands, and why it is one.
    pub(super) strangers: Vec<(String, String)>,
}

/// What is wrong with a shard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// It has no report.
    Missing,
    /// It did not come to its end; where that is said, and why.
    Unfinished(String, String),
    /// It has several reports, here.
    Double(String),
}

/// What all reports of a campaign have in common, by name.
fn identity(report: &Report) -> [(&'static str, String); 6] {
    // A build of changed or unknown sources is known by its file alone.
    let is_sure = report.commit != "unknown" && !report.commit.ends_with("+changes");
    let executable = if is_sure { None } else { report.executable.as_ref() };
    let executable = executable.map(|digest| format!(" (file {digest})")).unwrap_or_default();
    let options =
        report.options.iter().map(|(name, values)| format!("{name}={}", values.join(",")));
    [
        ("the version", report.version.clone()),
        ("the commit", format!("{}{executable}", report.commit)),
        ("the command", report.command.clone()),
        ("the seed", report.seed.map_or("none".to_owned(), |seed| seed.to_string())),
        ("the number of shards", report.shards.to_string()),
        ("an option", options.collect::<Vec<_>>().join(" ")),
    ]
}

/// How a report differs from one of another campaign.
fn strangeness(report: &Report, usual: &Found) -> String {
    let pairs = identity(report).into_iter().zip(identity(&usual.report));
    let differing = pairs.into_iter().find(|(own, other)| own != other);
    let Some(((what, own), (_, other))) = differing else { return String::new() };
    // Of options, only those that differ.
    let words = |text: &str, than: &str| {
        let than: Vec<&str> = than.split(' ').collect();
        let own: Vec<&str> = text.split(' ').filter(|word| !than.contains(word)).collect();
        if own.is_empty() { "not given".to_owned() } else { own.join(" ") }
    };
    let (own, other) = match what {
        "an option" => (words(&own, &other), words(&other, &own)),
        _ => (own, other),
    };
    format!("{what} is {own}; in {} it is {other}", usual.place)
}

impl Campaign {
    /// The majority campaign; of several with as many reports, the first.
    ///
    /// # Errors
    /// No report.
    pub(super) fn of(reports: Vec<Found>) -> Result<Self, Failure> {
        let mut groups: Vec<Vec<Found>> = Vec::new();
        let mut known = BTreeMap::new();
        for found in reports {
            let next = groups.len();
            let group = *known.entry(identity(&found.report)).or_insert(next);
            if group == next {
                groups.push(Vec::new());
            }
            groups[group].push(found);
        }
        // The last of equals is taken, so they are looked at from the end.
        let largest = groups.iter().enumerate().rev().max_by_key(|(_, group)| group.len());
        let Some((number, _)) = largest else {
            return Err(Failure::bad_input("there is no report to merge"));
        };
        let own = groups.remove(number);
        let others = groups.into_iter().flatten();
        let strangers = others.map(|one| (one.place, strangeness(&one.report, &own[0]))).collect();
        let of = own[0].report.shards;
        let mut shards: BTreeMap<u64, Vec<Found>> = BTreeMap::new();
        for found in own {
            shards.entry(found.report.shard).or_default().push(found);
        }
        Ok(Self { shards, of, strangers })
    }

    /// Every report of the campaign, by shard.
    pub(super) fn all(&self) -> impl Iterator<Item = &Found> {
        self.shards.values().flatten()
    }

    /// One report of each shard that came to its end.
    pub(super) fn done(&self) -> impl Iterator<Item = &Found> {
        let done = |one: &&Found| one.report.state == State::Done;
        self.shards.values().filter_map(move |found| found.iter().find(done))
    }

    /// What is wrong with which shard, in the order of the shards.
    pub(super) fn faults(&self) -> impl Iterator<Item = (u64, Fault)> {
        (1..=self.of).filter_map(|shard| Some((shard, self.fault(shard)?)))
    }

    fn fault(&self, shard: u64) -> Option<Fault> {
        let Some(found) = self.shards.get(&shard) else { return Some(Fault::Missing) };
        if let [_, _, ..] = &found[..] {
            let places: Vec<&str> = found.iter().map(|one| one.place.as_str()).collect();
            return Some(Fault::Double(places.join(", ")));
        }
        let one = &found[0];
        let why = match one.report.state {
            State::Done => return None,
            State::Interrupted => "was interrupted".to_owned(),
            State::Failed => {
                format!("failed: {}", one.report.message.as_deref().unwrap_or("nothing said why"))
            }
        };
        Some(Fault::Unfinished(one.place.clone(), why))
    }

    /// Whether every shard ran once, and some case was compared.
    pub(super) fn is_complete(&self) -> bool {
        self.strangers.is_empty() && self.faults().next().is_none() && self.cases() > 0
    }

    pub(super) fn cases(&self) -> u64 {
        self.sum(|report| report.cases)
    }

    pub(super) fn mismatches(&self) -> u64 {
        self.sum(|report| report.mismatches)
    }

    pub(super) fn milliseconds(&self) -> u64 {
        self.sum(|report| report.milliseconds)
    }

    fn sum(&self, number: fn(&Report) -> u64) -> u64 {
        self.done().map(|one| number(&one.report)).fold(0, u64::saturating_add)
    }

    /// Mismatches by stage.
    pub(super) fn stages(&self) -> BTreeMap<&str, u64> {
        let mut sum: BTreeMap<&str, u64> = BTreeMap::new();
        for (stage, more) in self.done().flat_map(|one| &one.report.stages) {
            let stage = sum.entry(stage).or_default();
            *stage = stage.saturating_add(*more);
        }
        sum
    }

    /// The parts with their sums, in the order in which reports name them.
    pub(super) fn parts(&self) -> Vec<Part> {
        let mut sum = Report::default();
        for part in self.done().flat_map(|one| &one.report.parts) {
            sum.add_to_part(&part.name, Part { name: String::new(), ..part.clone() });
        }
        sum.parts
    }

    /// What became of the baseline in all shards; `None` if there was none.
    pub(super) fn known(&self) -> Option<Baseline> {
        let mut baselines = self.done().filter_map(|one| one.report.known.as_ref());
        let mut sum = baselines.next()?.clone();
        for Baseline { different, gone, .. } in baselines {
            sum.different = sum.different.saturating_add(*different);
            sum.gone.extend(gone.iter().cloned());
        }
        sum.gone.sort();
        sum.gone.dedup();
        Some(sum)
    }

    /// The hits of all shards.
    ///
    /// # Errors
    /// A report without hits, or with those of other bins.
    pub(super) fn coverage(&self) -> Result<Coverage, Failure> {
        let mut sum = Coverage::new();
        for Found { place, report } in self.done() {
            let hits = report.coverage.as_deref().unwrap_or_default();
            let coverage = Coverage::from_hits(hits).ok_or_else(|| {
                Failure::bad_input(format!(
                    "{place}: it has the hits of {} coverage bins, not of {}; run the shards with \
                     --coverage FILE",
                    hits.len(),
                    sum.bins().count()
                ))
            })?;
            sum.merge(&coverage);
        }
        Ok(sum)
    }
}
