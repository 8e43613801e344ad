//! A campaign as text and as `JUnit` XML.

use super::campaign::{Campaign, ShardFault};
use super::read::FoundReport;
use crate::campaign::junit::{JunitCase, JunitSuite, Outcome, seconds};
use crate::campaign::report::Report;
use crate::output::counted;
use std::fmt::Write;

/// The largest number of shards of a kind that the text shows.
const SHOWN: usize = 100;

/// The largest number of faults that the `JUnit` file lists. A report may claim more shards than
/// fit into memory.
const LISTED: usize = 1_000_000;

/// The table, the differences, the faults, and the shards to run again.
pub(super) fn text(campaign: &Campaign) -> String {
    let mut text = String::new();
    // Writing to a String does not fail, so the results of `write!` are dropped throughout.
    if let Some(Report { command, version, commit, options, .. }) = campaign.sample() {
        let options: String =
            options.iter().map(|(name, values)| format!(" {name}={}", values.join(","))).collect();
        _ = writeln!(text, "tess {command}:{options}\ntess {version}, commit {commit}");
    }
    table(&mut text, campaign);
    differing(&mut text, campaign);
    faults(&mut text, campaign);
    let Report { cases, mismatches, milliseconds, .. } = &campaign.sum;
    let (once, of) = (campaign.once().count(), counted(campaign.of, "shard"));
    let time = seconds(*milliseconds);
    _ = writeln!(
        text,
        "{once} of {of} ran once: {cases} cases, {mismatches} mismatches, {time} s of all shards"
    );
    text
}

fn table(text: &mut String, campaign: &Campaign) {
    _ = writeln!(text, "{:<44} {:>15} {:>10}", "part", "cases", "mismatches");
    let Report { parts, cases, mismatches, stages, .. } = &campaign.sum;
    for part in parts {
        _ = writeln!(text, "{:<44} {:>15} {:>10}", part.name, part.cases, part.mismatches);
    }
    _ = writeln!(text, "{:<44} {cases:>15} {mismatches:>10}", "all");
    for (stage, mismatches) in stages {
        _ = writeln!(text, "stage {stage}: {mismatches}");
    }
    if let Some((baselines, known)) = campaign.known() {
        let (entries, different) = (counted(known.entries, "case"), known.different);
        let of = if baselines > 1 { format!(" of {baselines} baselines") } else { String::new() };
        _ = writeln!(text, "known differences: {different} of {entries}{of} occur");
        known.gone.iter().for_each(|line| _ = writeln!(text, "no longer different: {line}"));
    }
}

fn differing(text: &mut String, campaign: &Campaign) {
    let mut differing = campaign.done().filter(|one| one.report.mismatches > 0);
    for FoundReport { place, report } in differing.by_ref().take(SHOWN) {
        let Report { shard, shards, cases, mismatches, .. } = report;
        _ = writeln!(text, "shard {shard}/{shards} differs: {mismatches} of {cases} ({place})");
        report.first.iter().for_each(|first| _ = writeln!(text, "  {}", first.text("\n  ")));
    }
    more(text, differing.count(), "differing shard");
}

fn faults(text: &mut String, campaign: &Campaign) {
    for (place, why) in campaign.strangers.iter().take(SHOWN) {
        _ = writeln!(text, "{place} is of another campaign: {why}");
    }
    more(text, campaign.strangers.len().saturating_sub(SHOWN), "report of another campaign");
    let mut faults = campaign.faults();
    let mut has_faults = false;
    for ShardFault { shard, what, places } in faults.by_ref().take(SHOWN) {
        has_faults = true;
        let places = if places.is_empty() { places } else { format!(" ({places})") };
        _ = writeln!(text, "shard {shard}/{} {what}{places}", campaign.of);
    }
    if faults.next().is_some() {
        _ = writeln!(text, "and more shards");
    }
    if campaign.sum.cases == 0 {
        _ = writeln!(text, "no case was compared");
    }
    if let Some(sample) = campaign.sample().filter(|_| has_faults) {
        let Report { shard, shards, words, .. } = sample;
        let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
        _ = writeln!(
            text,
            "run these again, each with --shard I/{shards} and files of its own; shard {shard}/{shards} was:\n  # {}",
            words.join(" ")
        );
    }
}

fn more(text: &mut String, hidden: usize, one: &str) {
    if hidden > 0 {
        _ = writeln!(text, "and {} more", counted(hidden as u64, one));
    }
}

/// A word, quoted for a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// One test case per shard, and one per report of another campaign.
pub(super) fn junit(campaign: &Campaign) -> String {
    let command = campaign.sample().map_or("", |report| &report.command);
    let case = |name: String, milliseconds, outcome| JunitCase {
        class: format!("tess.{command}"),
        name,
        milliseconds,
        outcome,
    };
    let shard = |shard: u64| format!("shard {shard}/{}", campaign.of);
    let mut tests: Vec<(u64, JunitCase)> = campaign
        .once()
        .map(|FoundReport { report, .. }| {
            let counts = (report.mismatches, report.cases);
            let outcome = Outcome::of(counts, report.first.as_ref(), report.period);
            (report.shard, case(shard(report.shard), Some(report.milliseconds), outcome))
        })
        .collect();
    let mut faults = campaign.faults();
    tests.extend(faults.by_ref().take(LISTED).map(|fault| {
        let error = Outcome::Error(fault.what, fault.places);
        (fault.shard, case(shard(fault.shard), None, error))
    }));
    tests.sort_by_key(|(shard, _)| *shard);
    let more = faults.next().map(|_| {
        let why = format!("more than {LISTED} are not listed");
        case("more shards".to_owned(), None, Outcome::Error("are missing".to_owned(), why))
    });
    let strangers = campaign.strangers.iter().map(|(place, why)| {
        let error = Outcome::Error("of another campaign".to_owned(), why.clone());
        case(place.clone(), None, error)
    });
    let tests = tests.into_iter().map(|(_, test)| test).chain(more).chain(strangers).collect();
    let (name, milliseconds) = (format!("tess {command}"), campaign.sum.milliseconds);
    JunitSuite { name, milliseconds, tests }.to_xml()
}
