//! `tess check --rules`: a device's listings, judged by what a standard demands.

use crate::campaign::Recorder;
use crate::campaign::report::{First, Part};
use crate::failure::{Exit, Failure};
use crate::output::{progress, stdout};
use indicatif::ProgressBar;
use std::io::{BufRead, Write};
use std::path::Path;
use tess_verify::names::Named;
use tess_verify::rules::{Checker, Row, RulesReport, Specification, Verdict};
use tess_verify::vectors::{Kind, Record, VectorError, VectorFile};

/// Judges every listing of a file and prints the verdicts.
///
/// # Errors
/// A file that is malformed, truncated or too long, or has no listings.
pub(super) fn run<R: BufRead>(
    file: VectorFile<R>,
    specification: Specification,
    recorder: &Recorder,
) -> Result<Exit, Failure> {
    let kind = file.header().kind;
    if kind != Kind::Listings {
        return Err(Failure::bad_input(format!(
            "--rules judges listings; this file's kind is {}: write them with --format listing",
            kind.name()
        )));
    }
    let bar = file.header().count.map_or_else(ProgressBar::hidden, |n| progress(n, "records"));
    let mut checker = Checker::new(specification);
    for record in file {
        match record.map_err(|error: VectorError| Failure::bad_input(error.to_string()))? {
            Record::Listing(listing) => checker.add(&listing.case, &listing.output),
            Record::Coordinates(vertices) => checker.add(&vertices.case, &vertices.output()),
            _ => {}
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let report = checker.report();
    recorder.update(|record| record.add_parts(parts("listings", &report)));
    show(&report)
}

/// The rules of a report as parts of a run: how many patches each judged and how many of them break it.
pub(crate) fn parts(tested: &str, report: &RulesReport) -> Vec<Part> {
    let part = |row: &Row| {
        let first = row.smallest.as_ref().map(|example| {
            let cases: Vec<String> = example.cases.iter().map(ToString::to_string).collect();
            First { case: Some(cases.join("\n")), difference: example.what.clone() }
        });
        let name = format!("{tested} {}", row.rule.name());
        Part { name, cases: row.judged, mismatches: row.broken, first }
    };
    report.rows.iter().map(part).collect()
}

/// Prints a report; different if a rule is broken.
///
/// # Errors
/// It cannot be written.
pub(crate) fn show(report: &RulesReport) -> Result<Exit, Failure> {
    let written = stdout().and_then(|mut out| {
        write!(out, "{report}")?;
        out.flush()
    });
    written.map_err(|error| Failure::write(Path::new("-"), error))?;
    let is_broken = report.count(Verdict::Broken) > 0;
    Ok(if is_broken { Exit::Different } else { Exit::Done })
}
