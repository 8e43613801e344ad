//! Tests of campaigns: reports of shards, `JUnit` XML, `tess merge`, shards from the environment,
//! and known differences.

use crate::support::{Folder, Run, command, directory, shell, tess, tess_with_input};
use serde_json::Value;
use std::fs;
use std::path::Path;
use tess_verify::generate::LEVEL_VERSION;

pub(crate) fn json(path: &Path) -> Value {
    let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    assert_eq!(text.matches('\n').count(), 1, "one line: {text}");
    serde_json::from_str(&text).expect("it is JSON")
}

/// A report that an earlier run may have left.
const EARLIER: &str = "{\"format\":\"tess-report 2\",\"state\":\"done\"}\n";

/// Runs `tess` in a folder.
pub(crate) fn tess_in(folder: &Folder, words: &str) -> Run {
    Run::of(command(words).current_dir(folder))
}

/// A listing of 40 cases with a fault in the last point, and the line of its case.
fn faulty_listing() -> (String, String) {
    let right = tess("gen --level 3 --count 40 --domain tri --format listing").stdout;
    let is_point =
        |line: &&str| line.split_once(' ').is_some_and(|(u, v)| u.len() == 5 && v.len() == 5);
    let mut lines: Vec<&str> = right.lines().collect();
    let at = lines.iter().rposition(is_point).expect("a point");
    let case = lines[..at].iter().rfind(|line| line.starts_with("case ")).expect("its case");
    let case = (*case).to_owned();
    let last = if lines[at].ends_with('0') { "1" } else { "0" };
    let faulty = format!("{}{last}", &lines[at][..10]);
    lines[at] = &faulty;
    (lines.join("\n") + "\n", case)
}

#[test]
fn reports_say_what_was_run_and_found() {
    let folder = directory("reports");
    let run =
        tess_in(&folder, "verify --backend simd --random 20 --seed 7 --shard 2/3 --report r.jsonl");
    run.exits(0);
    let report = json(&folder.join("r.jsonl"));
    assert_eq!(report["format"], "tess-report 2", "{report}");
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"), "{report}");
    let set = format!("subjects=random level-version={LEVEL_VERSION} patches=20 seed=7");
    assert_eq!((&report["shard"], &report["shards"]), (&2.into(), &3.into()), "{report}");
    assert_eq!((&report["set"], &report["state"]), (&Value::from(set), &"done".into()), "{report}");
    assert_eq!(report["options"]["random"][0], "20", "{report}");
    assert_eq!(report["words"][2], "--backend", "{report}");
    assert_eq!(report["parts"][0]["name"], "random simd", "{report}");
    let row = run.stdout.lines().nth(1).expect("a row").split_whitespace().nth(2);
    assert_eq!(report["cases"].to_string(), row.expect("a number"), "{}", run.stdout);
    assert_eq!(report["mismatches"], 0, "{report}");
    let commit = report["commit"].as_str().expect("text");
    let hex = commit.trim_end_matches("+changes");
    assert!(
        commit == "unknown" || (hex.len() == 40 && hex.chars().all(|c| c.is_ascii_hexdigit())),
        "{commit}"
    );
}

/// The report contains the stage, the configuration and the case line of a planted difference.
#[test]
fn differences_are_in_the_report() {
    let folder = directory("report-differences");
    let (faulty, case) = faulty_listing();
    let report = folder.join("r.jsonl");
    let xml = folder.join("r.xml");
    let words = format!("check - --report {} --junit {}", report.display(), xml.display());
    tess_with_input(&words, &faulty).exits(1);
    let report = json(&report);
    assert_eq!((&report["cases"], &report["mismatches"]), (&40.into(), &1.into()), "{report}");
    assert_eq!(report["stages"]["location"], 1, "{report}");
    assert_eq!(report["first"]["case"], case.as_str(), "{report}");
    let configuration = case.split(' ').skip(1).take(3).collect::<Vec<_>>().join(" ");
    let parts = report["parts"].as_array().expect("parts");
    let wrong: Vec<&Value> = parts.iter().filter(|part| part["mismatches"] != 0).collect();
    assert_eq!(wrong.len(), 1, "{report}");
    assert_eq!(wrong[0]["name"], configuration.as_str(), "{report}");
    let names = parts.iter().map(|part| part["name"].as_str());
    assert!(names.is_sorted(), "whatever the threads did: {report}");
    let xml = fs::read_to_string(xml).expect("JUnit");
    assert!(xml.contains(" failures=\"1\" errors=\"0\" "), "{xml}");
    let failing = format!("name=\"{configuration}\">\n      <failure message=\"1 of ");
    assert!(xml.contains(&failing) && xml.contains(&case), "{xml}");
}

