//! The verdict by the rules of a standard.

use crate::campaign::Recorder;
use crate::campaign::report::{First, ReportPart};
use crate::failure::{Exit, Failure};
use crate::output::stdout;
use std::fmt::Display;
use std::io::Write;
use std::path::Path;
use tess_verify::Named;
use tess_verify::check::Known;
use tess_verify::rules::{RuleRow, RulesReport};

/// Prints a report and adds each rule to the run's report: the number of patches that it judged,
/// and of those that break it. The result is `Different` if a rule is broken, unless it is known to
/// be broken this often.
///
/// # Errors
/// Stdout cannot be written.
pub(crate) fn conclude(
    tested: &str,
    report: &RulesReport,
    known: &Known,
    recorder: &Recorder,
) -> Result<Exit, Failure> {
    print(report)?;
    let mut exit = Exit::Done;
    for row in &report.rows {
        let (name, RuleRow { broken, judged, .. }) = (row.rule.name(), row);
        let is_known = known.excuses_rule(row.rule, *broken);
        if is_known {
            print(&format!("known: {name} is broken {broken} times\n"))?;
        } else if *broken > 0 {
            exit = Exit::Different;
        }
        let first = row.smallest.as_ref().map(|example| {
            let cases: Vec<String> = example.cases.iter().map(ToString::to_string).collect();
            let difference = example.what.clone();
            First { case: Some(cases.join("\n")), difference, ..First::default() }
        });
        let (name, mismatches) = (format!("{tested} {name}"), if is_known { 0 } else { *broken });
        let part =
            ReportPart { name, cases: *judged, mismatches, first: first.filter(|_| !is_known) };
        recorder.update(|record| record.add_part(part));
    }
    Ok(exit)
}

/// Prints a part of the result.
///
/// # Errors
/// Stdout cannot be written.
pub(crate) fn print(what: &impl Display) -> Result<(), Failure> {
    let mut out = stdout();
    let written = write!(out, "{what}").and_then(|()| out.flush());
    written.map_err(|error| Failure::write(Path::new("-"), error))
}
