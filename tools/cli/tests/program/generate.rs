//! Tests of `tess gen`: `tess check` and Verilog read its formats, and its shards add up to the
//! whole.

use crate::support::{command, directory, tess, tess_with_input};
use std::fs;

const PLACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden/place.csv");

/// Both text formats can be checked, and a changed number is detected.
#[test]
fn vectors_can_be_checked() {
    for format in ["csv", "listing"] {
        let vectors = tess(&format!("gen --level 3 --seed 7 --count 60 --format {format}"));
        vectors.exits(0);
        tess_with_input("check -", &vectors.stdout).exits(0);
        let wrong = with_last_digit_changed(&vectors.stdout);
        tess_with_input("check -", &wrong).exits(1); // the fault is detected
        let again = tess(&format!("gen --level 3 --seed 7 --count 60 --format {format}"));
        assert_eq!(vectors.stdout, again.stdout, "the same arguments, the same bytes");
        let other = tess(&format!("gen --level 3 --seed 8 --count 60 --format {format}"));
        assert_ne!(vectors.stdout, other.stdout, "another seed");
    }
}

/// The last digit belongs to an index in a listing, and to a digest in CSV.
fn with_last_digit_changed(vectors: &str) -> String {
    let at = vectors.rfind(|c: char| c.is_ascii_digit()).expect("there are numbers");
    let other = if vectors[at..].starts_with('0') { "1" } else { "0" };
    [&vectors[..at], other, &vectors[at + 1..]].concat()
}

#[test]
fn shards_are_the_whole() {
    let cases = |words: &str| {
        let run = tess(&format!("gen --level 3 --count 50 --domain tri {words}"));
        run.exits(0);
        let lines = run.stdout.lines().filter(|line| line.starts_with("tri,"));
        let mut lines: Vec<String> = lines.map(str::to_owned).collect();
        lines.sort();
        lines
    };
    let mut parts = [1, 2, 3].map(|part| cases(&format!("--shard {part}/3"))).concat();
    parts.sort();
    let whole = cases("");
    assert_eq!(whole.len(), 50, "cases");
    assert_eq!(parts, whole, "each case in one part");
}

#[test]
fn memory_images_and_coverage() {
    let folder = directory("memh");
    let out = folder.join("vectors");
    let images = format!("gen --level 3 --count 30 --format readmemh -o {}", out.display());
    tess(&images).exits(0);
    for (file, words) in [("cases.memh", 30), ("factors.memh", 30)] {
        let text = fs::read_to_string(out.join(file)).expect("an image");
        let lines = text.lines().filter(|line| !line.starts_with("//") && !line.is_empty());
        assert_eq!(lines.count(), words, "{file}");
    }
    let sizes = fs::read_to_string(out.join("sizes.svh")).expect("sizes");
    assert!(sizes.contains("TESS_CASES 30"), "{sizes}");
    tess("gen --level 3 --count 30 --coverage").exits(0).prints("transition");
    tess("gen --shard 9/3").exits(2); // no such part
    tess("gen --level 4").exits(2); // no such level
    tess("gen --format readmemh").exits(2); // images need a folder
}

/// Two shards merged into one file cover the same patches as the whole, and so does a check of the
/// vectors, in the same order.
#[test]
fn coverage_files_merge() {
    let folder = directory("coverage");
    let file = |name: &str| folder.join(name).display().to_string();
    let of = |what: &str, name: &str| {
        let run = tess(&format!("{what} --coverage {}", file(name)));
        run.exits(0);
        run.stdout
    };
    let cases = "gen --level 3 --count 60";
    of(&format!("{cases} --shard 1/2"), "shards.xml");
    let merged = of(&format!("{cases} --shard 2/2"), "shards.xml");
    let report = tess(&format!("coverage {}", file("shards.xml"))).stdout;
    assert_eq!(merged, report, "the report of the sum");
    of(cases, "whole.xml");
    let vectors = file("vectors.csv");
    tess(&format!("{cases} -o {vectors}")).exits(0);
    of(&format!("check {vectors}"), "checked.xml");
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect("a coverage file");
    let whole = read("whole.xml");
    assert!(whole.contains("<coverpoint name=\"transition\""), "bins: {whole:.400}");
    assert_eq!(read("checked.xml"), whole, "one stream");
    // Everything except the group of sequences, which depends on the order of the stream.
    let patches = |text: &str| {
        let (before, sequences) =
            text.split_once("<coverpoint name=\"sequence\"").expect("a group");
        let (_, after) = sequences.split_once("</coverpoint>").expect("its end");
        [before.to_owned(), after.to_owned()]
    };
    assert_eq!(patches(&read("shards.xml")), patches(&whole), "the same patches");
    assert_ne!(read("shards.xml"), whole, "other sequences");
    of(&format!("{cases} --seed 2"), "other.xml");
    assert_ne!(read("whole.xml"), read("other.xml"), "other cases hit other bins");
    // Not a coverage file.
    tess(&format!("{cases} --coverage {vectors}")).exits(2).says("vectors.csv: line 1: ");
    let run = tess(&format!("check {} --coverage {}", PLACE, file("x.xml")));
    run.exits(2).says("this file's kind is locations"); // no patches
}

