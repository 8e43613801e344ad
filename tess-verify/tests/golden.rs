//! Tests that the model reproduces every recorded result of `golden/`, bit for bit.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufReader;
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

/// Checks the file of this name against its entry in [`FILES`].
fn check_file(name: &str) {
    let (_, kind, count) = FILES.into_iter().find(|(file, ..)| *file == name).expect("listed");
    let reader = BufReader::new(File::open(folder().join(name)).expect("the file is there"));
    let file = VectorFile::new(name, reader).unwrap_or_else(|error| panic!("{error}"));
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

#[test]
fn cases() {
    check_file("cases.txt");
}

#[test]
fn patches() {
    check_file("patches.csv");
}

#[test]
fn corners() {
    check_file("corners.csv");
}

#[test]
fn sweep() {
    check_file("sweep.csv");
}

#[test]
fn uniform() {
    check_file("uniform.csv");
}

#[test]
fn place() {
    check_file("place.csv");
}

#[test]
fn factor() {
    check_file("factor.csv");
}

#[test]
fn hlsl() {
    check_file("hlsl.csv");
}
