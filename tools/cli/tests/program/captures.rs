//! Tests of `tess gen`, `check` and `patch` with the cases that a device was asked, and with its
//! wrong answers.

use crate::support::{directory, tess, tess_with_input};
use std::fs::{read_to_string, write};

const TRI: &str = "case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000";
const QUAD: &str =
    "case quad integer triangle_cw ruler 40400000 40400000 40400000 40400000 40400000 40400000";

#[test]
fn filters_select_configurations() {
    let all = "gen --level 1 --domain quad --partitioning integer --count 40";
    let cases = |words: &str| {
        let run = tess(&format!("{all} {words}"));
        run.exits(0);
        let rows = run.stdout.lines().filter(|line| line.starts_with("quad,integer,"));
        rows.map(str::to_owned).collect::<Vec<_>>()
    };
    let (whole, some) = (cases(""), cases("--output line --split center"));
    assert!(some.len() > 60 && some.len() < whole.len(), "{} of {}", some.len(), whole.len());
    assert!(some.iter().all(|row| row.starts_with("quad,integer,line,center,")), "{some:?}");
    // A selection has a level of its own, which asks more of its configurations than the level of a
    // wider selection does.
    let chosen = whole.iter().filter(|row| row.starts_with("quad,integer,line,center,"));
    assert!(chosen.count() < some.len(), "everything is asked of the one configuration");
    let header = tess(&format!("{all} --output line --split center")).stdout;
    assert!(
        header.lines().next().is_some_and(|h| h.ends_with("output=line split=center")),
        "noted"
    );
}

#[test]
fn a_device_that_repeats_one_case_does_not_pass() {
    let folder = directory("asked");
    let asked = folder.join("asked.txt");
    write(&asked, format!("{TRI}\n{QUAD}\n")).expect("written");
    let right = tess(&format!("patch --cases {}", asked.display()));
    right.exits(0);
    let check =
        |listings: &str| tess_with_input(&format!("check - --cases {}", asked.display()), listings);
    check(&right.stdout).exits(0).prints_only("2 cases, 0 mismatches\n");
    let (header, body) = right.stdout.split_once('\n').expect("a header");
    let (first, _) = body.split_once("case quad").expect("two cases");
    let run = check(&format!("{header}\n{first}{first}# end\n"));
    run.exits(1).prints(format!("observed {TRI}, expected {QUAD}"));
    let run = check(&format!("{header}\n{first}# end\n"));
    run.exits(1).prints(format!("record 2 is missing: {QUAD}"));
    tess_with_input("check - --cases /nowhere", &right.stdout).exits(2);
}

#[test]
fn failing_records_are_kept_and_can_be_asked_again() {
    let folder = directory("failures");
    let [device, failing] = ["device.txt", "failing.txt"].map(|name| folder.join(name));
    let right = tess_with_input("patch --cases -", &format!("{TRI}\n{QUAD}\n{TRI}\n")).stdout;
    let wrong = right.replacen("\n10000 10000\n", "\n10000 0ffff\n", 1);
    assert_ne!(right, wrong, "a fault is planted in the quad");
    write(&device, &wrong).expect("written");
    let (device, failing) = (device.display(), failing.display());
    let run = tess(&format!("check {device} --order any --failures {failing}"));
    run.exits(1);
    run.prints("point (10000, 0ffff): observed 1 times (but point (10000, 10000) 0 times, not 1)");
    let kept = read_to_string(failing.to_string()).expect("a file");
    assert!(kept.contains(QUAD) && !kept.contains(TRI) && kept.ends_with("end\n# end\n"), "{kept}");
    tess(&format!("check {failing}")).exits(1).prints("1 cases, 1 mismatches");
    let asked = tess(&format!("patch --cases {failing}"));
    assert_eq!(asked.stdout.matches("\ncase ").count(), 1, "{}", asked.stdout);
    tess_with_input("check -", &asked.stdout).exits(0); // the model is right
    tess_with_input(&format!("check - --failures {failing}"), &right).exits(0);
    tess(&format!("check {failing}")).exits(2); // no record is left
    tess_with_input("check - --failures -", &right).exits(2); // not a file
}

/// A record that answers another case wrongly is kept; one that answers its own case correctly is
/// not.
#[test]
fn failing_records_that_answer_other_cases() {
    let folder = directory("astray");
    let [asked, failing] = ["asked.txt", "failing.txt"].map(|name| folder.join(name));
    write(&asked, format!("{QUAD}\n{TRI}\n{TRI}\n")).expect("written");
    let right = tess_with_input("patch --cases -", &format!("{TRI}\n{QUAD}\n")).stdout;
    let wrong = right.replacen("\n10000 10000\n", "\n10000 0ffff\n", 1);
    assert_ne!(right, wrong, "a fault is planted in the quad");
    let (asked, failing) = (asked.display(), failing.display());
    let run = tess_with_input(&format!("check - --cases {asked} --failures {failing}"), &wrong);
    run.exits(1);
    assert!(run.stdout.ends_with("3 cases, 2 mismatches\n"), "{}", run.stdout);
    run.says("1 difference left out of ");
    let kept = read_to_string(failing.to_string()).expect("a file");
    assert!(kept.contains(QUAD) && !kept.contains(TRI), "{kept}");
}

#[test]
fn a_device_that_turns_the_other_way_reads_one_line() {
    let cases = format!("{TRI}\n{QUAD}\n");
    let ccw = cases.replace("triangle_cw", "triangle_ccw");
    let turned =
        tess_with_input("patch --cases -", &ccw).stdout.replace("triangle_ccw", "triangle_cw");
    let run = tess_with_input("check - --order any", &turned);
    run.exits(1);
    run.prints("one mistake explains all 2 differences: every triangle turns the other way\n");
    assert_eq!(run.stdout.matches("\nrecord ").count(), 1, "{}", run.stdout);
    assert!(run.stdout.ends_with("and 1 more\n2 cases, 2 mismatches\n"), "{}", run.stdout);
}

