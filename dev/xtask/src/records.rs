//! Measurements as data: `benches/records/NAME.json`, described in the README beside them.

mod chart;
pub(crate) mod performance;
mod rates;
mod table;
pub(crate) mod take;
mod targets;

use crate::command::workspace;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::fs;
use std::path::PathBuf;

/// One object of `tess bench --json`, or of another program that measures.
type Row = Map<String, Value>;

/// The rows that one command printed on one machine.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    /// The command, as it is typed in the workspace's folder.
    command: String,
    /// Processor or device, and what else decides the speed.
    machine: String,
    /// Day of the measurement, `YYYY-MM-DD`.
    date: String,
    /// Commit that was measured.
    commit: String,
    /// Keys of the rows in the order of the table; empty for the rows of `tess bench`.
    #[serde(default)]
    columns: Vec<String>,
    rows: Vec<Row>,
}

impl Record {
    /// The file: a line for each key and for each row.
    fn text(&self) -> String {
        let Self { command, machine, date, commit, columns, rows } = self;
        let text = [("command", command), ("machine", machine), ("date", date), ("commit", commit)];
        let mut lines =
            text.map(|(key, text)| format!("  {}: {}", json!(key), json!(text))).to_vec();
        if !columns.is_empty() {
            lines.push(format!("  \"columns\": {}", json!(columns)));
        }
        let rows: Vec<String> = rows.iter().map(|row| format!("    {}", json!(row))).collect();
        lines.push(format!("  \"rows\": [\n{}\n  ]", rows.join(",\n")));
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}

/// The folder of the records.
fn folder() -> PathBuf {
    workspace().join("benches/records")
}

/// The file of the record with this name.
fn file(name: &str) -> PathBuf {
    folder().join(format!("{name}.json"))
}

/// Reads the record with this name.
///
/// # Errors
/// There is none, or the file has another form.
fn read(name: &str) -> Result<Record, String> {
    let path = file(name);
    let shown = path.display();
    let text = fs::read_to_string(&path).map_err(|error| format!("{shown}: {error}"))?;
    let record: Record =
        serde_json::from_str(&text).map_err(|error| format!("{shown}: {error}"))?;
    if record.rows.is_empty() {
        return Err(format!("{shown}: no rows"));
    }
    Ok(record)
}

/// The names of all records, in alphabetical order.
fn names() -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder()).map_err(|error| error.to_string())?;
    let name = |entry: Result<fs::DirEntry, _>| {
        let name = entry.ok()?.file_name().into_string().ok()?;
        Some(name.strip_suffix(".json")?.to_owned())
    };
    let mut names: Vec<String> = entries.filter_map(name).collect();
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_as_they_are_written() {
        for name in names().expect("names") {
            let text = fs::read_to_string(file(&name)).expect("text");
            assert!(read(&name).expect("record").text() == text, "{name}: another layout");
        }
    }
}
