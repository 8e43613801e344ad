//! Commands that work for a long time: they stop when their reader leaves, and when a signal ends
//! them they leave nothing half-written and keep what they have printed.

use crate::support::{command, directory};
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, ChildStdout, Command, Stdio};

/// More cases than can be counted one by one while a test runs.
const ENDLESS: &str = "gen --level 3 --count 1000000000000";

fn start(words: &str) -> Child {
    let mut command = command(words);
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("tess starts")
}

fn stdout(child: &mut Child) -> BufReader<ChildStdout> {
    BufReader::new(child.stdout.take().expect("stdout is piped"))
}

/// The signals that end a program, as `kill` names them, with their numbers. A background job of a
/// script ignores INT, and so does what it starts; then INT is not among them.
fn ending_signals() -> Vec<(&'static str, i32)> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.map_or(0, |mask| u64::from_str_radix(mask.trim(), 16).expect("a mask"));
    let mut signals = Vec::from([("INT", 2), ("TERM", 15), ("HUP", 1)]);
    signals.retain(|(_, number)| ignored >> (number - 1) & 1 == 0);
    assert!(signals.contains(&("TERM", 15)), "nothing ignores TERM: {ignored:x}");
    signals
}

/// Sends a signal as `kill` names it.
fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status();
    assert!(sent.expect("there is kill").success(), "{signal} is sent");
}

fn stderr(child: &mut Child) -> String {
    let mut text = String::new();
    child.stderr.take().expect("stderr is piped").read_to_string(&mut text).expect("text");
    text
}

/// Without the reader, none of these would end in a test's time.
#[test]
fn they_stop_when_the_reader_leaves() {
    for words in [
        ENDLESS,
        "gen --level 3 --count 1000000000000 --coverage",
        "verify --backend simd --random 1000000000",
        "bench --samples 1000",
    ] {
        let mut child = start(words);
        let mut begun = [0; 10];
        let mut out = stdout(&mut child);
        if words == ENDLESS {
            out.read_exact(&mut begun).expect("it begins at once");
        }
        drop(out);
        let ended = child.wait().expect("it ends");
        assert_eq!(ended.code(), Some(141), "{words}");
        let said = stderr(&mut child);
        assert!(!said.contains("cannot write"), "{words}: quietly, not {said}");
    }
}

#[test]
fn interrupted_files_leave_nothing() {
    let folder = directory("interrupted_files_leave_nothing");
    for (signal, number) in ending_signals() {
        for form in ["csv", "readmemh"] {
            let out = folder.join("out");
            let mut child = start(&format!("{ENDLESS} --format {form} -o {}", out.display()));
            while fs::read_dir(&folder).expect("the folder").next().is_none() {
                assert!(child.try_wait().expect("a child").is_none(), "{form}: it goes on");
                std::thread::yield_now();
            }
            send(signal, &child);
            let ended = child.wait().expect("it ends");
            assert_eq!(ended.signal(), Some(number), "{form}: it ends as {signal} ends programs");
            let left = fs::read_dir(&folder).expect("the folder").count();
            assert_eq!(left, 0, "{form}, {signal}: nothing is left");
        }
    }
}

/// A background job that is to survive the end of its terminal does.
#[test]
fn ignored_signals_stay_ignored() {
    let folder = directory("ignored_signals_stay_ignored");
    let words = format!("{ENDLESS} -o {}", folder.join("out").display());
    let mut shell = Command::new("sh");
    let script = format!("trap '' HUP; exec {} {words}", env!("CARGO_BIN_EXE_tess"));
    let mut child = shell.args(["-c", &script]).spawn().expect("a shell");
    while fs::read_dir(&folder).expect("the folder").next().is_none() {
        std::thread::yield_now();
    }
    send("HUP", &child);
    send("TERM", &child);
    assert_eq!(child.wait().expect("it ends").signal(), Some(15), "HUP did not end it");
}

/// What was measured before the signal is there, and what was not is named.
#[test]
fn interrupted_rows_are_kept() {
    let mut child = start("bench --working-set cache --samples 50 --json");
    let mut out = stdout(&mut child);
    let mut text = String::new();
    while !text.ends_with("\n  }") && !text.ends_with("\n  }\n") {
        let mut byte = [0];
        out.read_exact(&mut byte).expect("a first row");
        text.push(char::from(byte[0]));
    }
    let (signal, number) = ending_signals()[0];
    send(signal, &child);
    out.read_to_string(&mut text).expect("the rest");
    assert_eq!(child.wait().expect("it ends").signal(), Some(number), "as {signal} ends programs");
    let json: Value = serde_json::from_str(&text).expect("whole JSON");
    let rows = json.as_array().map_or(0, Vec::len);
    assert!(rows > 0, "{text}");
    let said = stderr(&mut child);
    assert!(said.contains("interrupted; left out: "), "{said}");
    assert_eq!(said.matches(", cache").count() + rows, all_workloads(), "{said}");

    let mut child = start("verify --backend simd --exhaustive");
    let mut out = stdout(&mut child);
    let mut line = String::new();
    while !line.starts_with("level-1") {
        line.clear();
        assert_ne!(out.read_line(&mut line).expect("a line"), 0, "a first row");
    }
    send("TERM", &child);
    assert_eq!(child.wait().expect("it ends").signal(), Some(15), "as TERM ends programs");
    let said = stderr(&mut child);
    assert!(said.contains("left out: ") && said.contains("factors"), "{said}");
    assert!(!said.contains("level-1"), "{said}");
}

fn all_workloads() -> usize {
    tess_verify::generate::Workload::all().len()
}

/// On a terminal there is a bar; elsewhere there is none. `script` gives the program a terminal.
#[test]
fn progress_is_shown_on_terminals() {
    let folder = directory("progress_is_shown_on_terminals");
    let file = folder.join("level-1.txt");
    let gen_level_1 = format!("gen --level 1 -o {}", file.display());
    for words in [gen_level_1.as_str(), "verify --backend simd --random 1000"] {
        let program = format!("{} {words}", env!("CARGO_BIN_EXE_tess"));
        let terminal = Command::new("script")
            .args(["-qec", &program, "/dev/null"])
            .stdin(Stdio::null())
            .output()
            .expect("there is `script`, of Debian's bsdutils");
        assert!(terminal.status.success(), "{words}");
        let shown = String::from_utf8_lossy(&terminal.stdout);
        assert!(shown.contains(['█', '░']), "`{words}` on a terminal: {shown}");
        let piped = command(words).output().expect("tess starts");
        let [out, err] =
            [piped.stdout, piped.stderr].map(|b| String::from_utf8_lossy(&b).into_owned());
        assert!(!(out + &err).contains(['█', '░']), "`{words}` into a pipe");
    }
}
