//! Tests of coverage files, which must be regular files, and of the reports of `tess coverage`.

use crate::support::{directory, shell};
use std::fs;

/// A file that could fill up the memory, or block forever, is refused.
#[test]
fn other_than_coverage_files() {
    let folder = directory("other_than_coverage_files");
    let setup = "mkfifo pipe; truncate -s 3G large.xml; printf '\\377' > bytes.xml; mkdir folder";
    shell(setup, &folder).exits(0);
    for (file, why) in [
        ("/dev/zero", "is not a regular file"),
        ("pipe", "is not a regular file"),
        ("folder", "is not a regular file"),
        ("-", "is not a regular file"),
        ("large.xml", "large.xml: line 1: not a coverage file"),
        ("bytes.xml", "bytes.xml: line 1: not a coverage file"),
        ("/nowhere/a.xml", "cannot write /nowhere/a.xml"),
    ] {
        let script = format!("ulimit -v 2000000; $TESS gen --level 3 --count 1 --coverage {file}");
        let run = shell(&script, &folder);
        run.exits(2).prints_nothing();
        assert!(run.stderr.contains(why) && run.stderr.len() < 500, "{file}: {}", run.stderr);
    }
}

/// The columns of the table line of a group.
fn row(report: &str, group: &str) -> Vec<String> {
    let is_it = |line: &&str| line.split_whitespace().nth(1) == Some(group);
    let row = report.lines().find(is_it).unwrap_or_default();
    row.split_whitespace().skip(2).map(str::to_owned).collect()
}

/// A device that has quads in one configuration only: the bins that it cannot hit are excluded, and
/// level 1 hits all others.
#[test]
fn what_a_device_cannot_hit_is_excluded() {
    let folder = directory("what_a_device_cannot_hit_is_excluded");
    let of = "--domain quad --partitioning integer --output triangle_cw";
    let run = shell(&format!("$TESS gen --level 1 {of} --coverage one.xml"), &folder);
    run.exits(0);
    assert_eq!(row(&run.stdout, "configuration"), ["96", "2", "94", "100.0"], "{}", run.stdout);
    assert_eq!(row(&run.stdout, "transition"), ["8064", "8064", "0", "100.0"], "{}", run.stdout);
    assert_eq!(row(&run.stdout, "exceptional"), ["6", "0", "6", "-"], "{}", run.stdout);
    let again = shell(&format!("$TESS coverage one.xml {of}"), &folder);
    assert_eq!((again.code, &again.stdout), (Some(0), &run.stdout), "{}", again.stderr);
    let two = shell(&format!("$TESS coverage one.xml {of},line"), &folder);
    assert_eq!(row(&two.stdout, "configuration"), ["96", "2", "92", "50.0"], "{}", two.stdout);
    let all = shell("$TESS coverage one.xml", &folder);
    assert_eq!(row(&all.stdout, "configuration"), ["96", "2", "0", "2.0"], "{}", all.stdout);
    let other = shell("$TESS gen --level 3 --count 1 --domain tri --coverage one.xml", &folder);
    assert_eq!(row(&other.stdout, "transition")[1], "8064", "hits of before are no exclusions");
    let configurations = row(&other.stdout, "configuration");
    assert_eq!(configurations, ["96", "3", "62", "8.8"], "two of before, one of 32");
}

#[test]
#[ignore = "slow: many runs of the program"]
fn files_are_added_up_and_reported() {
    let folder = directory("files_are_added_up_and_reported");
    let run = shell(
        "for i in ruler center; do
             $TESS gen --level 1 --split $i --coverage $i.xml > /dev/null
             $TESS gen --level 1 --split $i --coverage both.xml > /dev/null
         done
         # No patch of one run comes after a patch of the other.
         printf 'sequence/split/%s\n' ruler/center center/ruler > no.txt
         $TESS coverage ruler.xml - --merged sum.xml --exclude no.txt --complete < center.xml > sum.txt &&
             cmp sum.xml both.xml && tail -n 1 sum.txt; $TESS coverage sum.xml --complete > /dev/null",
        &folder,
    );
    run.exits(1); // without the exclusions
    assert!(run.stdout.starts_with("all") && run.stdout.ends_with(" 100.0\n"), "{}", run.stdout);
}

/// `--complete` is for batches: only holes and wrong exclusions end with exit code 1.
#[test]
fn completeness() {
    let folder = directory("completeness");
    let made = shell(
        "$TESS gen --level 1 --domain tri --coverage tri.xml; printf 'middle # all\n*/quad\n*/*/quad' > no.txt",
        &folder,
    );
    made.exits(0);
    for (words, code, why) in [
        ("", 0, ""),
        ("--complete", 1, ""),
        ("--domain quad", 0, "hit though excluded"),
        ("--exclude no.txt", 0, "8 bins hit though excluded"),
        ("--exclude no.txt --complete", 1, "8 bins hit though excluded"),
    ] {
        let run = shell(&format!("$TESS coverage tri.xml {words}"), &folder);
        run.exits(code).says(why).prints("\nmissed ");
    }
    let run = shell("$TESS coverage tri.xml --exclude no.txt | grep ^missed.*/quad/", &folder);
    assert_eq!(run.stdout, "", "quads are excluded by name");
}

#[test]
fn bad_coverage_files_are_refused() {
    let folder = directory("bad_coverage_files_are_refused");
    let made = shell(
        "$TESS gen --level 3 --count 1 --coverage a.xml; ln a.xml b.xml; echo midle > no.txt",
        &folder,
    );
    made.exits(0);
    for (words, why) in [
        ("", "required"),
        ("c.xml", "cannot read c.xml"),
        ("no.txt", "no.txt: line 1: not a coverage file"),
        ("a.xml a.xml", "a.xml is given twice"),
        ("a.xml b.xml", "b.xml is given twice"),
        ("a.xml --exclude no.txt", "--exclude no.txt: line 1: no bin begins with `midle`"),
        ("a.xml --merged a.xml", "are the same file"),
        ("a.xml --merged c.xml -o c.xml", "are the same file"),
        ("a.xml --merged /nowhere/a.xml", "cannot write /nowhere/a.xml"),
        ("a.xml --domain cube", "cube"),
    ] {
        shell(&format!("$TESS coverage {words}"), &folder).exits(2).prints_nothing().says(why);
    }
    assert_eq!(fs::read_dir(&folder).expect("the folder").count(), 3, "nothing is written");
}
