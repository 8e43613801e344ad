//! Faults planted in the seeds of mesh files, the same in every run.

use serde_json::{Value, json};

/// Variants of a seed of one target.
pub(crate) fn of(target: &str, seed: &[u8]) -> Vec<Vec<u8>> {
    let mut variants = of_bytes(seed);
    if target == "gltf" {
        variants.extend(of_json(seed));
    }
    variants
}

/// Changed, missing and repeated bytes, and truncated files.
fn of_bytes(seed: &[u8]) -> Vec<Vec<u8>> {
    let mut variants = Vec::new();
    let step = (seed.len() / 60).max(1);
    for at in (0..seed.len()).step_by(step) {
        let (before, after) = seed.split_at(at);
        for byte in [0, b'-', b'9', b'/', b'\n', 0x80, 0xFF, after[0] ^ 1] {
            variants.push([before, &[byte], &after[1..]].concat());
        }
        variants.push(before.to_vec());
        variants.push([before, &after[1..]].concat());
        variants.push([before, &after[..after.len().min(9)], after].concat());
    }
    variants
}

/// Every value of a document replaced by each of these, and removed.
fn of_json(seed: &[u8]) -> Vec<Vec<u8>> {
    let Ok(document) = serde_json::from_slice::<Value>(seed) else { return Vec::new() };
    let numbers = [0, 1, 2, 3, 4, 5, 7, 255, 5120, 5121, 5122, 5123, 5124, 5125, 5126];
    let mut values: Vec<Value> = numbers.iter().map(|number| json!(number)).collect();
    values.extend([-1i64, i64::MAX, 1 << 32, 1 << 20].map(|number| json!(number)));
    values.extend([json!(0.5), json!(1e39), json!(null), json!(true), json!([]), json!({})]);
    values.extend(
        ["", "SCALAR", "VEC2", "VEC3", "VEC4", "MAT4", "2.1", "9.0", "/dev/zero"].map(|t| json!(t)),
    );
    let mut paths = Vec::new();
    collect(&document, String::new(), &mut paths);
    let mut variants = Vec::new();
    for path in paths {
        for value in &values {
            let mut changed = document.clone();
            *changed.pointer_mut(&path).expect("a path of the document") = value.clone();
            variants.push(changed.to_string().into_bytes());
        }
        let mut without = document.clone();
        let (parent, name) = path.rsplit_once('/').expect("a path");
        match without.pointer_mut(parent) {
            Some(Value::Object(members)) => _ = members.remove(name),
            Some(Value::Array(list)) => _ = list.remove(name.parse().expect("an index")),
            _ => {}
        }
        variants.push(without.to_string().into_bytes());
    }
    variants
}

fn collect(value: &Value, path: String, paths: &mut Vec<String>) {
    if !path.is_empty() {
        paths.push(path.clone());
    }
    match value {
        Value::Object(members) => {
            members
                .iter()
                .for_each(|(name, value)| collect(value, format!("{path}/{name}"), paths));
        }
        Value::Array(list) => {
            let numbered = list.iter().enumerate();
            numbered.for_each(|(k, value)| collect(value, format!("{path}/{k}"), paths));
        }
        _ => {}
    }
}
