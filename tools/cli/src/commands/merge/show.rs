//! A campaign as text and as `JUnit` XML.

use super::campaign::{Campaign, ShardReports};
use super::cases::Compared;
use super::read::FoundReport;
use crate::campaign::junit::{JunitCase, JunitSuite, Outcome, seconds};
use crate::campaign::report::Report;
use crate::output::counted;
use std::fmt::Write;

/// The table, the differences, the faults, and the command line of a shard if some must run again.
pub(super) fn text(campaign: &Campaign, compared: &Compared) -> String {
    let mut text = String::new();
    // Writing to a String does not fail, so the results of `write!` are dropped throughout.
    let Report { command, version, commit, options, set, .. } = &campaign.sample;
    let options: String =
        options.iter().map(|(name, values)| format!(" {name}={}", values.join(","))).collect();
    _ = writeln!(text, "tess {command}:{options}\ntess {version}, commit {commit}");
    set.iter().for_each(|set| _ = writeln!(text, "cases: {set}"));
    table(&mut text, campaign);
    for FoundReport { place, report } in campaign.shards.values().filter_map(ShardReports::ended) {
        let Report { shard, shards, cases, mismatches, .. } = report;
        if *mismatches > 0 {
            _ = writeln!(text, "shard {shard}/{shards} differs: {mismatches} of {cases} ({place})");
            report.first.iter().for_each(|first| _ = writeln!(text, "  {}", first.text("\n  ")));
        }
    }
    for (place, why) in &campaign.strangers {
        _ = writeln!(text, "{place} is of another campaign: {why}");
    }
    let once = faults(&mut text, campaign);
    match compared {
        Compared::Equal(asked) => _ = writeln!(text, "asked: {asked}"),
        Compared::Other(lines) => lines.iter().for_each(|line| _ = writeln!(text, "{line}")),
        Compared::Unknown(why) => {
            _ = writeln!(text, "{NOT_COMPARED}: {why}; give the asked ones with --cases");
        }
    }
    let Report { cases, mismatches, milliseconds, .. } = &campaign.sum;
    if *cases == 0 {
        _ = writeln!(text, "no case was compared");
    }
    let (of, time) = (counted(campaign.sample.shards, "shard"), seconds(*milliseconds));
    _ = writeln!(
        text,
        "{once} of {of} ran once: {cases} cases, {mismatches} mismatches, {time} s of all shards"
    );
    text
}

const NOT_COMPARED: &str = "the cases were not compared";

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

/// The shards that are not proved, and how to run them again. Returns the number of the others.
fn faults(text: &mut String, campaign: &Campaign) -> usize {
    let Report { shard, shards, words, .. } = &campaign.sample;
    let mut once = 0;
    for (number, found) in &campaign.shards {
        let Err(what) = found.proof() else {
            once += 1;
            continue;
        };
        let places = found.places();
        let places = if places.is_empty() { places } else { format!(" ({places})") };
        _ = writeln!(text, "shard {number}/{shards} {what}{places}");
    }
    if once < campaign.shards.len() {
        let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
        _ = writeln!(
            text,
            "run these again, each with --shard I/{shards} and files of its own; shard {shard}/{shards} was:\n  # {}",
            words.join(" ")
        );
    }
    once
}

/// A word, quoted for a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// One test case per shard, one for the asked cases, and one per report of another campaign.
pub(super) fn junit(campaign: &Campaign, compared: &Compared) -> String {
    let Report { command, shards, .. } = &campaign.sample;
    let case = |name, milliseconds, outcome| JunitCase {
        class: format!("tess.{command}"),
        name,
        milliseconds,
        outcome,
    };
    let of_shard = |(number, shard): (&u64, &ShardReports)| {
        let (milliseconds, outcome) = match shard.proof() {
            Ok(FoundReport { report, .. }) => {
                let counts = (report.mismatches, report.cases);
                let outcome = Outcome::of(counts, report.first.as_ref(), report.period);
                (Some(report.milliseconds), outcome)
            }
            Err(what) => {
                let again = format!("run it again with --shard {number}/{shards}");
                let lines = [shard.places(), again];
                let full = lines.into_iter().filter(|line| !line.is_empty()).collect::<Vec<_>>();
                (None, Outcome::Error(what, full.join("\n")))
            }
        };
        case(format!("shard {number}/{shards}"), milliseconds, outcome)
    };
    let strangers = campaign.strangers.iter().map(|(place, why)| {
        let outcome = Outcome::Error("of another campaign".to_owned(), why.clone());
        case(place.clone(), None, outcome)
    });
    let of_cases = match compared {
        Compared::Equal(_) => Outcome::Passed,
        Compared::Other(lines) => Outcome::Error("other cases".to_owned(), lines.join("\n")),
        Compared::Unknown(why) => Outcome::Failed(NOT_COMPARED.to_owned(), why.clone()),
    };
    let of_cases = case("cases".to_owned(), None, of_cases);
    let shards = campaign.shards.iter().map(of_shard);
    let tests = shards.chain([of_cases]).chain(strangers).collect();
    let (name, milliseconds) = (format!("tess {command}"), campaign.sum.milliseconds);
    JunitSuite { name, milliseconds, tests }.to_xml()
}