/// However many records differ, every configuration that fails has a body with one of its cases.
#[test]
fn every_failing_part_has_a_body() {
    let folder = directory("every-failing-part-has-a-body");
    let file = "gen --level 3 --count 600 --format csv -o right.csv";
    tess_in(&folder, file).exits(0);
    let wrong = "sed '3,$s/0$/x/; 3,$s/[1-9a-f]$/0/; s/x$/1/' right.csv > wrong.csv; \
                 $TESS check wrong.csv --junit r.xml --report r.jsonl";
    let run = shell(wrong, &folder);
    run.exits(1).prints("\n600 cases, 600 mismatches\n");
    let report = json(&folder.join("r.jsonl"));
    let parts = report["parts"].as_array().expect("parts");
    assert!(parts.len() > 20, "more than the differences that are kept: {report}");
    let xml = fs::read_to_string(folder.join("r.xml")).expect("JUnit");
    assert_eq!(xml.matches("<failure ").count(), parts.len(), "{xml}");
    for part in parts {
        let name = part["name"].as_str().expect("text");
        let (_, body) = xml.split_once(&format!("name=\"{name}\">")).expect("its test case");
        let (body, _) = body.split_once("</failure>").expect("its body");
        assert!(body.contains(&format!(">first: case {name} ")), "{name}: {body}");
    }
}

/// The report has each missing answer in a part of its own, with the case that was asked.
#[test]
fn missing_answers_are_in_the_report() {
    let folder = directory("report-missing");
    let asked = tess("gen --level 3 --count 40 --domain tri --format listing").stdout;
    let at = asked.match_indices("\ncase ").nth(8).expect("the ninth case").0 + 1;
    let (case, _) = asked[at..].split_once('\n').expect("its line");
    let end = at + asked[at..].find("\nend\n").expect("its end") + "\nend\n".len();
    let answers = format!("{}{}", &asked[..at], &asked[end..]).replace("count=40", "count=39");
    fs::write(folder.join("asked.txt"), &asked).expect("written");
    fs::write(folder.join("device.txt"), answers).expect("written");
    let run = tess_in(&folder, "check device.txt --cases asked.txt --report r.jsonl");
    run.exits(1).prints(format!("record 9 is missing: {case}\n"));
    let report = json(&folder.join("r.jsonl"));
    assert_eq!((&report["cases"], &report["mismatches"]), (&40.into(), &1.into()), "{report}");
    assert_eq!(report["stages"], serde_json::json!({ "answer": 1 }), "{report}");
    assert_eq!(report["first"]["case"], case, "{report}");
    let parts = report["parts"].as_array().expect("parts");
    let wrong: Vec<&Value> = parts.iter().filter(|part| part["mismatches"] != 0).collect();
    let [part] = wrong[..] else { panic!("{report}") };
    assert_eq!((&part["cases"], &part["first"]["case"]), (&1.into(), &case.into()), "{report}");
}

#[test]
fn failed_runs_have_a_report() {
    let folder = directory("report-failed");
    let report = folder.join("r.jsonl");
    fs::write(&report, EARLIER).expect("written");
    let truncated = tess("gen --level 3 --count 3").stdout;
    let words =
        format!("check - --report {} --junit {}", report.display(), folder.join("r.xml").display());
    tess_with_input(&words, &truncated[..truncated.len() - 30]).exits(2);
    let report = json(&report);
    assert_eq!(report["state"], "failed", "{report}");
    assert!(report["message"].as_str().is_some_and(|m| m.contains("stdin:5")), "{report}");
    let xml = fs::read_to_string(folder.join("r.xml")).expect("JUnit");
    assert!(xml.contains(" errors=\"1\" ") && xml.contains("<error message=\"failed\""), "{xml}");
}

