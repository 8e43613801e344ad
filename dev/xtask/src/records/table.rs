//! A record as a Markdown table.
#![expect(clippy::float_arithmetic, reason = "units of measurements")]

use super::rates::{Column, RATES, digits, number};
use super::targets::{self, Target};
use super::{Record, Row};
use serde_json::Value;

/// The command, where and when it ran, and its rows.
pub(super) fn block(record: &Record, targets: &[Target]) -> String {
    let Record { command, machine, date, commit, .. } = record;
    let head = format!("    {command}\n\n{machine}; {date}, commit {commit}.\n\n");
    let (titles, rows) = match record.columns.is_empty() {
        true => bench(record, targets),
        false => as_printed(record),
    };
    let mut text = head + &line(&titles) + &line(&vec!["---".to_owned(); titles.len()]);
    for row in &rows {
        text += &line(row);
    }
    text
}

fn line(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}

/// Rows of `tess bench`: what all rows share stands in the first column's title; targets follow.
fn bench(record: &Record, targets: &[Target]) -> (Vec<String>, Vec<Vec<String>>) {
    let present =
        |column: &&Column| record.rows.iter().any(|row| number(row, column.key).is_some());
    let columns: Vec<&Column> = RATES.iter().filter(present).collect();
    let has_target = record.rows.iter().any(|row| !targets::of(targets, row).is_empty());
    let mut titles = vec!["workload".to_owned()];
    titles.extend(columns.iter().map(|column| column.title.to_owned()));
    titles.extend(has_target.then(|| "target".to_owned()));
    let cells = |row: &Row| {
        let mut cells = vec![name(row, record)];
        cells.extend(columns.iter().map(|column| {
            number(row, column.key).map_or_else(String::new, |value| digits(value / column.unit))
        }));
        cells.extend(has_target.then(|| targets::shown(&targets::of(targets, row), row)));
        cells
    };
    (titles, record.rows.iter().map(cells).collect())
}

/// A row's workload, and of the settings those that differ among the rows.
fn name(row: &Row, record: &Record) -> String {
    let varies = |key: &str| record.rows.iter().any(|other| other.get(key) != row.get(key));
    let settings = ["working_set", "threads", "index_type", "level"];
    let mut name = text(row, "workload");
    for key in settings.into_iter().filter(|key| varies(key)) {
        let what = if key == "threads" { " threads" } else { "" };
        name += &format!(", {}{what}", text(row, key));
    }
    name
}

/// Rows of other programs, as they printed them.
fn as_printed(record: &Record) -> (Vec<String>, Vec<Vec<String>>) {
    let titles = record.columns.iter().map(|column| column.replace('_', " ")).collect();
    let cells = |row: &Row| record.columns.iter().map(|column| text(row, column)).collect();
    (titles, record.rows.iter().map(cells).collect())
}

/// A value without quotes; nothing for `null` or a key that is missing.
fn text(row: &Row, key: &str) -> String {
    match row.get(key) {
        Some(Value::String(text)) => text.clone(),
        None | Some(Value::Null) => String::new(),
        Some(other) => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn row(workload: &str, working_set: &str, fill_ratio: f64) -> Row {
        let row = json!({ "workload": workload, "backend": "simd", "working_set": working_set,
            "patches_per_s": 4.07e6, "fill_ratio": fill_ratio });
        row.as_object().expect("an object").clone()
    }

    #[test]
    fn a_table_names_what_varies_and_whether_targets_are_reached() {
        let record = Record {
            command: "tess bench".into(),
            machine: "a machine".into(),
            date: "2026-01-02".into(),
            commit: "abc".into(),
            columns: vec![],
            rows: vec![row("worst", "cache", 0.5), row("worst", "stream", 1.25)],
        };
        let target = |working_set: &str, at_least| Target {
            backend: "simd".into(),
            workload: "worst".into(),
            working_set: working_set.into(),
            key: "fill_ratio".into(),
            at_least,
        };
        let block = block(&record, &[target("cache", 0.45), target("stream", 1.3)]);
        let expected = "    tess bench\n\na machine; 2026-01-02, commit abc.\n\n\
            | workload | M patches/s | of fill | target |\n| --- | --- | --- | --- |\n\
            | worst, cache | 4.07 | 0.5 | 0.45 of fill: reached |\n\
            | worst, stream | 4.07 | 1.25 | 1.3 of fill: missed |\n";
        assert_eq!(block, expected, "a table");
    }
}
