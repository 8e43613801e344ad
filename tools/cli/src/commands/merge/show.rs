//! A campaign as text, CSV and `JUnit` XML.

use super::again::{Pattern, command_of};
use super::campaign::{Campaign, LISTED, SHOWN, ShardFault, option_words};
use super::read::FoundReport;
use crate::campaign::junit::{JunitCase, JunitSuite, Outcome, seconds};
use crate::campaign::report::Report;
use crate::output::counted;
use std::fmt::Write;

/// The table, what differs, what is wrong, and the commands to run again.
pub(super) fn text(campaign: &Campaign) -> String {
    let mut text = String::new();
    campaign.all().take(1).for_each(|one| heading(&mut text, &one.report));
    table(&mut text, campaign);
    differing(&mut text, campaign);
    faults(&mut text, campaign);
    summary(&mut text, campaign);
    text
}

// Writing to a String does not fail: the results of `write!` are dropped throughout.

fn heading(text: &mut String, report: &Report) {
    let options: String = option_words(report).iter().map(|words| format!(" {words}")).collect();
    let Report { command, version, commit, .. } = report;
    _ = writeln!(text, "tess {command}:{options}\ntess {version}, commit {commit}");
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
    let differing: Vec<&FoundReport> =
        campaign.done().filter(|one| one.report.mismatches > 0).collect();
    for FoundReport { place, report } in differing.iter().take(SHOWN) {
        let Report { shard, shards, cases, mismatches, .. } = report;
        _ = writeln!(text, "shard {shard}/{shards} differs: {mismatches} of {cases} ({place})");
        report.first.iter().for_each(|first| _ = writeln!(text, "  {}", first.text("\n  ")));
    }
    more(text, differing.len() as u64, "differing shard");
}

fn faults(text: &mut String, campaign: &Campaign) {
    for (place, why) in campaign.strangers.iter().take(SHOWN) {
        _ = writeln!(text, "{place} is of another campaign: {why}");
    }
    more(text, campaign.strangers.len() as u64, "report of another campaign");
    let mut again = Vec::new();
    for (shard, fault) in campaign.faults().take(SHOWN) {
        let shard_of = format!("shard {shard}/{}", campaign.of);
        _ = match &fault {
            ShardFault::Missing => writeln!(text, "{shard_of} is missing"),
            ShardFault::Unfinished(place, why) => writeln!(text, "{shard_of} {why} ({place})"),
            ShardFault::Double(places) => writeln!(text, "{shard_of} is double: {places}"),
        };
        if !matches!(fault, ShardFault::Double(_)) {
            again.push(shard);
        }
    }
    if campaign.faults().nth(SHOWN).is_some() {
        _ = writeln!(text, "and more shards");
    }
    if campaign.sum.cases == 0 {
        _ = writeln!(text, "no case was compared");
    }
    run_again(text, campaign, &again);
}

/// The commands that are certain: those of the reports, and others if every report shows how they are made.
fn run_again(text: &mut String, campaign: &Campaign, again: &[u64]) {
    let pattern = if again.is_empty() {
        None
    } else {
        Pattern::of(&campaign.all().map(|one| &one.report).collect::<Vec<_>>())
    };
    let command = |shard: &u64| match campaign.report_of(*shard) {
        Some(own) => Some(command_of(own)),
        None => pattern.as_ref().map(|pattern| pattern.command(*shard)),
    };
    let commands: Vec<String> = again.iter().filter_map(command).collect();
    if !commands.is_empty() {
        _ = writeln!(text, "run again:");
        commands.iter().for_each(|command| _ = writeln!(text, "  {command}"));
    }
    let sample = campaign.all().next().map(|one| &one.report);
    if let Some(sample) = sample.filter(|_| commands.len() < again.len()) {
        let Report { shard, shards, .. } = sample;
        _ = writeln!(
            text,
            "run again what is missing, each with files of its own; shard {shard}/{shards} was:"
        );
        _ = writeln!(text, "  # {}", command_of(sample));
    }
}

