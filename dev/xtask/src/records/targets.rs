//! Speeds that the project aims at: `benches/targets.json`.

use super::Row;
use super::rates::{RATES, digits, number};
use crate::command::workspace;
use serde::Deserialize;
use serde_json::Value;
use std::fs;

/// The least value of one key in the rows of one workload.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Target {
    pub(super) backend: String,
    pub(super) workload: String,
    pub(super) working_set: String,
    /// A key of `tess bench --json`.
    pub(super) key: String,
    pub(super) at_least: f64,
}

/// Reads all targets.
pub(super) fn read() -> Result<Vec<Target>, String> {
    let path = workspace().join("benches/targets.json");
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let targets: Vec<Target> =
        serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
    match targets.iter().find(|target| RATES.iter().all(|rate| rate.key != target.key)) {
        Some(target) => Err(format!("{}: no row has the key {}", path.display(), target.key)),
        None => Ok(targets),
    }
}

/// The targets of this row; they hold for 32-bit indices on one thread.
pub(super) fn of<'a>(targets: &'a [Target], row: &Row) -> Vec<&'a Target> {
    let is = |key: &str, value: &str| row.get(key).and_then(Value::as_str) == Some(value);
    let is_plain = !is("index_type", "u16") && row.get("threads").is_none_or(|n| *n == 1);
    let fits = |target: &&Target| {
        is("backend", &target.backend)
            && is("workload", &target.workload)
            && is("working_set", &target.working_set)
    };
    targets.iter().filter(|_| is_plain).filter(fits).collect()
}

/// Each target and whether the row reaches it.
#[expect(clippy::float_arithmetic, reason = "units of measurements")]
pub(super) fn shown(targets: &[&Target], row: &Row) -> String {
    let shown = targets.iter().filter_map(|target| {
        let rate = RATES.iter().find(|rate| rate.key == target.key)?;
        let verdict = match number(row, rate.key) {
            Some(value) if value >= target.at_least => "reached",
            Some(_) => "missed",
            None => "not recorded",
        };
        Some(format!("{} {}: {verdict}", digits(target.at_least / rate.unit), rate.title))
    });
    shown.collect::<Vec<_>>().join("; ")
}
