//! Reads files of reports.

use crate::campaign::report::Report;
use crate::failure::Failure;
use crate::input;
use std::io;
use std::path::{Path, PathBuf};

/// The largest size of one file in bytes. A hundred thousand reports have about 100 MB.
const MAX_BYTES: u64 = 1 << 28;

/// A report, and its file.
#[derive(Clone, Debug)]
pub(super) struct FoundReport {
    pub(super) place: String,
    pub(super) report: Report,
}

/// The contents of the files.
#[derive(Debug, Default)]
pub(super) struct Reports {
    pub(super) reports: Vec<FoundReport>,
    /// The files that do not exist.
    pub(super) absent: Vec<PathBuf>,
}

/// Reads every report of the files. Errors: a file that cannot be read, is too long, or has a line
/// that is not a report; the message names the file and the line.
pub(super) fn reports(paths: &[PathBuf]) -> Result<Reports, Failure> {
    let mut all = Reports::default();
    for path in paths {
        match input::text(path, MAX_BYTES) {
            Ok(text) => all.reports.extend(lines(path, &text)?),
            Err(error) if error.kind() == io::ErrorKind::NotFound => all.absent.push(path.clone()),
            Err(error) => return Err(Failure::file("read", path, &error)),
        }
    }
    Ok(all)
}

fn lines(path: &Path, text: &str) -> Result<Vec<FoundReport>, Failure> {
    let name = input::name(path);
    let mut found = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let report = Report::parse(line)
            .map_err(|error| Failure::bad_input(format!("{name}:{number}: {error}")))?;
        found.push(FoundReport { place: name.clone(), report });
    }
    if found.is_empty() {
        return Err(Failure::bad_input(format!(
            "{name}:1: the file is empty; a report is a line of JSON"
        )));
    }
    if found.len() > 1 {
        for (number, one) in (1..).zip(&mut found) {
            one.place = format!("{name}:{number}");
        }
    }
    Ok(found)
}