/// The report of an earlier run is not mistaken for the result of one that was killed.
#[cfg(unix)]
#[test]
#[ignore = "slow: many runs of the program"]
fn interrupted_and_killed_runs() {
    let folder = directory("report-interrupted");
    for (signal, state) in [("TERM", "interrupted"), ("KILL", "running")] {
        fs::write(folder.join("r.jsonl"), EARLIER).expect("written");
        let script = format!(
            "rm -f rows; \"$TESS\" verify --backend simd --exhaustive --report r.jsonl > rows & p=$!\n\
             while ! grep -qs ^level-1 rows; do sleep 0.05; done; kill -s {signal} $p; wait $p"
        );
        shell(&script, &folder);
        let report = json(&folder.join("r.jsonl"));
        assert_eq!(report["state"], state, "{report}");
        if signal == "TERM" {
            assert_eq!(report["parts"][0]["cases"], 44070, "what was done is in it: {report}");
        }
    }
}

#[test]
fn places_of_reports_are_tried_first() {
    let folder = directory("report-places");
    for (option, why) in [
        ("--report /nowhere/r.jsonl", "cannot write /nowhere/r.jsonl"),
        ("--junit /nowhere/r.xml", "cannot write /nowhere/r.xml"),
        ("--report /dev/null", "--report /dev/null is not a regular file"),
        ("--report one --junit one", "are the same file"),
        ("--report one -o one", "are the same file"),
        ("--report new/", "cannot write new/: is a directory"),
    ] {
        let run = tess_in(&folder, &format!("gen --level 3 --count 2 {option}"));
        run.exits(2).prints_nothing().says(why);
    }
    assert_eq!(fs::read_dir(&folder).expect("the folder").count(), 0, "nothing is written");
}

/// Three shards of generated coverage.
pub(crate) fn campaign(folder: &Folder) {
    for part in 1..=3 {
        let words = format!(
            "gen --level 3 --count 50 --shard {part}/3 --coverage c{part}.xml --report r{part}.jsonl"
        );
        tess_in(folder, &words).exits(0);
    }
}

#[test]
fn a_whole_campaign() {
    let folder = directory("merge-whole");
    campaign(&folder);
    let words = "merge r1.jsonl r3.jsonl r2.jsonl --junit a.xml";
    tess_in(&folder, words).exits(0).prints("\n3 of 3 shards ran once: 50 cases, 0 mismatches, ");
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect("a file");
    assert!(read("a.xml").contains("tests=\"4\" failures=\"0\" errors=\"0\""), "{}", read("a.xml"));
    let all = read("r1.jsonl") + &read("r2.jsonl") + &read("r3.jsonl");
    tess_with_input("merge -", &all).exits(0); // one file of all
}

#[test]
fn what_is_missing_or_duplicated() {
    let folder = directory("merge-missing");
    campaign(&folder);
    let run = tess_in(&folder, "merge r1.jsonl r3.jsonl --junit a.xml");
    run.exits(2).prints("shard 2/3 is missing\n");
    run.prints("run these again, each with --shard I/3 and files of its own; shard 1/3 was:\n  # ");
    run.prints(" gen --level 3 --count 50 --shard 1/3 --coverage c1.xml --report r1.jsonl\n");
    let xml = fs::read_to_string(folder.join("a.xml")).expect("JUnit");
    assert!(xml.contains("name=\"shard 2/3\">\n      <error message=\"is missing\""), "{xml}");

    fs::copy(folder.join("r2.jsonl"), folder.join("away.jsonl")).expect("copied");
    let run = tess_in(&folder, "merge r1.jsonl r2.jsonl r3.jsonl away.jsonl");
    run.exits(2).prints("shard 2/3 is duplicated (r2.jsonl, away.jsonl)\n");
    let run = tess_in(&folder, "merge r1.jsonl r2.jsonl r3.jsonl r4.jsonl");
    run.exits(2).says("there is no r4.jsonl"); // a file that is not there
}

