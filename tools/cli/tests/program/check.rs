//! Tests of `tess check`: exit codes and messages for good, damaged and malformed files of every
//! kind.

use crate::campaigns::json;
use crate::support::{directory, tess, tess_with_input};
use std::fs::{read_to_string, write};
use tess_verify::generate::LEVEL_VERSION;

const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden");

/// The first `rows` rows of a golden file, with a header of that count.
fn excerpt(name: &str, rows: usize) -> String {
    let text = read_to_string(format!("{GOLDEN}/{name}")).expect("readable");
    let (header, rest) = text.split_once('\n').expect("a header");
    let kind = header.split_whitespace().nth(3).expect("a kind");
    let body: Vec<_> = rest.lines().take(rows + 1).collect();
    format!("# tess-vectors 1 {kind} count={rows} source=tess\n{}\n", body.join("\n"))
}

/// A small excerpt of each CSV kind.
fn excerpts() -> Vec<String> {
    ["patches.csv", "corners.csv", "sweep.csv", "uniform.csv", "place.csv", "hlsl.csv"]
        .map(|name| excerpt(name, 3))
        .into_iter()
        .chain([excerpt("factor.csv", 1)])
        .collect()
}

#[test]
fn equal_files() {
    tess(&format!("check {GOLDEN}/cases.txt")).exits(0).prints_only("51 cases, 0 mismatches\n");
    for text in excerpts() {
        let run = tess_with_input("check -", &text);
        run.exits(0);
        assert!(run.stdout.ends_with(" cases, 0 mismatches\n"), "{}", run.stdout);
    }
}

/// A device that fails on every hundredth patch, with the cases of an older level.
#[test]
fn devices_that_keep_something() {
    let listing = tess("patch tri --outer 3,3,3 --inner 3 --output triangle_cw").stdout;
    let (_, right) = listing.split_once('\n').expect("a header");
    let first = right.lines().nth(2).expect("a point");
    let wrong = right.replacen(first, "00000 0ffff", 1);
    let records = (0..500).map(|i| if i % 100 == 49 { &*wrong } else { right });
    let header = "# tess-vectors 1 kind=listings count=500 source=device level=1\n";
    let folder = directory("devices_that_keep_something");
    let file = |name: &str| folder.join(name).display().to_string();
    let words = format!("check - --report {} --junit {}", file("r.jsonl"), file("r.xml"));
    let run = tess_with_input(&words, &(header.to_owned() + &records.collect::<String>()));
    run.exits(1);
    let said = format!(
        "tess: the levels have version 1; this program makes version {LEVEL_VERSION}, so the answers \
         are not compared with what was asked; give --cases\n"
    );
    assert_eq!(run.stderr, said, "what is not compared is said");
    assert_eq!(run.stdout.matches("\n  passes alone: ").count(), 5, "{}", run.stdout);
    let report = json(&folder.join("r.jsonl"));
    let said = (&report["period"], &report["first"]["passes_alone"]);
    assert_eq!(said, (&100.into(), &true.into()), "{report}");
    let xml = read_to_string(file("r.xml")).expect("written");
    let passes = xml.split_once("&#10;passes alone: ").expect("alone").1;
    assert!(
        passes.contains("&#10;the numbers of all records that differ are multiples of 100 "),
        "{xml}"
    );
    tess(&format!("merge {} --junit {}", file("r.jsonl"), file("m.xml"))).exits(1);
    let merged = read_to_string(file("m.xml")).expect("written");
    assert!(merged.contains("differ are multiples of 100 apart"), "{merged}");
    let end = "differ are multiples of 100 apart\n500 cases, 5 mismatches\n";
    assert!(run.stdout.ends_with(end), "{}", run.stdout);
}

/// Changes the last hexadecimal or decimal digit of the last row.
#[test]
fn different_files() {
    for text in excerpts() {
        let text = text.trim_end();
        let last = if text.ends_with('1') { "2" } else { "1" };
        let run = tess_with_input("check -", &format!("{}{last}\n", &text[..text.len() - 1]));
        run.exits(1);
        assert!(run.stdout.ends_with(" cases, 1 mismatches\n"), "{}", run.stdout);
        run.prints("observed ").prints("expected ").prints("stage: "); // the stage
    }
}