/// An option that would accept every difference is named.
#[test]
fn a_device_that_flushes_denormals_reads_the_option() {
    let listing = "# tess-vectors 1 kind=listings count=1 source=device\n\
                   case tri integer triangle_cw ruler 00000001 40400000 40400000 40400000\n\
                   points 0\nindices 0\nend\n";
    let run = tess_with_input("check - --order any", listing);
    let line = "--denormals flush would accept all 1 difference: positive denormal outer factors";
    run.exits(1).prints(line);
    let run = tess_with_input("check - --order any --denormals flush", listing);
    run.exits(0).prints_only("1 cases, 0 mismatches\n");
}

#[test]
fn captures_by_coordinates() {
    let capture = "# tess-vectors 1 kind=listings source=capture\n\
        case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000\n\
        coordinates float\n0 1 0\n0 0 1\n1 0 0\nend\n# end\n";
    let run = tess_with_input("check - --order sequence", capture);
    run.exits(0).prints_only("1 cases, 0 mismatches\n");
    let run = tess_with_input("check -", &capture.replace("0 0 1", "0 0 0"));
    run.exits(1).prints("third coordinate of vertex 1 of primitive 0");
    for notation in ["hex", "decimal"] {
        tess_with_input("check -", &capture.replace("float", notation)).exits(2).prints_nothing();
    }
}

#[test]
fn a_patch_or_cases() {
    tess("patch tri --outer 1,1,1 --inner 1 --cases x").exits(2).says("--cases");
    for words in ["patch", "patch tri --inner 1"] {
        tess(words).exits(2).says("--outer");
    }
    tess_with_input("patch --cases - --format json", TRI).exits(2).says("--format text");
}

/// Cases are tessellated as they arrive: these would not fit into memory, and never end.
#[cfg(unix)]
#[test]
fn cases_are_not_collected() {
    use std::io::{Read, Write};
    use std::process::Stdio;
    let mut patch = crate::support::command("patch --cases -");
    let patch = patch.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let mut patch = patch.expect("tess starts");
    let mut input = patch.stdin.take().expect("stdin is piped");
    let lines = format!("{QUAD}\n").repeat(1000);
    // It ends when the program does.
    let asking = std::thread::spawn(move || while input.write_all(lines.as_bytes()).is_ok() {});
    let mut output = patch.stdout.take().expect("stdout is piped");
    let mut begun = vec![0; 100_000];
    output.read_exact(&mut begun).expect("listings before the last case");
    drop(output);
    assert_eq!(patch.wait().expect("it ends").code(), Some(141), "the reader left");
    asking.join().expect("the pipe is closed");
}

/// A case that cannot be read leaves the output file unchanged.
#[test]
fn a_wrong_case_writes_no_file() {
    let folder = directory("a_wrong_case_writes_no_file");
    let file = folder.join("right.txt");
    write(&file, "as it was").expect("written");
    let words = format!("patch --cases - -o {}", file.display());
    tess_with_input(&words, &format!("{TRI}\ncase cube\n")).exits(2).says("stdin:2: ");
    assert_eq!(read_to_string(&file).expect("readable"), "as it was");
}

/// Each freedom accepts its own difference, and no other.
#[test]
fn every_freedom_is_used() {
    let listing = |case: &str, right: &str| {
        let right = tess_with_input("patch --cases -", &format!("case {right}\n")).stdout;
        right.replacen(right_of(&right), case, 1)
    };
    let quad = "quad fractional_odd triangle_cw ruler 40a00000 40d00000 40e00000 40500000 40a80000";
    let culled = "tri integer triangle_cw ruler 00000000 40400000 40400000 40400000";
    // A denormal that counts as zero; a factor halfway between two numbers that was converted to
    // the other one; another leading vertex; a triangle that the model does not have.
    let flushed = listing(&culled.replace("00000000", "00000001"), culled);
    let converted = listing(&format!("{quad} 40400020"), &format!("{quad} 40400040"));
    let whole = tess_with_input("patch --cases -", TRI).stdout;
    let turned = whole.replacen("\n0 1 ", "\n1 TURNED 0 ", 1);
    let third = whole.split("\n0 1 ").nth(1).and_then(|rest| rest.split('\n').next());
    let third = third.expect("a first triangle");
    let turned = turned.replacen(&format!("1 TURNED 0 {third}"), &format!("1 {third} 0"), 1);
    let wrong = whole.replacen(&format!("\n0 1 {third}\n"), &format!("\n0 {third} 1\n"), 1);
    let freedoms = ["--denormals flush", "--conversion 0.6ulp", "--order any", "--points"];
    for (number, device) in [flushed, converted, turned, wrong].iter().enumerate() {
        tess_with_input("check -", device).exits(1);
        for (other, freedom) in freedoms.iter().enumerate() {
            // Points have no leading vertex.
            let equal = other == number || (number, other) == (2, 3);
            let run = tess_with_input(&format!("check - {freedom}"), device);
            let code = Some(if equal { 0 } else { 1 });
            assert_eq!(run.code, code, "{freedom}: {device}{}{}", run.stdout, run.stderr);
        }
    }
}

/// The case of a file's first listing.
fn right_of(text: &str) -> &str {
    let line = text.lines().find_map(|line| line.strip_prefix("case "));
    line.expect("a case line")
}
