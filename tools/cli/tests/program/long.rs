//! Tests of commands that run for a long time: they stop when their reader exits, and leave nothing
//! half-written when a signal ends them.

use crate::support::{command, directory};
use std::fs;
use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};

/// More cases than can be generated one by one within the time of a test.
const ENDLESS: &str = "gen --level 3 --count 1000000000000";

fn start(words: &str) -> Child {
    let mut command = command(words);
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("tess starts")
}

/// Sends a signal, named as for `kill`.
fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status();
    assert!(sent.expect("there is kill").success(), "{signal} is sent");
}

/// If it did not notice that the reader is gone, it would not end within the time of a test.
#[test]
fn it_stops_when_the_reader_leaves() {
    let mut child = start(ENDLESS);
    let mut out = child.stdout.take().expect("stdout is piped");
    out.read_exact(&mut [0; 10]).expect("it begins at once");
    drop(out);
    assert_eq!(child.wait().expect("it ends").code(), Some(141));
    let mut said = String::new();
    child.stderr.take().expect("stderr is piped").read_to_string(&mut said).expect("text");
    assert!(!said.contains("cannot write"), "quietly, not {said}");
}

#[test]
fn interrupted_files_leave_nothing() {
    let folder = directory("interrupted_files_leave_nothing");
    // Again and again: a file may be made, or one more in a folder, just while the others go.
    let signals = [("INT", 2), ("TERM", 15)].into_iter().cycle().take(16);
    for (signal, number) in signals {
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

/// A closing terminal. The test itself may run where that signal is ignored, so that the program
/// gets back its default.
#[cfg(target_os = "linux")]
#[test]
fn a_closing_terminal_leaves_nothing() {
    let folder = directory("a_closing_terminal_leaves_nothing");
    let words = format!("{ENDLESS} -o {}", folder.join("out").display());
    let mut command = Command::new("env");
    command.args(["--default-signal=HUP", env!("CARGO_BIN_EXE_tess")]).args(words.split(' '));
    let mut child = command.spawn().expect("there is env");
    while fs::read_dir(&folder).expect("the folder").next().is_none() {
        assert!(child.try_wait().expect("a child").is_none(), "it goes on");
        std::thread::yield_now();
    }
    send("HUP", &child);
    assert_eq!(child.wait().expect("it ends").signal(), Some(1), "it ends as HUP ends programs");
    assert_eq!(fs::read_dir(&folder).expect("the folder").count(), 0, "nothing is left");
}

/// A background job that should survive the end of its terminal does so.
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

/// A bar is shown on a terminal and nowhere else. `script` gives the program a terminal.
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