/// The printed command reproduces the difference.
#[cfg(unix)]
#[test]
fn differences_can_be_run_again() {
    let text = excerpt("patches.csv", 30).replacen(",435,", ",436,", 1);
    let first = tess_with_input("check -", &text);
    first.exits(1);
    let commands: Vec<_> =
        first.stdout.lines().filter_map(|l| l.trim().strip_prefix("again: ")).collect();
    let [check, patch] = &commands[..] else { panic!("two commands: {}", first.stdout) };
    let run = |command: &str| {
        let command = command.replace("tess check", "\"$TESS\" check");
        let mut shell = std::process::Command::new("sh");
        shell.env("TESS", env!("CARGO_BIN_EXE_tess")).args(["-c", &command]);
        shell.output().expect("a shell")
    };
    let again = run(check);
    assert_eq!(again.status.code(), Some(1), "{check}");
    let again = String::from_utf8_lossy(&again.stdout).into_owned();
    let element = "number of indices: observed 435, expected 436 (stage: counts)";
    assert!(first.stdout.contains(element) && again.contains(element), "{again}");
    tess(patch.strip_prefix("tess ").expect("the program")).prints("\nindices 435\n");
}

#[test]
fn malformed_truncated_surplus_and_empty_files() {
    let directory = directory("check");
    let good = excerpt("patches.csv", 3);
    let lines: Vec<_> = good.lines().collect();
    let truncated = lines[..4].join("\n");
    // The records before the fault are checked.
    for (name, text, before, expected) in [
        ("empty", String::new(), 0, ":1: header: a vector file starts with"),
        ("truncated", truncated, 2, ":5: count: the header announces 3, but the file ends"),
        ("surplus", format!("{good}{}\n", lines[2]), 3, ":6: count: the header announces 3, but"),
        ("hex", good.replacen("ruler,", "ruler,xyz ", 1), 0, ":3: factors_f32_hex: `xyz` is not"),
    ] {
        let path = directory.join(name);
        write(&path, &text).expect("written");
        let from_file = tess(&format!("check {}", path.display()));
        let from_stdin = tess_with_input("check -", &text);
        for (run, source) in [(from_file, path.display().to_string()), (from_stdin, "stdin".into())]
        {
            run.exits(2);
            let message = format!("tess: {source}{expected}");
            assert!(run.stderr.starts_with(&message), "{name}: {} is not {message}", run.stderr);
            let shown = match before {
                0 => String::new(),
                _ => format!(
                    "{before} cases, 0 mismatches before the malformed record; there is no verdict\n"
                ),
            };
            assert_eq!(run.stdout, shown, "{name}");
        }
    }
}

/// A truncated file has no verdict, but the differences before its end are shown.
#[test]
fn a_truncated_file_with_differences_is_malformed() {
    let text = excerpt("patches.csv", 1000).replace(",1", ",2");
    let run = tess_with_input("check -", &text[..text.len() - 200]);
    run.exits(2).prints("observed ");
    let no_verdict = " mismatches before the malformed record; there is no verdict\n";
    assert!(run.stdout.ends_with(no_verdict), "{}", run.stdout);
}

#[test]
fn missing_files_and_wrong_usage() {
    tess("check /nothing/here.csv").exits(2); // no such file
    tess("check").exits(2); // no file given
    tess("check - --backend abacus").exits(2); // no such backend
}

/// Without --backend, listings are the output of a device, whatever name they give: a device may be
/// named like this project, or copy the first line of `tess gen`.
#[test]
fn listings_of_a_device() {
    let patch = tess("patch quad --outer 3,4,5,6 --inner 4,7").stdout;
    for source in ["tess-core", "tesseract-gpu", "rtl"] {
        let device = patch.replacen("source=tess-core", &format!("source={source}"), 1);
        let run = tess_with_input("check -", &device);
        let equal = (Some(0), "1 cases, 0 mismatches\n");
        assert_eq!((run.code, run.stdout.as_str()), equal, "{source}");
        let faulty = device.replacen("\n08000 ", "\n08001 ", 1);
        assert_ne!(device, faulty, "a fault is planted");
        let run = tess_with_input("check -", &faulty);
        run.exits(1);
        assert!(run.stdout.starts_with("tested: stdin; right: the model\n"), "{}", run.stdout);
        run.prints("u: observed 0x08001, expected 0x08000");
        let run = tess_with_input("check - --backend core", &faulty);
        assert!(run.stdout.starts_with("tested: the backend core; right: stdin\n"), "{source}");
        run.prints("u: observed 0x08000, expected 0x08001");
    }
}

