//! Reads files of reports.

use crate::campaign::report::Report;
use crate::failure::Failure;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The most bytes of one file: a thousand reports with coverage have 20 MB.
const MAX_BYTES: u64 = 1 << 28;

/// A report, and the file that it stands in.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) place: String,
    pub(super) report: Report,
}

/// What the files have.
#[derive(Debug, Default)]
pub(super) struct Reports {
    pub(super) reports: Vec<Found>,
    /// The files that are not there.
    pub(super) absent: Vec<PathBuf>,
}

/// Reads every report of the files.
///
/// # Errors
/// A file that cannot be read, is too long, or has a line that is no report; which, and the line.
pub(super) fn reports(paths: &[PathBuf]) -> Result<Reports, Failure> {
    let mut all = Reports::default();
    for path in paths {
        match text(path) {
            Ok(text) => all.reports.extend(lines(path, &text)?),
            Err(error) if error.kind() == io::ErrorKind::NotFound => all.absent.push(path.clone()),
            Err(error) => return Err(Failure::file("read", path, &error)),
        }
    }
    Ok(all)
}

fn text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    let read = match path.to_str() {
        Some("-") => io::stdin().take(MAX_BYTES + 1).read_to_string(&mut text)?,
        _ => File::open(path)?.take(MAX_BYTES + 1).read_to_string(&mut text)?,
    };
    if read as u64 > MAX_BYTES {
        return Err(io::Error::other(format!("it has more than {MAX_BYTES} bytes")));
    }
    Ok(text)
}

fn lines(path: &Path, text: &str) -> Result<Vec<Found>, Failure> {
    let name =
        if path.as_os_str() == "-" { "stdin".to_owned() } else { path.display().to_string() };
    let mut found = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let report = Report::parse(line)
            .map_err(|error| Failure::bad_input(format!("{name}:{number}: {error}")))?;
        found.push(Found { place: name.clone(), report });
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