fn more(text: &mut String, all: u64, one: &str) {
    let hidden = all.saturating_sub(SHOWN as u64);
    if hidden > 0 {
        _ = writeln!(text, "and {} more", counted(hidden, one));
    }
}

fn summary(text: &mut String, campaign: &Campaign) {
    let once = campaign.once().count();
    let Report { cases, mismatches, milliseconds, .. } = &campaign.sum;
    let (of, time) = (counted(campaign.of, "shard"), seconds(*milliseconds));
    _ = writeln!(
        text,
        "{once} of {of} ran once: {cases} cases, {mismatches} mismatches, {time} s of all shards"
    );
}

/// A row for each report of the campaign, and one for each missing shard.
pub(super) fn csv(campaign: &Campaign) -> String {
    let mut text =
        "shard,shards,state,cases,mismatches,seconds,first,difference,report\n".to_owned();
    for FoundReport { place, report } in campaign.all() {
        let state = format!("{:?}", report.state).to_lowercase();
        let (case, difference) = match &report.first {
            Some(first) => (first.case.as_deref().unwrap_or_default(), first.difference.as_str()),
            None => ("", ""),
        };
        let Report { shard, shards, cases, mismatches, milliseconds, .. } = report;
        let [case, difference, place] = [case, difference, place].map(field);
        let time = seconds(*milliseconds);
        _ = writeln!(
            text,
            "{shard},{shards},{state},{cases},{mismatches},{time},{case},{difference},{place}"
        );
    }
    for (shard, fault) in campaign.faults().take(LISTED) {
        if fault == ShardFault::Missing {
            _ = writeln!(text, "{shard},{},missing,0,0,0.000,,,", campaign.of);
        }
    }
    if campaign.faults().nth(LISTED).is_some() {
        _ = writeln!(text, "more,{},missing,0,0,0.000,,,", campaign.of);
    }
    text
}

/// A field of CSV, in quotes where it must be.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        return format!("\"{}\"", text.replace('"', "\"\""));
    }
    text.to_owned()
}

/// A test case for each shard, and one for each report of another campaign.
pub(super) fn junit(campaign: &Campaign) -> String {
    let command = campaign.all().next().map(|one| one.report.command.as_str()).unwrap_or_default();
    let class = format!("tess.{command}");
    let of = campaign.of;
    let case = |name, milliseconds, outcome| JunitCase {
        class: class.clone(),
        name,
        milliseconds,
        outcome,
    };
    let test = |shard: u64, time, outcome| case(format!("shard {shard}/{of}"), time, outcome);
    let mut tests: Vec<(u64, JunitCase)> = campaign
        .once()
        .map(|FoundReport { report, .. }| {
            let counts = (report.mismatches, report.cases);
            let outcome = Outcome::of(counts, report.first.as_ref(), report.period);
            (report.shard, test(report.shard, Some(report.milliseconds), outcome))
        })
        .collect();
    for (shard, fault) in campaign.faults().take(LISTED) {
        let error = match fault {
            ShardFault::Missing => {
                Outcome::Error("missing".to_owned(), "it has no report".to_owned())
            }
            ShardFault::Unfinished(place, why) => Outcome::Error(why, place),
            ShardFault::Double(places) => Outcome::Error("double".to_owned(), places),
        };
        tests.push((shard, test(shard, None, error)));
    }
    tests.sort_by_key(|(shard, _)| *shard);
    let more = campaign.faults().nth(LISTED).map(|_| {
        let why = format!("more than {LISTED} are not listed");
        case("more shards".to_owned(), None, Outcome::Error("missing".to_owned(), why))
    });
    let strangers = campaign.strangers.iter().map(|(place, why)| {
        let error = Outcome::Error("of another campaign".to_owned(), why.clone());
        case(place.clone(), None, error)
    });
    let tests = tests.into_iter().map(|(_, test)| test).chain(more).chain(strangers).collect();
    let (name, milliseconds) = (format!("tess {command}"), campaign.sum.milliseconds);
    JunitSuite { name, milliseconds, tests }.to_xml()
}