/// A point that no primitive uses is detected in any order.
#[test]
fn unused_points_in_any_order() {
    let patch = tess("patch tri --outer 1,1,1 --inner 1").stdout;
    let junk = patch.replacen("points 3\n", "points 4\nfffff 12345\n", 1);
    let moved = junk.replacen("\n0 1 2\n", "\n1 2 3\n", 1);
    assert_ne!(junk, moved, "the triangle is the same");
    let run = tess_with_input("check - --order any", &moved);
    run.exits(1);
    run.prints("point (fffff, 12345): observed 1 times, expected 0 times (stage: location)");
}

/// Neither endless lines nor endless lists fill up the memory.
#[cfg(target_os = "linux")]
#[test]
fn endless_input() {
    let run = tess("check /dev/zero");
    run.exits(2).prints_nothing();
    assert!(
        run.stderr.starts_with("tess: /dev/zero:1: line: longer than the 4096"),
        "{}",
        run.stderr
    );
    let patch = tess("patch tri --outer 1,1,1 --inner 1").stdout;
    let run = tess_with_input("check -", &patch.replacen("points 3", "points 99999999999", 1));
    run.exits(2).says("stdin:3: points: 99999999999 is too many");
}

/// With many differences, each stage and configuration has a line that counts them, and its
/// smallest case is shown.
#[test]
fn many_differences() {
    let text = excerpt("patches.csv", 100);
    let rows = text.lines().enumerate().map(|(i, line)| {
        let cut = line.len() - if i > 1 { 16 } else { 0 };
        line[..cut].to_owned() + if i > 1 { "0123456789abcdef" } else { "" }
    });
    let run = tess_with_input("check -", &rows.collect::<Vec<_>>().join("\n"));
    run.exits(1);
    let counts = run.stdout.lines().filter(|line| line.contains("  stitch  "));
    let counts: Vec<u64> = counts
        .map(|line| line.split_whitespace().next().expect("a count").parse().expect("a number"))
        .collect();
    assert_eq!(counts.iter().sum::<u64>(), 100, "all are counted: {}", run.stdout);
    let shown = counts.len().min(20);
    assert_eq!(run.stdout.matches("\nrecord ").count(), shown, "{}", run.stdout);
    let ending = format!("\nand {} more\n100 cases, 100 mismatches\n", 100 - shown);
    assert!(run.stdout.ends_with(&ending), "{}", run.stdout);
}

/// A malformed answer ends the check, but the differences before it are still shown.
#[test]
fn malformed_answers() {
    let folder = directory("malformed-answers");
    let quad =
        "case quad integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000 3f800000 3f800000";
    let right = tess_with_input("patch --cases -", &format!("{quad}\n")).stdout;
    let wrong = right.replacen("00000 10000", "00000 10001", 1).replace(" count=1", "");
    assert_ne!(wrong, right, "a fault is planted");
    let wrong = wrong.trim_end_matches("# end\n");
    let file = format!("{wrong}{quad}\npoints 0\nindices 24579\n");
    let report = folder.join("r.jsonl");
    let run = tess_with_input(&format!("check - --report {}", report.display()), &file);
    run.exits(2).prints("1 cases, 1 mismatches before the malformed record; there is no verdict\n");
    run.prints("point 3 v: observed 0x10001, expected 0x10000");
    run.says("indices: ").says("(record 2, from line ").says(quad);
    let report = read_to_string(report).expect("a report");
    assert!(
        report.contains("\"state\":\"failed\"") && report.contains("\"mismatches\":1"),
        "{report}"
    );
    let run = tess_with_input("check - --rules d3d11", &file);
    run.exits(2).prints("1 records before the malformed record; there is no verdict\n");
}
