//! Tests that the model reproduces every recorded result of `golden/`, bit for bit; without
//! `--include-ignored`, every seventh.

use std::collections::BTreeSet;
use std::path::PathBuf;
use tess_verify::check::{Mismatch, SecondFormulation, Tested, check};
use tess_verify::vectors::{Kind, VectorFile};
use tess_verify::{Backend, Case, CoreBackend};

/// All vector files that exist.
const FILES: [(&str, Kind, u64); 8] = [
    ("cases.txt", Kind::Listings, 51),
    ("patches.csv", Kind::Patches, 4000),
    ("corners.csv", Kind::Patches, 1552),
    ("sweep.csv", Kind::Sweep, 640),
    ("uniform.csv", Kind::Uniform, 792),
    ("place.csv", Kind::Locations, 252),
    ("factor.csv", Kind::Factors, 40),
    ("hlsl.csv", Kind::Preparation, 3000),
];

fn folder() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../golden"))
}

/// Which records of a file are checked.
#[derive(Clone, Copy)]
enum Extent {
    /// Every seventh. The files count through lists of 2, 3, 4 and more values; a step that shares
    /// no factor with their lengths meets every value of each.
    Seventh,
    All,
}

/// The text of a file, and its number of records, reduced to those that are checked.
fn excerpt(name: &str, count: u64, extent: Extent) -> (String, u64) {
    let text = std::fs::read_to_string(folder().join(name)).expect("the file is there");
    let [header, columns, rows @ ..] = &text.lines().collect::<Vec<_>>()[..] else {
        panic!("{name} has a header and columns")
    };
    let step = match extent {
        Extent::Seventh => 7,
        Extent::All => return (text, count),
    };
    let kept: Vec<&str> = rows.iter().copied().step_by(step).collect();
    let [before, after] = [format!("count={count} "), format!("count={} ", kept.len())];
    assert!(header.contains(&before), "{name} has {count} records: {header}");
    let header = header.replace(&before, &after);
    (format!("{header}\n{columns}\n{}\n", kept.join("\n")), kept.len() as u64)
}

/// Checks the file of this name against its entry in [`FILES`].
fn check_file(name: &str, extent: Extent) {
    let (_, kind, count) = FILES.into_iter().find(|(file, ..)| *file == name).expect("listed");
    let (text, count) = excerpt(name, count, extent);
    let file = VectorFile::new(name, text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((file.header().kind, file.header().count), (kind, Some(count)), "{name}");
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut backends: Vec<Box<dyn Backend>> = Vec::new();
    backends.resize_with(threads, || Box::new(CoreBackend));
    let report = check(file, &mut backends, Tested::Backend, &|_| ())
        .unwrap_or_else(|error| panic!("{error}"));
    let differences: Vec<_> = report
        .differences
        .iter()
        .map(|d| format!("{d}\n{}\n", between_formulations(d.case)))
        .collect();
    assert_eq!(report.mismatches, 0, "{name}: {report}\n{}", differences.concat());
    assert_eq!(report.cases, count, "{name}: all cases were checked");
}

/// Where the model's two formulations differ, which helps to continue from a digest that differs.
fn between_formulations(case: Option<Case>) -> String {
    let Some(case) = case else { return String::new() };
    let mut other = SecondFormulation;
    let by_number = other.tessellate(case.config, &[case.factors]).expect("the model runs");
    match Mismatch::between(&case, &case.patch().tessellate(), &by_number[0]) {
        Some(first) => format!("  in sequence, where by number it is as expected: {first}"),
        None => "  both formulations agree: factors, contexts, places and rows are what they share"
            .into(),
    }
}

#[test]
fn the_folder_holds_these_files_alone() {
    let entries = std::fs::read_dir(folder()).expect("golden/ is there");
    let found: BTreeSet<String> = entries
        .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
        .collect();
    let files = FILES.iter().map(|(name, ..)| *name);
    // The outputs of devices, which `tools/probe` checks.
    let expected = files.chain(["README.md", "devices"]).map(str::to_owned);
    assert_eq!(found, expected.collect(), "entries of golden/");
}

/// The recorded listings, each of another kind.
#[test]
fn cases() {
    check_file("cases.txt", Extent::All);
}

/// The other files: some of their records, and all.
macro_rules! files {
    ($($test:ident of $name:literal)*) => {
        mod some {
            $(#[test]
            fn $test() {
                super::check_file($name, super::Extent::Seventh);
            })*
        }

        mod all {
            $(#[test]
            #[ignore = "slow: all recorded results"]
            fn $test() {
                super::check_file($name, super::Extent::All);
            })*
        }
    };
}

files! {
    patches of "patches.csv"
    corners of "corners.csv"
    sweep of "sweep.csv"
    uniform of "uniform.csv"
    place of "place.csv"
    factor of "factor.csv"
    hlsl of "hlsl.csv"
}
