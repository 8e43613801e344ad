//! The rules that a standard has for the output of a tessellator.

use crate::errors::{self, argument, file_format};
use crate::names::named;
use crate::signals::{self, Watch};
use crate::values;
use crate::vectors::{device_answers, open};
use pyo3::prelude::*;
use pyo3::types::{PyString, PyTuple};
use std::path::PathBuf;
use tess_verify::Named;
use tess_verify::check::CheckError;
use tess_verify::rules::{Checker, RuleRow, RulesReport, Specification};
use tess_verify::vectors::{Kind, Record};

/// Judges outputs by the rules of a standard, without the model (docs/rules.md).
///
/// Args:
///     answers: As for :func:`check_device`, or the path of a file of listings.
///     specification: ``vulkan``, ``opengl`` or ``d3d11``.
///
/// Returns:
///     A :class:`RulesReport`.
///
/// ``generate(rules=True, split="ruler")`` makes patches that exercise every rule.
///
/// >>> from tess_model import Patch, check_rules
/// >>> patch = Patch.from_bits("isoline", [0x3f800000, 0x40400001], partitioning="fractional_odd", output="line")
/// >>> report = check_rules([(patch, patch.points, patch.indices)], "vulkan")
/// >>> report.rule("segments").verdict, report.rule("segments").example.what
/// ('broken', 'line 0 has 3 segments, its level 3.0000002 asks for 5')
#[pyfunction]
pub(crate) fn check_rules<'py>(
    py: Python<'py>,
    answers: &Bound<'py, PyAny>,
    specification: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let specification = named::<Specification>(specification)?;
    let is_path = answers.is_instance_of::<PyString>() || answers.hasattr("__fspath__")?;
    let found = if is_path {
        let path: PathBuf = answers.extract()?;
        signals::interruptible(py, move |stop| of_file(open(&path, stop)?.0, specification))??
    } else {
        let answers = device_answers(answers)?;
        let mut watch = Watch::default();
        let answers = answers.into_iter().take_while(|_| watch.goes_on());
        let mut checker = Checker::new(specification);
        py.detach(|| answers.for_each(|(case, output)| checker.add(&case, &output)));
        watch.finish()?;
        checker.report()
    };
    report(py, &found)
}

fn of_file(file: crate::vectors::Reader, specification: Specification) -> PyResult<RulesReport> {
    if file.header().kind != Kind::Listings {
        return Err(errors::check(CheckError::NoListings(file.header().kind)));
    }
    let mut checker = Checker::new(specification);
    for record in file {
        match record.map_err(file_format)? {
            Record::Listing(listing) => checker.add(&listing.case, &listing.output),
            Record::Coordinates(vertices) => checker.add(&vertices.case, &vertices.output()),
            _ => return Err(argument("a listing is expected")),
        }
    }
    Ok(checker.report())
}

fn report<'py>(py: Python<'py>, found: &RulesReport) -> PyResult<Bound<'py, PyAny>> {
    let rows: Vec<_> = found.rows.iter().map(|one| row(py, one)).collect::<PyResult<_>>()?;
    let rows = PyTuple::new(py, rows)?;
    let elements = (found.specification.name(), found.patches, rows, found.to_string());
    values::value(py, "RulesReport", elements)
}

fn row<'py>(py: Python<'py>, row: &RuleRow) -> PyResult<Bound<'py, PyAny>> {
    let example = row.smallest.as_ref().map(|example| {
        let cases = PyTuple::new(py, example.cases.iter().map(ToString::to_string))?;
        values::value(py, "RuleExample", (cases, &example.what))
    });
    let (rule, verdict) = (row.rule.name(), row.verdict().name());
    let not_asked = PyTuple::new(py, row.asked.missing())?;
    let (judged, broken) = (row.judged, row.broken);
    let elements = (rule, row.source, verdict, judged, broken, example.transpose()?, not_asked);
    values::value(py, "RuleRow", elements)
}
