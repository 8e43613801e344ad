//! Tests of `tess merge`: the reports that form one campaign, the text that is printed, that the
//! result is certain, and the time that it takes.

use crate::campaigns::{campaign, json, tess_in};
use crate::support::{Run, directory, shell, tess_with_input};
use serde_json::{Value, json as value};
use std::fs;
use std::time::{Duration, Instant};

/// The report of a shard that another program has written, with some entries of its own. It does
/// not say which cases it saw, so that a campaign of such reports ends with 1 at best.
fn report(shard: u64, shards: u64, own: Value) -> String {
    let mut report = value!({
        "format": "tess-report 2", "version": "1", "commit": "abc", "command": "device",
        "words": ["device", "--report", format!("r{shard}.jsonl")], "options": {}, "shard": shard,
        "shards": shards, "state": "done", "cases": 2, "mismatches": 0, "milliseconds": 1,
    });
    let Value::Object(own) = own else { panic!("an object: {own}") };
    own.into_iter().for_each(|(key, value)| report[key] = value);
    report.to_string() + "\n"
}

fn merged(reports: &[String]) -> Run {
    tess_with_input("merge -", &reports.concat())
}

/// Options are compared value by value.
#[test]
fn joined_values_are_other_values() {
    let of =
        |shard, domains: &[&str]| report(shard, 2, value!({ "options": { "domain": domains } }));
    let run = merged(&[of(1, &["tri,quad"]), of(2, &["tri", "quad"])]);
    run.exits(2).prints(r#"the option domain is ["tri", "quad"]; in stdin:1 it is ["tri,quad"]"#);
    let of = |shard, options: Value| report(shard, 2, value!({ "options": options }));
    let run =
        merged(&[of(1, value!({ "a": ["1 b=2"] })), of(2, value!({ "a": ["1"], "b": ["2"] }))]);
    run.exits(2);
    let run = merged(&[of(1, value!({ "a": ["1 a=2"] })), of(2, value!({ "a": ["1", "2"] }))]);
    run.exits(2).prints(r#"the option a is ["1", "2"]; in stdin:1 it is ["1 a=2"]"#);
    merged(&[of(1, value!({ "a": ["1"] })), of(2, value!({ "a": ["1"] }))])
        .exits(1)
        .prints("\nthe cases were not compared: stdin:1 does not say which it saw; ");
}

/// Baselines of one name must have the same cases; a shard may have a baseline of its own.
#[test]
fn baselines_are_compared() {
    let of = |shard, file: &str, digest: &str| {
        let known =
            value!({ "file": file, "digest": digest, "entries": 3, "different": 1, "gone": [] });
        report(shard, 3, value!({ "known": known }))
    };
    let run = merged(&[of(1, "k", "0a"), of(2, "k", "0b"), of(3, "k", "0a")]);
    run.exits(2);
    let why =
        "stdin:2 is of another campaign: the lines of k have the digest 0b; elsewhere it is 0a";
    run.prints(why);
    let run = merged(&[of(1, "k1", "0a"), of(2, "k2", "0b"), of(3, "k3", "0a")]);
    run.exits(1).prints("known differences: 3 of 6 cases of 2 baselines occur\n");
    let run = merged(&[of(1, "k", "0a"), of(2, "k", "0a"), report(3, 3, value!({}))]);
    run.exits(2).prints("stdin:3 is of another campaign: the baseline is not given");
}

/// The digest depends on the cases only, not on their order or on remarks.
#[test]
fn baselines_by_their_cases() {
    let folder = directory("baselines_by_their_cases");
    let lines = ["40000000", "40400000"]
        .map(|factor| format!("case isoline integer line ruler 3f800000 {factor}\n"));
    let baselines =
        [lines.concat(), format!("# remark\n{}{}", lines[1], lines[0]), lines[0].clone()];
    let digest = |text: &String| {
        fs::write(folder.join("k.txt"), text).expect("written");
        let run =
            tess_in(&folder, "verify --backend simd --random 1 --known k.txt --report r.jsonl");
        run.exits(0);
        let report = json(&folder.join("r.jsonl"));
        assert_eq!(report["known"]["file"], "k.txt", "{report}");
        report["known"]["digest"].as_str().expect("text").to_owned()
    };
    let digests = baselines.each_ref().map(digest);
    assert_eq!(digests[0], digests[1], "the same cases");
    assert_ne!(digests[0], digests[2], "fewer cases");
}

/// Every shard is in the `JUnit` file, however many are missing.
#[test]
fn every_fault_is_listed() {
    let folder = directory("every_fault_is_listed");
    fs::write(folder.join("r.jsonl"), report(7, 500, value!({}))).expect("written");
    let run = tess_in(&folder, "merge r.jsonl --junit s.xml");
    run.exits(2);
    let xml = fs::read_to_string(folder.join("s.xml")).expect("JUnit");
    assert!(xml.contains("tests=\"501\" failures=\"1\" errors=\"499\""), "{}", &xml[..300]);
    assert!(!xml.contains("\"></error>") && !xml.contains("\"></failure>"), "each has a body");
    assert_eq!(run.stdout.matches(" is missing\n").count(), 499, "in the text, too");
}

/// A word that a shell would take apart is quoted.
#[test]
fn the_command_of_a_report_is_shown() {
    let words = value!(["tess", "check", "a b.txt", "--report", "it's"]);
    let run = merged(&[report(1, 3, value!({ "words": words }))]);
    let shown = r"shard 1/3 was:
  # tess check 'a b.txt' --report 'it'\''s'
";
    run.exits(2).prints(shown);
}

/// Sums do not wrap around.
#[test]
fn sums_end_at_the_largest_number() {
    let half = 1u64 << 63;
    let part = value!([{ "name": "p", "cases": half, "mismatches": 0 }]);
    let of = |shard| report(shard, 2, value!({ "cases": half, "parts": part }));
    let run = merged(&[of(1), of(2)]);
    run.exits(1);
    let shown = |name: &str| {
        let line = run.stdout.lines().find(|line| line.starts_with(name)).expect("a row");
        line.split_whitespace().nth(1).expect("a number").to_owned()
    };
    assert_eq!([shown("p "), shown("all ")], [u64::MAX.to_string(), u64::MAX.to_string()]);
}

/// The times of all shards, and the differences by stage, are added up.
#[test]
fn times_and_stages_are_added_up() {
    let of = |shard, stages: Value| {
        let own = value!({ "mismatches": 2, "milliseconds": 700, "stages": stages });
        report(shard, 2, own)
    };
    let run =
        merged(&[of(1, value!({ "location": 2 })), of(2, value!({ "answer": 1, "location": 1 }))]);
    run.exits(1).prints("stage answer: 1\nstage location: 3\n");
    run.prints("4 cases, 4 mismatches, 1.400 s of all shards\n");
}

/// Ten times as many shards take no more than about ten times as long, in one file or in many.
#[test]
#[ignore = "slow: thousands of shards"]
fn the_time_grows_with_the_shards_alone() {
    let folder = directory("the_time_grows_with_the_shards_alone");
    let time = |shards: u64| -> Duration {
        // Each with a part of its own.
        let part = |shard| value!([{ "name": format!("p{shard}"), "cases": 2, "mismatches": 0 }]);
        let one = |shard| report(shard, shards, value!({ "parts": part(shard) }));
        let all: String = (1..=shards).map(one).collect();
        fs::write(folder.join("all"), all).expect("written");
        let times = (0..3).map(|_| {
            let start = Instant::now();
            tess_in(&folder, "merge all --junit s.xml").exits(1);
            start.elapsed()
        });
        times.min().expect("three")
    };
    let (few, many) = (time(2000), time(20_000));
    assert!(many < 25 * few, "{many:?} is far more than ten times {few:?}");
}

/// More files than file descriptors; each is still distinguished from the outputs.
#[test]
fn many_files() {
    let folder = directory("many_files");
    let name = |shard: u64| folder.join(format!("r{shard}"));
    for shard in 1..=2000 {
        fs::write(name(shard), report(shard, 2000, value!({}))).expect("written");
    }
    shell("ulimit -n 64; $TESS merge r* --junit s.xml", &folder).exits(1);
    shell("ulimit -n 64; $TESS merge r* --junit r1", &folder).exits(2).says("are the same file");
    assert!(fs::read_to_string(name(1)).is_ok_and(|text| text.starts_with('{')), "it is kept");
}

/// A baseline that is the checked file itself would excuse everything, so it is refused.
#[test]
fn files_do_not_excuse_themselves() {
    let folder = directory("files_do_not_excuse_themselves");
    let made = "$TESS gen --level 3 --count 5 --format listing -o a.txt && ln -s a.txt link && ln a.txt hard \
                && cp a.txt copy.txt && cp a.txt d.txt";
    shell(made, &folder).exits(0);
    for command in [
        "check a.txt --known a.txt",
        "check a.txt --known link",
        "check hard --known ./a.txt",
        "check - --known a.txt < a.txt",
        "check d.txt --cases a.txt --known link",
    ] {
        let run = shell(&format!("$TESS {command}"), &folder);
        run.exits(2).says("itself: every difference would be known");
    }
    tess_in(&folder, "check a.txt --known copy.txt").exits(0); // another file
}

/// The failing records are in the order of the file, whichever thread finds them first.
#[test]
fn failures_are_in_the_order_of_the_file() {
    let folder = directory("failures_are_in_the_order_of_the_file");
    let right = "gen --level 3 --count 3000 --domain isoline --format csv -o right.csv";
    tess_in(&folder, right).exits(0);
    let text = fs::read_to_string(folder.join("right.csv")).expect("vectors");
    let (head, rows): (Vec<&str>, Vec<&str>) =
        (text.lines().take(2).collect(), text.lines().skip(2).collect());
    let wrong: Vec<String> =
        rows.iter().map(|row| row[..row.len() - 16].to_owned() + "0123456789abcdef").collect();
    let file = format!("{}\n{}\n", head.join("\n"), wrong.join("\n"));
    fs::write(folder.join("wrong.csv"), file).expect("written");
    for _ in 0..3 {
        tess_in(&folder, "check wrong.csv --failures f.csv").exits(1);
        let failures = fs::read_to_string(folder.join("f.csv")).expect("failures");
        let found: Vec<&str> = failures.lines().skip(2).take(wrong.len()).collect();
        assert!(found == wrong, "each in its place");
    }
}

/// A variable that is not text is a shard that cannot be read, not the absence of a shard.
#[test]
fn variables_that_are_no_text() {
    let folder = directory("variables_that_are_no_text");
    for variable in
        ["TEST_SHARD_INDEX", "TEST_TOTAL_SHARDS", "SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"]
    {
        let script = format!("export {variable}=$(printf '1\\377'); $TESS gen --level 3 --count 2");
        shell(&script, &folder).exits(2).prints_nothing().says("which is not a number");
    }
}

/// A file of patterns is limited in size, and a repeated pattern costs no time.
#[test]
fn long_exclusions() {
    let folder = directory("long_exclusions");
    campaign(&folder);
    let run = tess_in(&folder, "coverage c1.xml --exclude /dev/zero");
    run.exits(2).says("cannot read /dev/zero: it has more than ");
    let time = |lines: usize| {
        fs::write(folder.join("x.txt"), "*\n".repeat(lines)).expect("written");
        let start = Instant::now();
        tess_in(&folder, "coverage c1.xml --exclude x.txt").exits(0);
        start.elapsed()
    };
    let (once, often) = (time(1), time(20_000));
    assert!(often < 10 * once, "{often:?} for equal lines, {once:?} for one");
}
