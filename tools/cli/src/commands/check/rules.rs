//! `tess check --rules`: a device's listings, judged by what a standard demands.

use crate::campaign::Recorder;
use crate::campaign::report::{First, Part};
use crate::failure::{Exit, Failure};
use crate::output::{progress, stdout};
use indicatif::ProgressBar;
use std::fmt::{self, Display, Formatter};
use std::io::{BufRead, Write};
use std::path::Path;
use tess_core::Tessellation;
use tess_verify::check::{ListOrder, Strength};
use tess_verify::rules::{Checker, RuleRow, RulesReport, Specification, Verdict};
use tess_verify::vectors::{Kind, Record, VectorError, VectorFile};
use tess_verify::{Case, Named};

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
    let (mut checker, mut beside) = (Checker::new(specification), BesideModel::default());
    let mut judge = |case: &Case, output: &Tessellation| {
        checker.add(case, output);
        beside.add(case, output);
    };
    for record in file {
        match record.map_err(|error: VectorError| Failure::bad_input(error.to_string()))? {
            Record::Listing(listing) => judge(&listing.case, &listing.output),
            Record::Coordinates(vertices) => judge(&vertices.case, &vertices.output()),
            _ => {}
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let report = checker.report();
    recorder.update(|record| record.add_parts(parts("listings", &report)));
    let ended = show(&report)?;
    print(&beside)?;
    Ok(ended)
}

/// How patches compare with the model, vertex by vertex. No standard but Direct3D's asks for its order.
#[derive(Default)]
struct BesideModel {
    equal: u64,
    reordered: u64,
    different: u64,
}

impl BesideModel {
    fn add(&mut self, case: &Case, observed: &Tessellation) {
        let expected = case.patch().tessellate();
        let is_equal =
            |order| Strength { order, ..Strength::default() }.equal(case, observed, &expected);
        if is_equal(ListOrder::Sequence) {
            self.equal += 1;
        } else if is_equal(ListOrder::Any) {
            self.reordered += 1;
        } else {
            self.different += 1;
        }
    }
}

impl Display for BesideModel {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { equal, reordered, different } = self;
        writeln!(
            f,
            "patches beside the model: {equal} equal, {reordered} in another order, {different} different"
        )
    }
}

/// The rules of a report as parts of a run: how many patches each judged and how many of them break it.
pub(crate) fn parts(tested: &str, report: &RulesReport) -> Vec<Part> {
    let part = |row: &RuleRow| {
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
    print(report)?;
    let is_broken = report.rows.iter().any(|row| row.verdict() == Verdict::Broken);
    Ok(if is_broken { Exit::Different } else { Exit::Done })
}

fn print(what: &impl Display) -> Result<(), Failure> {
    let mut out = stdout();
    let written = write!(out, "{what}").and_then(|()| out.flush());
    written.map_err(|error| Failure::write(Path::new("-"), error))
}
