//! Tests of `tess probe` on the first Vulkan device, which the tests require: exit codes and
//! formats of the report.

use crate::support::{directory, tess};

const FEW: &str = "--level 3 --seed 3 --count 200";

#[test]
fn devices_are_listed() {
    let run = tess("probe --list");
    run.exits(0);
    assert!(run.stdout.starts_with("0: "), "{}", run.stdout);
}

#[test]
fn an_equal_device_ends_with_0() {
    tess(&format!("probe {FEW} --denormals flush")).exits(0).says("equal: all ").prints("in order");
}

#[test]
fn reports_are_json_on_request() {
    let folder = directory("probe-json");
    let file = folder.join("report.json");
    tess(&format!("probe {FEW} --denormals flush --json -o {}", file.display())).exits(0);
    let text = std::fs::read_to_string(file).expect("it was written");
    let report: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
    assert_eq!(report["different"], 0, "{text}");
    assert_eq!(report["patches"].as_u64(), Some(200), "{text}");
    assert_eq!(report["rows"][0]["set_digest"].as_str().map(str::len), Some(16), "{text}");
}

/// A shard without cases is done, as with other commands, so that its campaign can be complete.
#[test]
fn shards_without_cases_are_done() {
    let folder = directory("shards_without_cases_are_done");
    let words = "probe --level 3 --count 1 --domain tri --denormals flush";
    let run = |shard: u64| {
        let place = folder.join(format!("r{shard}.jsonl"));
        tess(&format!("{words} --shard {shard}/2 --report {}", place.display()))
    };
    let runs = [1, 2].map(run);
    for run in &runs {
        run.exits(0);
    }
    assert!(runs[1].stderr.contains("tess: no case in shard 2/2\n"), "{}", runs[1].stderr);
    let [one, two] = [1, 2].map(|shard| folder.join(format!("r{shard}.jsonl")));
    let merged = tess(&format!("merge {} {}", one.display(), two.display()));
    merged.exits(0).prints("2 of 2 shards ran once: 1 cases");
}

/// An output that cannot be written is refused before the device is used, which does not exist
/// here.
#[test]
fn outputs_are_tried_first() {
    for (option, why) in [
        ("--picture first.jpg", "name it .svg, .png"),
        ("--picture /nowhere/first.png", "cannot write /nowhere/first.png"),
        ("-o /nowhere/report.txt", "cannot write /nowhere/report.txt"),
    ] {
        tess(&format!("probe --device 1000 {option}")).exits(2).says(why);
    }
}

/// For a manifest that it cannot read, the loader reports that memory is short.
#[cfg(target_os = "linux")]
#[test]
fn a_malformed_manifest_is_said() {
    let folder = directory("a_malformed_manifest_is_said");
    let manifest = folder.join("icd.json");
    std::fs::write(&manifest, "{ this is no JSON").expect("written");
    let path = manifest.to_str().expect("text");
    let variables = [("VK_DRIVER_FILES", path), ("VK_ICD_FILENAMES", path)];
    let run = crate::support::tess_with_environment("probe --list", &variables);
    run.exits(3).prints_nothing().says("manifest").says("driver");
}

#[test]
fn what_cannot_be_done_is_said() {
    tess("probe --device 1000").exits(3).says("there is no Vulkan device 1000");
    tess("probe --level 3 --count 0").exits(2).says("select no case");
    tess("probe --level 4").exits(2); // there are only three levels
    tess("probe --bench --workload nothing").exits(2);
}
