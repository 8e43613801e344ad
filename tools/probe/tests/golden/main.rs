//! Compares captures of devices in `golden/devices` with the current model.

mod level;

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;
use tess_core::Partitioning;
use tess_probe::{Digests, asked, cases};
use tess_verify::check::flushed;
use tess_verify::generate::{GenLevel, Selection, Shard};
use tess_verify::{Case, Named};

/// Domain, partitioning and output.
type Names = (String, String, String);

fn recorded() -> Vec<(PathBuf, Value)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden/devices");
    let entries = std::fs::read_dir(folder).expect("it is there").map(|e| e.expect("read").path());
    let files = entries.filter(|path| path.extension().is_some_and(|e| e == "json"));
    files
        .map(|path| {
            let text = std::fs::read_to_string(&path).expect("it can be read");
            let report = serde_json::from_str(&text).expect("it is JSON");
            (path, report)
        })
        .collect()
}

/// The cases that a recorded device was asked: level 1; for the first devices, its first version.
fn asked_of(report: &Value) -> Vec<Case> {
    let first = asked(level::cases());
    if report["patches"] == first.len() {
        return first;
    }
    cases(Selection::level(GenLevel::One, 1), Shard::WHOLE)
}

/// The model's digests and numbers of patches for the cases that a device was asked, with the
/// device's freedom and with `fault`.
fn model(report: &Value, fault: impl Fn(&Case, &mut Vec<u32>)) -> BTreeMap<Names, (u64, Digests)> {
    let flush = is_flushing(report);
    let mut all = BTreeMap::<Names, (u64, Digests)>::new();
    for case in asked_of(report) {
        let names =
            [case.domain().name(), case.config.partitioning.name(), case.config.output.name()];
        let [domain, partitioning, output] = names.map(str::to_owned);
        // The factors of pow2 are rounded before a device receives them, so none is denormal.
        let flush = flush && case.config.partitioning != Partitioning::Pow2;
        let asked = flushed(&case).filter(|_| flush).unwrap_or(case);
        let mut whole = asked.patch().tessellate();
        fault(&case, &mut whole.indices);
        let (patches, digests) = all.entry((domain, partitioning, output)).or_default();
        *patches += 1;
        digests.add(&whole, case.primitive_size());
    }
    all
}

fn is_flushing(report: &Value) -> bool {
    let explanations = report["explanations"].as_array().expect("a list");
    explanations.iter().any(|one| one["way"] == "flush" && one["is_all"] == true)
}

/// The configurations that differ.
fn differing(report: &Value, model: &BTreeMap<Names, (u64, Digests)>) -> Vec<Names> {
    let rows = report["rows"].as_array().expect("a list");
    assert_eq!(rows.len(), model.len(), "every configuration");
    let text = |row: &Value, key: &str| row[key].as_str().expect("text").to_owned();
    let names = |row: &Value| (text(row, "domain"), text(row, "partitioning"), text(row, "output"));
    let differs = |row: &&Value| {
        let (patches, digests) = &model[&names(row)];
        let number = |key: &str| row[key].as_u64().expect("a number");
        let in_order = number("sequence") + number("culling") == *patches;
        number("patches") != *patches
            || row["set_digest"] != digests.set()
            || (in_order && row["sequence_digest"] != digests.sequence())
    };
    rows.iter().filter(differs).map(names).collect()
}

#[test]
fn the_model_is_what_devices_gave() {
    let recorded = recorded();
    assert!(recorded.len() >= 2, "lavapipe and an H200 are recorded");
    for (path, report) in &recorded {
        assert_eq!(report["unexplained"]["patches"], 0, "{}", path.display());
        let model = model(report, |_, _| {});
        assert_eq!(differing(report, &model), vec![], "{}", path.display());
    }
}

/// A reversed triangle of one patch, and a lost one, are detected.
#[test]
fn a_change_of_the_model_is_seen() {
    let (_, report) = recorded().remove(0);
    let line = "case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000";
    let changed: Case = line.parse().expect("a case");
    let turned = model(&report, |case, indices| {
        if *case == changed {
            indices.swap(0, 1);
        }
    });
    let names = ["tri", "integer", "triangle_cw"].map(str::to_owned);
    let [domain, partitioning, output] = names;
    assert_eq!(differing(&report, &turned), vec![(domain, partitioning, output)]);
}