/// Each of these reports differs from the campaign in one respect.
#[test]
fn reports_of_other_campaigns() {
    let folder = directory("merge-strangers");
    campaign(&folder);
    let own = fs::read_to_string(folder.join("r2.jsonl")).expect("a report");
    let report: Value = serde_json::from_str(&own).expect("JSON");
    let commit = report["commit"].as_str().expect("text").to_owned();
    for (old, new, why) in [
        ("\"version\":\"", "\"version\":\"9", "the version is 9"),
        (&format!("\"commit\":\"{commit}"), "\"commit\":\"00", "the commit is 00"),
        (
            "\"count\":[\"50\"]",
            "\"count\":[\"51\"]",
            "the option count is [\"51\"]; in r1.jsonl it is [\"50\"]",
        ),
        ("\"shards\":3", "\"shards\":4", "the number of shards is 4; in r1.jsonl it is 3"),
        ("\"command\":\"gen\"", "\"command\":\"check\"", "the command is check"),
    ] {
        let other = own.replacen(old, new, 1);
        assert_ne!(other, own, "{old}");
        fs::write(folder.join("r2.jsonl"), other).expect("written");
        let run = tess_in(&folder, "merge r1.jsonl r2.jsonl r3.jsonl");
        run.exits(2);
        let expected = format!("r2.jsonl is of another campaign: {why}");
        run.prints(&expected).prints("shard 2/3 is missing");
    }
}

#[test]
fn differing_and_unfinished_shards() {
    let folder = directory("merge-differing");
    campaign(&folder);
    let own = fs::read_to_string(folder.join("r2.jsonl")).expect("a report");
    let differing = own.replacen("\"mismatches\":0", "\"mismatches\":2", 2).replacen(
        "\"first\":null",
        "\"first\":{\"case\":\"case a\",\"difference\":\"b, c\"}",
        1,
    );
    fs::write(folder.join("r2.jsonl"), differing).expect("written");
    let run = tess_in(&folder, "merge r1.jsonl r2.jsonl r3.jsonl --junit a.xml");
    run.exits(1);
    let shown = "shard 2/3 differs: 2 of 17 (r2.jsonl)\n  case a\n  b, c\n";
    run.prints(shown);
    let xml = fs::read_to_string(folder.join("a.xml")).expect("JUnit");
    assert!(xml.contains("<failure message=\"2 of 17 differ\" type=\"failure\">first: "), "{xml}");
    for (state, shown) in
        [("interrupted", "was interrupted"), ("failed", "failed: for an unknown reason")]
    {
        let unfinished = own.replacen("\"state\":\"done\"", &format!("\"state\":\"{state}\""), 1);
        fs::write(folder.join("r2.jsonl"), unfinished).expect("written");
        let run = tess_in(&folder, "merge r1.jsonl r2.jsonl r3.jsonl");
        run.exits(2).prints(format!("shard 2/3 {shown} (r2.jsonl)\n")).prints("run these again");
    }
}

#[test]
fn what_is_no_report() {
    let folder = directory("merge-malformed");
    campaign(&folder);
    let own = fs::read_to_string(folder.join("r2.jsonl")).expect("a report");
    // The cases that the whole report counts; `asked` and the parts have numbers of their own.
    let counted = "\"state\":\"done\",\"message\":null,\"cases\":17";
    assert!(own.contains(counted), "{own}");
    for (text, why) in [
        (String::new(), "bad.jsonl:1: the file is empty"),
        ("\n".to_owned(), "bad.jsonl:1: no report"),
        (own[..own.len() / 2].to_owned(), "bad.jsonl:1: no report"),
        (own.replacen("report 2", "report 1", 1), "the format is `tess-report 1`"),
        (own.replacen("\"digest\":\"", "\"digest\":\"0", 1), "a digest has 32 hex digits"),
        (own.replacen("\"shard\":2", "\"shard\":0", 1), "shards are counted from 1"),
        (own.replacen("\"shard\":2", "\"shard\":4", 1), "shard 4 of 3"),
        (own.replacen("\"shards\":3", "\"shards\":1000001", 1), "has at most 1000000"),
        (own.replacen(counted, &counted.replace("17", "18"), 1), "the parts add up to 17"),
        (own.replacen("\"cases\"", "\"case\"", 1), "unknown field `case`"),
        (own.clone() + "{}\n", "bad.jsonl:2: no report"),
    ] {
        fs::write(folder.join("bad.jsonl"), &text).expect("written");
        tess_in(&folder, "merge r1.jsonl bad.jsonl r3.jsonl").exits(2).prints_nothing().says(why);
    }
}

fn with_variables(folder: &Folder, words: &str, variables: &[(&str, &str)]) -> Run {
    Run::of(command(words).current_dir(folder).envs(variables.iter().copied()))
}

