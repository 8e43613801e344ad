//! `tess check` with its options crossed.

use super::{Crossed, Excluded, FACTORS, KNOWN, is_left_out, is_refused};
use crate::support::{directory, tess_with_input};
use std::fs::{read_to_string, write};
use std::path::Path;
use tess_core::{DomainPoint, PatchFactors};
use tess_verify::Case;
use tess_verify::vectors::Listing;

/// A second case of the same configuration, which is answered wrongly.
fn second(case: Case) -> Case {
    Case { factors: PatchFactors::from_fn(case.domain(), |i| FACTORS[5 - i]), ..case }
}

/// A file with the model's answer and a wrong answer to the second case, as listings or as digests.
fn answers(case: Case, kind: &str) -> String {
    let (right, mut wrong) = (Listing::of_model(case), Listing::of_model(second(case)));
    let last = wrong.output.points.last_mut().expect("a point");
    *last = DomainPoint::from_bits(last.u.to_bits() ^ 0x1234, last.v.to_bits());
    let form = if kind == "digests" { Listing::to_csv } else { Listing::to_file };
    let [right, wrong] = [right, wrong].map(|answer| form(&answer, "a-device"));
    let heading = if kind == "digests" { 2 } else { 1 };
    let wrong: String = wrong.split_inclusive('\n').skip(heading).collect();
    right.replacen(" count=1 ", " count=2 ", 1) + &wrong
}

/// How the backend of a check runs counts as one option. All but the first value exclude the
/// options for listings of a device.
const CHECKED_BY: [&str; 5] = [
    "",
    "--backend core",
    "--backend simd",
    "--backend simd --index-type u16 --cpu-level baseline",
    "--backend gpu --index-type u16",
];

const RULES: (usize, &str) = (11, "--rules d3d11");

/// The options that exclude `--rules`, which judges listings without a backend.
const NOT_JUDGED: [(usize, &str); 6] = [
    (2, "--order sequence"),
    (2, "--order any"),
    (3, "--points"),
    (4, "--conversion 0.6ulp"),
    (5, "--denormals flush"),
    (7, "--failures failures.txt"),
];

fn of_checks() -> Crossed {
    let own: [&[&str]; 11] = [
        &["listings", "digests"],
        &["", "--order sequence", "--order any"],
        &["", "--points"],
        &["", "--conversion 0.6ulp"],
        &["", "--denormals flush"],
        &["", "--cases cases.txt"],
        &["", "--failures failures.txt"],
        &["", "--coverage coverage.xml --shard 2/3", "--shard 1/1"],
        &["", "--known known.txt"],
        &["", "--report report.jsonl --junit report.xml"],
        &["", RULES.1],
    ];
    let name = |words: &'static str| words.split(' ').next().unwrap_or(words);
    let weaker = NOT_JUDGED.into_iter().take(5);
    let mut excluded: Vec<Excluded> = Vec::new();
    for (at, words) in weaker.chain([RULES]) {
        for backend in &CHECKED_BY[1..] {
            excluded.push(((0, *backend), (at, words), ["--backend", name(words)]));
        }
        excluded.push(((1, "digests"), (at, words), ["kind is patches", name(words)]));
    }
    let with_rules = NOT_JUDGED.into_iter().chain([(8, "--coverage coverage.xml --shard 2/3")]);
    excluded.extend(with_rules.map(|(at, words)| ((at, words), RULES, [name(words), "--rules"])));
    let values = [&CHECKED_BY[..]].iter().chain(&own).map(|values| values.to_vec()).collect();
    Crossed { values, excluded }
}

/// The command line of a check of standard input; its files are in the folder.
fn check(folder: &Path, words: &[&str]) -> String {
    let words = [&words[..1], &words[2..]].concat().join(" ");
    let is_file = |word: &str| [".txt", ".xml", ".jsonl"].iter().any(|end| word.ends_with(end));
    let path = |word: &str| match is_file(word) {
        true => folder.join(word).display().to_string(),
        false => word.to_owned(),
    };
    format!("check - {}", words.split_whitespace().map(path).collect::<Vec<_>>().join(" "))
}

/// Whatever the options, the model's answer is equal and a wrong one is different.
#[test]
fn answers_are_judged_whatever_the_options() {
    let folder = directory("crossed_checks");
    write(folder.join("known.txt"), KNOWN).expect("written");
    let run = |case: Case, words: &[&str]| {
        write(folder.join("cases.txt"), format!("{case}\n{}\n", second(case))).expect("written");
        tess_with_input(&check(&folder, words), &answers(case, words[1]))
    };
    let mut runs = 0;
    of_checks().run(
        |case, words| {
            let run = run(case, words);
            if is_left_out(&run, words) {
                return;
            }
            let said = format!("{case}: {words:?}: {}{}", run.stdout, run.stderr);
            if words[RULES.0].is_empty() {
                run.exits(1);
                assert!(run.stdout.ends_with("2 cases, 1 mismatches\n"), "{said}");
                are_written(&folder, case, words, &said);
            } else {
                let beside = "beside the model: 1 equal, 0 in another order, 1 different\n";
                assert!(run.stdout.ends_with(beside), "{said}");
            }
            runs += 1;
        },
        |case, words, says| is_refused(&run(case, words), &format!("{case}: {words:?}"), says),
    );
    assert!(runs > 20, "{runs} runs");
}

/// The files that the options ask for contain the wrong answer only.
fn are_written(folder: &Path, case: Case, words: &[&str], said: &str) {
    let file = |name: &str| read_to_string(folder.join(name)).expect("written");
    let mut texts = Vec::new();
    if words[7].starts_with("--failures") {
        // A listing begins with its case; a row of digests contains it, separated by commas.
        texts.push(file("failures.txt").replace(',', " "));
    }
    if words[10].starts_with("--report") {
        let report = file("report.jsonl");
        assert!(report.contains("\"cases\":2,\"mismatches\":1,"), "{report}: {said}");
        texts.extend([report, file("report.xml")]);
    }
    let has = |text: &str, case: Case| text.contains(case.to_string().trim_start_matches("case "));
    for text in texts {
        assert!(has(&text, second(case)) && !has(&text, case), "{text}: {said}");
    }
}
