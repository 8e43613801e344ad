//! Tests that the files of an earlier run are never taken for results of a run that ends early, and
//! that a command line that is not understood touches none of them.

use crate::campaigns::{json, tess_in};
use crate::support::{Folder, Run, directory, shell, tess};
use std::fs;
use std::path::Path;

/// The trusted outputs, each by its option with a name and what an earlier run may have left in it.
const OLD: [(&str, &str, &str); 4] = [
    ("--report", "r.jsonl", "{\"format\":\"tess-report 2\",\"state\":\"done\"}\n"),
    (
        "--junit",
        "r.xml",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tess\" tests=\"19\"/>\n",
    ),
    ("--failures", "f.txt", "# tess-vectors 1 kind=listings source=yesterday\n# end\n"),
    (
        "--merged",
        "m.xml",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<UCIS ucisVersion=\"1.0\"></UCIS>\n",
    ),
];

/// The options of these outputs as words.
fn options(names: &[&str]) -> String {
    let named = OLD.iter().filter(|(option, ..)| names.contains(option));
    named.map(|(option, name, _)| format!(" {option} {name}")).collect()
}

fn prepare(folder: &Path) {
    for (_, name, old) in OLD {
        fs::write(folder.join(name), old).expect("written");
    }
}

/// Runs a script that ends early, in which `$TESS` is the program, and checks that nothing looks
/// like its result.
fn left_nothing(folder: &Folder, script: &str, names: &[&str]) -> Run {
    prepare(folder);
    let run = shell(script, folder);
    assert_ne!(run.code, Some(0), "{script}: {}{}", run.stdout, run.stderr);
    for (_, name, old) in OLD.iter().filter(|(option, ..)| names.contains(option)) {
        let left = fs::read_to_string(folder.join(name)).unwrap_or_default();
        let is_result = left.contains("done") || left.contains("tests=\"19\"") || left == *old;
        assert!(!is_result, "{script}: {name} is yesterday's: {left}{}", run.stderr);
    }
    run
}

const RUN: [&str; 2] = ["--report", "--junit"];
const CHECK: [&str; 3] = ["--report", "--junit", "--failures"];

#[test]
fn runs_that_end_early() {
    let folder = directory("runs_that_end_early");
    let listing =
        "$TESS patch tri --outer 2,2,2 --inner 2 -o e.txt && sed -n /^case/p e.txt > a.txt";
    shell(listing, &folder).exits(0);
    let check = [
        "false | $TESS check - --cases a.txt",
        "$TESS check missing.txt",
        "echo Segmentation fault | $TESS check -",
        "$TESS check e.txt --known missing.txt",
        "$TESS check e.txt --cases missing.txt",
        "TEST_SHARD_INDEX=0 $TESS check e.txt",
        "TEST_TOTAL_SHARDS=2 TEST_SHARD_INDEX=0 JOB_COMPLETION_INDEX=1 TESS_SHARDS=2 $TESS check e.txt",
        "sed 's/^10000 00000/10000 00001/' e.txt | $TESS check - --coverage missing/c.xml",
    ];
    for command in check {
        left_nothing(&folder, &format!("{command}{}", options(&CHECK)), &CHECK);
    }
    let mut others = vec![
        "$TESS gen --level 3 --count 0",
        "$TESS gen --level 3 --count 1 -o missing/a.csv",
        "$TESS gen --level 3 --count 90000 > /dev/full",
        "$TESS verify --backend simd --known missing.txt",
        "SLURM_ARRAY_TASK_ID=1 $TESS verify --backend simd --random 1",
    ];
    if cfg!(feature = "gpu") {
        others.push("export VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent WGPU_BACKEND=vulkan; $TESS verify --backend gpu");
    }
    if cfg!(feature = "probe") {
        others.push("$TESS probe --device 1000");
        others.push("$TESS probe --known missing.txt");
        others.push("$TESS probe --picture first.jpg");
    }
    for command in others {
        left_nothing(&folder, &format!("{command}{}", options(&RUN)), &RUN);
    }
    left_nothing(&folder, "$TESS check missing.txt --report=r.jsonl --junit=r.xml", &RUN);
    let script = "ln -s r.jsonl link; $TESS check missing.txt --report link";
    left_nothing(&folder, script, &["--report"]);
}

/// Checks that every file is as [`prepare`] left it.
#[track_caller]
fn unchanged(folder: &Path, command: &str) {
    for (_, name, old) in OLD {
        let now = fs::read_to_string(folder.join(name));
        assert_eq!(now.ok().as_deref(), Some(old), "{command}: {name}");
    }
}

