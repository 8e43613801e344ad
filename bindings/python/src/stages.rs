//! Single numbers of one stage: contexts and placements.

use crate::errors::argument;
use crate::names::{named, whole};
use crate::strength::one_of;
use crate::values;
use pyo3::prelude::*;
use tess_core::fixed_point::ONE;
use tess_core::{
    Config, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning, Patch, SplitOrder,
    TriangleFactors,
};

/// The context of a 15.16 factor. Errors: an unknown name, or a factor that factor processing never
/// produces with this parity.
pub(crate) fn factor_context(
    factor: u32,
    parity: &str,
    split_order: &str,
) -> PyResult<(SplitOrder, FactorContext)> {
    let (parity, split) = (named::<Parity>(parity)?, named::<SplitOrder>(split_order)?);
    let (in_range, range) = match parity {
        Parity::Odd => ((ONE..=63 * ONE).contains(&factor), "0x010000..0x3f0000 if odd"),
        Parity::Even => (
            factor == ONE || (2 * ONE..=64 * ONE).contains(&factor),
            "0x010000 or 0x020000..0x400000 if even",
        ),
    };
    if !in_range {
        return Err(argument(format!("the 15.16 factor {factor:#08x} is none of {range}")));
    }
    Ok((split, FactorContext::new(FixedFactor::from_bits(factor), parity, split)))
}

/// Computes the context of a factor (specification, section 4), a :class:`FactorContext`.
///
/// ``factor`` is a 15.16 number as an integer: 1..63 if ``parity`` is ``odd``, 1 or 2..64 if
/// ``parity`` is ``even``.
///
/// >>> import tess_model
/// >>> tess_model.context(0x28000, "odd").points  # factor 2.5
/// 4
#[pyfunction]
#[pyo3(signature = (factor, parity, split_order = "ruler"))]
pub(crate) fn context<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = whole)] factor: u32,
    parity: &str,
    split_order: &str,
) -> PyResult<Bound<'py, PyAny>> {
    values::context(py, &factor_context(factor, parity, split_order)?.1)
}

/// Processes one factor (specification, section 3). Returns a :class:`ProcessedFactor`, or ``None``
/// if the factor culls the patch: an outer factor that is NaN or not greater than 0.
///
/// Args:
///     factor: The raw factor, rounded to the nearest binary32.
///     partitioning, split: As for :class:`Patch`.
///     role: ``outer`` or ``inside``: the factor ``u0`` or ``inside`` of a triangle patch whose
///         other factors are 3.
///
/// >>> import tess_model
/// >>> tess_model.process_factor(2.5, "fractional_odd").fixed
/// 163840
#[pyfunction]
#[pyo3(signature = (factor, partitioning = "integer", *, role = "outer", split = "ruler"))]
#[expect(clippy::cast_possible_truncation, reason = "to the nearest binary32, as documented")]
pub(crate) fn process_factor<'py>(
    py: Python<'py>,
    factor: f64,
    partitioning: &str,
    role: &str,
    split: &str,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let position = one_of("role", role, &[("outer", 0), ("inside", 3)])?;
    let (partitioning, split) = (named::<Partitioning>(partitioning)?, named(split)?);
    let config = Config { partitioning, output: OutputPrimitive::Point, split };
    let raw = factor as f32;
    let mut factors = [3.0; 4];
    factors[position] = raw;
    let patch = Patch::new(config, TriangleFactors::from(factors));
    let processed = patch.processed().factors().and_then(|all| all.iter().nth(position));
    let name = TriangleFactors::<f32>::NAMES[position];
    processed.map(|factor| values::processed(py, name, raw, &factor)).transpose()
}

/// Computes the location of point ``p`` of an edge, with every step (specification, section 5): a
/// :class:`Placement`.
///
/// ``factor`` and ``parity`` are those of :func:`context`; ``p`` is less than the context's
/// ``points``.
///
/// >>> import tess_model
/// >>> tess_model.place(0x28000, "odd", 1)  # doctest: +NORMALIZE_WHITESPACE
/// Placement(flip=False, position=1, blend=Blend(coarse=0, fine=21845, fraction=49152),
/// half_location=16384, location=16384)
#[pyfunction]
#[pyo3(signature = (factor, parity, p, split_order = "ruler"))]
pub(crate) fn place<'py>(
    py: Python<'py>,
    #[pyo3(from_py_with = whole)] factor: u32,
    parity: &str,
    #[pyo3(from_py_with = whole)] p: u32,
    split_order: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let (_, context) = factor_context(factor, parity, split_order)?;
    values::placement(py, &placed(&context, p)?)
}

/// The placement of point `p` of an edge. Errors: the edge has no such point.
pub(crate) fn placed(context: &FactorContext, p: u32) -> PyResult<tess_core::place::Placement> {
    if p >= context.points {
        let points = context.points;
        let message = format!("there is no point {p}: the edge has {points} points, from 0");
        return Err(crate::errors::no_such_element(message));
    }
    Ok(tess_core::place::placement(context, p))
}