/// Each process adds its hits to those of the others.
#[test]
#[ignore = "slow: many runs of the program"]
fn no_hit_is_lost() {
    let folder = directory("no_hit_is_lost");
    let file = |name: &str| folder.join(name).display().to_string();
    let words = |seed: u32, file: &str| {
        format!("gen --level 3 --domain tri --count 40 --seed {seed} --coverage {file}")
    };
    for seed in 1..=12 {
        tess(&words(seed, &file("one.xml"))).exits(0);
    }
    let together = (1..=12).map(|seed| {
        let mut tess = command(&words(seed, &file("all.xml")));
        tess.stdout(std::process::Stdio::null()).spawn().expect("tess starts")
    });
    for mut process in together.collect::<Vec<_>>() {
        assert!(process.wait().expect("it ends").success(), "every one adds");
    }
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect("a coverage file");
    assert!(read("one.xml") == read("all.xml"), "the same hits as one after another");
    let mut left: Vec<_> = fs::read_dir(&folder)
        .expect("the folder")
        .map(|entry| entry.expect("a file").file_name())
        .filter(|name| !cfg!(windows) || !name.to_string_lossy().ends_with(".lock"))
        .collect();
    left.sort();
    assert_eq!(left, ["all.xml", "one.xml"], "nothing else is left");
}

/// The first line states every option that the cases depend on, so that the file can be made again
/// from it.
#[test]
fn headers_say_how_a_file_is_made() {
    let options = "--level 3 --seed 7 --count 40 --domain tri --partitioning pow2 --shard 2/3";
    let run = tess(&format!("gen {options}"));
    let header = run.stdout.lines().next().expect("a header");
    let notes = "source=tess-core level=3 level-version=5 seed=7 random=40 domain=tri partitioning=pow2 shard=2/3";
    assert_eq!(header, format!("# tess-vectors 1 kind=patches count=13 {notes}"), "{options}");
    let noted: Vec<String> = header
        .split(' ')
        .skip(6)
        .filter(|note| !note.starts_with("level-version="))
        .map(|note| format!("--{}", note.replace("random", "count").replacen('=', " ", 1)))
        .collect();
    assert_eq!(tess(&format!("gen {}", noted.join(" "))).stdout, run.stdout, "the same again");
    let header = tess("gen --level 3 --count 1").stdout;
    assert!(header.contains(" random=1\n"), "no other option: {header}");
}

/// A shard without cases is not an error, as in `tess verify`: the other shards have them.
#[test]
fn a_shard_without_cases() {
    let run = tess("gen --level 3 --count 2 --shard 5/9");
    assert_eq!(run.stderr, "tess: no case in shard 5/9\n", "it is said");
    run.exits(0); // a file without records
    assert!(run.stdout.starts_with("# tess-vectors 1 kind=patches count=0 "), "{}", run.stdout);
    tess_with_input("check -", &run.stdout).exits(2).prints_nothing();
    let folder = directory("empty-shard");
    let asked = folder.join("asked.csv");
    fs::write(&asked, &run.stdout).expect("written");
    let options = format!("check - --cases {}", asked.display());
    tess_with_input(&options, &run.stdout).exits(2); // no case was asked
    tess("gen --level 3 --count 0 --shard 5/9").exits(2); // no shard has any
    tess("gen --level 3 --count 0").exits(2); // no case at all
}

/// Vectors of single stages: the same bytes for the same arguments, in both forms, for one block of
/// a circuit.
#[test]
fn vectors_of_single_stages() {
    for stage in ["factors", "context", "place", "stitch"] {
        let options = format!("gen --stage {stage} --level 3 --seed 3 --count 40");
        let csv = tess(&options);
        csv.exits(0);
        let [first, columns] = [0, 1].map(|line| csv.stdout.lines().nth(line).expect("a line"));
        let rows = csv.stdout.lines().count() - 2;
        assert!(
            first.starts_with(&format!("# tess-stage 1 stage={stage} count={rows}: ")),
            "{first}"
        );
        assert!(rows > 20 && columns.contains(','), "{rows} rows of {columns}");
        assert_eq!(tess(&options).stdout, csv.stdout, "the same again");
        let image = tess(&format!("{options} --format readmemh")).stdout;
        assert_eq!(image.lines().filter(|line| !line.starts_with("//")).count(), rows, "{stage}");
    }
    tess("gen --stage place --format listing").exits(2); // no such form
    tess("gen --stage places").exits(2); // no such stage
}