/// Until the command line is understood, nothing is touched.
#[test]
fn command_lines_that_are_not_understood() {
    let folder = directory("command_lines_that_are_not_understood");
    shell("$TESS patch tri --outer 2,2,2 --inner 2 -o e.txt", &folder).exits(0);
    shell("$TESS gen --level 3 --count 1 --coverage c.xml", &folder).exits(0);
    fs::write(folder.join("out"), "result").expect("written");
    let coverage = fs::read(folder.join("c.xml")).expect("coverage");
    let (run, check) = (options(&RUN), options(&CHECK));
    let others = " --coverage c.xml -o out";
    for command in [
        format!("check e.txt --nonsense{check} --coverage c.xml"),
        format!("check e.txt{check} --coverage c.xml --order sideways"),
        format!("check{check}"),
        format!("check e.txt{run} --failures"),
        format!("check e.txt e.txt{check}"),
        format!("chekc e.txt{check}"),
        format!("check e.txt --backend simd --cpu-level sse9{run}"),
        format!("check e.txt{run} --failures ./r.jsonl"),
        format!("check e.txt{check} --known e.txt"),
        format!("check e.txt{check} --backend core --order any"),
        format!("gen --level 4{run}{others}"),
        format!("gen --level 3 --count 1{run} --nonsense -o out"),
        format!("gen --level 3 --count 1{run} -o r.xml"),
        format!("verify --backend simd --random 0{run}"),
        format!("verify --nonsense{run}"),
        format!("verify --backend core --cpu-level avx2 --random 1{run}"),
        format!("merge --nonsense r.jsonl{}", options(&["--junit"])),
        "merge r.xml --junit r.xml".to_owned(),
        format!("coverage --nonsense c.xml{} -o out", options(&["--merged"])),
        format!("coverage c.xml c.xml{} -o out", options(&["--merged"])),
        format!("probe --device x{run}{others} --picture out"),
        "patch tri --nonsense -o out".to_owned(),
        "draw tri --outer 1,1,1 --inner 1 --nonsense -o out".to_owned(),
        "mesh --factor x -o out".to_owned(),
        "explain tri --outer 1,1,1 --inner 1 --nonsense -o out".to_owned(),
    ] {
        if command.starts_with("probe") && !cfg!(feature = "probe") {
            continue;
        }
        prepare(&folder);
        tess_in(&folder, &command).exits(2);
        unchanged(&folder, &command);
        let others = [("out", &b"result"[..]), ("c.xml", &coverage)];
        for (name, before) in others {
            assert!(
                fs::read(folder.join(name)).is_ok_and(|now| now == before),
                "{command}: {name}"
            );
        }
    }
}

/// While a run waits for a device's first line, and after it is killed there, its files say so.
#[test]
fn waiting_for_the_first_line() {
    let folder = directory("waiting_for_the_first_line");
    let options = options(&CHECK);
    for (signal, state) in [("TERM", "interrupted"), ("KILL", "running")] {
        let script = format!(
            "rm -f device; mkfifo device; $TESS check device{options} & p=$!\n\
             i=0; while ! grep -q running r.xml && [ $i -lt 200 ]; do sleep 0.05; i=$((i + 1)); done\n\
             cp r.jsonl waiting.jsonl; kill -s {signal} $p; wait $p; exit 1"
        );
        left_nothing(&folder, &script, &CHECK);
        let waiting = json(&folder.join("waiting.jsonl"));
        assert_eq!(waiting["state"], "running", "{signal}: {waiting}");
        let report = json(&folder.join("r.jsonl"));
        assert_eq!(report["state"], state, "{signal}: {report}");
        let xml = fs::read_to_string(folder.join("r.xml")).expect("JUnit");
        assert!(xml.contains(" errors=\"1\" "), "{signal}: {xml}");
    }
}

/// A run that is killed while it works has not ended for those who read its report.
#[test]
fn killed_runs_are_not_merged() {
    let folder = directory("killed_runs_are_not_merged");
    let script = format!(
        "rm -f rows; $TESS verify --backend simd --exhaustive{} > rows & p=$!\n\
         while ! grep -qs ^level-1 rows; do sleep 0.05; done; kill -s KILL $p; wait $p",
        options(&RUN)
    );
    left_nothing(&folder, &script, &RUN);
    let run = tess_in(&folder, "merge r.jsonl");
    run.exits(2).prints("shard 1/1 has not ended: it still runs, or was killed (r.jsonl)\n");
}