#[test]
fn shards_from_the_environment() {
    let folder = directory("shards-environment");
    let gen_words = "gen --level 3 --count 50 --domain tri --report r.jsonl";
    let status = folder.join("status");
    let bazel = [
        ("TEST_TOTAL_SHARDS", "3"),
        ("TEST_SHARD_INDEX", "1"),
        ("TEST_SHARD_STATUS_FILE", status.to_str().expect("text")),
    ];
    let whole = with_variables(&folder, &format!("{gen_words} --shard 1/1"), &bazel);
    assert_eq!(whole.stdout.lines().count(), 52, "the option wins: {}", whole.stderr);
    assert!(!status.exists(), "the runner is not told that its shards are done");
    let part = with_variables(&folder, gen_words, &bazel);
    part.says("tess: shard 2/3 (from TEST_SHARD_INDEX)\n");
    assert!(status.exists(), "the runner is told");
    assert_eq!(json(&folder.join("r.jsonl"))["shard_from"], "TEST_SHARD_INDEX", "in the report");
    assert_eq!(
        part.stdout,
        tess("gen --level 3 --count 50 --domain tri --shard 2/3").stdout,
        "that part"
    );
    let run = with_variables(&folder, "gen --level 3 --count 5", &[("JOB_COMPLETION_INDEX", "0")]);
    run.exits(2).prints_nothing().says("TESS_SHARDS is not"); // no total
    let run = with_variables(&folder, "verify --backend simd --rules d3d11", &bazel);
    run.exits(2).says("cannot be cut into shards"); // it cannot be cut
}

/// A file whose first line names a shard is that shard.
#[test]
fn shards_of_files() {
    let folder = directory("shards-files");
    let asked = "gen --level 3 --count 40 --seed 5 --format listing --shard 2/4 -o asked.txt";
    tess_in(&folder, asked).exits(0);
    let the_file_itself = "check asked.txt --cases asked.txt --report r.jsonl";
    tess_in(&folder, the_file_itself).exits(2);
    fs::copy(folder.join("asked.txt"), folder.join("device.txt")).expect("copied");
    tess_in(&folder, "check device.txt --cases asked.txt --report r.jsonl").exits(0);
    let report = json(&folder.join("r.jsonl"));
    assert_eq!((&report["shard"], &report["shards"]), (&2.into(), &4.into()), "{report}");
    let set = format!("level=3 level-version={LEVEL_VERSION} seed=5 random=40");
    assert_eq!(
        (&report["set"], &report["shard_from"]),
        (&Value::from(set), &"--cases".into()),
        "{report}"
    );
    assert_eq!(report["asked"]["cases"], 10, "{report}");
    let run = tess_in(&folder, "check device.txt --shard 3/4");
    run.exits(2).says("one says shard 3/4, the other shard 2/4 (from FILE)");
}

/// A known deviation is not a mismatch; an unknown one is, and one that no longer occurs is named.
#[test]
fn known_differences() {
    let folder = directory("known");
    let (faulty, case) = faulty_listing();
    fs::write(folder.join("device.txt"), &faulty).expect("written");
    tess_in(&folder, "check device.txt --failures known.txt").exits(1);
    let equal = faulty.lines().find(|line| line.starts_with("case ")).expect("another case");
    fs::write(folder.join("lines.txt"), format!("# documented\n{case}\n{equal}\n"))
        .expect("written");
    let run = tess_in(&folder, "check device.txt --known known.txt --report r.jsonl");
    run.exits(0).says_nothing();
    assert_eq!(run.stdout, "40 cases, 0 mismatches, 1 known\n", "what --failures wrote");
    let run = tess_in(&folder, "check device.txt --known lines.txt --report r.jsonl");
    run.exits(0);
    let gone = format!("tess: no longer different, though known: 1 case\n  {equal}\n");
    assert_eq!(run.stderr, gone, "lines, too");
    let known = &json(&folder.join("r.jsonl"))["known"];
    assert_eq!((&known["entries"], &known["different"]), (&2.into(), &1.into()), "{known}");
    assert_eq!(known["gone"][0], equal, "{known}");
    fs::write(folder.join("other.txt"), format!("{equal}\n")).expect("written");
    tess_in(&folder, "check device.txt --known other.txt").exits(1); // another case
    tess_in(&folder, "verify --backend simd --random 2 --known lines.txt").exits(0);
    fs::write(folder.join("empty.txt"), "").expect("written");
    let without_a_case = "check device.txt --known empty.txt";
    tess_in(&folder, without_a_case).exits(2).says("there is no case");
}

