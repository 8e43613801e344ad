//! Tests of `tess bench`: the keys that it prints, and its errors. No time is asserted.

use crate::support::tess;
use serde_json::Value;

const KEYS: [&str; 11] = [
    "workload",
    "backend",
    "level",
    "working_set",
    "threads",
    "index_type",
    "patches_per_s",
    "triangles_per_s",
    "bytes_per_s",
    "fill_ratio",
    "core_ratio",
];

#[test]
fn json_has_exactly_the_documented_keys() {
    let words = "bench --workload uniform-2 --workload seed-table/quad-16 \
                 --working-set cache --samples 1 --json";
    let run = tess(words);
    run.exits(0);
    let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let rows = json.as_array().expect("an array");
    assert_eq!(rows.len(), 2, "one row for each workload");
    for row in rows {
        let keys: Vec<_> = row.as_object().expect("an object").keys().collect();
        let mut expected = KEYS.to_vec();
        expected.sort_unstable();
        assert_eq!(keys, expected, "{row}");
        for rate in &KEYS[6..] {
            assert!(row[rate].as_f64().is_some_and(|rate| rate > 0.0), "{rate} of {row}");
        }
    }
}

#[test]
fn bad_options_say_what_would_be_right() {
    let cases = [
        ("bench --workload uniform-3", "uniform-64"),
        ("bench --threads 0", "1..=1024"),
        ("bench --threads 2", "one thread"),
        ("bench --cpu-level avx2", "--backend simd"),
        ("bench --backend simd --cpu-level avx1024", "avx512"),
        ("bench --index-type u8", "[possible values: u16, u32]"),
        ("bench --working-set ram", "stream"),
        ("bench --frame 8", "--backend simd"),
        ("bench --backend simd --frame 0", "1..=1024"),
    ];
    for (words, remedy) in cases {
        tess(words).exits(2).says(remedy);
    }
}

/// A workload is repeated as frames until one call produces their output, and what is timed is
/// still compared with the model.
#[test]
fn frames() {
    let words = "bench --backend simd --workload uniform-2 --working-set cache --samples 1 --json";
    let run = tess(&format!("{words} --frame 2 --threads 2"));
    run.exits(0);
    let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(json[0]["workload"], "uniform-2, frames of 2 MiB", "{json}");
    let run = tess(&format!("{} --frame 2", words.replace("uniform-2", "single/uniform-1")));
    run.says("its calls have their size: no --frame");
    assert_ne!(run.code, Some(0), "{}", run.stdout);
}
