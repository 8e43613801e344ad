//! Results: as objects for programs, as a table for people.
#![expect(clippy::float_arithmetic, reason = "units of measurements")]

use serde::Serialize;
use std::fmt::Write;

/// One line of results, with the keys that `--json` prints.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Row {
    pub(super) workload: String,
    pub(super) backend: &'static str,
    pub(super) level: String,
    pub(super) working_set: &'static str,
    pub(super) threads: u32,
    pub(super) index_type: &'static str,
    pub(super) patches_per_s: f64,
    pub(super) triangles_per_s: f64,
    pub(super) bytes_per_s: f64,
    pub(super) fill_ratio: f64,
    pub(super) core_ratio: f64,
}

/// A heading and one line for each row; rates in millions and in GB (10^9 bytes).
#[must_use]
pub(crate) fn table(rows: &[Row]) -> String {
    let mut text = String::new();
    if let Some(row) = rows.first() {
        // Writing to a String does not fail.
        _ = writeln!(
            text,
            "backend {} ({}), threads {}, {} indices",
            row.backend, row.level, row.threads, row.index_type
        );
    }
    _ = writeln!(
        text,
        "{:<34} {:<6} {:>12} {:>13} {:>8} {:>8} {:>8}",
        "workload", "set", "Mpatches/s", "Mtriangles/s", "GB/s", "of fill", "of core"
    );
    for row in rows {
        _ = writeln!(
            text,
            "{:<34} {:<6} {:>12.4} {:>13.1} {:>8.2} {:>8.4} {:>8.2}",
            row.workload,
            row.working_set,
            row.patches_per_s / 1e6,
            row.triangles_per_s / 1e6,
            row.bytes_per_s / 1e9,
            row.fill_ratio,
            row.core_ratio
        );
    }
    text
}