/// A line with terms excuses the difference that it expects, until it expires; a line that does not
/// apply is a mismatch.
#[test]
#[ignore = "slow: many runs of the program"]
fn known_differences_have_terms() {
    let folder = directory("known_terms");
    let (faulty, case) = faulty_listing();
    fs::write(folder.join("device.txt"), &faulty).expect("written");
    let asked: String =
        faulty.lines().filter(|line| line.starts_with("case ")).collect::<Vec<_>>().join("\n");
    fs::write(folder.join("asked.txt"), asked).expect("written");
    let run = tess_in(&folder, "check device.txt");
    let shown = run.stdout.lines().skip_while(|line| !line.ends_with(&case)).nth(1);
    let found = shown.expect("a difference").trim();
    let equal = faulty.lines().find(|line| line.starts_with("case ")).expect("another case");
    let other = "case tri integer point center 40a00000 40a00000 40a00000 40a00000";
    let terms = |case: &str, expected: &str| {
        format!("{case} | {expected} | ada | 9999-12-31 | rounds half up\n")
    };
    let right = terms(&case, found);
    for (known, words, code, says) in [
        (&right, "", 0, ""),
        (&terms(&case, "*"), "", 0, ""),
        (&terms(&case, "missing"), "", 1, "k.txt:1: expects `missing`, not `"),
        (&right.replacen("observed", "observes", 1), "", 1, "k.txt:1: expects `"),
        (&right.replace("9999", "2020"), "", 1, "k.txt:1: expired on 2020-12-31"),
        (&(right.clone() + &terms(equal, "*")), "", 1, "k.txt:2: is unused"),
        (
            &(right.clone() + &terms(equal, "*")),
            "--shard 1/2 --cases asked.txt",
            1,
            "k.txt:2: is unused",
        ),
        (&(right.clone() + &terms(other, "*")), "", 1, "k.txt:2: is unused"),
        (&(right.clone() + &terms(other, "*")), "--shard 1/2 --cases asked.txt", 0, ""),
        (&(right.clone() + "rule cover | 1 | ada | 9999-12-31 | not judged here"), "", 0, ""),
        (&(right.clone() + &case), "", 2, "k.txt:2: subject: is also on line 1"),
    ] {
        fs::write(folder.join("k.txt"), known).expect("written");
        let run =
            tess_in(&folder, &format!("check device.txt --known k.txt --report r.jsonl {words}"));
        run.exits(code);
        assert!(
            run.stderr.contains(says) && run.stderr.is_empty() == says.is_empty(),
            "{}",
            run.stderr
        );
    }
    fs::write(folder.join("one.txt"), format!("{case}\n{other}\n")).expect("written");
    fs::write(folder.join("k.txt"), terms(other, "missing")).expect("written");
    let asked = format!("{case}\n");
    let answer = tess_with_input("patch --cases -", &asked).stdout;
    fs::write(folder.join("answer.txt"), answer).expect("written");
    for (words, code) in [("", 1), ("--known k.txt", 0)] {
        tess_in(&folder, &format!("check answer.txt --cases one.txt {words}")).exits(code);
    }
    fs::write(folder.join("k.txt"), terms(equal, "*")).expect("written");
    let report = "check device.txt --known k.txt --report r.jsonl --shard 1/1";
    tess_in(&folder, report).exits(1);
    tess_in(&folder, "merge r.jsonl").exits(1).prints("\nbaseline ");
}

/// After the device is fixed, a newly written baseline has no record: it excuses nothing and is not
/// an error.
#[test]
fn baselines_that_became_empty() {
    let folder = directory("baselines_that_became_empty");
    let (faulty, _) = faulty_listing();
    fs::write(folder.join("device.txt"), &faulty).expect("written");
    let made = "gen --level 3 --count 5 --format listing -o right.txt";
    tess_in(&folder, made).exits(0); // a fixed device
    tess_in(&folder, "check right.txt --failures known.txt").exits(0);
    fs::write(folder.join("remarks.txt"), "# all mended\n").expect("written");
    for baseline in ["known.txt", "remarks.txt"] {
        tess_in(&folder, &format!("check right.txt --known {baseline}")).exits(0).says_nothing();
        let nothing_is_excused = format!("check device.txt --known {baseline}");
        tess_in(&folder, &nothing_is_excused).exits(1);
        tess_in(&folder, &format!("verify --backend simd --random 2 --known {baseline}")).exits(0);
    }
}