#[test]
fn sums_that_cannot_be_made() {
    let folder = directory("sums_that_cannot_be_made");
    const MERGE: [&str; 1] = ["--junit"];
    const COVERAGE: [&str; 1] = ["--merged"];
    for (text, code) in [("{}\n", 2), ("", 2)] {
        fs::write(folder.join("bad"), text).expect("written");
        for (command, names) in [("merge", &MERGE[..]), ("coverage", &COVERAGE)] {
            for file in ["bad", "missing"] {
                let run = left_nothing(
                    &folder,
                    &format!("$TESS {command} {file}{}", options(names)),
                    names,
                );
                run.exits(code);
            }
        }
    }
}

/// One typo away from `--report /etc/fstab`: a file of another kind is kept, and the run says so at
/// once.
#[test]
fn what_is_another_file_is_kept() {
    let folder = directory("what_is_another_file_is_kept");
    let listing = tess("patch tri --outer 2,2,2 --inner 2").stdout;
    fs::write(folder.join("e.txt"), &listing).expect("written");
    for (command, option) in [
        ("check e.txt", "--report"),
        ("gen --level 3 --count 1", "--report"),
        ("verify --backend simd --random 1", "--junit"),
        ("check e.txt", "--junit"),
        ("check e.txt", "--failures"),
        ("merge r.jsonl", "--junit"),
        ("coverage c.xml", "--merged"),
    ] {
        for text in [
            "thesis\n",
            "{\"a\": 1}\n",
            "<?xml version=\"1.0\"?>\n<svg/>\n",
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"mine\"/>\n",
            "\u{feff}\n",
        ] {
            fs::write(folder.join("mine"), text).expect("written");
            let run = tess_in(&folder, &format!("{command} {option} mine"));
            let left = fs::read_to_string(folder.join("mine")).expect("it is there");
            assert_eq!((run.code, left.as_str()), (Some(2), text), "{command}: {}", run.stderr);
            let said = format!("{option} mine exists and is not a ");
            run.says(&said);
            assert_eq!(run.stdout, "", "{command} {option}");
        }
    }
    // The other outputs are as they were, too.
    prepare(&folder);
    fs::write(folder.join("mine"), "thesis\n").expect("written");
    tess_in(&folder, "check e.txt --report mine --junit r.xml --failures f.txt").exits(2);
    unchanged(&folder, "the report is another file");
    // An empty file, as `mktemp` makes it, may be overwritten.
    fs::write(folder.join("mine"), "").expect("written");
    tess_in(&folder, "check e.txt --report mine").exits(0);
    let before = fs::read(folder.join("mine")).expect("a report");
    tess_in(&folder, "check e.txt --report mine --help").exits(0);
    assert!(fs::read(folder.join("mine")).is_ok_and(|now| now == before), "help removes nothing");
}

/// A file that the command reads is no earlier result, whichever way it is named.
#[test]
fn what_is_read_is_kept() {
    let folder = directory("what_is_read_is_kept");
    shell("$TESS gen --level 3 --count 2 --format listing -o f.txt", &folder).exits(0);
    let before = fs::read(folder.join("f.txt")).expect("vectors");
    for command in [
        "check f.txt --failures f.txt",
        "check ./f.txt --failures=f.txt",
        "check - --failures f.txt < f.txt",
        "check --failures f.txt -- f.txt",
        "check other.txt --cases=f.txt --failures f.txt",
        "check missing.txt --failures f.txt > f.txt",
    ] {
        shell(&format!("$TESS {command}"), &folder).exits(2);
        let now = fs::read(folder.join("f.txt"));
        let is_there = now.is_ok_and(|now| now == before || command.contains("> f.txt"));
        assert!(is_there, "{command}");
        fs::write(folder.join("f.txt"), &before).expect("written");
    }
}

/// After `--` come files, not options.
#[test]
fn what_follows_two_dashes_is_read() {
    let folder = directory("what_follows_two_dashes_is_read");
    prepare(&folder);
    let run = shell("$TESS merge missing.jsonl -- --junit r.xml", &folder);
    run.exits(2);
    assert!(folder.join("r.xml").exists(), "{}", run.stderr);
}

/// Several runs write the same report at the same time: each finds it, or finds that another run
/// has removed it.
#[test]
#[ignore = "slow: many runs of the program"]
fn runs_into_one_report_at_once() {
    let folder = directory("runs_into_one_report_at_once");
    let one = "$TESS gen --level 3 --count 1 --report r.jsonl > /dev/null || touch failed";
    let script = format!("for i in $(seq 40); do ({one}) & ({one}) & ({one}) & wait; done");
    shell(&script, &folder).exits(0).says_nothing();
    assert!(!folder.join("failed").exists(), "each ended with 0");
}
