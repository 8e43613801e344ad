//! `tess probe` on the first Vulkan device, which the tests have: exit codes and forms of the report.

use crate::support::{directory, tess};

const FEW: &str = "--level 3 --seed 3 --count 200";

#[test]
fn devices_are_listed() {
    let run = tess("probe --list");
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.starts_with("0: "), "{}", run.stdout);
}

#[test]
fn an_equal_device_ends_with_0() {
    let run = tess(&format!("probe {FEW} --denormals flush"));
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("equal: all "), "{}", run.stderr);
    assert!(run.stdout.contains("in order"), "{}", run.stdout);
}

#[test]
fn reports_are_json_on_request() {
    let file = directory("probe-json").join("report.json");
    let run = tess(&format!("probe {FEW} --denormals flush --json -o {}", file.display()));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let text = std::fs::read_to_string(file).expect("it was written");
    let report: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
    assert_eq!(report["different"], 0, "{text}");
    assert_eq!(report["patches"].as_u64(), Some(200), "{text}");
    assert_eq!(report["rows"][0]["set_digest"].as_str().map(str::len), Some(16), "{text}");
}

#[test]
fn what_cannot_be_done_is_said() {
    let run = tess("probe --device 1000");
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    assert!(run.stderr.contains("there is no Vulkan device 1000"), "{}", run.stderr);
    let run = tess("probe --level 3 --count 0");
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("select no case"), "{}", run.stderr);
    assert_eq!(tess("probe --level 4").code, Some(2), "there are three levels");
    let run = tess("probe --bench --workload nothing");
    assert_eq!(run.code, Some(2), "{}", run.stderr);
}
