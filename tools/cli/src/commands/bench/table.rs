//! Results: as objects for programs, and as a table for people.
#![expect(clippy::float_arithmetic, reason = "units of measurements")]

use super::runner::Description;
use crate::args::name_in;
use crate::backends::INDEX_WIDTHS;
use crate::output::json;
use serde::Serialize;

/// One row of results, with the keys of `--json`.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct BenchRow {
    pub(super) workload: String,
    pub(super) backend: &'static str,
    pub(super) level: String,
    pub(super) working_set: String,
    pub(super) threads: u32,
    pub(super) index_type: &'static str,
    pub(super) patches_per_s: f64,
    pub(super) triangles_per_s: f64,
    pub(super) bytes_per_s: f64,
    pub(super) fill_ratio: f64,
    pub(super) core_ratio: f64,
}

/// The lines above the rows: the timed backend and the columns. Rates are in millions and in GB
/// (10^9 bytes).
pub(crate) fn heading(description: &Description) -> String {
    let Description { backend, level, threads, .. } = description;
    format!(
        "backend {backend} ({level}), threads {threads}, {} indices\n\
         {:<34} {:<6} {:>12} {:>13} {:>8} {:>8} {:>8}\n",
        name_in(INDEX_WIDTHS, &description.index_type),
        "workload",
        "set",
        "Mpatches/s",
        "Mtriangles/s",
        "GB/s",
        "of fill",
        "of core"
    )
}

impl BenchRow {
    /// One line of the table.
    pub(crate) fn line(&self) -> String {
        format!(
            "{:<34} {:<6} {:>12.4} {:>13.1} {:>8.2} {:>8.4} {:>8.2}\n",
            self.workload,
            self.working_set,
            self.patches_per_s / 1e6,
            self.triangles_per_s / 1e6,
            self.bytes_per_s / 1e9,
            self.fill_ratio,
            self.core_ratio
        )
    }

    /// The row as an element of a JSON array.
    pub(crate) fn json(&self) -> String {
        let object = json(self);
        let lines: Vec<_> = object.lines().map(|line| format!("  {line}")).collect();
        lines.join("\n")
    }
}
