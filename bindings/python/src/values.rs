//! The named tuples of `python/tess_model/values.py`.

use pyo3::call::PyCallArgs;
use pyo3::prelude::*;
use tess_core::place::Placement;
use tess_core::{FactorContext, PointOrigin, PrimitiveOrigin, ProcessedFactor};
use tess_show::SignalDifference;
use tess_verify::Named;
use tess_verify::check::{Difference, Report};

/// A named tuple with these elements.
pub(crate) fn value<'py>(
    py: Python<'py>,
    name: &str,
    elements: impl PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    py.import("tess_model.values")?.getattr(name)?.call1(elements)
}

pub(crate) fn context<'py>(py: Python<'py>, c: &FactorContext) -> PyResult<Bound<'py, PyAny>> {
    let parity = c.parity.name();
    let elements =
        (parity, c.inv_floor, c.inv_ceil, c.fraction, c.half_points, c.split_position, c.points);
    value(py, "FactorContext", elements)
}

/// A factor by its name and raw value after factor processing.
pub(crate) fn processed<'py>(
    py: Python<'py>,
    name: &str,
    raw: f32,
    factor: &ProcessedFactor,
) -> PyResult<Bound<'py, PyAny>> {
    let ProcessedFactor { clamped, rounded, fixed, context } = factor;
    let elements =
        (name, raw.to_bits(), clamped, rounded, fixed.to_bits(), self::context(py, context)?);
    value(py, "ProcessedFactor", elements)
}

pub(crate) fn placement<'py>(py: Python<'py>, placed: &Placement) -> PyResult<Bound<'py, PyAny>> {
    let Placement { flip, position, blend, half_location, location } = *placed;
    let blend = blend.map(|blend| value(py, "Blend", (blend.coarse, blend.fine, blend.fraction)));
    value(py, "Placement", (flip, position, blend.transpose()?, half_location, location.to_bits()))
}

pub(crate) fn point_origin(py: Python<'_>, origin: PointOrigin) -> PyResult<Bound<'_, PyAny>> {
    let none = None::<u32>;
    let elements = match origin {
        PointOrigin::Corner { corner } => ("corner", none, none, none, corner),
        PointOrigin::Line { line, p } => ("line", Some(line), none, none, p),
        PointOrigin::OuterEdge { edge, p } => ("outer_edge", none, none, Some(edge), p),
        PointOrigin::Ring { ring, edge, p } => ("ring", none, Some(ring), Some(edge), p),
        PointOrigin::Centre { p } => ("centre", none, none, none, p),
    };
    value(py, "PointOrigin", elements)
}

pub(crate) fn primitive_origin(
    py: Python<'_>,
    origin: PrimitiveOrigin,
) -> PyResult<Bound<'_, PyAny>> {
    use PrimitiveOrigin as Origin;
    let none = None::<u32>;
    let elements = match origin {
        Origin::Sequence { step } => ("sequence", none, none, none, step),
        Origin::Line { line, segment } => ("line", Some(line), none, none, segment),
        Origin::Minimum { step } => ("minimum", none, none, none, step),
        Origin::Transition { edge, step } => ("transition", none, none, Some(edge), step),
        Origin::Ring { ring, edge, step } => ("ring", none, Some(ring), Some(edge), step),
        Origin::Centre { step } => ("centre", none, none, none, step),
    };
    value(py, "PrimitiveOrigin", elements)
}

pub(crate) fn signal_difference<'py>(
    py: Python<'py>,
    found: &SignalDifference,
) -> PyResult<Bound<'py, PyAny>> {
    let elements = (found.signal.stage, found.signal.name, found.observed, found.expected);
    value(py, "SignalDifference", elements)
}

pub(crate) fn report<'py>(py: Python<'py>, report: &Report) -> PyResult<Bound<'py, PyAny>> {
    let differences: Vec<_> =
        report.differences.iter().map(|one| difference(py, one)).collect::<PyResult<_>>()?;
    let differences = pyo3::types::PyTuple::new(py, differences)?;
    value(py, "Report", (report.cases, report.mismatches, differences))
}

fn difference<'py>(py: Python<'py>, found: &Difference) -> PyResult<Bound<'py, PyAny>> {
    let mismatch = &found.mismatch;
    let elements = (
        found.number,
        found.line,
        found.case.map(|case| case.to_string()),
        mismatch.element.to_string(),
        &mismatch.observed,
        &mismatch.expected,
        mismatch.stage.to_string(),
        found.to_string(),
    );
    value(py, "Difference", elements)
}
